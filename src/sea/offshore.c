/* Given water from the depth-averaged model, which is stepped together with the particles. */
#include "base/memory.h"
#include "offshore/maps.h"
#include "offshore/motion.h"
#include "sea/parts.h"

#include <math.h>
#include <stdio.h>

typedef struct nest {
    sb_offshore *water;
    sb_offshore_maps *maps;  /* NULL: none */
    double before;           /* s that the grid runs before the particles */
    double highest, fastest; /* m, m/s, at the start */
} nest;

static void destroy(void *state)
{
    nest *sea = state;
    if (sea) sb_offshore_maps_destroy(sea->maps);
    if (sea) sb_offshore_destroy(sea->water);
    sb_free(sea);
}

/* Runs the grid until the particles begin. */
static sb_status run_ahead(nest *made, sb_error *error)
{
    double time = 0, taken;
    while (time < made->before * (1 - 1e-12)) {
        const sb_status status = sb_offshore_step(made->water, made->before - time, &taken, error);
        if (status != SB_OK) return status;
        if (made->maps) sb_offshore_maps_step(made->maps, made->water, taken);
        time += taken;
    }
    return SB_OK;
}

static sb_status create(const sb_scene *scene, const sb_offshore_start *grid, void **state, sb_sea_notes *notes,
                        sb_error *error)
{
    if (!grid) return sb_fail(error, SB_FAILED, "sea.source: offshore, but no grid was made");
    nest *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "sea");
    *made = (nest){.before = -scene->given.start, .highest = grid->highest, .fastest = grid->fastest};
    sb_status status = sb_offshore_begin(scene, grid, &made->water, error);
    if (status == SB_OK && scene->offshore.maps)
        status = sb_offshore_maps_create(made->water, scene->offshore.threshold, &made->maps, error);
    if (status == SB_OK) status = run_ahead(made, error);
    if (status != SB_OK) {
        destroy(made);
        return status;
    }
    snprintf(notes->about, sizeof notes->about, "the depth-averaged model, %zu x %zu cells of %g m, %s", grid->columns,
             grid->rows, scene->offshore.cell, scene->offshore.coupling == SB_COUPLING_TWO_WAY ? "two-way" : "one-way");
    *state = made;
    return SB_OK;
}

/* Whether there is water, the particles' bed decides: a quay that stands between the centres of two cells is a slope in
   the grid, above the water for some way. The velocity over the depth is that of the equations with dispersion; without
   it, it is uniform. */
static void at(const void *state, double t, double x, double y, double z, double bed, sb_sea_point *out)
{
    const nest *sea = state;
    sb_offshore_motion m;
    sb_offshore_motion_over(sea->water, t, x, y, bed, &m);
    out->surface = m.surface;
    if (!m.wet || !(m.surface > bed)) return;
    const double depth = m.surface - bed, height = depth * sb_sea_fraction(z, bed, m.surface);
    const double share = depth * depth / 6 - 0.5 * height * height;
    out->velocity[0] = m.u + share * m.bend[0];
    out->velocity[1] = m.v + share * m.bend[1];
    out->velocity[2] = -height * m.divergence;
    out->acceleration[0] = m.u_rate;
    out->acceleration[1] = m.v_rate;
    out->acceleration[2] = height / depth * m.lift;
}

static double greatest_surface(const void *state)
{
    return ((const nest *)state)->highest;
}

static double greatest_speed(const void *state)
{
    return ((const nest *)state)->fastest;
}

static sb_offshore *grid_of(void *state)
{
    return ((nest *)state)->water;
}

static sb_offshore_maps *maps_of(void *state)
{
    return ((nest *)state)->maps;
}

const sb_sea_form sb_sea_form_offshore = {create, at, greatest_surface, greatest_speed, destroy, grid_of, maps_of};
