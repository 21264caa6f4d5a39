/* Writes frames as particle files for ParaView. */
#include "app/consumers.h"
#include "output/vtp.h"

#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <unistd.h>

static void name_of(uint64_t number, char name[64])
{
    snprintf(name, 64, "particles/%06" PRIu64 ".vtp", number);
}

/* Writes the list before files are removed, so that it never names a file that does not exist. */
static sb_status start_list(const sb_recorder *recorder, sb_error *error)
{
    char list[SB_PATH_MAX];
    sb_status status = sb_path_join(list, recorder->directory, "particles.pvd", error);
    if (status == SB_OK && recorder->count > 0) return sb_pvd_write(&recorder->pvd, list, error);
    if (status == SB_OK && unlink(list) != 0 && errno != ENOENT)
        return sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", list, strerror(errno));
    return status;
}

static sb_status open_recorder(void *state, sb_error *error)
{
    const sb_recorder *recorder = state;
    char folder[SB_PATH_MAX];
    sb_status status = sb_make_folder(folder, recorder->directory, "particles", error);
    if (status == SB_OK) status = start_list(recorder, error);
    return status == SB_OK ? sb_remove_numbered(folder, ".vtp", recorder->count, error) : status;
}

static sb_status record(void *state, const sb_frame *frame, sb_error *error)
{
    sb_recorder *recorder = state;
    char name[64], path[SB_PATH_MAX], list[SB_PATH_MAX];
    const uint64_t number = recorder->count + 1;
    name_of(number, name);
    sb_status status = sb_path_join(path, recorder->directory, name, error);
    if (status == SB_OK) status = sb_path_join(list, recorder->directory, "particles.pvd", error);
    if (status == SB_OK) status = sb_vtp_write(path, frame, number, error);
    if (status != SB_OK) return status;
    status = sb_pvd_add(&recorder->pvd, list, frame->status.time, name, error);
    if (status != SB_OK) (void)unlink(path); /* the list does not name it */
    recorder->count += status == SB_OK;
    return status;
}

sb_status sb_recorder_sync(sb_recorder *recorder, sb_gone *gone, sb_error *error)
{
    char name[64] = "particles";
    const uint64_t first = recorder->synced;
    for (uint64_t number = first; number <= recorder->count && recorder->count > first; number++) {
        if (number > first) name_of(number, name); /* the first iteration syncs the folder */
        sb_status status = sb_written_sync(recorder->directory, name, gone, error);
        if (status != SB_OK) return status;
    }
    recorder->synced = recorder->count;
    return SB_OK;
}

void sb_recorder_save(const sb_recorder *recorder, sb_archive_out *out)
{
    sb_put_count(out, recorder->count);
    for (uint64_t i = 0; i < recorder->count; i++) sb_put_real(out, recorder->pvd.entries[i].time);
}

sb_status sb_recorder_load(sb_recorder *recorder, sb_archive_in *in, sb_error *error)
{
    const uint64_t count = sb_take_count(in, UINT32_MAX);
    sb_status status = SB_OK;
    sb_pvd_free(&recorder->pvd);
    recorder->count = recorder->synced = 0;
    while (status == SB_OK && recorder->count < count && in->error.status == SB_OK) {
        char name[64];
        name_of(++recorder->count, name);
        status = sb_pvd_note(&recorder->pvd, sb_take_real(in), name, error);
    }
    recorder->synced = recorder->count;
    return status;
}

static void close_recorder(void *state)
{
    sb_recorder *recorder = state;
    sb_pvd_free(&recorder->pvd);
}

sb_consumer_work sb_recorder_work(sb_recorder *recorder)
{
    return (sb_consumer_work){
        .name = "particle files", .state = recorder, .open = open_recorder, .handle = record, .close = close_recorder};
}
