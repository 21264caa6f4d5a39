#include "sim/pressure/pressure_problem.h"

#include "base/memory.h"
#include "check.h"

void problem_begin(problem *p, int dimensions, sb_preset preset)
{
    *p = (problem){0};
    /* More than one block of particles, so that sums over blocks are tested. */
    bool flat = dimensions == 2;
    sb_vec3 size = flat ? sb_vec(3, 0, 2) : sb_vec(2, 0.8, 1.5);
    tank_of_particles(&p->tank, dimensions, flat ? 0.05 : 0.1, size, flat ? 2 : 1.4, flat ? 1.4 : 1.2, 0.1);
    tank_use(&p->tank, preset);
    if (preset == SB_PRESET_DEFAULT) p->tank.scene.numerics.support = 2.75; /* in 2D, too: docs/method.md, section 2 */
    p->tank.scene.numerics.solver = SB_SOLVER_CG;
    p->tank.scene.numerics.wall_friction = 0.05;
    p->tank.model.fluid_position[0] = sb_vec(size.x - 0.33, size.y / 2, size.z - 0.3);
    p->tank.model.fluid_velocity[0] = sb_vec(0.5, 0, 0.5);
    p->sim = tank_sim(&p->tank);
    assert_non_null(p->sim);
    assert_int_equal(tank_steps(p->sim, 12), 0);
    assert_int_equal(tank_prepare_source(p->sim, p->sim->state.time_step), 0);
    p->n = p->sim->state.n;
    assert_int_equal(p->n, p->tank.model.fluid_count);
    assert_int_equal(twin_make(p->sim, &p->twin), 0);
    for (size_t i = 0; i < p->n; i++) {
        const sb_f4 v = p->sim->work.predicted[i];
        p->twin.velocity[i] = sb_vec((double)v[0], (double)v[1], (double)v[2]);
    }
    p->acceleration = sb_alloc(p->n, sizeof *p->acceleration);
    double **fields[] = {&p->x, &p->y, &p->product, &p->source, &p->solution, &p->diagonal};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        *fields[f] = sb_alloc(p->n, sizeof(double));
        assert_non_null(*fields[f]);
    }
    assert_non_null(p->acceleration);
    for (size_t i = 0; i < p->n; i++) {
        p->source[i] = (double)p->sim->work.source[i];
        p->diagonal[i] = (double)p->sim->work.diagonal[i];
    }
}

void problem_end(problem *p)
{
    double *fields[] = {p->x, p->y, p->product, p->source, p->solution, p->diagonal};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) sb_free(fields[f]);
    sb_free(p->acceleration);
    twin_free(&p->twin);
    sb_sim_destroy(p->sim);
    tank_free(&p->tank);
}
