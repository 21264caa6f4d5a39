/* Draws frames as PNG pictures, one folder per camera. */
#include "app/consumers.h"

#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static bool wanted(const sb_pictures *pictures, size_t camera)
{
    return pictures->camera < 0 || (size_t)pictures->camera == camera;
}

/* Niceness of this thread and of those that its graphics library starts. The simulation's threads wait for each other
   at every barrier, so they take precedence. */
enum { NICENESS = 10 };

/* Makes the folders and removes the pictures beyond the count. */
static sb_status clear_later(sb_pictures *pictures, sb_error *error)
{
    const sb_render_settings *render = &pictures->scene->render;
    for (size_t c = 0; c < render->camera_count; c++) {
        char name[128], path[SB_PATH_MAX];
        if (!wanted(pictures, c)) continue;
        snprintf(name, sizeof name, "frames/%s", render->cameras[c].name);
        sb_status status = sb_make_folder(path, pictures->directory, name, error);
        if (status == SB_OK) status = sb_remove_numbered(path, ".png", pictures->count, error);
        if (status != SB_OK) return status;
    }
    pictures->cleared = true;
    return SB_OK;
}

static sb_status open_pictures(void *state, sb_error *error)
{
    sb_pictures *pictures = state;
    setpriority(PRIO_PROCESS, 0, NICENESS); /* if refused, the niceness stays as it is */
    sb_status status = pictures->count > 0 ? clear_later(pictures, error) : SB_OK;
    return status == SB_OK ? sb_renderer_create(pictures->scene, pictures->model, &pictures->renderer, error) : status;
}

/* The path of a camera's next picture. */
static sb_status name_next(const sb_pictures *pictures, size_t camera, char path[SB_PATH_MAX], sb_error *error)
{
    char name[128];
    snprintf(name, sizeof name, "frames/%s/%06llu.png", pictures->scene->render.cameras[camera].name,
             (unsigned long long)pictures->count + 1);
    return sb_path_join(path, pictures->directory, name, error);
}

static sb_status draw_each(sb_pictures *pictures, const sb_frame *frame, sb_error *error)
{
    for (size_t c = 0; c < pictures->scene->render.camera_count; c++) {
        char path[SB_PATH_MAX];
        if (!wanted(pictures, c)) continue;
        sb_status status = name_next(pictures, c, path, error);
        if (status == SB_OK) status = sb_renderer_draw(pictures->renderer, frame, c, &pictures->image, error);
        /* Pictures of an earlier command stay until the first new picture is drawn. */
        if (status == SB_OK && !pictures->cleared) status = clear_later(pictures, error);
        if (status == SB_OK) status = sb_png_write(path, &pictures->image, error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

/* Removes the pictures of a frame that not all cameras could draw, so that all films have the same length. */
static void remove_incomplete(const sb_pictures *pictures)
{
    char path[SB_PATH_MAX];
    for (size_t c = 0; pictures->cleared && c < pictures->scene->render.camera_count; c++)
        if (wanted(pictures, c) && name_next(pictures, c, path, NULL) == SB_OK) (void)unlink(path);
}

static sb_status draw(void *state, const sb_frame *frame, sb_error *error)
{
    sb_pictures *pictures = state;
    sb_status status = draw_each(pictures, frame, error);
    if (status == SB_OK)
        pictures->count++;
    else
        remove_incomplete(pictures);
    return status;
}

/* Syncs a camera's folder and its pictures that have not been synced yet. */
static sb_status sync_camera(const sb_pictures *pictures, const char *camera, sb_gone *gone, sb_error *error)
{
    char name[128];
    for (uint64_t number = pictures->synced; number <= pictures->count; number++) {
        if (number == pictures->synced)
            snprintf(name, sizeof name, "frames/%s", camera);
        else
            snprintf(name, sizeof name, "frames/%s/%06llu.png", camera, (unsigned long long)number);
        sb_status status = sb_written_sync(pictures->directory, name, gone, error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

sb_status sb_pictures_sync(sb_pictures *pictures, sb_gone *gone, sb_error *error)
{
    const sb_render_settings *render = &pictures->scene->render;
    for (size_t c = 0; c < render->camera_count && pictures->count > pictures->synced; c++) {
        sb_status status = wanted(pictures, c) ? sync_camera(pictures, render->cameras[c].name, gone, error) : SB_OK;
        if (status != SB_OK) return status;
    }
    pictures->synced = pictures->count;
    return SB_OK;
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
