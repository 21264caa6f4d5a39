#include "sim/passes/cpu/body_forces.h"

#include "base/memory.h"
#include "sim/walls/entry.h"
#include "sim/walls/mirrors.h"
#include "sim/walls/pushes.h"

#include <string.h>

enum { VALUES = SB_FORCE_VALUES };

int sb_body_forces_create(sb_body_forces *f, size_t bodies)
{
    *f = (sb_body_forces){.sum = sb_alloc(bodies * VALUES, sizeof *f->sum),
                          .body = sb_alloc(bodies, sizeof *f->body),
                          .acted_on = sb_alloc(bodies, sizeof *f->acted_on),
                          .all = sb_alloc(bodies * VALUES, sizeof *f->all)};
    return f->sum && f->body && f->acted_on && f->all ? 0 : -1;
}

void sb_body_forces_free(sb_body_forces *f)
{
    sb_free(f->sum);
    sb_free(f->body);
    sb_free(f->acted_on);
    sb_free(f->all);
}

sb_vec3 sb_wall_to_original(const sb_space *space, sb_record image)
{
    return sb_sub(sb_space_position(space, sb_space_wrap(space, image)), sb_space_position(space, image));
}

void sb_wall_push_record(const sb_sim *sim, size_t i, uint32_t wall, sb_vec3 force)
{
    const sb_record of = sb_wall_set_of(sim, wall)->record[sb_wall_particle(wall)];
    const sb_vec3 shift = sim->space.repeats ? sb_wall_to_original(&sim->space, of) : (sb_vec3){0};
    sb_pushes_add(sim->pushes,
                  &(sb_wall_push){.body = sb_wall_body(sim, wall),
                                  .at = sb_add(sb_space_position(&sim->space, sim->state.position[i]), shift),
                                  .force = force,
                                  .from = sb_add(sb_space_position(&sim->space, of), shift)});
}

static void add_to(double value[3], sb_vec3 v)
{
    value[0] += v.x;
    value[1] += v.y;
    value[2] += v.z;
}

void sb_body_forces_add(const sb_sim *sim, sb_body_forces *to, uint32_t body, sb_vec3 at, sb_vec3 pressure,
                        sb_vec3 drag)
{
    double *value = to->sum + (size_t)VALUES * body;
    if (!to->acted_on[body]) {
        to->acted_on[body] = true;
        to->body[to->count++] = body;
    }
    add_to(value, pressure);
    add_to(value + 3, drag);
    add_to(value + 6, sb_cross(sb_sub(at, sim->model->bodies[body].moment_point), sb_add(pressure, drag)));
}

void sb_body_forces_of_facet(const sb_sim *sim, sb_body_forces *to, uint32_t mirror, sb_vec3 at, sb_vec3 force,
                             sb_vec3 normal)
{
    const uint32_t body = sb_mirror_body(sim, mirror);
    const sb_vec3 place = sb_add(at, sb_mirror_shift(sim, mirror));
    if (sim->pushes) sb_pushes_add(sim->pushes, &(sb_wall_push){body, place, force, normal, place});
    sb_body_forces_add(sim, to, body, place, force, (sb_vec3){0});
}

void sb_body_forces_close(sb_body_forces *f)
{
    for (size_t b = 0; b < f->count; b++) {
        double *sum = f->sum + (size_t)VALUES * f->body[b];
        sb_exact *all = f->all + (size_t)VALUES * f->body[b];
        for (int v = 0; v < VALUES; v++) sb_exact_add(&all[v], sum[v]);
        memset(sum, 0, VALUES * sizeof *sum);
        f->acted_on[f->body[b]] = false;
    }
    f->count = 0;
}
