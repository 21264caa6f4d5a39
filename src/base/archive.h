/* A file of named sections of plain values, each under a checksum: written whole or not at all, read only when
   every byte is as it was written. Every value carries its kind and every list its length, so that reading out of
   step, or bytes made up by someone else, end in a refusal.

   Layout, little-endian: kind (8 bytes), version and 0x01020304 (32 bits each); then sections of name (8 bytes),
   length, checksum (64 bits each) and content; the last is named "end" and is empty. The checksum runs over the name,
   the content by blocks of SB_ARCHIVE_BLOCK bytes, and the length. */
#ifndef SB_BASE_ARCHIVE_H
#define SB_BASE_ARCHIVE_H

#include "base/file.h"
#include "base/status.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SB_ARCHIVE_NAME = 8,     /* most characters in a kind and in a section's name */
    SB_ARCHIVE_BLOCK = 16384 /* bytes */
};

/* ---- writing ---- */

/* In the making: in memory, or on its way into a file, of which no more than a block is held. Zero-initialised is
   empty; may be begun anew, its memory is kept. */
typedef struct sb_archive_out {
    sb_atomic_file file;  /* its stream is NULL: in memory */
    unsigned char *bytes; /* in memory: all blocks so far */
    size_t used;          /* bytes so far, the one in hand left out */
    size_t capacity;      /* of bytes */
    size_t section;       /* where the open section's head lies; 0: none is open */
    uint64_t sum;         /* of the open section's blocks so far */
    int reason;           /* errno of the first failure, told at the end */
    size_t in_hand;       /* bytes of the block that is being filled */
    unsigned char block[SB_ARCHIVE_BLOCK];
} sb_archive_out;

/* In memory: once closed, bytes and used are the whole archive. */
void sb_archive_begin(sb_archive_out *out, const char *kind, uint32_t version);
/* On disk: beside `path`, renamed when closed. SB_FAILED names path and reason. */
sb_status sb_archive_create(sb_archive_out *out, const char *path, const char *kind, uint32_t version, sb_error *error);
/* What follows belongs to this section, until the next. */
void sb_archive_section(sb_archive_out *out, const char *name);

void sb_put_count(sb_archive_out *out, uint64_t value);
void sb_put_real(sb_archive_out *out, double value);
void sb_put_flag(sb_archive_out *out, bool value);
void sb_put_vector(sb_archive_out *out, sb_vec3 value);
/* count elements of size bytes, as they lie in memory. */
void sb_put_list(sb_archive_out *out, const void *items, size_t count, size_t size);
void sb_put_text(sb_archive_out *out, const char *text);

/* Ends it; a file is then on disk, synced and renamed. SB_FAILED says why that, or anything on the way, could not be:
   there is no file then, and one of that name from before stays. */
sb_status sb_archive_close(sb_archive_out *out, sb_error *error);
/* Gives up what is not closed. */
void sb_archive_out_free(sb_archive_out *out);

/* ---- reading ---- */

/* Zero-initialised is empty. The first value that is not as asked for is kept as the error; from then on all
   reads give zeros. */
typedef struct sb_archive_in {
    char name[256];     /* of the file, for messages */
    unsigned char *own; /* freed by sb_archive_in_free; NULL: borrowed */
    const unsigned char *bytes;
    size_t length;
    char section[SB_ARCHIVE_NAME + 1];
    size_t at, end; /* of the section being read */
    sb_error error;
} sb_archive_in;

/* Reads the file and proves it whole. SB_BAD_INPUT: unreadable, another kind or version, cut short, damaged. */
sb_status sb_archive_open(sb_archive_in *in, const char *path, const char *kind, uint32_t version, sb_error *error);
/* The same for bytes in memory, which must outlive it; `name` stands in messages. */
sb_status sb_archive_parse(sb_archive_in *in, const char *name, const void *bytes, size_t length, const char *kind,
                           uint32_t version, sb_error *error);
void sb_archive_in_free(sb_archive_in *in);

/* The following reads are of this section, from its start. SB_BAD_INPUT when there is none. */
sb_status sb_archive_enter(sb_archive_in *in, const char *name, sb_error *error);
/* After the section's last value: SB_BAD_INPUT when a read failed, or when something is left over; SB_FAILED when
   memory ran out. */
sb_status sb_archive_leave(sb_archive_in *in, sb_error *error);

/* At most `most`. */
uint64_t sb_take_count(sb_archive_in *in, uint64_t most);
double sb_take_real(sb_archive_in *in);
bool sb_take_flag(sb_archive_in *in);
sb_vec3 sb_take_vector(sb_archive_in *in);
/* A list of exactly this shape into items; zeros when it has another. */
void sb_take_list(sb_archive_in *in, void *items, size_t count, size_t size);
/* How many elements the list that comes next has, when of `size` bytes each and at most `most`; else 0. */
size_t sb_take_length(sb_archive_in *in, size_t size, size_t most);
/* A copy to free with sb_free; NULL when there is no text, or no memory: then the error is SB_FAILED. */
char *sb_take_text(sb_archive_in *in);

/* Keeps "<file>: <section>: <what is wrong>" as the error, unless there is one: for values that make no sense. */
void sb_archive_refuse(sb_archive_in *in, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
