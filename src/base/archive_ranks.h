/* Lists of an archive whose elements lie in several ranks, one rank after another. Rank 0 has the archive; the others
   give it to these functions as NULL. The file is that of one process, whoever writes its bytes. Together: all ranks
   call these functions in the same order. */
#ifndef SB_BASE_ARCHIVE_RANKS_H
#define SB_BASE_ARCHIVE_RANKS_H

#include "base/archive.h"
#include "base/ranks.h"

typedef struct sb_archive_ranks {
    sb_ranks *ranks;
    void *file; /* of the transport; NULL: rank 0 receives and writes all bytes */
    int reason; /* errno of this rank's first write that failed */
} sb_archive_ranks;

/* Lets each rank write the whole blocks of its elements into the archive's file, if the archive is on disk, the
   transport has files, and each rank finds this file under its name. Else the others send their bytes to rank 0. */
void sb_archive_ranks_begin(sb_archive_ranks *lists, sb_ranks *ranks, sb_archive_out *out);

/* Writes a list: counts[r] elements of `size` bytes of each rank r; own: those of this rank. */
void sb_archive_ranks_list(sb_archive_ranks *lists, sb_archive_out *out, const uint64_t *counts, void *own,
                           size_t size);

/* The bytes of all ranks are on disk then, or sb_archive_close fails with the rank and the reason. */
void sb_archive_ranks_end(sb_archive_ranks *lists, sb_archive_out *out);

#endif
