/* Frames into particle files for ParaView. */
#include "app/consumers.h"
#include "output/vtp.h"

static sb_status open_recorder(void *state, sb_error *error)
{
    const sb_recorder *recorder = state;
    char folder[SB_PATH_MAX];
    sb_status status = sb_path_join(folder, recorder->directory, "particles", error);
    if (status == SB_OK)
        status = sb_make_directories(folder, error);
    return status == SB_OK ? sb_remove_numbered(folder, ".vtp", error) : status;
}

static sb_status record(void *state, const sb_frame *frame, sb_error *error)
{
    sb_recorder *recorder = state;
    char name[64], path[SB_PATH_MAX], list[SB_PATH_MAX];
    snprintf(name, sizeof name, "particles/%06llu.vtp", (unsigned long long)recorder->count + 1);
    sb_status status = sb_path_join(path, recorder->directory, name, error);
    if (status == SB_OK)
        status = sb_path_join(list, recorder->directory, "particles.pvd", error);
    if (status == SB_OK)
        status = sb_vtp_write(path, frame, error);
    if (status == SB_OK)
        status = sb_pvd_add(&recorder->pvd, list, frame->status.time, name, error);
    recorder->count += status == SB_OK;
    return status;
}

static void close_recorder(void *state)
{
    sb_recorder *recorder = state;
    sb_pvd_free(&recorder->pvd);
}

sb_consumer_work sb_recorder_work(sb_recorder *recorder)
{
    return (sb_consumer_work){"particle files", recorder, open_recorder, record, close_recorder};
}
