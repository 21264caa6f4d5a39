/* Writes frames as particle files. */
#include "app/frames/consumers.h"
#include "output/particles/foam_files.h"
#include "output/particles/pvtp.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

/* The path of the list of files; empty if the format has none. */
static sb_status find_list(const sb_recorder *recorder, char path[SB_PATH_MAX], sb_error *error)
{
    char name[SB_PARTICLE_NAME_MAX];
    path[0] = '\0';
    if (!sb_particle_format_list(recorder->format, name)) return SB_OK;
    return sb_path_join(path, recorder->directory, name, error);
}

static sb_status write_list(const sb_recorder *recorder, sb_error *error)
{
    char list[SB_PATH_MAX];
    sb_status status = find_list(recorder, list, error);
    return status == SB_OK && *list ? recorder->format->write_list(list, &recorder->list, error) : status;
}

/* Writes the list before files are removed, so that it never names a file that does not exist. */
static sb_status start_list(const sb_recorder *recorder, sb_error *error)
{
    char list[SB_PATH_MAX];
    if (recorder->count > 0) return write_list(recorder, error);
    sb_status status = find_list(recorder, list, error);
    if (status == SB_OK && *list && unlink(list) != 0 && errno != ENOENT)
        return sb_fail(error, SB_FAILED, "%.500s: cannot remove: %s", list, strerror(errno));
    return status;
}

sb_status sb_recorder_clear_pieces(sb_recorder *recorder, sb_error *error)
{
    char folder[SB_PATH_MAX];
    if (recorder->format != &sb_particles_pvtp || recorder->cleared) return SB_OK;
    sb_status status = sb_path_join(folder, recorder->directory, SB_PARTICLE_FOLDER, error);
    if (status == SB_OK) status = sb_pvtp_remove_pieces(folder, recorder->count, error);
    recorder->cleared = status == SB_OK;
    return status;
}

static sb_status open_recorder(void *state, sb_error *error)
{
    sb_recorder *recorder = state;
    char folder[SB_PATH_MAX];
    sb_status status = sb_make_folder(folder, recorder->directory, SB_PARTICLE_FOLDER, error);
    if (status == SB_OK) status = start_list(recorder, error);
    if (status == SB_OK && recorder->foam)
        status = sb_foam_files_open(recorder->directory, &recorder->list, recorder->count, error);
    if (status == SB_OK && recorder->ranks == 1) status = sb_recorder_clear_pieces(recorder, error);
    return status == SB_OK ? sb_remove_numbered(folder, recorder->format->ending, recorder->count, error) : status;
}

/* Adds the file to the list and writes the list. On an error neither is done. */
static sb_status enter(sb_recorder *recorder, double time, const char *name, sb_error *error)
{
    sb_status status = sb_particle_list_add(&recorder->list, time, name, strlen(name), error);
    if (status != SB_OK) return status;
    status = write_list(recorder, error);
    if (status == SB_OK && recorder->foam) status = sb_foam_files_list(recorder->directory, &recorder->list, error);
    recorder->list.count -= status != SB_OK;
    return status;
}

uint64_t sb_recorder_next(const sb_recorder *recorder)
{
    return recorder->count + 1;
}

static sb_status record(void *state, const sb_frame *frame, sb_error *error)
{
    sb_recorder *recorder = state;
    char name[SB_PARTICLE_NAME_MAX], path[SB_PATH_MAX];
    const uint64_t number = sb_recorder_next(recorder);
    sb_particle_format_file(recorder->format, number, name);
    if (recorder->failure.status != SB_OK)
        return sb_fail(error, recorder->failure.status, "%s", recorder->failure.text);
    sb_status status = sb_path_join(path, recorder->directory, name, error);
    if (status == SB_OK && recorder->foam) status = sb_foam_files_write(recorder->directory, frame, number, error);
    if (status == SB_OK)
        status = recorder->ranks > 1 ? sb_pvtp_write(path, frame, number, recorder->ranks, error)
                                     : recorder->format->write(path, frame, number, error);
    if (status != SB_OK) return status;
    status = enter(recorder, frame->status.time, name, error);
    if (status != SB_OK) (void)unlink(path); /* the list does not name it */
    recorder->count += status == SB_OK;
    return status;
}

/* Syncs the pieces of a number, or, of number 0, the folders of the ranks. */
static sb_status sync_pieces(const sb_recorder *recorder, uint64_t number, sb_gone *gone, sb_error *error)
{
    char path[SB_PATH_MAX], folder[SB_PATH_MAX];
    sb_status status = SB_OK;
    for (int rank = 0; rank < recorder->ranks && status == SB_OK; rank++) {
        status = sb_pvtp_piece_path(SB_PARTICLE_FOLDER, rank, number, path, error);
        sb_path_folder(folder, path);
        if (status == SB_OK) status = sb_written_sync(recorder->directory, number == 0 ? folder : path, gone, error);
    }
    return status;
}

/* Syncs the files of a number, or, of number 0, the folders. */
static sb_status sync_one(const sb_recorder *recorder, uint64_t number, sb_gone *gone, sb_error *error)
{
    char name[SB_PARTICLE_NAME_MAX] = SB_PARTICLE_FOLDER, foam[SB_FOAM_NAME_MAX] = SB_FOAM_FOLDER;
    if (number > 0) {
        sb_particle_format_file(recorder->format, number, name);
        sb_foam_file(number, foam);
    }
    sb_status status = sb_written_sync(recorder->directory, name, gone, error);
    if (status == SB_OK && recorder->foam) status = sb_written_sync(recorder->directory, foam, gone, error);
    if (status == SB_OK && recorder->format == &sb_particles_pvtp) status = sync_pieces(recorder, number, gone, error);
    return status;
}

sb_status sb_recorder_sync(sb_recorder *recorder, sb_gone *gone, sb_error *error)
{
    const uint64_t first = recorder->synced;
    for (uint64_t number = first; number <= recorder->count && recorder->count > first; number++) {
        sb_status status = sync_one(recorder, number > first ? number : 0, gone, error);
        if (status != SB_OK) return status;
    }
    recorder->synced = recorder->count;
    return SB_OK;
}

void sb_recorder_save(const sb_recorder *recorder, sb_archive_out *out)
{
    sb_put_count(out, recorder->count);
    for (uint64_t i = 0; i < recorder->count; i++) sb_put_real(out, recorder->list.entries[i].time);
}

sb_status sb_recorder_load(sb_recorder *recorder, sb_archive_in *in, sb_error *error)
{
    const uint64_t count = sb_take_count(in, UINT32_MAX);
    sb_status status = SB_OK;
    sb_particle_list_free(&recorder->list);
    recorder->count = recorder->synced = 0;
    while (status == SB_OK && recorder->count < count && in->error.status == SB_OK) {
        char name[SB_PARTICLE_NAME_MAX];
        sb_particle_format_file(recorder->format, ++recorder->count, name);
        status = sb_particle_list_add(&recorder->list, sb_take_real(in), name, strlen(name), error);
    }
    recorder->synced = recorder->count;
    return status;
}

static void close_recorder(void *state)
{
    sb_recorder *recorder = state;
    sb_particle_list_free(&recorder->list);
}

sb_consumer_work sb_recorder_work(sb_recorder *recorder)
{
    return (sb_consumer_work){
        .name = "particle files", .state = recorder, .open = open_recorder, .handle = record, .close = close_recorder};
}
