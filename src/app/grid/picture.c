#include "app/grid/picture.h"

#include "base/memory.h"
#include "offshore/motion.h"

#include <math.h>

enum { ALL_LAYERS = 10000 };
/* Least depth of a film that is shown, in spacings. */
static const double FILM = 0.3;

/* The lattice along one axis: it continues that of the domain, in which its columns from 0 to `inside` - 1 are. */
typedef struct axis {
    double min, max, spacing; /* m, of the domain */
    long first, count, inside;
} axis;

static axis axis_of(double min, double max, double low, double high, double reach, double spacing)
{
    axis a = {.min = min, .max = max, .spacing = spacing, .inside = (long)fmax(round((max - min) / spacing), 1)};
    const long before = (long)floor(fmax(min - fmax(low, min - reach), 0) / spacing + 0.5);
    const long after = (long)floor(fmax(fmin(high, max + reach) - max, 0) / spacing + 0.5);
    a.first = -before;
    a.count = before + a.inside + after;
    return a;
}

static double place_of(const axis *a, long column)
{
    if (column < 0) return a->min + ((double)column + 0.5) * a->spacing;
    if (column >= a->inside) return a->max + ((double)(column - a->inside) + 0.5) * a->spacing;
    return a->min + ((double)column + 0.5) * (a->max - a->min) / (double)a->inside;
}

static bool is_inside(const axis *a, long column)
{
    return column >= 0 && column < a->inside;
}

static int most_layers(const sb_scene *scene)
{
    for (size_t c = 0; c < scene->render.camera_count; c++) {
        const sb_camera *camera = &scene->render.cameras[c];
        if (camera->color == SB_COLOR_DEPTH || camera->color == SB_COLOR_MOMENTUM_FLUX ||
            sb_norm(camera->slice.normal) > 0)
            return ALL_LAYERS;
    }
    return SB_GRID_PICTURE_LAYERS;
}

typedef struct lattice {
    axis x, y;
    int most; /* layers */
    const sb_grid_source *grid;
    double time, weight; /* s, of the grid; N/m^3 */
    bool flat;
} lattice;

static lattice lattice_of(const sb_grid_source *grid, const sb_scene *scene, const sb_frame *frame)
{
    const sb_offshore_settings *o = &scene->offshore;
    const sb_domain *d = &scene->domain;
    lattice l = {.grid = grid,
                 .time = frame->status.time - scene->given.start,
                 .weight = scene->fluid.density * scene->fluid.gravity,
                 .flat = scene->dimensions == 2,
                 .most = most_layers(scene)};
    l.x = axis_of(d->min.x, d->max.x, o->x_min, o->x_max, o->drawn, frame->spacing);
    l.y = l.flat ? (axis){.spacing = frame->spacing, .count = 1, .inside = 1}
                 : axis_of(d->min.y, d->max.y, o->y_min, o->y_max, o->drawn, frame->spacing);
    return l;
}

/* The water at a column of the lattice; returns the layers that it has, 0 within the domain. */
static int water_at(const lattice *l, long i, long j, sb_grid_column *water)
{
    if (is_inside(&l->x, i) && is_inside(&l->y, j)) return 0;
    l->grid->at(l->grid->state, l->time, place_of(&l->x, i), l->flat ? 0 : place_of(&l->y, j), water);
    const double layers = (water->surface - water->bed) / l->x.spacing;
    return layers < FILM ? 0 : (int)fmin(fmax(round(layers), 1), l->most);
}

/* The upmost layer is half a spacing below the surface, as in water of particles. Returns the number of particles. */
static int put_column(const lattice *l, sb_frame *frame, size_t to, long i, long j)
{
    sb_grid_column water;
    const int layers = water_at(l, i, j, &water);
    const double pitch = layers > 0 && layers < l->most ? (water.surface - water.bed) / layers : l->x.spacing;
    for (int k = 0; k < layers; k++, to++) {
        const double z = water.surface - (k + 0.5) * pitch;
        float *position = frame->position + 3 * to, *velocity = frame->velocity + 3 * to;
        position[0] = (float)(place_of(&l->x, i) - frame->origin.x);
        position[1] = l->flat ? 0 : (float)(place_of(&l->y, j) - frame->origin.y);
        position[2] = (float)(z - frame->origin.z);
        velocity[0] = (float)water.u;
        velocity[1] = (float)water.v;
        velocity[2] = 0;
        frame->pressure[to] = (float)(l->weight * (water.surface - z));
        frame->id[to] = UINT32_MAX - (uint32_t)to;
    }
    return layers;
}

sb_status sb_grid_picture_from(const sb_grid_source *source, const sb_scene *scene, sb_frame *frame, sb_error *error)
{
    const lattice l = lattice_of(source, scene, frame);
    size_t *first = sb_alloc((size_t)l.y.count + 1, sizeof *first); /* particles before each row */
    if (!first) return sb_fail_memory(error, "a picture of the grid's water");
#pragma omp parallel for schedule(static)
    for (long j = 0; j < l.y.count; j++)
        for (long i = 0; i < l.x.count; i++) {
            sb_grid_column water;
            first[j + 1] += (size_t)water_at(&l, l.x.first + i, l.y.first + j, &water);
        }
    for (long j = 0; j < l.y.count; j++) first[j + 1] += first[j];
    const size_t before = frame->count;
    if (sb_frame_extend(frame, first[l.y.count]) != 0) {
        sb_free(first);
        return sb_fail_memory(error, "a picture of the grid's water");
    }
#pragma omp parallel for schedule(static)
    for (long j = 0; j < l.y.count; j++) {
        size_t to = before + first[j];
        for (long i = 0; i < l.x.count; i++) to += (size_t)put_column(&l, frame, to, l.x.first + i, l.y.first + j);
    }
    sb_free(first);
    return SB_OK;
}

static void at(const void *state, double time, double x, double y, sb_grid_column *out)
{
    sb_offshore_motion water;
    sb_offshore_motion_at(state, time, x, y, &water);
    *out = (sb_grid_column){water.bed, water.wet ? water.surface : water.bed, water.u, water.v};
}

sb_status sb_grid_picture_add(const sb_sim *sim, const sb_scene *scene, sb_frame *frame, sb_error *error)
{
    if (!sb_sim_grid(sim) || !(scene->offshore.drawn > 0)) return SB_OK;
    const sb_grid_source source = {at, sb_sim_grid(sim)};
    return sb_grid_picture_from(&source, scene, frame, error);
}
