/* Draws frames as PNG pictures, one folder per camera: pictures of the film, and stills of a size of their own. */
#include "app/frames/consumers.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static bool wanted(const sb_pictures *pictures, size_t camera)
{
    return !pictures->only || pictures->only[camera];
}

/* Niceness of this thread beside a simulation, and of those that its graphics library starts. The simulation's threads
   wait for each other at every barrier, so they take precedence. */
enum { NICENESS = 10 };

sb_status sb_pictures_begin(sb_pictures *pictures, const sb_scene *scene, const sb_model *model, const char *directory,
                            sb_error *error)
{
    *pictures = (sb_pictures){.scene = scene,
                              .model = model,
                              .directory = directory,
                              .film = {.folder = "frames"},
                              .stills = {.folder = "stills"}};
    sb_status status = sb_insets_begin(&pictures->insets, scene, model, error);
    if (status != SB_OK || scene->render.camera_count == 0) return status;
    pictures->motions = sb_alloc(scene->render.camera_count, sizeof *pictures->motions);
    if (!pictures->motions) return sb_fail_memory(error, "the cameras");
    status = sb_poses_create(&pictures->poses, scene, 0, error);
    return status == SB_OK ? sb_cameras_check(scene, model, error) : status;
}

void sb_pictures_free(sb_pictures *pictures)
{
    sb_free(pictures->motions);
    sb_insets_free(&pictures->insets);
    sb_poses_free(&pictures->poses);
    sb_reached_free(&pictures->reached);
    pictures->motions = NULL;
}

/* Makes the folders and removes the pictures beyond the count. */
static sb_status clear_later(const sb_pictures *pictures, sb_picture_set *set, sb_error *error)
{
    const sb_render_settings *render = &pictures->scene->render;
    for (size_t c = 0; c < render->camera_count; c++) {
        char name[128], path[SB_PATH_MAX];
        if (!wanted(pictures, c)) continue;
        snprintf(name, sizeof name, "%s/%s", set->folder, render->cameras[c].name);
        sb_status status = sb_make_folder(path, pictures->directory, name, error);
        if (status == SB_OK) status = sb_remove_numbered(path, ".png", set->count, error);
        if (status != SB_OK) return status;
    }
    set->cleared = true;
    return SB_OK;
}

static sb_status make_renderer(sb_pictures *pictures, sb_error *error)
{
    if (pictures->renderer) return SB_OK;
    const sb_status status = sb_renderer_create(&pictures->poses.scene, pictures->model, &pictures->renderer, error);
    if (status == SB_OK) sb_renderer_share(pictures->renderer, &pictures->reached);
    return status;
}

static sb_status open_pictures(void *state, sb_error *error)
{
    sb_pictures *pictures = state;
    /* If refused, the niceness stays as it is. */
    if (pictures->beside_simulation) setpriority(PRIO_PROCESS, 0, NICENESS);
    sb_status status = pictures->film.count > 0 ? clear_later(pictures, &pictures->film, error) : SB_OK;
    if (status == SB_OK && pictures->stills.count > 0) status = clear_later(pictures, &pictures->stills, error);
    /* Stills have renderers of their own. */
    const bool stills_only = !(pictures->scene->render.interval > 0) && pictures->scene->render.still_count > 0;
    return status == SB_OK && !stills_only ? make_renderer(pictures, error) : status;
}

/* The path of a camera's next picture. */
static sb_status name_next(const sb_pictures *pictures, const sb_picture_set *set, size_t camera,
                           char path[SB_PATH_MAX], sb_error *error)
{
    char name[128];
    snprintf(name, sizeof name, "%s/%s/%06llu.png", set->folder, pictures->scene->render.cameras[camera].name,
             (unsigned long long)set->count + 1);
    return sb_path_join(path, pictures->directory, name, error);
}

static sb_status draw_one(sb_pictures *pictures, const sb_scene *scene, sb_renderer *renderer, const sb_frame *frame,
                          size_t camera, sb_error *error)
{
    const double aspect = (double)scene->render.width / scene->render.height;
    pictures->poses.keys[camera] =
        sb_cameras_at(pictures->scene, pictures->model, camera, frame, aspect, &pictures->motions[camera]);
    const sb_status status = sb_renderer_draw(renderer, frame, camera, &pictures->image, error);
    return status == SB_OK ? sb_insets_draw(&pictures->insets, frame->status.time, &pictures->image, error) : status;
}

static sb_status draw_each(sb_pictures *pictures, sb_picture_set *set, const sb_scene *scene, sb_renderer *renderer,
                           const sb_frame *frame, sb_error *error)
{
    for (size_t c = 0; c < scene->render.camera_count; c++) {
        char path[SB_PATH_MAX];
        if (!wanted(pictures, c)) continue;
        sb_status status = name_next(pictures, set, c, path, error);
        if (status == SB_OK) status = draw_one(pictures, scene, renderer, frame, c, error);
        /* Pictures of an earlier command stay until the first new picture is drawn. */
        if (status == SB_OK && !set->cleared) status = clear_later(pictures, set, error);
        if (status == SB_OK) status = sb_png_write(path, &pictures->image, error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

/* Removes the pictures of a frame that not all cameras could draw, so that all films have the same length. */
static void remove_incomplete(const sb_pictures *pictures, const sb_picture_set *set)
{
    char path[SB_PATH_MAX];
    for (size_t c = 0; set->cleared && c < pictures->scene->render.camera_count; c++)
        if (wanted(pictures, c) && name_next(pictures, set, c, path, NULL) == SB_OK) (void)unlink(path);
}

static sb_status draw_set(sb_pictures *pictures, sb_picture_set *set, const sb_scene *scene, sb_renderer *renderer,
                          const sb_frame *frame, sb_error *error)
{
    const sb_status status = draw_each(pictures, set, scene, renderer, frame, error);
    if (status == SB_OK)
        set->count++;
    else
        remove_incomplete(pictures, set);
    return status;
}

/* Stills are few: their renderer exists only while they are drawn. */
static sb_status draw_still(sb_pictures *pictures, const sb_frame *frame, sb_error *error)
{
    sb_scene scene = pictures->poses.scene;
    sb_renderer *renderer = NULL;
    scene.render.width = scene.render.still_width;
    scene.render.height = scene.render.still_height;
    sb_status status = sb_renderer_create(&scene, pictures->model, &renderer, error);
    if (status == SB_OK) {
        sb_renderer_share(renderer, &pictures->reached);
        status = draw_set(pictures, &pictures->stills, &scene, renderer, frame, error);
    }
    sb_renderer_destroy(renderer);
    return status;
}

static sb_status draw(void *state, const sb_frame *frame, sb_error *error)
{
    sb_pictures *pictures = state;
    const bool film = frame->drawn == 0 || frame->drawn & SB_FRAME_FILM;
    sb_status status = film ? make_renderer(pictures, error) : SB_OK, still = SB_OK;
    if (film && status == SB_OK)
        status = draw_set(pictures, &pictures->film, &pictures->poses.scene, pictures->renderer, frame, error);
    if (frame->drawn & SB_FRAME_STILL) still = draw_still(pictures, frame, status == SB_OK ? error : NULL);
    return status == SB_OK ? still : status;
}

/* Syncs a camera's folder and its pictures that have not been synced yet. */
static sb_status sync_camera(const sb_pictures *pictures, const sb_picture_set *set, const char *camera, sb_gone *gone,
                             sb_error *error)
{
    char name[128];
    for (uint64_t number = set->synced; number <= set->count; number++) {
        if (number == set->synced)
            snprintf(name, sizeof name, "%s/%s", set->folder, camera);
        else
            snprintf(name, sizeof name, "%s/%s/%06llu.png", set->folder, camera, (unsigned long long)number);
        sb_status status = sb_written_sync(pictures->directory, name, gone, error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

static sb_status sync_set(const sb_pictures *pictures, sb_picture_set *set, sb_gone *gone, sb_error *error)
{
    const sb_render_settings *render = &pictures->scene->render;
    for (size_t c = 0; c < render->camera_count && set->count > set->synced; c++) {
        sb_status status =
            wanted(pictures, c) ? sync_camera(pictures, set, render->cameras[c].name, gone, error) : SB_OK;
        if (status != SB_OK) return status;
    }
    set->synced = set->count;
    return SB_OK;
}

sb_status sb_pictures_sync(sb_pictures *pictures, sb_gone *gone, sb_error *error)
{
    const sb_status status = sync_set(pictures, &pictures->film, gone, error);
    return status == SB_OK ? sync_set(pictures, &pictures->stills, gone, error) : status;
}

void sb_pictures_save(sb_pictures *pictures, sb_archive_out *out)
{
    sb_put_count(out, pictures->film.count);
    sb_put_count(out, pictures->stills.count);
    for (size_t c = 0; pictures->motions && c < pictures->scene->render.camera_count; c++) {
        const sb_camera_motion *motion = &pictures->motions[c];
        sb_put_flag(out, motion->begun);
        sb_put_real(out, motion->time);
        sb_put_real(out, motion->place);
        sb_put_real(out, motion->speed);
    }
    sb_insets_save(&pictures->insets, out);
    if (pictures->motions && sb_reached_shown(pictures->scene)) sb_reached_save(&pictures->reached, out);
}

sb_status sb_pictures_load(sb_pictures *pictures, sb_archive_in *in, sb_error *error)
{
    pictures->film.count = sb_take_count(in, UINT32_MAX); /* the next checkpoint syncs all of them again */
    pictures->stills.count = sb_take_count(in, UINT32_MAX);
    for (size_t c = 0; pictures->motions && c < pictures->scene->render.camera_count; c++) {
        sb_camera_motion *motion = &pictures->motions[c];
        motion->begun = sb_take_flag(in);
        motion->time = sb_take_real(in);
        motion->place = sb_take_real(in);
        motion->speed = sb_take_real(in);
        if (!isfinite(motion->time) || !isfinite(motion->place) || !isfinite(motion->speed))
            sb_archive_refuse(in, "camera %s is nowhere, expected finite numbers",
                              pictures->scene->render.cameras[c].name);
    }
    const sb_status status = sb_insets_load(&pictures->insets, in, error);
    const bool reached = pictures->motions && sb_reached_shown(pictures->scene);
    return status == SB_OK && reached ? sb_reached_load(&pictures->reached, pictures->scene, pictures->model, in, error)
                                      : status;
}

static void close_pictures(void *state)
{
    sb_pictures *pictures = state;
    sb_renderer_destroy(pictures->renderer);
    sb_image_free(&pictures->image);
    pictures->renderer = NULL;
}

sb_consumer_work sb_pictures_work(sb_pictures *pictures)
{
    return (sb_consumer_work){
        .name = "pictures", .state = pictures, .open = open_pictures, .handle = draw, .close = close_pictures};
}
