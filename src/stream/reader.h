/* Reads LCM's encoding from untrusted bytes. LCM's own decoders allocate and copy by counts that they do not check, so
   messages are read here, field by field, without access beyond their end. The first problem is kept; reads after it
   return 0. Internal to src/stream and src/control. */
#ifndef SB_STREAM_READER_H
#define SB_STREAM_READER_H

#include "stream/decode.h"

typedef struct sb_message_reader {
    const unsigned char *at;
    size_t left;
    const char *problem; /* static text, NULL: none */
} sb_message_reader;

/* Begins a message of this type, which has at most `most` bytes, and reads its fingerprint and version. */
sb_message_reader sb_reader_begin(const void *buffer, size_t size, size_t most, int64_t fingerprint);
/* SB_BAD_INPUT with the problem, or because bytes are left over. type: the message in the error's text. */
sb_status sb_reader_end(sb_message_reader *in, const char *type, size_t size, sb_error *error);

void sb_reader_refuse(sb_message_reader *in, const char *problem);

/* Returns the next `bytes` bytes, or NULL. */
const unsigned char *sb_reader_bytes(sb_message_reader *in, size_t bytes);
int8_t sb_reader_int8(sb_message_reader *in);
int32_t sb_reader_int32(sb_message_reader *in);
int64_t sb_reader_int64(sb_message_reader *in);
/* Refuse a number that is not finite. */
double sb_reader_double(sb_message_reader *in);
void sb_reader_doubles(sb_message_reader *in, double *out, size_t count);
void sb_reader_floats(sb_message_reader *in, float *out, size_t count);
void sb_reader_int32s(sb_message_reader *in, int32_t *out, size_t count);
/* A name of at most 63 bytes. Bytes that are not printable ASCII become '?': names are printed on terminals. */
void sb_reader_name(sb_message_reader *in, char name[SB_STREAM_NAME]);
/* The same for a text of at most size - 1 bytes. */
void sb_reader_text(sb_message_reader *in, char *text, size_t size);
/* A count from 0 to most. */
int32_t sb_reader_count(sb_message_reader *in, int32_t most, const char *problem);
/* A count that must equal `expected`. */
void sb_reader_same(sb_message_reader *in, int64_t expected, const char *problem);
sb_message_head sb_reader_head(sb_message_reader *in);

#endif
