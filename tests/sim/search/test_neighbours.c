/* Lists, densities, wall vectors, the diagonal and the wall volumes compared with brute force in double precision. */
#include "base/memory.h"
#include "sim/presets.h"
#include "sim/step/stages.h"
#include "sim/twin.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct setup {
    tank tank;
    sb_sim *sim;
    twin twin;
} setup;

static const sb_wavemaker_parameters *paddle_law(void)
{
    static sb_wavemaker_parameters law;
    law = (sb_wavemaker_parameters){.kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 0.8, .gravity = 9.81};
    return &law;
}

/* Water scattered through a tank with a static plate and a moving paddle. kernel NULL: kernel and support of the
   preset. */
static void begin(setup *s, int dimensions, sb_preset preset, const char *kernel)
{
    double dr = 0.1;
    sb_vec3 size = dimensions == 2 ? sb_vec(3.03, 0, 2.04) : sb_vec(1.53, 1.21, 1.04);
    tank_of_particles(&s->tank, dimensions, dr, size, size.x - 0.2, 0.8 * size.z, 0);
    tank_use(&s->tank, preset);
    if (kernel) {
        s->tank.scene.numerics.kernel = sb_kernel_find(kernel);
        s->tank.scene.numerics.support = s->tank.scene.numerics.kernel->support;
    }
    tank_scatter(&s->tank, (uint64_t)dimensions, 1);
    tank_add_plate(&s->tank, "sill", 0.9, 0, 0.5, sb_vec(0, 0, 0), NULL);
    tank_add_plate(&s->tank, "paddle", 0.2, 0, 1, sb_vec(1, 0, 0), paddle_law());
    s->sim = tank_sim(&s->tank);
    assert_non_null(s->sim);
    s->sim->state.time = 0.4;
    assert_int_equal(tank_prepare(s->sim, 0.01), 0);
    assert_true(s->sim->walls.moving[0].displacement > 0.1);
    assert_true(s->sim->walls.moving[0].velocity.x > 0.5);
    assert_int_equal(twin_make(s->sim, &s->twin), 0);
}

static void end(setup *s)
{
    twin_free(&s->twin);
    sb_sim_destroy(s->sim);
    tank_free(&s->tank);
}

static int by_value(const void *a, const void *b)
{
    size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return x < y ? -1 : x > y;
}

/* Compares one list with the reference's pairs: they are the same except for pairs at the support radius to float
   round-off. Padding repeats an entry of the list, or i, with slope 0. Returns the number of pairs at the radius. */
static size_t check_list(const setup *s, size_t i, bool walls)
{
    const sb_reference *r = &s->twin.reference;
    const sb_reference_pair *expected = walls ? r->wall : r->fluid;
    const size_t *start = walls ? r->wall_start : r->fluid_start;
    size_t listed[1024], count = 0, edge = 0;
    assert_int_equal(twin_listed(s->sim, i, walls) % 4, 0);
    for (size_t k = 0; k < twin_listed(s->sim, i, walls); k++) {
        const twin_entry entry = twin_list(s->sim, i, walls, k);
        if (entry.padding)
            assert_true(entry.slope == 0);
        else
            listed[count++] = walls ? twin_wall(&s->twin, entry.other) : entry.other;
    }
    qsort(listed, count, sizeof *listed, by_value);
    size_t at = 0;
    for (size_t k = start[i]; k < start[i + 1]; k++) {
        double r_over_h = sb_norm(expected[k].offset) / r->cloud.h;
        if (at < count && listed[at] == expected[k].other)
            at++;
        else if (r_over_h > 1 - 3e-7)
            edge++;
        else
            fail_msg("particle %zu: %s %zu at r = %.9f h is not listed", i, walls ? "wall" : "water", expected[k].other,
                     r_over_h);
    }
    if (at != count) fail_msg("particle %zu: %zu is listed but beyond the support radius", i, listed[at]);
    return edge;
}

static void check_lists(const setup *s)
{
    size_t pairs = 0, walls = 0, edge = 0, n = s->sim->state.n;
    for (size_t i = 0; i < n; i++) {
        edge += check_list(s, i, false) + check_list(s, i, true);
    }
    pairs = s->twin.reference.fluid_start[n];
    walls = s->twin.reference.wall_start[n];
    printf("%zu particles, %zu pairs, %zu wall pairs, %zu on the edge\n", n, pairs, walls, edge);
    assert_int_equal(n, s->tank.model.fluid_count);
    assert_true(pairs > 5 * n && walls > n / 2 && edge <= 4);
}

/* m grad W and psi grad W of the listed pairs. The roots of fluid pairs are stored rounded to half a unit. */
static void check_slopes(const setup *s)
{
    const sb_reference *r = &s->twin.reference;
    const sb_sim *sim = s->sim;
    twin_gap wall = {0};
    double worst = 0, unit = (double)sim->work.pairs.unit;
    for (size_t i = 0; i < sim->state.n; i++)
        for (int walls = 0; walls < 2; walls++)
            for (size_t k = 0; k < twin_listed(sim, i, walls); k++) {
                const twin_entry entry = twin_list(sim, i, walls, k);
                if (entry.padding) continue;
                size_t b = walls ? twin_wall(&s->twin, entry.other) : entry.other;
                sb_vec3 x = walls ? s->twin.wall_position[b] : s->twin.position[b];
                double distance = sb_norm(sb_sub(s->twin.position[i], x));
                double expected = (walls ? s->twin.psi[b] : r->mass) *
                                  sb_kernel_slope(r->cloud.kernel, r->cloud.dimension, r->cloud.h, distance);
                if (walls)
                    twin_compare(&wall, i, entry.slope * distance / sim->space.quantum, expected);
                else
                    worst = fmax(
                        worst, fabs(sqrt(entry.slope / unit) - sqrt(expected / distance * sim->space.quantum / unit)));
            }
    printf("root of m W'/r: worst %.4f units; psi W': worst %.2g relative to the largest\n", worst,
           twin_relative(&wall));
    assert_true(worst < 0.5 + 2e-6 * 32767 && twin_relative(&wall) < 2e-6);
}

static void check_sums(const setup *s)
{
    const sb_reference *r = &s->twin.reference;
    const sb_sim *sim = s->sim;
    size_t n = sim->state.n;
    double *rho = sb_alloc(n, sizeof *rho), *diagonal = sb_alloc(n, sizeof *diagonal);
    assert_true(rho && diagonal);
    sb_reference_density(r, rho);
    sb_reference_diagonal(r, diagonal);
    twin_gap density = {0}, vector = {0}, flux = {0};
    double dt2 = sim->state.time_step * sim->state.time_step, worst = 0;
    for (size_t i = 0; i < n; i++) {
        sb_vec3 b = {0, 0, 0};
        double flow = 0;
        for (size_t k = r->wall_start[i]; k < r->wall_start[i + 1]; k++) {
            const sb_reference_pair *pair = &r->wall[k];
            b = sb_madd(b, s->twin.psi[pair->other], pair->gradient);
            flow += s->twin.psi[pair->other] * sb_dot(s->twin.wall_velocity[pair->other], pair->gradient);
        }
        twin_compare(&density, i, (double)sim->work.density[i], rho[i]);
        twin_compare(&vector, i, (double)sim->work.wall[i][0], b.x);
        twin_compare(&vector, i, (double)sim->work.wall[i][1], b.y);
        twin_compare(&vector, i, (double)sim->work.wall[i][2], b.z);
        twin_compare(&flux, i, (double)sim->work.wall[i][3], flow);
        double expected = -diagonal[i] / dt2;
        assert_true(sim->work.diagonal[i] > 0 || expected < 1.001e-6 * (double)sim->constant.full_diagonal);
        if (sim->work.diagonal[i] > 0) worst = fmax(worst, fabs((double)sim->work.diagonal[i] / expected - 1));
    }
    printf("density: worst %.2g, B: %.2g, wall flux: %.2g, diagonal: %.2g of each\n", twin_relative(&density),
           twin_relative(&vector), twin_relative(&flux), worst);
    assert_true(density.scale > 500 && vector.scale > 0);
    assert_true(flux.scale > 0 || sim->walls.moving_count == 0);
    assert_true(twin_relative(&density) < 1e-6);
    assert_true(twin_relative(&vector) < 1e-6);
    assert_true(twin_relative(&flux) < 1e-6);
    assert_true(worst < 1e-5);
    sb_free(rho);
    sb_free(diagonal);
}

/* psi_b over the whole static set, and over each moving body by itself. */
static void check_volumes(const setup *s)
{
    const twin *t = &s->twin;
    double gamma = twin_gamma(s->sim), worst = 0;
    const bool curved = s->sim->needs.images;
    size_t all = t->reference.cloud.wall_count;
    double *psi = sb_alloc(all, sizeof *psi);
    assert_non_null(psi);
    sb_reference_cloud set = t->reference.cloud;
    set.wall_count = t->static_count;
    sb_reference_psi(&set, gamma, curved, psi);
    set.wall_count = all - t->static_count;
    set.wall_position += t->static_count;
    set.wall_normal += t->static_count;
    sb_reference_psi(&set, gamma, curved, psi + t->static_count);
    for (size_t b = 0; b < all; b++) worst = fmax(worst, fabs(t->psi[b] / psi[b] - 1));
    printf("psi: worst %.2g of each, %zu static and %zu moving\n", worst, t->static_count, all - t->static_count);
    assert_int_equal(all, s->tank.model.wall_count);
    assert_true(t->static_count < all && worst < 1e-6);
    sb_free(psi);
}

static void check_all(int dimensions, sb_preset preset, const char *kernel)
{
    setup s;
    begin(&s, dimensions, preset, kernel);
    printf("%dD, %s%s%s:\n", dimensions, tank_preset_names[preset], kernel ? " with " : "", kernel ? kernel : "");
    check_lists(&s);
    check_slopes(&s);
    check_sums(&s);
    check_volumes(&s);
    end(&s);
}

static void a_flat_cloud_with_walls(void **state)
{
    check_all(2, preset_of(state), NULL);
}

static void a_cloud_with_walls(void **state)
{
    check_all(3, preset_of(state), NULL);
}

static void other_kernels(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        check_all(dimensions, SB_PRESET_DEFAULT, "cubic");
        check_all(dimensions, SB_PRESET_DEFAULT, "wendland-c2");
        check_all(dimensions, SB_PRESET_DEFAULT, "wendland-c4");
    }
}

/* Lists are built again if their pool was too small, in any order of the threads. */
static void lists_do_not_depend_on_the_pool(void **state)
{
    setup s;
    begin(&s, 3, preset_of(state), NULL);
    size_t n = s.sim->state.n, used = s.sim->work.pairs.used;
    size_t *count = sb_alloc(n, sizeof *count);
    assert_non_null(count);
    for (size_t i = 0; i < n; i++) count[i] = s.sim->work.pairs.count[i];
    int before = omp_get_max_threads();
    for (int threads = 1; threads <= 3; threads++) {
        omp_set_num_threads(threads);
        s.sim->work.pairs.capacity = 10;
        assert_int_equal(tank_prepare(s.sim, 0.01), 0);
        assert_int_equal(s.sim->work.pairs.used, used);
        assert_true(s.sim->work.pairs.capacity >= used);
        for (size_t i = 0; i < n; i++) assert_int_equal(s.sim->work.pairs.count[i], count[i]);
        check_lists(&s);
    }
    omp_set_num_threads(before);
    sb_free(count);
    end(&s);
}

/* Returns the number of pairs of water with boundary particles of the whole model, and checks that boundary particles
   beside the domain have the psi that follows from all of them. */
static size_t check_against_model(const setup *s)
{
    const sb_model *m = &s->tank.model;
    const twin *t = &s->twin;
    double h = t->reference.cloud.h, worst = 0;
    double *psi = sb_alloc(m->wall_count, sizeof *psi);
    assert_non_null(psi);
    sb_reference_cloud all = t->reference.cloud;
    all.wall_count = m->wall_count;
    all.wall_position = m->wall_position;
    all.wall_normal = m->wall_normal;
    sb_reference_psi(&all, twin_gamma(s->sim), s->sim->needs.images, psi);
    size_t pairs = 0, beside = 0;
    for (size_t b = 0; b < m->wall_count; b++) {
        sb_vec3 x = m->wall_position[b];
        for (size_t i = 0; i < s->sim->state.n; i++) pairs += sb_norm(sb_sub(t->position[i], x)) < h;
        sb_vec3 inside = sb_max(m->min, sb_min(m->max, x));
        if (sb_norm(sb_sub(x, inside)) >= h) continue;
        beside++;
        size_t k = 0;
        while (k < t->static_count && sb_norm(sb_sub(t->wall_position[k], x)) > 1e-6) k++;
        assert_true(k < t->static_count);
        worst = fmax(worst, fabs(t->psi[k] / psi[b] - 1));
    }
    printf("%zu of %zu boundary particles beside the domain, %zu kept, psi: worst %.2g\n", beside, m->wall_count,
           t->static_count, worst);
    assert_true(beside > 500 && t->static_count < m->wall_count && worst < 1e-6);
    sb_free(psi);
    return pairs;
}

/* Terrain often extends beyond the domain. Boundary particles there must not hide walls within the domain, although
   their cells have the same keys. */
static void walls_beyond_the_domain_hide_nothing(void **state)
{
    setup s;
    tank_of_particles(&s.tank, 3, 0.1, sb_vec(2.4, 0.8, 0.8), 2.4, 0.6, 0);
    tank_use(&s.tank, preset_of(state));
    tank_scatter(&s.tank, 11, 1);
    size_t hill = tank_add_plate(&s.tank, "hill", -3.05, -6, 6, sb_vec(0, 0, 0), NULL);
    for (int far = -2; far <= 6; far++) {
        s.tank.model.body_count = hill + 1;
        tank_add_plate(&s.tank, "part", 1.2 * far + 0.05, -6, 6, sb_vec(0, 0, 0), NULL);
    }
    sb_model_body *body = &s.tank.model.bodies[hill];
    body->count = s.tank.model.wall_count - body->begin;
    s.tank.model.body_count = hill + 1;
    for (size_t f = 0; f < s.tank.model.facets.count; f++)
        if (s.tank.model.facets.facets[f].body > hill) s.tank.model.facets.facets[f].body = (uint32_t)hill;
    s.sim = tank_sim(&s.tank);
    assert_non_null(s.sim);
    assert_int_equal(tank_prepare(s.sim, 0.01), 0);
    const sb_cells *cells = &s.sim->walls.set[SB_STATIC].cells;
    for (size_t c = 0; c < cells->count; c++)
        for (size_t d = 0; d < c; d++) assert_true(cells->code[c] != cells->code[d]);
    assert_int_equal(twin_make(s.sim, &s.twin), 0);
    check_lists(&s);
    check_sums(&s);
    assert_int_equal(check_against_model(&s), s.twin.reference.wall_start[s.sim->state.n]);
    end(&s);
}

static void collapse_and_missing_memory_are_distinguished(void **state)
{
    setup s;
    begin(&s, 2, preset_of(state), NULL);
    sb_error error = {0};
    int failures = 0;
    for (long n = 1;; n++) {
        error = (sb_error){0};
        s.sim->work.pairs.capacity = s.sim->work.wall_pairs.capacity = 0;
        sb_memory_fail_at(n);
        if (sb_stage_neighbours(s.sim, &error) == SB_OK) break;
        failures++;
        if (!strstr(error.text, "out of memory")) fail_msg("allocation %ld failed, but: %s", n, error.text);
    }
    sb_memory_fail_at(0);
    assert_true(failures > 5);
    check_lists(&s);
    end(&s);
    /* All water at one position: more particles than lists can hold. */
    begin(&s, 3, preset_of(state), NULL);
    assert_true(s.sim->state.n > 1024);
    for (size_t i = 0; i < s.sim->state.n; i++) s.sim->state.position[i] = s.sim->state.position[0];
    s.sim->state.time_step = 0.01;
    assert_int_equal(sb_stage_sort(s.sim, &error), SB_OK);
    assert_int_equal(sb_stage_neighbours(s.sim, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "collapsed"));
    end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        in_both_presets(a_flat_cloud_with_walls),
        in_both_presets(a_cloud_with_walls),
        cmocka_unit_test(other_kernels),
        in_both_presets(lists_do_not_depend_on_the_pool),
        in_both_presets(walls_beyond_the_domain_hide_nothing),
        in_both_presets(collapse_and_missing_memory_are_distinguished),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
