#include "request.h"

#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"
#include "origin.h"

#include <stdio.h>
#include <string.h>

const char *sb_request_preset(const sb_request *request)
{
    return request->preset ? request->preset : "default";
}

void sb_request_settings(const sb_request *request, sb_settings *settings)
{
    *settings = (sb_settings){0};
    snprintf(settings->resolution, sizeof settings->resolution, "%s=%.9g",
             request->of->grid ? "offshore.cell" : "resolution", request->plan->resolution);
    snprintf(settings->seed, sizeof settings->seed, "numerics.seed=%d", request->seed);
    settings->list[settings->count++] = settings->resolution;
    settings->list[settings->count++] = settings->seed;
    settings->list[settings->count++] = "output.plots=false";
    for (const char *const *more = request->plan->settings; more && *more && settings->count < SB_SETTINGS_MAX - 2;
         more++)
        settings->list[settings->count++] = *more;
    if (request->change[0]) settings->list[settings->count++] = request->change;
    if (!request->replays) return;
    snprintf(settings->record, sizeof settings->record, "sea.file=%s/record.csv", request->replays);
    settings->list[settings->count++] = settings->record;
}

void sb_request_label(const sb_request *request, bool with_case, char label[96])
{
    char seed[32] = "";
    if (request->seed != 1) snprintf(seed, sizeof seed, ", seed %d", request->seed);
    const char *variant = request->plan->variant ? request->plan->variant : "";
    snprintf(label, 96, "%s%s%.6g m%s%s%s%s%s%s%s", with_case ? request->of->name : "", with_case ? ", " : "",
             request->plan->resolution, variant[0] ? ", " : "", variant, request->preset ? ", " : "",
             request->preset ? request->preset : "", seed, request->change[0] ? ", " : "", request->change);
}

sb_status sb_settings_scene(const char *path, const char *preset, const char *const *settings, size_t count,
                            sb_scene *scene, sb_error *error)
{
    sb_override overrides[SB_SETTINGS_MAX];
    char keys[SB_SETTINGS_MAX][256];
    for (size_t i = 0; i < count; i++) {
        const char *equals = strchr(settings[i], '=');
        if (!equals) return sb_fail(error, SB_BAD_INPUT, "%.400s: %s: expected KEY=VALUE", path, settings[i]);
        snprintf(keys[i], sizeof keys[i], "%.*s", (int)(equals - settings[i]), settings[i]);
        overrides[i] = (sb_override){.key = keys[i], .value = equals + 1};
    }
    return sb_scene_read(path, preset, overrides, count, scene, error);
}

/* Reads the scene with all settings; continues the hash over the settings. */
static sb_status read_scene(const sb_request *request, const char *path, sb_scene *scene, uint64_t *hash,
                            sb_error *error)
{
    sb_settings settings;
    const char *preset = sb_request_preset(request);
    sb_request_settings(request, &settings);
    *hash = sb_hash(*hash, preset, strlen(preset));
    const size_t named = settings.count - (request->replays ? 1 : 0);
    for (size_t i = 0; i < named; i++) *hash = sb_hash(*hash, settings.list[i], strlen(settings.list[i]));
    return sb_settings_scene(path, preset, settings.list, settings.count, scene, error);
}

/* The files of the given water and of the depth-averaged model. */
static sb_status hash_sea(const sb_scene *scene, uint64_t *hash, sb_error *error)
{
    sb_status status = scene->given.file ? sb_hash_file(scene->given.file, hash, error) : SB_OK;
    for (size_t t = 0; status == SB_OK && t < scene->offshore.terrain_count; t++)
        status = sb_hash_file(scene->offshore.terrain[t].file, hash, error);
    if (status == SB_OK && scene->offshore.has_uplift) status = sb_hash_file(scene->offshore.uplift.file, hash, error);
    return status;
}

sb_status sb_request_hash(const sb_request *request, const char *assets, uint64_t *hash, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_scene scene = {0};
    sb_status status = sb_path_join(path, assets, request->of->scene, error);
    if (status == SB_OK) status = sb_hash_file(path, hash, error);
    if (status == SB_OK) status = read_scene(request, path, &scene, hash, error);
    for (size_t b = 0; status == SB_OK && b < scene.body_count; b++)
        if (scene.bodies[b].file) status = sb_hash_file(scene.bodies[b].file, hash, error);
    for (size_t w = 0; status == SB_OK && w < scene.wavemaker_count; w++)
        if (scene.wavemakers[w].law.file) status = sb_hash_file(scene.wavemakers[w].law.file, hash, error);
    if (status == SB_OK) status = hash_sea(&scene, hash, error);
    sb_scene_free(&scene);
    return status;
}

sb_status sb_scene_defaults_hash(const sb_scene *scene, uint64_t *hash, sb_error *error)
{
    char *text = NULL;
    sb_scene bare = *scene;
    bare.body_count = bare.wavemaker_count = 0;
    bare.render = (sb_render_settings){0}; /* a run fills in the range of a picture's colours */
    sb_status status = sb_scene_identity(&bare, &text, error);
    if (status == SB_OK) *hash = sb_hash(0, text, strlen(text));
    sb_free(text);
    return status;
}

sb_status sb_request_defaults_hash(const sb_request *request, const char *assets, uint64_t *hash, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_scene scene = {0};
    uint64_t unused = 0;
    sb_status status = sb_path_join(path, assets, request->of->scene, error);
    if (status == SB_OK) status = read_scene(request, path, &scene, &unused, error);
    if (status == SB_OK) status = sb_scene_defaults_hash(&scene, hash, error);
    sb_scene_free(&scene);
    return status;
}
