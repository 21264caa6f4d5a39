/* Spray, foam and bubbles: what decides how much water emits against sums over all pairs in double precision, motion
   against exact solutions, the limit of their number, and that the water does not feel them. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "sim/foam/foam.h"
#include "sim/search/around.h"
#include "sim/step/stages.h"
#include "sim/tank.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

/* Position of an entry of the arrays that neighbours are read from, and a value of it, in double precision. */
static sb_vec3 place(const sb_sim *sim, size_t e)
{
    return sb_space_position(&sim->space, sim->state.position[e]);
}

static sb_vec3 vector(sb_f4 v)
{
    return sb_vec((double)v[0], (double)v[1], (double)v[2]);
}

static size_t entries(const sb_sim *sim)
{
    return sim->state.n + sim->ghosts.count;
}

/* ---- potentials ---- */

/* A cube of jittered water with edges of 1 m in the middle of a tank: no wall is within the support radius. Its
   velocity is irregular, and 2 m/s along each axis in the mean. */
static sb_sim *free_cube(tank *t, int dimensions)
{
    tank_of_particles(t, dimensions, 0.1, sb_vec(3, 2, 3), 1, 1, 0.3);
    t->scene.foam = (sb_foam_settings){.enabled = true, .most = 1000, .amount = 1};
    sb_model *m = &t->model;
    size_t kept = 0;
    for (size_t i = 0; i < m->fluid_count; i++) {
        const sb_vec3 at = m->fluid_position[i];
        if (dimensions == 3 && (at.y < 0.5 || at.y > 1.5)) continue;
        m->fluid_position[kept] = sb_add(at, sb_vec(1, 0, 1));
        m->fluid_velocity[kept] =
            sb_vec(4 * sb_random(1, kept), dimensions == 2 ? 0 : 4 * sb_random(2, kept), 4 * sb_random(3, kept));
        kept++;
    }
    m->fluid_count = kept;
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 0.01), 0);
    sb_foam_find_surface(sim);
    return sim;
}

/* -sum_j m grad W_ij dr/rho_0 over all pairs. */
static sb_vec3 normal_by_pairs(const sb_sim *sim, size_t i)
{
    const sb_constants *c = &sim->constant;
    const double h = (double)c->support, scale = -(double)c->mass * (double)c->spacing / (double)c->rest_density;
    sb_vec3 sum = {0};
    for (size_t j = 0; j < sim->state.n; j++) {
        const sb_vec3 apart = sb_sub(place(sim, i), place(sim, j));
        const double r = sb_norm(apart);
        if (j == i || r >= h) continue;
        sum = sb_madd(sum, scale * sb_kernel_slope(sim->scene->numerics.kernel, c->dimension, h, r) / r, apart);
    }
    return sum;
}

typedef struct sums {
    double trapped, crest;
    bool near_edge; /* a condition of a term is within round-off of its limit */
} sums;

static sums sums_by_pairs(const sb_sim *sim, const sb_vec3 *normal, size_t i)
{
    const sb_foam_law *law = &sim->foam->law;
    const double h = (double)law->support;
    const double reach = h / (double)sim->constant.spacing;
    const double full = M_PI / 3 * (sim->constant.dimension == 2 ? reach * reach : reach * reach * reach);
    const sb_vec3 v = vector(sim->state.velocity[i]), n = sb_normalize(normal[i]);
    const double outwards = sb_dot(v, n) - (double)law->outwards * sb_norm(v);
    sums s = {.near_edge = fabs(outwards) < 1e-3};
    for (size_t j = 0; j < sim->state.n; j++) {
        const sb_vec3 apart = sb_sub(place(sim, i), place(sim, j));
        const double r = sb_norm(apart), w = 1 - r / h;
        if (j == i || w <= 0) continue;
        const sb_vec3 relative = sb_sub(v, vector(sim->state.velocity[j])), m = sb_normalize(normal[j]);
        s.trapped += w * sb_norm(relative) * (1 - sb_dot(sb_normalize(relative), apart) / r) / full;
        const double length = sb_norm(normal[j]);
        s.near_edge |= fabs(length - (double)law->surface) < 1e-3 || fabs(sb_dot(apart, n)) < 1e-3 * r;
        if (outwards >= 0 && length > (double)law->surface && sb_dot(apart, n) > 0)
            s.crest += w * (1 - sb_dot(n, m)) / full;
    }
    return s;
}

static void potentials_are_those_of_all_pairs(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        sb_sim *sim = free_cube(&t, dimensions);
        uint32_t entry[SB_AROUND_MAX];
        double worst_normal = 0, worst_trapped = 0, worst_crest = 0, most_trapped = 0, most_crest = 0;
        size_t surface = 0, crests = 0;
        sb_vec3 *normal = sb_alloc(sim->state.n, sizeof *normal);
        assert_non_null(normal);
        for (size_t i = 0; i < sim->state.n; i++) normal[i] = normal_by_pairs(sim, i);
        for (size_t g = 0; g < sim->groups.count; g++) {
            const sb_group *group = &sim->groups.group[g];
            sb_foam_entries(sim, group, entry);
            for (size_t i = group->first; i < group->end; i++) {
                const double length = (double)sim->work.surface[i][3];
                const sb_vec3 n = sb_scale(vector(sim->work.surface[i]), length);
                worst_normal = fmax(worst_normal, sb_norm(sb_sub(n, normal[i])));
                surface += length > (double)sim->foam->law.surface;
                const sb_foam_sums s = sb_foam_sums_of(sim, entry, i);
                const sums expected = sums_by_pairs(sim, normal, i);
                worst_trapped = fmax(worst_trapped, fabs((double)s.trapped - expected.trapped));
                most_trapped = fmax(most_trapped, expected.trapped);
                if (expected.near_edge) continue;
                worst_crest = fmax(worst_crest, fabs((double)s.crest - expected.crest));
                most_crest = fmax(most_crest, expected.crest);
                crests += expected.crest > 0;
            }
        }
        printf("%dD: normals within %.1e, approach within %.1e of %.3g m/s, crest within %.1e of %.3g; %zu of %zu at "
               "the surface, %zu crests\n",
               dimensions, worst_normal, worst_trapped, most_trapped, worst_crest, most_crest, surface, sim->state.n,
               crests);
        /* Slopes in the lists have 15 bits, roots of 1/32767; velocities and places are floats. */
        assert_true(worst_normal < 2e-4 && worst_trapped < 1e-5 && worst_crest < 1e-3);
        assert_true(most_trapped > 0.5 && most_crest > 0.05 && crests > 10 && surface > 30 && surface < sim->state.n);
        sb_free(normal);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* The water around any place, beyond periodic sides too. */
static void water_around_is_that_of_all_entries(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        tank t;
        tank_make(&t, dimensions, 0.1, sb_vec(1, 0.6, 1), 1, 0.6, 0.2);
        tank_repeat(&t, 0);
        t.scene.foam = (sb_foam_settings){.enabled = true, .most = 1000, .amount = 1};
        sb_sim *sim = tank_sim(&t);
        assert_non_null(sim);
        assert_int_equal(tank_prepare(sim, 0.01), 0);
        for (size_t i = 0; i < sim->state.n; i++)
            sim->work.end_velocity[i] =
                (sb_f4){(float)sb_random(1, i), (float)sb_random(2, i), (float)sb_random(3, i), 0};
        const double h = (double)sim->constant.support, reach = h / 0.1;
        const double full = M_PI / 3 * (dimensions == 2 ? reach * reach : reach * reach * reach);
        double worst = 0, most = 0;
        for (uint64_t k = 0; k < 300; k++) {
            const sb_vec3 from = sb_vec(sb_random(4, k), dimensions == 2 ? 0 : 0.6 * sb_random(5, k), sb_random(6, k));
            const sb_record at = sb_space_record(&sim->space, sb_add(t.scene.domain.min, from));
            const sb_foam_water water = sb_foam_look(sim, at);
            double sum = 0;
            sb_vec3 v = {0};
            for (size_t e = 0; e < entries(sim); e++) {
                const double w = 1 - sb_norm(sb_sub(place(sim, e), sb_space_position(&sim->space, at))) / h;
                const size_t owner = e < sim->state.n ? e : sim->ghosts.of[e - sim->state.n];
                if (w <= 0) continue;
                sum += w;
                v = sb_madd(v, w, vector(sim->work.end_velocity[owner]));
            }
            most = fmax(most, sum / full);
            worst = fmax(worst, fabs((double)water.share - sum / full));
            if (sum > 1e-3) worst = fmax(worst, sb_norm(sb_sub(vector(water.velocity), sb_scale(v, 1 / sum))));
        }
        printf("%dD: share and velocity within %.1e, largest share %.3g\n", dimensions, worst, most);
        /* Weights of 1e-3 are known to a float's 1e-7 of 1. */
        assert_true(worst < 2e-4 && most > 0.8 && most < 1.3);
        sb_sim_destroy(sim);
        tank_free(&t);
    }
}

/* ---- motion ---- */

/* Adds a particle of foam by hand. */
static sb_foam_particle *add(sb_sim *sim, sb_vec3 at, sb_vec3 velocity, double life)
{
    sb_foam *foam = sim->foam;
    assert_int_equal(sb_grow((void **)&foam->particle, &foam->capacity, foam->count + 1, sizeof *foam->particle), 0);
    foam->particle[foam->count] = (sb_foam_particle){
        .position = sb_space_record(&sim->space, at),
        .velocity = {(float)velocity.x, (float)velocity.y, (float)velocity.z, (float)life},
        .id = foam->next_id++,
    };
    foam->particle[foam->count].position[3] = 0;
    return &foam->particle[foam->count++];
}

/* A tank of still water that emits nothing. */
static sb_sim *quiet_tank(tank *t)
{
    tank_make(t, 3, 0.1, sb_vec(2, 1, 3), 2, 0.5, 0);
    t->scene.foam = (sb_foam_settings){.enabled = true, .most = 100, .lifetime = 10};
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    return sim;
}

static void spray_flies_its_parabola(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = quiet_tank(&t);
    const sb_vec3 from = sb_vec(0.3, 0.2, 1.0), v = sb_vec(1.5, 0.4, 2.5);
    add(sim, from, v, 10);
    assert_int_equal(tank_steps(sim, 20), 0);
    const double time = sim->state.time, quantum = sim->space.quantum;
    assert_true(time > 0.1 && sim->foam->count == 1);
    const sb_foam_particle *p = sim->foam->particle;
    const sb_vec3 expected = sb_add(sb_madd(from, time, v), sb_vec(0, 0, -0.5 * 9.81 * time * time));
    assert_int_equal(p->kind, SB_FOAM_SPRAY);
    /* Each step rounds to quanta and its velocity to floats. */
    assert_true(sb_norm(sb_sub(sb_space_position(&sim->space, p->position), expected)) < 40 * quantum + 1e-5);
    assert_near((double)p->velocity[2], v.z - 9.81 * time, 1e-5);
    assert_near((double)p->velocity[3], 10, 0); /* life passes in water only */
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Water that moves as a whole in a periodic tank carries foam; bubbles rise through it. */
static void foam_moves_with_the_water_and_bubbles_rise(void **state)
{
    (void)state;
    tank t;
    tank_make(&t, 3, 0.1, sb_vec(1, 0.8, 2), 1, 0.8, 0);
    tank_repeat(&t, 0);
    tank_repeat(&t, 1);
    t.scene.foam = (sb_foam_settings){.enabled = true, .most = 100, .lifetime = 10};
    for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_velocity[i] = sb_vec(0.5, 0, 0);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    const sb_vec3 floating = sb_vec(0.2, 0.4, 0.8), deep = sb_vec(0.6, 0.4, 0.3);
    add(sim, floating, sb_vec(0, 0, 0), 10);
    add(sim, deep, sb_vec(0, 0, 0), 10);
    assert_int_equal(tank_steps(sim, 4), 0);
    assert_int_equal(sim->foam->count, 2);
    const double time = sim->state.time, rise = 0.3 * sqrt(9.81 * 0.1) * time;
    const sb_vec3 a = sb_space_position(&sim->space, sim->foam->particle[0].position);
    const sb_vec3 b = sb_space_position(&sim->space, sim->foam->particle[1].position);
    assert_int_equal(sim->foam->particle[0].kind, SB_FOAM_FLOATS);
    assert_int_equal(sim->foam->particle[1].kind, SB_FOAM_BUBBLES);
    /* The unsettled water moves up and down a little. */
    assert_near(a.x, floating.x + 0.5 * time, 0.003);
    assert_near(a.z, floating.z, 0.01);
    assert_near(b.x, deep.x + 0.5 * time, 0.003);
    assert_near(b.z, deep.z + rise, 0.01);
    assert_true(rise > 0.015);
    assert_near((double)sim->foam->particle[0].velocity[3], 10 - time, 1e-5);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void particles_end(void **state)
{
    (void)state;
    tank t;
    sb_sim *sim = quiet_tank(&t);
    add(sim, sb_vec(1, 0.5, 0.3), sb_vec(0, 0, 0), 1e-4);  /* of age */
    add(sim, sb_vec(0.05, 0.5, 2), sb_vec(-30, 0, 0), 10); /* at a wall */
    add(sim, sb_vec(1, 0.5, 2.95), sb_vec(0, 0, 30), 10);  /* at the open top */
    add(sim, sb_vec(1, 0.5, 2), sb_vec(0, 0, 0), 10);      /* not yet: it falls */
    assert_int_equal(tank_steps(sim, 1), 0);
    assert_int_equal(sim->foam->count, 1);
    assert_int_equal(sim->foam->particle[0].id, 3);
    while (sim->state.time < 0.7) assert_int_equal(tank_steps(sim, 1), 0);
    assert_int_equal(sim->foam->count, 1);
    assert_true(sim->foam->particle[0].kind != SB_FOAM_SPRAY); /* it has fallen into the water */
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* Bodies stop spray: a wall across the tank. */
static void no_spray_passes_a_wall(void **state)
{
    (void)state;
    tank t;
    tank_of_particles(&t, 3, 0.1, sb_vec(2, 1, 3), 2, 0.5, 0);
    tank_add_plate(&t, "plate", 1.5, 0, 3, sb_vec(-1, 0, 0), NULL);
    t.scene.foam = (sb_foam_settings){.enabled = true, .most = 100, .lifetime = 10};
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    add(sim, sb_vec(1.3, 0.5, 2), sb_vec(3, 0, 2), 10);
    add(sim, sb_vec(1.3, 0.3, 2), sb_vec(-0.5, 0, 2), 10);
    while (sim->state.time < 0.15) assert_int_equal(tank_steps(sim, 1), 0);
    assert_int_equal(sim->foam->count, 1);
    assert_int_equal(sim->foam->particle[0].id, 1);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* ---- runs ---- */

/* A column of water that falls. amount 0: no foam. */
static void dam_break(tank *t, int most, double amount)
{
    tank_make(t, 3, 0.05, sb_vec(1.6, 0.3, 1), 0.4, 0.6, 0.1);
    t->scene.foam = (sb_foam_settings){.enabled = amount > 0, .most = most, .amount = amount};
}

enum { STEPS = 110 };

static sb_sim *ran(const tank *t, int threads, int steps)
{
    const int before = omp_get_max_threads();
    omp_set_num_threads(threads);
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(tank_steps(sim, steps), 0);
    omp_set_num_threads(before);
    return sim;
}

static void assert_same_foam(const sb_sim *a, const sb_sim *b)
{
    assert_int_equal(a->foam->count, b->foam->count);
    assert_int_equal(a->foam->next_id, b->foam->next_id);
    assert_true(a->foam->count > 100);
    assert_memory_equal(a->foam->particle, b->foam->particle, a->foam->count * sizeof *a->foam->particle);
}

static void water_does_not_feel_it_and_threads_do_not_change_it(void **state)
{
    (void)state;
    tank with, without;
    dam_break(&with, 20000, 1);
    dam_break(&without, 20000, 0);
    sb_sim *plain = ran(&without, 2, STEPS), *three = ran(&with, 3, STEPS), *one = ran(&with, 1, 0);
    size_t most[SB_FOAM_KINDS] = {0};
    for (int s = 0; s < STEPS; s++) {
        const size_t *count = sb_sim_report(one)->foam;
        assert_int_equal(tank_steps(one, 1), 0);
        assert_int_equal(count[0] + count[1] + count[2], one->foam->count);
        for (int k = 0; k < SB_FOAM_KINDS; k++) most[k] = count[k] > most[k] ? count[k] : most[k];
    }
    assert_true(sb_sim_hash(plain) == sb_sim_hash(one) && sb_sim_hash(plain) == sb_sim_hash(three));
    assert_same_foam(one, three);
    assert_true(tank_skips(plain, "foam: off") && !tank_has_stage(plain, "foam") && !plain->foam);
    assert_true(!tank_skips(one, "foam: off") && tank_has_stage(one, "foam"));
    assert_null(plain->work.surface);
    printf("to t = %.3g s at most %zu of spray, %zu of foam, %zu bubbles\n", one->state.time, most[0], most[1],
           most[2]);
    assert_true(most[SB_FOAM_SPRAY] > 10 && most[SB_FOAM_FLOATS] > 100 && most[SB_FOAM_BUBBLES] > 10);
    sb_sim_destroy(plain);
    sb_sim_destroy(one);
    sb_sim_destroy(three);
    tank_free(&with);
    tank_free(&without);
}

static void a_restart_continues_it(void **state)
{
    (void)state;
    enum { HALF = 80 };
    tank t;
    sb_archive_out out = {0};
    sb_error error = {0};
    dam_break(&t, 20000, 1);
    sb_sim *whole = ran(&t, 2, HALF), *second = tank_sim(&t);
    tank_save(whole, &out);
    assert_int_equal(tank_steps(whole, STEPS - HALF), 0);
    assert_non_null(second);
    if (tank_load(second, &out, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(tank_steps(second, STEPS - HALF), 0);
    assert_same_foam(whole, second);
    /* A snapshot has it all. */
    sb_frame *frame = sb_sim_snapshot(second);
    assert_non_null(frame);
    assert_int_equal(frame->foam.count, second->foam->count);
    for (size_t p = 0; p < frame->foam.count; p++) {
        const sb_foam_particle *one = &second->foam->particle[p];
        const float *at = frame->foam.position + 3 * p;
        const sb_vec3 there = sb_add(frame->origin, sb_vec((double)at[0], (double)at[1], (double)at[2]));
        assert_true(sb_norm(sb_sub(there, sb_space_position(&second->space, one->position))) < 1e-6);
        assert_true(frame->foam.life[p] > 0 && frame->foam.life[p] <= 1);
        assert_true(frame->foam.kind[p] == one->kind && frame->foam.id[p] == one->id);
        assert_true(p == 0 || frame->foam.id[p] > frame->foam.id[p - 1]);
    }
    sb_frame_release(frame);
    sb_sim_destroy(whole);
    sb_sim_destroy(second);
    sb_archive_out_free(&out);
    tank_free(&t);
}

/* A state with an impossible particle of foam is refused. */
static void a_damaged_state_is_refused(void **state)
{
    (void)state;
    tank t;
    dam_break(&t, 20000, 1);
    sb_sim *sim = ran(&t, 2, 5);
    for (int fault = 0; fault < 4; fault++) {
        sb_archive_out out = {0};
        sb_error error = {0};
        sim->foam->count = 0;
        sb_foam_particle *p = add(sim, sb_vec(1, 0.1, 0.5), sb_vec(0, 0, 0), 1);
        if (fault == 1) p->kind = SB_FOAM_KINDS;
        if (fault == 2) p->velocity[0] = NAN;
        if (fault == 3) p->position[0] = SB_POSITION_END;
        sb_sim *other = tank_sim(&t);
        assert_non_null(other);
        tank_save(sim, &out);
        const sb_status status = tank_load(other, &out, &error);
        assert_int_equal(status, fault == 0 ? SB_OK : SB_BAD_INPUT);
        if (fault > 0) assert_non_null(strstr(error.text, "particle 0 of foam"));
        sb_sim_destroy(other);
        sb_archive_out_free(&out);
    }
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void the_limit_holds(void **state)
{
    (void)state;
    enum { MOST = 200 };
    tank t;
    size_t largest = 0;
    dam_break(&t, MOST, 100);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    for (int s = 0; s < STEPS; s++) {
        assert_int_equal(tank_steps(sim, 1), 0);
        assert_true(sim->foam->count <= MOST);
        largest = sim->foam->count > largest ? sim->foam->count : largest;
    }
    printf("at most %zu of %d\n", largest, MOST);
    assert_true(largest > 3 * MOST / 4);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* A wave that does not break emits nothing: a standing wave of a tenth of the depth's amplitude. */
static void calm_water_has_none(void **state)
{
    (void)state;
    tank t;
    tank_make(&t, 3, 0.05, sb_vec(2, 0.2, 1.2), 2, 0.5, 0);
    t.scene.foam = (sb_foam_settings){.enabled = true, .most = 10000, .amount = 1};
    t.scene.numerics.settle_steps = 100;
    for (size_t i = 0; i < t.model.fluid_count; i++)
        t.model.fluid_velocity[i] = sb_vec(0.2 * sin(M_PI * t.model.fluid_position[i].x / 2), 0, 0);
    sb_sim *sim = tank_settled(&t);
    for (int s = 0; s < 80; s++) {
        assert_int_equal(tank_steps(sim, 1), 0);
        assert_int_equal(sim->foam->next_id, 0);
    }
    printf("t = %.3g s, highest speed %.3g m/s\n", sim->state.time, sim->state.max_speed);
    assert_true(sim->state.max_speed > 0.1);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* A failed allocation ends a step with an error and leaks nothing. */
static void without_memory_a_step_fails(void **state)
{
    (void)state;
    tank t;
    sb_error error = {0};
    sb_sim *sim = quiet_tank(&t);
    add(sim, sb_vec(1, 0.5, 2), sb_vec(0, 0, 0), 10);
    assert_int_equal(tank_prepare(sim, 0.01), 0);
    sb_memory_fail_at(1);
    assert_int_equal(sb_stage_foam(sim, &error), SB_FAILED);
    sb_memory_fail_at(0);
    assert_non_null(strstr(error.text, "foam"));
    sb_sim_destroy(sim);
    tank_free(&t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(potentials_are_those_of_all_pairs),
        cmocka_unit_test(water_around_is_that_of_all_entries),
        cmocka_unit_test(spray_flies_its_parabola),
        cmocka_unit_test(foam_moves_with_the_water_and_bubbles_rise),
        cmocka_unit_test(particles_end),
        cmocka_unit_test(no_spray_passes_a_wall),
        cmocka_unit_test(water_does_not_feel_it_and_threads_do_not_change_it),
        cmocka_unit_test(a_restart_continues_it),
        cmocka_unit_test(a_damaged_state_is_refused),
        cmocka_unit_test(the_limit_holds),
        cmocka_unit_test(calm_water_has_none),
        cmocka_unit_test(without_memory_a_step_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
