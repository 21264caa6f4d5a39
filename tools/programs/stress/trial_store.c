#include "trial_store.h"

#include "base/hash.h"
#include "origin.h"
#include "record.h"

#include <errno.h>
#include <ftw.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

sb_status sb_trial_store_open(sb_trial_store *store, const char *out, const char *program, const char *own,
                              const char *source, sb_error *error)
{
    char assets[SB_PATH_MAX];
    *store = (sb_trial_store){0};
    sb_status status = sb_make_directories(out, error);
    if (status != SB_OK) return status;
    if (!realpath(out, store->out)) return sb_fail(error, SB_FAILED, "%.400s: %s", out, strerror(errno));
    if (!realpath(program, store->program) || access(store->program, X_OK) != 0)
        return sb_fail(error, SB_BAD_INPUT, "%.400s: no such program", program);
    status = sb_path_join(assets, source, "assets/stress", error);
    if (status != SB_OK) return status;
    if (!realpath(assets, store->assets)) return sb_fail(error, SB_BAD_INPUT, "%.400s: %s", assets, strerror(errno));
    status = sb_hash_file(store->program, &store->build, error);
    if (status == SB_OK) status = sb_hash_file(own, &store->build, error);
    sb_origin_commit(source, store->commit);
    sb_origin_machine(store->machine);
    return status;
}

sb_status sb_trial_store_folder(const sb_trial_store *store, const sb_job *job, char folder[SB_PATH_MAX],
                                sb_error *error)
{
    int length = snprintf(folder, SB_PATH_MAX, "%s/runs/%s/%s", store->out, job->of->name, job->trial->name);
    return length < SB_PATH_MAX - 64 ? SB_OK : sb_fail(error, SB_BAD_INPUT, "%.400s: the path is too long", store->out);
}

uint64_t sb_trial_store_request_hash(const sb_trial_store *store, const sb_job *job)
{
    const sb_trial *t = job->trial;
    char path[SB_PATH_MAX];
    sb_scene scene = {0};
    uint64_t hash = (uint64_t)t->kind;
    if (sb_path_join(path, store->assets, t->scene, NULL) == SB_OK) sb_hash_file(path, &hash, NULL);
    hash = sb_hash(hash, &t->number, sizeof t->number);
    for (size_t i = 0; i < t->setting_count; i++) hash = sb_hash(hash, t->settings[i], strlen(t->settings[i]));
    if (sb_trial_scene(t, store->assets, &scene, NULL) == SB_OK)
        for (size_t b = 0; b < scene.body_count; b++)
            if (scene.bodies[b].file) sb_hash_file(scene.bodies[b].file, &hash, NULL);
    sb_scene_free(&scene);
    return hash;
}

static bool recalled(const char *folder, const char *key, uint64_t wanted)
{
    char value[64];
    sb_record_recall(folder, key, value, sizeof value);
    return value[0] && strtoull(value, NULL, 16) == wanted;
}

bool sb_trial_store_has(const sb_trial_store *store, const sb_job *job)
{
    char folder[SB_PATH_MAX];
    return sb_trial_store_folder(store, job, folder, NULL) == SB_OK && recalled(folder, "build", store->build) &&
           recalled(folder, "asked", sb_trial_store_request_hash(store, job));
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)kind;
    (void)where;
    return remove(path);
}

sb_status sb_trial_store_clear(const char *folder, sb_error *error)
{
    if (access(folder, F_OK) == 0 && nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS) != 0)
        return sb_fail(error, SB_FAILED, "%.400s: %s", folder, strerror(errno));
    return sb_make_directories(folder, error);
}

sb_status sb_trial_store_write(const sb_trial_store *store, const sb_job *job, const sb_outcome *o, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open_in(&file, o->folder, SB_RECORD_NAME, error);
    if (status != SB_OK) return status;
    fprintf(file.stream, "asked: %016" PRIx64 "\nbuild: %016" PRIx64 "\ncommit: %s\n",
            sb_trial_store_request_hash(store, job), store->build, store->commit);
    fprintf(file.stream, "how: %u\nended: %s\nwall: %.3f\nsaid: %s\n", o->how, o->ended, o->wall, o->last_line);
    return sb_atomic_commit(&file, 0, error);
}

/* Removes a folder from the paths in a message. */
static void shorten(char *text, const char *folder)
{
    const size_t length = strlen(folder);
    for (char *at; (at = strstr(text, folder)) && at[length] == '/';)
        memmove(at, at + length + 1, strlen(at + length + 1) + 1);
}

sb_outcome sb_trial_store_read(const sb_trial_store *store, const sb_job *job)
{
    sb_outcome o = {0};
    char value[64];
    if (sb_trial_store_folder(store, job, o.folder, NULL) != SB_OK ||
        !recalled(o.folder, "asked", sb_trial_store_request_hash(store, job)))
        return o;
    o.there = true;
    sb_record_recall(o.folder, "how", value, sizeof value);
    o.how = (unsigned)strtoul(value, NULL, 10);
    sb_record_recall(o.folder, "wall", value, sizeof value);
    o.wall = strtod(value, NULL);
    sb_record_recall(o.folder, "ended", o.ended, sizeof o.ended);
    sb_record_recall(o.folder, "said", o.last_line, sizeof o.last_line);
    shorten(o.last_line, store->assets);
    shorten(o.last_line, o.folder);
    sb_record_recall(o.folder, "commit", o.commit, sizeof o.commit);
    sb_outcome_read(&o);
    return o;
}
