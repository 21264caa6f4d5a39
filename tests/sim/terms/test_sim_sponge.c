/* Sponges: what they take from each particle, their entry in the ledger, and that they cost nothing when off. */
#include "base/memory.h"
#include "sim/presets.h"
#include "sim/state/space.h"
#include "sim/tank.h"
#include "sim/terms/sponge.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>

static const sb_sponge beach = {.name = "beach",
                                .side = SB_X_MAX,
                                .end = 1.8,
                                .length = 1.2,
                                .profile = SB_SPONGE_QUADRATIC,
                                .period = 1,
                                .depth = 0.5,
                                .strength = 8};

/* Water that falls from a column and runs to the other side. */
static void make(tank *t, bool with)
{
    tank_make(t, 2, 0.05, sb_vec(2, 1, 1.5), 0.8, 0.7, 0);
    if (!with) return;
    t->scene.sponges = sb_alloc(1, sizeof *t->scene.sponges);
    assert_non_null(t->scene.sponges);
    t->scene.sponges[0] = beach;
    t->scene.sponge_count = 1;
}

static double sum(const sb_ledger *l)
{
    return l->bodies + l->viscosity + l->friction + l->pressure + l->contact + l->integration + l->left + l->stress +
           l->sponge;
}

static double energy_of(const sb_sim *sim)
{
    const sb_energy e = sb_sim_energy(sim);
    return e.kinetic + e.potential;
}

static void sponge_is_accounted_for(void **state)
{
    (void)state;
    tank t;
    make(&t, true);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_true(tank_has_stage(sim, "sponge") == false); /* no step yet */
    const double start = energy_of(sim);
    double gap = 0, imbalance = 0;
    while (sb_sim_report(sim)->time < 1.2) {
        assert_int_equal(tank_steps(sim, 1), 0);
        gap = fmax(gap, fabs(energy_of(sim) - start - sum(sb_sim_ledger(sim))));
        imbalance = fmax(imbalance, sb_sim_report(sim)->momentum_imbalance);
    }
    assert_true(tank_has_stage(sim, "sponge") && tank_has_stage(sim, "drained"));
    printf("sponge: %g J of %g J, sum off by %g, momentum %g\n", sb_sim_ledger(sim)->sponge, start, gap, imbalance);
    assert_true(gap < 1e-12 * start && imbalance < 1e-6);
    assert_true(sb_sim_ledger(sim)->sponge < -0.01 * start);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* In one step: each particle's predicted velocity is less by strength dt/(1 + strength dt) of its velocity. */
static void each_particle_loses_its_share(void **state)
{
    (void)state;
    tank with, without;
    make(&with, true);
    make(&without, false);
    tank_scatter(&with, 5, 1);
    tank_scatter(&without, 5, 1);
    sb_sim *a = tank_sim(&with), *b = tank_sim(&without);
    assert_int_equal(tank_prepare_source(a, 1e-3), 0);
    assert_int_equal(sb_stage_sponge(a, NULL), SB_OK);
    assert_int_equal(tank_prepare_source(b, 1e-3), 0);
    size_t slowed = 0;
    assert_int_equal(a->state.n, b->state.n);
    for (size_t i = 0; i < a->state.n; i++) {
        const double x = sb_space_position(&a->space, a->state.position[i]).x, dt = a->state.time_step;
        const double s = fmin(fmax((x - 0.6) / 1.2, 0), 1), part = 8 * s * s * dt, share = part / (1 + part);
        slowed += share > 0;
        for (int axis = 0; axis < 3; axis += 2)
            assert_near((double)(a->work.predicted[i][axis] - b->work.predicted[i][axis]),
                        -share * (double)a->state.velocity[i][axis], 1e-6);
    }
    assert_true(slowed > 20);
    sb_sim_destroy(a);
    sb_sim_destroy(b);
    tank_free(&with);
    tank_free(&without);
}

static uint64_t hash_of(const tank *t, int threads)
{
    omp_set_num_threads(threads);
    sb_sim *sim = tank_sim(t);
    assert_int_equal(tank_steps(sim, 60), 0);
    const uint64_t hash = sb_sim_hash(sim);
    sb_sim_destroy(sim);
    return hash;
}

static void bits_do_not_depend_on_threads(void **state)
{
    (void)state;
    tank t;
    make(&t, true);
    const int before = omp_get_max_threads();
    const uint64_t one = hash_of(&t, 1);
    assert_true(hash_of(&t, 3) == one);
    omp_set_num_threads(before);
    tank_free(&t);
}

/* Explicit steps with a viscous sponge, with and without turbulence. */
static sb_sim *make_viscous(tank *t, sb_turbulence turbulence, double alpha)
{
    tank_make(t, 2, 0.05, sb_vec(2, 1, 1.5), 0.8, 0.7, 0);
    t->form.particles = false;
    tank_use(t, SB_PRESET_WEN);
    t->scene.numerics.walls = SB_WALLS_IMAGES;
    t->scene.numerics.kernel_correction = SB_CORRECTION_NONE;
    t->scene.numerics.turbulence = turbulence;
    t->scene.sponges = sb_alloc(1, sizeof *t->scene.sponges);
    assert_non_null(t->scene.sponges);
    t->scene.sponges[0] = beach;
    t->scene.sponges[0].kind = SB_SPONGE_VISCOUS;
    t->scene.sponges[0].alpha = alpha;
    t->scene.sponge_count = 1;
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

/* Each particle has alpha h c_s/16 times the share at its place, beside its eddy viscosity. */
static void viscosity_is_added_by_place(void **state)
{
    (void)state;
    tank with, without;
    sb_sim *a = make_viscous(&with, SB_TURBULENCE_SPS, 0.5), *b = make_viscous(&without, SB_TURBULENCE_SPS, 0);
    assert_int_equal(tank_steps(a, 1), 0);
    assert_int_equal(tank_steps(b, 1), 0);
    const double most = 0.5 * (double)a->constant.support * (double)a->constant.sound_speed / 16;
    size_t within = 0;
    for (size_t i = 0; i < a->state.n; i++) a->work.eddy[i] = b->work.eddy[i] = 0.25f * (float)(i % 5);
    assert_int_equal(sb_stage_viscous_sponge(a, NULL), SB_OK);
    assert_int_equal(sb_stage_viscous_sponge(b, NULL), SB_OK);
    for (size_t i = 0; i < a->state.n; i++) {
        const double x = sb_space_position(&a->space, a->state.position[i]).x, s = fmin(fmax((x - 0.6) / 1.2, 0), 1);
        assert_near((double)a->work.eddy[i] - 0.25 * (double)(i % 5), most * s * s, 1e-6 * most);
        assert_near((double)b->work.eddy[i], 0.25 * (double)(i % 5), 0);
        within += s > 0;
    }
    assert_true(within > 0 && within < a->state.n);
    sb_sim_destroy(a);
    sb_sim_destroy(b);
    tank_free(&with);
    tank_free(&without);
}

/* Its work is part of the ledger's viscosity; water loses more with it, and no momentum but to walls. */
static void viscous_sponge_is_accounted_for(void **state)
{
    (void)state;
    double lost[2];
    for (int on = 0; on < 2; on++) {
        tank t;
        sb_sim *sim = make_viscous(&t, SB_TURBULENCE_NONE, on ? 0.6 : 0.001);
        double imbalance = 0;
        const double start = energy_of(sim);
        while (sb_sim_report(sim)->time < 0.6) {
            assert_int_equal(tank_steps(sim, 1), 0);
            imbalance = fmax(imbalance, sb_sim_report(sim)->momentum_imbalance);
        }
        assert_true(tank_has_stage(sim, "viscous_sponge") && !tank_has_stage(sim, "sponge"));
        lost[on] = -sb_sim_ledger(sim)->viscosity / start;
        printf("alpha %g: viscosity took %g of the energy, momentum %g\n", t.scene.sponges[0].alpha, lost[on],
               imbalance);
        assert_true(imbalance < 1e-5 && sb_sim_ledger(sim)->sponge == 0);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
    assert_true(lost[1] > lost[0] + 0.005);
}

static void off_it_has_no_stage(void **state)
{
    (void)state;
    tank t;
    make(&t, false);
    sb_sim *sim = tank_sim(&t);
    assert_int_equal(tank_steps(sim, 2), 0);
    assert_false(tank_has_stage(sim, "sponge") || tank_has_stage(sim, "viscous_sponge") || sim->work.eddy);
    assert_near(sb_sim_ledger(sim)->sponge, 0, 0);
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sponge_is_accounted_for),         cmocka_unit_test(each_particle_loses_its_share),
        cmocka_unit_test(bits_do_not_depend_on_threads),   cmocka_unit_test(viscosity_is_added_by_place),
        cmocka_unit_test(viscous_sponge_is_accounted_for), cmocka_unit_test(off_it_has_no_stage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
