#include "app/checkpoint/lock.h"
#include "app/commands/commands.h"
#include "app/frames/consumers.h"
#include "app/frames/render_files.h"
#include "app/frames/render_log.h"
#include "app/grid/water.h"
#include "app/options.h"
#include "app/run/files.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "output/particles/particle_format.h"
#include "output/plots/video.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char help[] =
    "usage: shorebreak render RUN_DIR|LOG [--camera NAME]... [--set KEY=VALUE]... [--out DIR] [--quiet]\n"
    "Draws pictures from the particle files of a run (output.particle_interval), or from a stream that lcm-logger\n"
    "recorded, without simulating. The water of a grid beside the particles comes from the run's grid/*.vti.\n\n"
    "With --out, or --set render.stills, stills are drawn, too; alone, if render.interval is 0. They replace all\n"
    "earlier ones of a camera. A still shows the water of the nearest particle file if none has its time.\n\n"
    "  --camera NAME    draw the pictures of this camera only; several of these options draw the pictures of each\n"
    "                   camera that is named (default: all of the scene's cameras)\n"
    "  --set KEY=VALUE  change a key of the run's scene, e.g. --set render.width=1920, or replace the cameras:\n"
    "                   --set 'render.cameras=[{name: top, eye: [0, 0, 900], target: [400, 1, 0]}]'\n"
    "  --out DIR        write frames/<camera>/ and stills/<camera>/ to DIR (default: RUN_DIR, once the run has\n"
    "                   ended; LOG-pictures)\n"
    "  --quiet          print no progress\n";

static sb_status find_camera(const sb_render_settings *render, const char *name, size_t *camera, sb_error *error)
{
    for (*camera = 0; *camera < render->camera_count; ++*camera)
        if (strcmp(render->cameras[*camera].name, name) == 0) return SB_OK;
    sb_nearest nearest = sb_nearest_to(name);
    for (size_t c = 0; c < render->camera_count; c++) sb_nearest_try(&nearest, render->cameras[c].name);
    return sb_fail(error, SB_BAD_INPUT, "--camera %.100s: no such camera in the run's scene; %s %s%s", name,
                   nearest.found ? "did you mean" : "the first one is",
                   nearest.found ? nearest.found : render->cameras[0].name, nearest.found ? "?" : "");
}

/* *only: by camera, whether the options name it; NULL if they name none. Owned by the caller, also after a failure. */
static sb_status choose_cameras(const sb_scene *scene, const sb_options *options, bool **only, sb_error *error)
{
    const sb_render_settings *render = &scene->render;
    if (render->camera_count == 0)
        return sb_fail(error, SB_BAD_INPUT, "the run's scene has no camera: add one with --set render.cameras=...");
    if (options->camera_count == 0) return SB_OK;
    *only = sb_alloc(render->camera_count, sizeof **only);
    sb_status status = *only ? SB_OK : sb_fail_memory(error, "the cameras");
    for (size_t k = 0; status == SB_OK && k < options->camera_count; k++) {
        size_t camera;
        status = find_camera(render, options->cameras[k], &camera, error);
        if (status == SB_OK) (*only)[camera] = true;
    }
    return status;
}

static void warn(const char *text)
{
    fprintf(stderr, "shorebreak: warning: %s\n", text);
}

static void make_videos(const char *directory, const sb_scene *scene, const bool *only, uint64_t count)
{
    for (size_t c = 0; c < scene->render.camera_count && scene->render.video; c++)
        if (!only || only[c])
            sb_video_write(directory, scene->render.cameras[c].name, count, scene->render.video_rate, NULL);
}

/* Call this before any of the run's files is read: reading a FIFO among them would block. */
static sb_status check_run(const char *run, sb_error *error)
{
    sb_run_files files;
    sb_status status = sb_run_files_find(run, NULL, &files, error);
    sb_run_files_free(&files);
    return status;
}

/* Earlier pictures of shorebreak are replaced. Files of other origin are not: the command is refused. */
static sb_status check_place(const char *directory, const sb_scene *scene, const bool *only, sb_error *error)
{
    sb_run_files files;
    sb_status status = sb_run_files_find_pictures(directory, scene, only, &files, error);
    if (status == SB_OK && files.foreign[0])
        status = sb_fail(error, SB_BAD_INPUT,
                         "%.500s/%.300s: was not written by shorebreak, and render would overwrite it; name another "
                         "directory with --out",
                         directory, files.foreign);
    sb_run_files_free(&files);
    return status;
}

/* What the pictures are drawn from: the directory of a run, or a log. */
typedef struct job {
    const char *source, *directory;
    bool is_log, quiet;
    sb_scene scene;
    sb_model model;
    const sb_particle_format *format;
    sb_particle_list list;
    bool *only; /* by camera: whether it is drawn, owned; NULL: all are */
    int lock;
} job;

/* The stills of a run have their exact times: they are replaced on request only. */
static bool asks_for_stills(const sb_options *options)
{
    bool asks = options->out != NULL;
    for (size_t k = 0; k < options->override_count; k++)
        asks = asks || strncmp(options->overrides[k].key, "render.still", strlen("render.still")) == 0;
    return asks;
}

static sb_status open_run(job *j, const sb_options *options, sb_error *error)
{
    char scene_path[SB_PATH_MAX];
    j->format = sb_particle_format_in(j->source);
    sb_status status = sb_path_join(scene_path, j->source, "scene.yaml", error);
    if (status == SB_OK && access(j->source, F_OK) == 0) status = check_run(j->source, error);
    if (status == SB_OK) status = sb_options_scene(options, scene_path, &j->scene, error);
    if (status == SB_OK) status = sb_grid_refuse(&j->scene, "render", error);
    if (status == SB_OK) status = choose_cameras(&j->scene, options, &j->only, error);
    if (status == SB_OK && !asks_for_stills(options)) j->scene.render.still_count = 0;
    return status == SB_OK ? sb_particle_format_read_list(j->format, j->source, &j->list, error) : status;
}

static sb_status open_log(job *j, const sb_options *options, sb_error *error)
{
    if (options->override_count > 0)
        return sb_fail(error, SB_BAD_INPUT, "--set %.200s: %.500s is a log, whose scene cannot be changed",
                       options->overrides[0].key, j->source);
    const sb_status status = sb_render_log_scene(j->source, &j->scene, &j->model, error);
    return status == SB_OK ? choose_cameras(&j->scene, options, &j->only, error) : status;
}

static sb_status draw_pictures(const job *j, sb_pictures *pictures, sb_error *error)
{
    sb_status status = j->is_log ? sb_render_log_draw(j->source, pictures, j->quiet, error)
                                 : sb_render_files(j->source, j->format, &j->list, pictures, j->quiet, warn, error);
    const uint64_t count = pictures->film.count;
    if (status == SB_OK && count > 1) make_videos(j->directory, &j->scene, j->only, count);
    return status;
}

static sb_status draw_job(job *j, sb_error *error)
{
    sb_status status = sb_make_directories(j->directory, error);
    if (status == SB_OK)
        status = sb_lock_directory(j->directory, "another directory given with --out", &j->lock, error);
    if (status == SB_OK) status = check_place(j->directory, &j->scene, j->only, error);
    if (status == SB_OK && !j->is_log) status = sb_model_import_bodies(&j->scene, &j->model, error);
    if (status != SB_OK) return status;
    sb_pictures pictures;
    status = sb_pictures_begin(&pictures, &j->scene, &j->model, j->directory, error);
    pictures.only = j->only;
    if (status == SB_OK && !j->is_log) status = sb_insets_read(&pictures.insets, j->source, error);
    if (status == SB_OK) status = draw_pictures(j, &pictures, error);
    sb_pictures_free(&pictures);
    return status;
}

static sb_status render(const sb_options *options, sb_error *error)
{
    struct stat info;
    char beside[SB_PATH_MAX];
    job j = {.source = options->positional, .directory = options->out, .quiet = options->quiet, .lock = -1};
    j.is_log = stat(j.source, &info) == 0 && S_ISREG(info.st_mode);
    snprintf(beside, sizeof beside, "%s%s", j.source, j.is_log ? "-pictures" : "");
    if (!j.directory) j.directory = beside;
    sb_status status = j.is_log ? open_log(&j, options, error) : open_run(&j, options, error);
    if (status == SB_OK) status = draw_job(&j, error);
    if (j.lock >= 0) close(j.lock);
    sb_free(j.only);
    sb_particle_list_free(&j.list);
    sb_model_free(&j.model);
    sb_scene_free(&j.scene);
    return status;
}

int sb_command_render(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_status status = sb_options_parse(count, arguments, SB_OPT_OUT | SB_OPT_CAMERA | SB_OPT_SET | SB_OPT_QUIET,
                                        "run directory or log", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = render(&options, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_options_free(&options);
    return (int)status;
}
