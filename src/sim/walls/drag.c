#include "sim/walls/drag.h"

/* Smallest distance from the wall in the law of the wall, in spacings. Particles that are closer are treated as if they
   were at this distance. */
static const double NEAREST = 0.25;

sb_wall_drag sb_wall_drag_make(const sb_sim *sim)
{
    const sb_numerics *n = &sim->scene->numerics;
    const sb_constants *c = &sim->constant;
    const double quantum = sim->space.quantum, h = (double)c->support, spacing = (double)c->spacing;
    const bool shear = sim->needs.wall_shear;
    return (sb_wall_drag){.on = sim->needs.wall_drag,
                          .friction = (float)(0.5 * n->wall_friction * h * (double)c->sound_speed / quantum),
                          .epsilon = (float)(0.01 * h * h / (quantum * quantum)),
                          .shear = shear,
                          .viscosity = c->viscosity,
                          .rest_density = c->rest_density,
                          .quantum = (float)quantum,
                          .offset = (float)(n->wall_offset * spacing / quantum),
                          .nearest = (float)(NEAREST * spacing / quantum)};
}
