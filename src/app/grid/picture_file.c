/* Water of the grid from its files, for pictures of stored runs. */
#include "app/grid/picture.h"

#include "base/file.h"
#include "base/memory.h"
#include "output/maps/vti.h"

#include <math.h>
#include <stdio.h>

enum { BED, DEPTH, VELOCITY, ARRAYS };

typedef struct water {
    sb_vti image;
    sb_vti_array array[ARRAYS];
    float *values;
} water;

/* Two cells along an axis between whose centres a place lies, and their weights. */
typedef struct between {
    size_t cell[2];
    double weight[2];
} between;

static between cells_at(double place, double corner, double cell, size_t count)
{
    const double last = (double)count - 1, at = fmin(fmax((place - corner) / cell - 0.5, 0), last);
    const double first = fmin(floor(at), fmax(last - 1, 0));
    return (between){{(size_t)first, (size_t)fmin(first + 1, last)}, {1 - (at - first), at - first}};
}

/* Bilinear between the centres of cells that are wet; dry where these have less than half of the weight. */
static void at(const void *state, double time, double x, double y, sb_grid_column *out)
{
    (void)time;
    const water *w = state;
    const sb_vti *g = &w->image;
    const between i = cells_at(x, g->x, g->cell, g->columns), j = cells_at(y, g->y, g->cell, g->rows);
    double wet = 0, bed = 0, depth = 0, u = 0, v = 0, wet_bed = 0;
    for (int k = 0; k < 4; k++) {
        const size_t cell = j.cell[k >> 1] * g->columns + i.cell[k & 1];
        const double weight = j.weight[k >> 1] * i.weight[k & 1];
        const double h = (double)w->array[DEPTH].values[cell], ground = (double)w->array[BED].values[cell];
        bed += weight * ground;
        if (!(h > 0)) continue;
        wet += weight;
        wet_bed += weight * ground;
        depth += weight * h;
        u += weight * (double)w->array[VELOCITY].values[3 * cell];
        v += weight * (double)w->array[VELOCITY].values[3 * cell + 1];
    }
    *out = (sb_grid_column){.bed = bed, .surface = bed};
    if (wet < 0.5) return;
    *out = (sb_grid_column){bed, (wet_bed + depth) / wet, u / wet, v / wet};
}

static bool is_finite(const water *w)
{
    for (int k = 0; k < ARRAYS; k++)
        for (size_t c = 0; c < w->image.columns * w->image.rows * w->array[k].components; c++)
            if (!isfinite(w->array[k].values[c])) return false;
    return true;
}

/* A file is of the same step as the particle file: the grid is ahead of the particles by less than one of its steps,
   and both files are due at the same multiple of the interval. */
static sb_status check(const water *w, const char *path, const sb_scene *scene, const sb_frame *frame, sb_error *error)
{
    const double time = w->image.time + scene->given.start, most = 0.5 * scene->output.particle_interval;
    if (!is_finite(w)) return sb_fail(error, SB_BAD_INPUT, "%.400s: water that is not finite", path);
    if (fabs(time - frame->status.time) <= fmax(most, frame->status.time_step)) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.400s: has the water at %g s, expected %g s", path, time, frame->status.time);
}

sb_status sb_grid_picture_read(const char *run, size_t number, const sb_scene *scene, sb_frame *frame, sb_error *error)
{
    char name[64], path[SB_PATH_MAX];
    water w = {.array = {{"bed", 1, NULL}, {"depth", 1, NULL}, {"velocity", 3, NULL}}};
    if (!sb_scene_nested(scene) || !(scene->offshore.drawn > 0)) return SB_OK;
    snprintf(name, sizeof name, SB_VTI_FOLDER "/%06zu.vti", number);
    sb_status status = sb_path_join(path, run, name, error);
    if (status == SB_OK) status = sb_vti_read(path, w.array, ARRAYS, &w.image, &w.values, error);
    if (status == SB_OK) status = check(&w, path, scene, frame, error);
    const sb_grid_source source = {at, &w};
    if (status == SB_OK) status = sb_grid_picture_from(&source, scene, frame, error);
    sb_free(w.values);
    return status;
}
