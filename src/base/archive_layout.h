/* Layout of an archive, shared by archive_write.c and archive_read.c. Internal to src/base. */
#ifndef SB_BASE_ARCHIVE_LAYOUT_H
#define SB_BASE_ARCHIVE_LAYOUT_H

#include "base/archive.h"
#include "base/hash.h"

#include <assert.h>

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "archives are little-endian");

#define SB_ARCHIVE_ORDER 0x01020304u
#define SB_ARCHIVE_END "end"

enum {
    SB_ARCHIVE_HEAD = SB_ARCHIVE_NAME + 8,
    SB_SECTION_HEAD = SB_ARCHIVE_NAME + 16 /* name, length, checksum */
};

/* The byte that precedes each value and states its kind. */
enum { SB_VALUE_COUNT = 'c', SB_VALUE_REAL = 'r', SB_VALUE_FLAG = 'f', SB_VALUE_LIST = 'l' };

/* Checksum of the section whose head and content begin at `head`. */
static inline uint64_t sb_archive_sum(const unsigned char *head, uint64_t length)
{
    const unsigned char *content = head + SB_SECTION_HEAD;
    uint64_t sum = sb_hash(0, head, SB_ARCHIVE_NAME);
    for (uint64_t at = 0; at < length; at += SB_ARCHIVE_BLOCK) {
        const uint64_t block =
            sb_hash(0, content + at, length - at < SB_ARCHIVE_BLOCK ? length - at : SB_ARCHIVE_BLOCK);
        sum = sb_hash(sum, &block, sizeof block);
    }
    return sb_hash(sum, &length, sizeof length);
}

#endif
