#include "app/frames/render_files.h"

#include "app/grid/picture.h"
#include "output/particles/foam_files.h"

#include <math.h>
#include <stdio.h>

/* Multiples of the interval are rounded, as in picture_times.c. */
static const double ROUNDING = 1e-9;

typedef struct job {
    const char *run;
    const sb_particle_format *format;
    const sb_particle_list *list;
    sb_pictures *pictures;
    bool film, quiet;
    sb_render_warning warn;
    bool *told, *told_loads; /* of missing files of the grid; of missing loads */
} job;

/* A particle file has the state at the end of the step that passed a multiple of the interval: its picture shows the
   water at the multiple. */
static double picture_time(const job *j, double time)
{
    const double interval = j->pictures->scene->output.particle_interval;
    return interval > 0 ? interval * floor(time / interval + ROUNDING) : time;
}

/* Without the files of the grid, pictures show the particles only; the first one that is missing is told. */
static sb_status add_grid(const job *j, size_t file, sb_frame *frame, sb_error *error)
{
    sb_error why = {0};
    char text[700];
    const sb_status status = sb_grid_picture_read(j->run, file + 1, j->pictures->scene, frame, &why);
    if (status == SB_OK || status == SB_FAILED) return status == SB_OK ? SB_OK : sb_fail(error, status, "%s", why.text);
    snprintf(text, sizeof text, "%.500s; pictures without it show no water of the grid", why.text);
    if (!*j->told) j->warn(text);
    *j->told = true;
    return SB_OK;
}

/* The first interval of a run has no loads yet. */
static void warn_of_loads(const job *j, const sb_frame *frame)
{
    const sb_scene *scene = j->pictures->scene;
    if (!scene->render.loads || frame->face_count > 0 || *j->told_loads) return;
    if (frame->status.time < scene->measure.interval) return;
    j->warn(
        "render.loads: the particle files have no loads of faces: their run was made without render.loads, or by an "
        "earlier version; the colours show the pressure next to the walls instead, which is too low in impacts. Run "
        "with render.loads for the forces themselves");
    *j->told_loads = true;
}

static sb_status read_frame(const job *j, size_t file, sb_frame **frame, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_path_join(path, j->run, j->list->entries[file].file, error);
    if (status == SB_OK) status = j->format->read(path, frame, error);
    if (status != SB_OK) return status;
    warn_of_loads(j, *frame);
    if (j->pictures->scene->foam.enabled) status = sb_foam_files_read(j->run, file + 1, *frame, error);
    if (status == SB_OK) status = add_grid(j, file, *frame, error);
    if (status != SB_OK) sb_frame_release(*frame);
    return status;
}

/* Draws the frame carried to a time, and releases it. */
static sb_status draw_at(const job *j, sb_frame *frame, double time, unsigned drawn, sb_error *error)
{
    sb_consumer_work work = sb_pictures_work(j->pictures);
    if (time != frame->status.time) sb_frame_carry(frame, time);
    frame->drawn = drawn;
    const sb_status status = work.handle(j->pictures, frame, error);
    sb_frame_release(frame);
    return status;
}

static size_t nearest_file(const job *j, double time)
{
    size_t nearest = 0;
    double least = HUGE_VAL;
    for (size_t i = 0; i < j->list->count; i++) {
        const double away = fabs(picture_time(j, j->list->entries[i].time) - time);
        if (away < least) nearest = i;
        least = fmin(away, least);
    }
    return nearest;
}

/* The time that a still of a file shows. False: the file is too far from it. */
static bool shown_time(const job *j, const sb_frame_status *state, double still, double *shown)
{
    const double start = state->time - state->time_step, interval = j->pictures->scene->output.particle_interval;
    *shown = picture_time(j, state->time);
    if (still >= start - ROUNDING * fabs(start) && still <= state->time) *shown = still;
    return fabs(*shown - still) <= fmax(interval, state->time_step);
}

static void warn_of(const job *j, double still, double shown, bool near)
{
    char text[200];
    if (near && shown != still)
        snprintf(text, sizeof text,
                 "render.stills: %g s: no particle file has this time; the still shows the water at %g s", still,
                 shown);
    else if (!near)
        snprintf(text, sizeof text, "render.stills: %g s: no particle file is near this time, there is no still of it",
                 still);
    else
        return;
    j->warn(text);
}

/* Draws the stills for which this file is the nearest one, those before its picture or the others: cameras that follow
   need frames in the order of their times. */
static sb_status draw_stills(const job *j, size_t file, const sb_frame_status *state, bool before, sb_error *error)
{
    const sb_render_settings *render = &j->pictures->scene->render;
    for (size_t s = 0; s < render->still_count; s++) {
        const double still = render->stills[s].time;
        double shown;
        if (nearest_file(j, still) != file) continue;
        const bool near = shown_time(j, state, still, &shown);
        if ((shown < picture_time(j, state->time)) != before) continue;
        warn_of(j, still, shown, near);
        if (!near) continue;
        sb_frame *frame = NULL;
        sb_status status = read_frame(j, file, &frame, error);
        if (status == SB_OK) status = draw_at(j, frame, shown, SB_FRAME_STILL, error);
        if (status != SB_OK) return status;
    }
    return SB_OK;
}

static sb_status draw_file(const job *j, size_t file, sb_error *error)
{
    sb_frame *frame = NULL;
    sb_status status = read_frame(j, file, &frame, error);
    if (status != SB_OK) return status;
    const sb_frame_status state = frame->status;
    status = draw_stills(j, file, &state, true, error);
    if (status == SB_OK && j->film)
        status = draw_at(j, frame, picture_time(j, state.time), SB_FRAME_FILM, error);
    else
        sb_frame_release(frame);
    return status == SB_OK ? draw_stills(j, file, &state, false, error) : status;
}

static bool has_still(const job *j, size_t file)
{
    const sb_render_settings *render = &j->pictures->scene->render;
    for (size_t s = 0; s < render->still_count; s++)
        if (nearest_file(j, render->stills[s].time) == file) return true;
    return false;
}

sb_status sb_render_files(const char *run, const sb_particle_format *format, const sb_particle_list *list,
                          sb_pictures *pictures, bool quiet, sb_render_warning warn, sb_error *error)
{
    const sb_render_settings *render = &pictures->scene->render;
    bool told = false, told_loads = false;
    const job j = {run,   format, list,  pictures,   render->interval > 0 || render->still_count == 0,
                   quiet, warn,   &told, &told_loads};
    sb_consumer_work work = sb_pictures_work(pictures);
    sb_status status = work.open(pictures, error);
    for (size_t i = 0; i < list->count && status == SB_OK; i++) {
        if (!j.film && !has_still(&j, i)) continue;
        status = draw_file(&j, i, error);
        if (!quiet && status == SB_OK && j.film)
            printf("t = %g s: picture %zu of %zu\n", list->entries[i].time, i + 1, list->count);
    }
    if (!quiet && status == SB_OK && pictures->stills.count > 0)
        printf("%llu of %zu stills\n", (unsigned long long)pictures->stills.count, render->still_count);
    work.close(pictures);
    return status;
}
