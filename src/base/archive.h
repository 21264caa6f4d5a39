/* A file of named sections that contain plain values. Each section has a checksum. A file is written whole or not at
   all, and is read only if every byte is as it was written. Every value is stored with its kind and every list with its
   length, so that a reader that is out of step with the writer, or a forged file, ends in an error.

   Layout, little-endian: kind (8 bytes), version and 0x01020304 (32 bits each); then sections of name (8 bytes),
   length, checksum (64 bits each) and content. The last section is named "end" and is empty. The checksum covers the
   name, the checksum of each block of SB_ARCHIVE_BLOCK bytes of the content, and the length: blocks may be written, and
   their checksums computed, by several processes. */
#ifndef SB_BASE_ARCHIVE_H
#define SB_BASE_ARCHIVE_H

#include "base/file.h"
#include "base/status.h"
#include "base/vec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    SB_ARCHIVE_NAME = 8,     /* largest number of characters in a kind and in a section's name */
    SB_ARCHIVE_BLOCK = 16384 /* bytes */
};

/* ---- writing ---- */

/* An archive that is being written: to memory, or to a file, of which at most one block is in memory. A
   zero-initialised struct is empty. An archive may be begun again; its memory is reused. */
typedef struct sb_archive_out {
    sb_atomic_file file;  /* its stream is NULL when the archive is in memory */
    unsigned char *bytes; /* all blocks so far, when the archive is in memory */
    size_t used;          /* number of bytes so far, without the block that is being filled */
    size_t capacity;      /* of bytes */
    size_t section;       /* position of the open section's head; 0: no section is open */
    uint64_t sum;         /* checksum of the open section's blocks so far */
    int reason;           /* errno of the first failure; sb_archive_close reports it */
    int rank;             /* of base/archive_ranks.h, in which it failed */
    size_t pending;       /* bytes in the block that is being filled */
    unsigned char block[SB_ARCHIVE_BLOCK];
} sb_archive_out;

/* Begins an archive in memory. After sb_archive_close, `bytes` and `used` contain the whole archive. */
void sb_archive_begin(sb_archive_out *out, const char *kind, uint32_t version);
/* Begins an archive on disk, in a temporary file that sb_archive_close renames to `path`. SB_FAILED names path and
   reason. */
sb_status sb_archive_create(sb_archive_out *out, const char *path, const char *kind, uint32_t version, sb_error *error);
/* Begins a section. The values that follow belong to it until the next section begins. */
void sb_archive_section(sb_archive_out *out, const char *name);

void sb_put_count(sb_archive_out *out, uint64_t value);
void sb_put_real(sb_archive_out *out, double value);
void sb_put_flag(sb_archive_out *out, bool value);
void sb_put_vector(sb_archive_out *out, sb_vec3 value);
/* Writes count elements of size bytes each, with the bytes that they have in memory. */
void sb_put_list(sb_archive_out *out, const void *items, size_t count, size_t size);
/* The same list in pieces: begins one of count elements; adds bytes to it until all elements are there. */
void sb_put_list_begin(sb_archive_out *out, size_t count, size_t size);
void sb_put_list_bytes(sb_archive_out *out, const void *bytes, size_t length);
void sb_put_text(sb_archive_out *out, const char *text);
/* Adds whole blocks of a list to an archive on disk at the end of a block, out->pending = 0: their checksums. The
   caller lets their bytes be written into the file from out->used on. */
void sb_put_blocks(sb_archive_out *out, const uint64_t *sums, size_t count);

/* Ends the archive. A file is then on disk, synced and renamed. SB_FAILED names the reason why this step or an earlier
   write failed: no new file is left, and an older file of that name stays. */
sb_status sb_archive_close(sb_archive_out *out, sb_error *error);
/* Discards an archive that is not closed, and frees the memory. */
void sb_archive_out_free(sb_archive_out *out);

/* ---- reading ---- */

/* An archive that is being read. A zero-initialised struct is empty. The first value that differs from what the reader
   expects is stored as the error; all reads after it return zeros. */
typedef struct sb_archive_in {
    char name[256];     /* of the file, for messages */
    unsigned char *own; /* the bytes that sb_archive_in_free frees; NULL: the caller owns them */
    const unsigned char *bytes;
    size_t length;
    char section[SB_ARCHIVE_NAME + 1];
    size_t at, end; /* position in the section being read, and its end */
    sb_error error;
} sb_archive_in;

/* Reads the file and verifies all checksums. SB_BAD_INPUT: there is no such file, it is of another kind or version, it
   is truncated or damaged. SB_FAILED: the system cannot read it at the moment. */
sb_status sb_archive_open(sb_archive_in *in, const char *path, const char *kind, uint32_t version, sb_error *error);
/* The same for bytes in memory, which must stay valid while `in` is used. Messages contain `name`. */
sb_status sb_archive_parse(sb_archive_in *in, const char *name, const void *bytes, size_t length, const char *kind,
                           uint32_t version, sb_error *error);
void sb_archive_in_free(sb_archive_in *in);

/* Starts reading this section from its first value. SB_BAD_INPUT if the archive has no such section. */
sb_status sb_archive_enter(sb_archive_in *in, const char *name, sb_error *error);
/* Ends reading a section. SB_BAD_INPUT if a read failed or if bytes are left over; SB_FAILED if memory ran out. */
sb_status sb_archive_leave(sb_archive_in *in, sb_error *error);

/* Reads a count that is at most `most`. */
uint64_t sb_take_count(sb_archive_in *in, uint64_t most);
double sb_take_real(sb_archive_in *in);
bool sb_take_flag(sb_archive_in *in);
sb_vec3 sb_take_vector(sb_archive_in *in);
/* Reads a list of exactly count elements of size bytes into items. Any other list is an error and fills items with
   zeros. */
void sb_take_list(sb_archive_in *in, void *items, size_t count, size_t size);
/* Returns the elements of such a list where they are, which is not aligned, while the archive is there; NULL: an error.
 */
const void *sb_take_list_place(sb_archive_in *in, size_t count, size_t size);
/* Returns the number of elements of the next list without reading it. A list whose elements are not of `size` bytes, or
   that has more than `most` elements, is an error and gives 0. */
size_t sb_take_length(sb_archive_in *in, size_t size, size_t most);
/* Reads a text into a copy that the caller frees with sb_free. NULL if the next value is not a text, or if memory runs
   out: the error is then SB_FAILED. */
char *sb_take_text(sb_archive_in *in);

/* Stores "<file>: section "<section>": <message>" as the error, unless there already is an error. For a caller that
   finds an invalid value. */
void sb_archive_refuse(sb_archive_in *in, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
