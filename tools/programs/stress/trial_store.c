#include "trial_store.h"

#include "base/hash.h"
#include "origin.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

sb_status sb_trial_folder(const sb_store *store, const sb_job *job, char folder[SB_PATH_MAX], sb_error *error)
{
    int length = snprintf(folder, SB_PATH_MAX, "%s/runs/%s/%s", store->out, job->of->name, job->trial->name);
    return length < SB_PATH_MAX - 64 ? SB_OK : sb_fail(error, SB_BAD_INPUT, "%.400s: the path is too long", store->out);
}

/* Hash of a request: the scene's text, the files that it names, and all settings. */
static uint64_t request_hash(const sb_store *store, const sb_job *job)
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
    sb_record_text(folder, key, value, sizeof value);
    return value[0] && strtoull(value, NULL, 16) == wanted;
}

bool sb_trial_is_stored(const sb_store *store, const sb_job *job)
{
    char folder[SB_PATH_MAX];
    return sb_trial_folder(store, job, folder, NULL) == SB_OK && recalled(folder, "build", store->build) &&
           recalled(folder, "asked", request_hash(store, job));
}

sb_status sb_trial_write(const sb_store *store, const sb_job *job, const sb_outcome *o, sb_error *error)
{
    return sb_record_write(
        o->folder, SB_RECORD_NAME, error,
        "asked: %016" PRIx64 "\nbuild: %016" PRIx64 "\ncommit: %s\nhow: %u\nended: %s\nwall: %.3f\nsaid: %s\n",
        request_hash(store, job), store->build, store->commit, o->how, o->ended, o->wall, o->last_line);
}

/* Removes a folder from the paths in a message. */
static void shorten(char *text, const char *folder)
{
    const size_t length = strlen(folder);
    for (char *at; (at = strstr(text, folder)) && at[length] == '/';)
        memmove(at, at + length + 1, strlen(at + length + 1) + 1);
}

sb_outcome sb_trial_read(const sb_store *store, const sb_job *job)
{
    sb_outcome o = {0};
    if (sb_trial_folder(store, job, o.folder, NULL) != SB_OK || !recalled(o.folder, "asked", request_hash(store, job)))
        return o;
    o.there = true;
    o.how = (unsigned)sb_record_number(o.folder, "how");
    o.wall = sb_record_number(o.folder, "wall");
    sb_record_text(o.folder, "ended", o.ended, sizeof o.ended);
    sb_record_text(o.folder, "said", o.last_line, sizeof o.last_line);
    shorten(o.last_line, store->assets);
    shorten(o.last_line, o.folder);
    sb_record_text(o.folder, "commit", o.commit, sizeof o.commit);
    sb_outcome_read(&o);
    return o;
}
