/* Given water from the scene's `water`: its level, and its initial wave, which travels on from where it is at t = 0. A
   standing wave counts as a long wave that travels, and that grows from nothing in its first period. */
#include "sea/sea.h"

#include "base/memory.h"
#include "physics/wave_theory.h"

#include <math.h>

struct sb_sea_source {
    double level, gravity, celerity, sign, position;
    double height, rate; /* of a long wave: amplitude, m, and circular frequency, 1/s */
    sb_solitary solitary;
    sb_initial_wave_kind kind;
};

sb_status sb_sea_create(const sb_scene *scene, sb_sea_source **out, sb_error *error)
{
    const sb_initial_wave *wave = &scene->wave;
    sb_sea_source *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the given sea");
    *made = (sb_sea_source){.level = scene->sea.level,
                            .gravity = scene->fluid.gravity,
                            .sign = wave->direction < 0 ? -1 : 1,
                            .position = wave->position,
                            .height = wave->height,
                            .kind = wave->kind};
    made->solitary = (sb_solitary){wave->height, wave->depth, scene->fluid.gravity, wave->theory};
    if (wave->kind == SB_INITIAL_SOLITARY) made->celerity = sb_solitary_celerity(&made->solitary);
    if (wave->kind == SB_INITIAL_STANDING) {
        made->celerity = sqrt(scene->fluid.gravity * wave->depth);
        made->rate = 2 * M_PI * made->celerity / wave->wavelength;
    }
    *out = made;
    return SB_OK;
}

void sb_sea_destroy(sb_sea_source *sea)
{
    sb_free(sea);
}

/* Ahead of the crest, or of the place where the phase is 0. */
static double ahead_of(const sb_sea_source *sea, double t, double x)
{
    return sea->sign * (x - sea->position) - sea->celerity * t;
}

static void solitary_at(const sb_sea_source *sea, double t, double x, double height, double v[3])
{
    double u, w;
    sb_solitary_velocity(&sea->solitary, ahead_of(sea, t, x), height, &u, &w);
    v[0] = sea->sign * u;
    v[1] = 0;
    v[2] = w;
}

/* eta = a sin(omega t - k x), and u from the Riemann invariant of water at rest ahead of it. */
static double long_wave_at(const sb_sea_source *sea, double t, double x, double height, double depth, double v[3])
{
    const double phase = -ahead_of(sea, t, x) * sea->rate / sea->celerity;
    const double grown = phase <= 0 ? 0 : phase >= 2 * M_PI ? 1 : 0.5 * (1 - cos(0.5 * phase));
    const double eta = sea->height * grown * sin(phase), slope = sea->height * grown * cos(phase) * sea->rate;
    v[0] = sea->sign * 2 * (sqrt(sea->gravity * (depth + eta)) - sqrt(sea->gravity * depth));
    v[1] = 0;
    v[2] = slope * fmin(height / (depth + eta), 1);
    return eta;
}

static double elevation_at(const sb_sea_source *sea, double t, double x, double height, double depth, double v[3])
{
    v[0] = v[1] = v[2] = 0;
    if (sea->kind == SB_INITIAL_STANDING && depth > 0) return long_wave_at(sea, t, x, height, depth, v);
    if (sea->kind != SB_INITIAL_SOLITARY) return 0;
    const double eta = sb_solitary_elevation(&sea->solitary, ahead_of(sea, t, x));
    solitary_at(sea, t, x, fmin(height, sea->solitary.depth + eta), v);
    return eta;
}

void sb_sea_at(const sb_sea_source *sea, double t, double x, double y, double z, double bed, sb_sea_point *out)
{
    (void)y;
    *out = (sb_sea_point){.surface = sea->level};
    if (sea->kind == SB_INITIAL_NONE) return;
    const double height = fmax(z - bed, 0), depth = sea->level - bed,
                 step = 1e-3 * sqrt(sea->solitary.depth / sea->gravity);
    double before[3], after[3];
    out->surface = sea->level + elevation_at(sea, t, x, height, depth, out->velocity);
    elevation_at(sea, t - step, x, height, depth, before);
    elevation_at(sea, t + step, x, height, depth, after);
    for (int axis = 0; axis < 3; axis++) out->acceleration[axis] = (after[axis] - before[axis]) / (2 * step);
}

double sb_sea_greatest_surface(const sb_sea_source *sea)
{
    return sea->level + (sea->kind == SB_INITIAL_NONE ? 0 : fabs(sea->height));
}

double sb_sea_greatest_speed(const sb_sea_source *sea)
{
    const double depth = sea->solitary.depth;
    return sea->kind == SB_INITIAL_NONE ? 0 : sea->celerity * fabs(sea->height) / depth;
}
