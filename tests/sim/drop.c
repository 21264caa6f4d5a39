#include "sim/drop.h"

#include "base/random.h"

#include <math.h>

static const double TENSION = 500, DENSITY = 1000, SIZE = 4, JITTER = 0.05;

static bool inside(const drop_form *form, sb_vec3 x)
{
    const double pi = acos(-1), half = form->dimensions == 2 ? 0.5 * sqrt(pi) : 0.5 * cbrt(4 * pi / 3);
    return form->cube ? fmax(fmax(fabs(x.x), fabs(x.y)), fabs(x.z)) < half : sb_dot(x, x) < 1;
}

static void fill(drop *d, const drop_form *form)
{
    sb_model *m = &d->tank.model;
    const bool flat = form->dimensions == 2;
    const sb_vec3 centre = sb_vec(SIZE / 2, flat ? 0 : SIZE / 2, SIZE / 2);
    const double across = pow(form->stretch, flat ? -1 : -0.5), jitter = JITTER * form->spacing;
    size_t n = 0;
    for (size_t i = 0; i < m->fluid_count; i++) {
        const sb_vec3 x = sb_sub(m->fluid_position[i], centre);
        if (!inside(form, x)) continue;
        sb_vec3 by = sb_vec(sb_random(3, 3 * i), flat ? 0.5 : sb_random(3, 3 * i + 1), sb_random(3, 3 * i + 2));
        by = sb_scale(sb_sub(by, sb_vec(0.5, 0.5, 0.5)), 2 * jitter);
        const sb_vec3 at = sb_vec(across * x.x, across * x.y, form->stretch * x.z);
        m->fluid_position[n] = sb_add(centre, sb_add(at, by));
        m->fluid_velocity[n] = (sb_vec3){0};
        m->fluid_pressure[n++] = 0;
    }
    m->fluid_count = n;
}

void drop_make(drop *d, const drop_form *form)
{
    const bool flat = form->dimensions == 2;
    tank_make(&d->tank, form->dimensions, form->spacing, sb_vec(SIZE, flat ? 0 : SIZE, SIZE), SIZE, SIZE, 0);
    d->tank.scene.fluid.gravity = 0;
    d->tank.scene.fluid.viscosity = 0;
    d->tank.scene.fluid.surface_tension = TENSION;
    d->tank.scene.numerics.artificial_viscosity = form->viscosity;
    d->tank.scene.numerics.settle_steps = 0;
    fill(d, form);
    const double pi = acos(-1), volume = (double)d->tank.model.fluid_count * pow(form->spacing, form->dimensions);
    const double r = flat ? sqrt(volume / pi) : cbrt(0.75 * volume / pi);
    d->radius = r;
    d->pressure = (form->dimensions - 1) * TENSION / r;
    /* omega^2 = n (n - 1) (n + 2) sigma/(rho R^3), 2D: n (n^2 - 1) [Rayleigh 1879], n = 2 */
    d->period = 2 * pi * sqrt(DENSITY * r * r * r / ((flat ? 6 : 8) * TENSION));
    d->sim = tank_sim(&d->tank);
}

void drop_free(drop *d)
{
    sb_sim_destroy(d->sim);
    tank_free(&d->tank);
}

drop_shape drop_look(drop *d)
{
    sb_sim *sim = d->sim;
    const size_t n = sim->state.n;
    const int dimension = sim->constant.dimension;
    sb_vec3 centre = {0};
    double second = 0, upright = 0, fourth = 0, corners = 0, pressure = 0;
    size_t within = 0;
    drop_shape shape = {0};
    sb_sim_find_virial_pressures(sim);
    for (size_t i = 0; i < n; i++)
        centre = sb_madd(centre, 1 / (double)n, sb_space_position(&sim->space, sim->state.position[i]));
    for (size_t i = 0; i < n; i++) {
        const sb_vec3 x = sb_sub(sb_space_position(&sim->space, sim->state.position[i]), centre);
        const sb_f4 v = sim->state.velocity[i];
        const double square = sb_dot(x, x), powers = pow(x.x, 4) + pow(x.y, 4) + pow(x.z, 4);
        second += square;
        upright += dimension * x.z * x.z - square;
        fourth += square * square;
        corners += powers - (dimension == 2 ? 0.75 : 0.6) * square * square;
        if (square < 0.25 * d->radius * d->radius) {
            pressure += (double)sim->work.virial[i];
            within++;
        }
        shape.momentum = sb_madd(shape.momentum, 1 / (double)n, sb_vec((double)v[0], (double)v[1], (double)v[2]));
    }
    shape.stretch = upright / second;
    shape.corners = corners / fourth;
    shape.inside = pressure / (double)within;
    return shape;
}
