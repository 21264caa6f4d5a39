#include "app/cluster/join.h"

#include "app/check/team.h"
#include "app/checkpoint/build.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"
#include "mpi/starter.h"
#include "mpi/world.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static sb_ranks *joined; /* for `end`, which a transport calls without knowing more */

static _Noreturn void end(const char *line)
{
    fprintf(stderr, "shorebreak: %s\n", line);
    fflush(NULL);
    sb_world_abort(joined);
    _exit(SB_FAILED);
}

sb_status sb_cluster_join(const sb_options *options, sb_status own, sb_ranks **ranks, sb_error *error)
{
    sb_error reason = {0};
    if (own != SB_OK && sb_world_started_count() <= 1) return own;
    const sb_status status = sb_world_join(options->rank_deadline, end, ranks, &reason);
    joined = *ranks;
    if (joined) sb_team_share(sb_world_sharing(joined));
    if (status == SB_OK) return own == SB_OK ? SB_OK : sb_cluster_compare(joined, options, own, error);
    if (own == SB_OK) *error = reason;
    return own == SB_OK ? status : own;
}

/* What must be the same in all ranks. */
typedef struct identity {
    uint64_t scene, options;   /* hashes: of the file's text; of what the command line changes of it */
    char build[SB_BUILD_TEXT]; /* with processor and library */
} identity;

static uint64_t hash_options(const sb_options *options)
{
    sb_running_hash hash = {0};
    if (options->preset) sb_hash_add(&hash, options->preset, strlen(options->preset) + 1);
    for (size_t i = 0; i < options->override_count; i++) {
        sb_hash_add(&hash, options->overrides[i].key, strlen(options->overrides[i].key) + 1);
        sb_hash_add(&hash, options->overrides[i].value, strlen(options->overrides[i].value) + 1);
    }
    const int flags = options->resume + 2 * options->overwrite + 4 * options->mixed;
    sb_hash_add(&hash, &flags, sizeof flags);
    return sb_hash_sum(&hash);
}

static sb_status identify(const sb_options *options, identity *own, sb_error *error)
{
    enum { LIMIT = 1 << 30 }; /* bytes; the scene was read with a stricter limit */
    char *text = NULL;
    size_t length = 0;
    const sb_status status = sb_file_read(options->positional, LIMIT, &text, &length, error);
    if (status != SB_OK) return status;
    *own = (identity){.scene = sb_hash(0, text, length), .options = hash_options(options)};
    sb_build_numerics(own->build);
    sb_free(text);
    return SB_OK;
}

static sb_status compare(const sb_ranks *ranks, const sb_options *options, const identity *all, sb_error *error)
{
    bool warned = false;
    for (int k = 1; k < ranks->count; k++) {
        const char *host = sb_world_host(ranks, k);
        if (all[k].scene != all[0].scene)
            return sb_fail(error, SB_BAD_INPUT, "%.500s: rank %d on %s reads another text than rank 0 on %s",
                           options->positional, k, host, sb_world_host(ranks, 0));
        if (all[k].options != all[0].options)
            return sb_fail(error, SB_BAD_INPUT,
                           "rank %d on %s has other options than rank 0, expected the same command line", k, host);
        if (strcmp(all[k].build, all[0].build) == 0) continue;
        if (!options->mixed)
            return sb_fail(
                error, SB_BAD_INPUT,
                "rank %d on %s computes other bits than rank 0: (%.300s) instead of (%.300s); to run anyway, "
                "with bits that depend on the ranks, add --mixed",
                k, host, all[k].build, all[0].build);
        if (ranks->rank == 0 && !warned)
            fprintf(stderr,
                    "shorebreak: warning: rank %d on %s is of another build or processor than rank 0: the bits depend "
                    "on the ranks\n",
                    k, host);
        warned = true;
    }
    return SB_OK;
}

sb_status sb_cluster_compare(sb_ranks *ranks, const sb_options *options, sb_status own, sb_error *error)
{
    identity mine = {0};
    if (!ranks) return own;
    if (own == SB_OK) own = identify(options, &mine, error);
    own = sb_world_agree(ranks, own, error);
    if (own != SB_OK) return own;
    identity *all = sb_alloc((size_t)ranks->count, sizeof *all);
    own = sb_world_agree(ranks, all ? SB_OK : sb_fail_memory(error, "the ranks"), error);
    if (own == SB_OK) {
        sb_ranks_gather(ranks, &mine, sizeof mine, all);
        own = compare(ranks, options, all, error);
    }
    sb_free(all);
    return own;
}
