/* Files of several ranks: checkpoints, which are one file, and pieces of particle files. */
#include "app/checkpoint/parts.h"
#include "app/cluster/orders.h"
#include "base/hash.h"
#include "mpi/world.h"
#include "output/particles/particle_format.h"
#include "output/particles/pvtp.h"

void sb_cluster_save(run *r, bool settling, sb_archive_out *out)
{
    r->cluster.out = out;
    (void)sb_cluster_order(r, &(order){.what = ORDER_SAVE, .flag = settling}, NULL);
}

sb_status sb_cluster_act_save(run *r, const order *given, sb_error *error)
{
    (void)error;
    sb_sim_save(r->sim, r->cluster.out);
    if (sb_cluster_leads(r) && given->flag == 0) sb_measure_save(r->measure, r->cluster.out);
    return SB_OK;
}

sb_status sb_cluster_load(run *r, bool settling, uint64_t step, sb_archive_in *in, sb_error *error)
{
    r->cluster.in = in;
    return sb_cluster_order(r, &(order){.what = ORDER_LOAD, .flag = settling, .number = step}, error);
}

static sb_status open_own(const run *r, const order *given, sb_archive_in *in, sb_error *error)
{
    char path[SB_PATH_MAX];
    const sb_status status = given->flag != 0 ? sb_checkpoint_settling_path(r, path, error)
                                              : sb_checkpoint_path(r, given->number, path, error);
    return status == SB_OK ? sb_archive_open(in, path, SB_CHECKPOINT_KIND, SB_CHECKPOINT_FORMAT, error) : status;
}

/* Fails unless each rank has opened a file of these contents. */
static sb_status compare_files(const run *r, const sb_archive_in *in, sb_error *error)
{
    uint64_t all[SB_RANKS_MAX];
    const uint64_t own = sb_hash(0, in->bytes, in->length);
    sb_ranks_gather(r->cluster.ranks, &own, sizeof own, all);
    for (int k = 1; k < r->cluster.ranks->count; k++)
        if (all[k] != all[0])
            return sb_fail(error, SB_FAILED, "%s: has other contents for rank %d on %s than for rank 0", in->name, k,
                           sb_world_host(r->cluster.ranks, k));
    return SB_OK;
}

sb_status sb_cluster_act_load(run *r, const order *given, sb_error *error)
{
    const bool several = sb_cluster_several(r);
    sb_archive_in own = {0}, *in = sb_cluster_leads(r) ? r->cluster.in : &own;
    sb_status status = sb_cluster_leads(r) ? SB_OK : open_own(r, given, &own, error);
    if (several) status = sb_world_agree(r->cluster.ranks, status, error);
    if (several && status == SB_OK) status = compare_files(r, in, error);
    if (status == SB_OK) {
        status = sb_sim_load(r->sim, in, error);
        if (status == SB_OK && given->flag == 0) status = sb_measure_load(r->measure, in, error);
        if (several) status = sb_world_agree(r->cluster.ranks, status, error);
    }
    sb_archive_in_free(&own);
    return status;
}

sb_status sb_cluster_act_pieces(run *r, const order *given, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_frame *frame = sb_sim_snapshot_own(r->sim);
    if (sb_cluster_leads(r)) {
        r->cluster.frame = frame;
        return SB_OK;
    }
    if (!frame) return sb_fail_memory(error, "a frame");
    sb_status status = sb_measure_fill_frame(r->measure, frame, error);
    if (status == SB_OK) status = sb_make_folder(folder, r->directory, SB_PARTICLE_FOLDER, error);
    if (status == SB_OK) status = sb_pvtp_write_piece(folder, r->cluster.ranks->rank, frame, given->number, error);
    sb_frame_release(frame);
    return status;
}
