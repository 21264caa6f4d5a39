#include "base/archive_ranks.h"

#include "base/hash.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PIECE = 1 << 18, SUMS = PIECE / sizeof(uint64_t) }; /* bytes, and checksums, in one message */

/* ---- the file ---- */

/* The archive's file, by which the others recognise it. */
typedef struct identity {
    bool known;
    uint64_t number, size; /* inode; bytes */
    char path[SB_PATH_MAX + 8];
} identity;

static identity identify(sb_archive_out *out)
{
    identity file = {.known = false};
    struct stat found;
    char *path = out->file.stream && !out->reason ? realpath(out->file.temporary, NULL) : NULL;
    if (path && strlen(path) < sizeof file.path && fflush(out->file.stream) == 0 && stat(path, &found) == 0) {
        file.known = true;
        file.number = (uint64_t)found.st_ino;
        file.size = (uint64_t)found.st_size;
        strcpy(file.path, path);
    }
    free(path);
    return file;
}

/* A host without a common file system has no such file, or one of its own. */
static bool is_here(const identity *file)
{
    struct stat found;
    return stat(file->path, &found) == 0 && S_ISREG(found.st_mode) && (uint64_t)found.st_ino == file->number &&
           (uint64_t)found.st_size == file->size;
}

void sb_archive_ranks_begin(sb_archive_ranks *lists, sb_ranks *ranks, sb_archive_out *out)
{
    identity file = {.known = false};
    *lists = (sb_archive_ranks){.ranks = ranks};
    if (!sb_ranks_several(ranks) || !ranks->transport->open) return;
    if (out) file = identify(out);
    sb_ranks_share(ranks, 0, &file, sizeof file);
    if (!file.known || sb_ranks_any(ranks, !is_here(&file))) return;
    const int reason = ranks->transport->open(ranks, file.path, &lists->file);
    if (!sb_ranks_any(ranks, reason != 0)) return;
    if (lists->file) (void)ranks->transport->close(lists->file);
    lists->file = NULL;
}

void sb_archive_ranks_end(sb_archive_ranks *lists, sb_archive_out *out)
{
    sb_ranks *ranks = lists->ranks;
    int32_t all[SB_RANKS_MAX];
    if (!lists->file) return;
    const int closed = ranks->transport->close(lists->file);
    const int32_t own = lists->reason ? lists->reason : closed;
    lists->file = NULL;
    sb_ranks_gather(ranks, &own, sizeof own, all);
    for (int r = 0; out && r < ranks->count; r++)
        if (all[r] != 0 && !out->reason) {
            out->reason = all[r];
            out->rank = r;
        }
}

/* ---- the parts of the ranks ---- */

/* Where a list goes on: the block that is being filled begins at byte `at` of the file, and has `filled` bytes. */
typedef struct place {
    uint64_t at, filled;
} place;

/* A rank's bytes: up to the end of a block that another rank began; whole blocks, at `at` of the file; and the rest. */
typedef struct part {
    size_t head, blocks, tail;
    uint64_t at;
} part;

/* before: bytes between the begin of the place's block and the part. */
static part divide(const sb_archive_ranks *lists, const place *begin, uint64_t before, size_t length)
{
    const uint64_t first = (before + SB_ARCHIVE_BLOCK - 1) / SB_ARCHIVE_BLOCK * SB_ARCHIVE_BLOCK;
    part p = {.head = length, .at = begin->at + first};
    if (!lists->file || first - before >= length) return p;
    p.head = (size_t)(first - before);
    p.blocks = (length - p.head) / SB_ARCHIVE_BLOCK;
    p.tail = length - p.head - p.blocks * SB_ARCHIVE_BLOCK;
    return p;
}

static void exchange(sb_ranks *ranks, int with, void *bytes, size_t size)
{
    const sb_parcel parcel = {with, bytes, size};
    const bool sends = ranks->rank > 0;
    sb_ranks_start(ranks, &parcel, sends, &parcel, !sends);
    sb_ranks_finish(ranks);
}

static void send_bytes(sb_ranks *ranks, char *bytes, size_t length)
{
    for (size_t at = 0; at < length; at += PIECE)
        exchange(ranks, 0, bytes + at, length - at < PIECE ? length - at : PIECE);
}

static void receive_bytes(sb_ranks *ranks, int from, size_t length, sb_archive_out *out)
{
    char piece[PIECE];
    for (size_t at = 0; at < length; at += PIECE) {
        const size_t size = length - at < PIECE ? length - at : PIECE;
        exchange(ranks, from, piece, size);
        sb_put_list_bytes(out, piece, size);
    }
}

static void send_sums(sb_ranks *ranks, const char *bytes, size_t blocks)
{
    uint64_t sums[SUMS];
    for (size_t done = 0; done < blocks; done += SUMS) {
        const size_t some = blocks - done < SUMS ? blocks - done : SUMS;
        for (size_t k = 0; k < some; k++) sums[k] = sb_hash(0, bytes + (done + k) * SB_ARCHIVE_BLOCK, SB_ARCHIVE_BLOCK);
        exchange(ranks, 0, sums, some * sizeof *sums);
    }
}

static void receive_sums(sb_ranks *ranks, int from, size_t blocks, sb_archive_out *out)
{
    uint64_t sums[SUMS];
    for (size_t done = 0; done < blocks; done += SUMS) {
        const size_t some = blocks - done < SUMS ? blocks - done : SUMS;
        exchange(ranks, from, sums, some * sizeof *sums);
        sb_put_blocks(out, sums, some);
    }
}

/* All ranks write at the same time; then rank 0 takes the rest from one after another. */
static void give_part(sb_archive_ranks *lists, const part *p, char *own)
{
    const sb_transport *transport = lists->ranks->transport;
    char *const whole = own + p->head;
    const size_t length = p->blocks * SB_ARCHIVE_BLOCK;
    if (p->blocks > 0 && !lists->reason) lists->reason = transport->write_at(lists->file, p->at, whole, length);
    send_bytes(lists->ranks, own, p->head);
    send_sums(lists->ranks, whole, p->blocks);
    send_bytes(lists->ranks, whole + length, p->tail);
}

static void take_part(sb_archive_ranks *lists, int from, const part *p, sb_archive_out *out)
{
    receive_bytes(lists->ranks, from, p->head, out);
    receive_sums(lists->ranks, from, p->blocks, out);
    receive_bytes(lists->ranks, from, p->tail, out);
}

static void begin_list(const uint64_t *counts, int ranks, size_t size, sb_archive_out *out, place *begin)
{
    uint64_t all = 0;
    for (int r = 0; r < ranks; r++) all += counts[r];
    sb_put_list_begin(out, all, size);
    *begin = (place){out->used, out->pending};
}

void sb_archive_ranks_list(sb_archive_ranks *lists, sb_archive_out *out, const uint64_t *counts, void *own, size_t size)
{
    sb_ranks *ranks = lists->ranks;
    const int count = sb_ranks_count(ranks), here = sb_ranks_own(ranks);
    place begin = {0};
    if (here == 0) begin_list(counts, count, size, out, &begin);
    if (lists->file) sb_ranks_share(ranks, 0, &begin, sizeof begin);
    uint64_t before = begin.filled;
    for (int r = 0; r < count; r++) {
        const size_t length = (size_t)counts[r] * size;
        const part p = divide(lists, &begin, before, length);
        before += length;
        if (here == 0 && r == 0)
            sb_put_list_bytes(out, own, length);
        else if (here == 0)
            take_part(lists, r, &p, out);
        else if (here == r)
            give_part(lists, &p, own);
    }
}
