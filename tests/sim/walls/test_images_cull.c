/* Tests which images are left out before they are candidates: for facets, groups of particles and sources at random, a
   path by one or several reflections that is left out has no weight for any particle of the group, and one that is
   known as whole has the weight 1. */
#include "base/random.h"
#include "check.h"
#include "sim/passes/cpu/path_weights.h"

#include <stdio.h>

enum { TRIALS = 4000, PARTICLES = 40 };

static sb_near near;
static sb_cull cull;
static sb_sources sources;
static sb_standing standing;
static sb_relations relations;
static float x[2 * SB_SOURCES_MAX], y[2 * SB_SOURCES_MAX], z[2 * SB_SOURCES_MAX];
static const float SPACING = 1000, SUPPORT = 2750, EDGE = 2750;
static uint64_t draws;

/* In [from, to). */
static float draw(float from, float to)
{
    return from + (to - from) * (float)sb_random(5, draws++);
}

/* What sb_cull_begin reads of a simulation. */
static const sb_sim *lengths(void)
{
    static sb_sim sim;
    sim.constant.spacing = SPACING;
    sim.constant.support = SUPPORT;
    sim.space.quantum = 1;
    return &sim;
}

static sb_f4 unit(sb_f4 v)
{
    return v * sb_splat(1 / sqrtf(sb_sum3(v * v)));
}

static sb_f4 across(sb_f4 a, sb_f4 b)
{
    return (sb_f4){a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0], 0};
}

/* One facet through a point near the group, with up to four edges that surround some place in its plane. */
static void make_facet(void)
{
    const sb_f4 level = {0, 0, 1, 0}, any = {draw(-1, 1), draw(-1, 1), draw(-1, 1), 0};
    const sb_f4 n = draws % 3 == 0 ? level : unit(any), u = unit(across(n, (sb_f4){0.3f, 0.8f, 0.5f, 0}));
    const sb_f4 v = across(n, u), at = {draw(0, 4 * EDGE), draw(0, 4 * EDGE), draw(EDGE, 3 * EDGE), 0};
    const sb_f4 inward[4] = {u, v, -u, -v};
    near.count = 1;
    near.edge_count = (size_t)draw(0, 4.99f);
    near.facet[0] = (sb_near_facet){.plane = n, .edges = (uint32_t)near.edge_count, .both = draw(0, 1) < 0.3f};
    near.facet[0].plane[3] = sb_sum3(n * at);
    for (size_t k = 0; k < near.edge_count; k++) {
        near.edges[k] = (sb_near_edge){inward[k], SB_BEND_CONVEX};
        near.edges[k].inward[3] = sb_sum3(inward[k] * at) - draw(0, 3 * SPACING);
    }
}

static sb_f4 particle(sb_f4 low, sb_f4 high)
{
    return (sb_f4){draw(low[0], high[0]), draw(low[1], high[1]), draw(low[2], high[2]), 0};
}

/* The weight of the path between two places by the facet. */
static float weight(sb_f4 self, sb_f4 source)
{
    const sb_near_facet *f = &near.facet[0];
    const sb_weigher w = {&near, &relations, self, SB_TRANSITION * SPACING, 1e-3f * SPACING, &standing};
    sb_half_angle angle[4];
    bool meets = true;
    standing.above[0] = sb_before_facet(f, self);
    standing.edge[0] = sb_about_edges(&near, f, self, standing.above[0], standing.angle);
    const float above = sb_before_facet(f, source);
    const sb_other_end j = {above, sb_about_edges(&near, f, source, above, angle), angle};
    return sb_at_facet(&w, 0, j, &meets).value;
}

static void what_is_left_out_has_no_weight(void **state)
{
    (void)state;
    size_t beyond = 0, whole = 0, weighed = 0, pairs = 0;
    for (int trial = 0; trial < TRIALS; trial++) {
        make_facet();
        const sb_f4 low = {EDGE + draw(0, EDGE), EDGE + draw(0, EDGE), EDGE + draw(0, EDGE), 0};
        const sb_f4 high = low + (sb_f4){draw(0, EDGE), draw(0, EDGE), draw(0, EDGE), 0};
        sources = (sb_sources){.count = 1 + (size_t)draw(0, 40), .x = x, .y = y, .z = z};
        sources.lowest[0] = INFINITY, sources.highest[0] = -INFINITY;
        const sb_f4 cell = {EDGE * floorf(draw(0, 4)), EDGE * floorf(draw(0, 4)), EDGE * floorf(draw(0, 4)), 0};
        for (size_t s = 0; s < sources.count; s++)
            x[s] = cell[0] + draw(0, EDGE), y[s] = cell[1] + draw(0, EDGE), z[s] = cell[2] + draw(0, EDGE);
        sb_cull_begin(lengths(), &near, low, high, &cull);
        const bool any = sb_cull_sources(&near, &cull, &sources);
        for (size_t s = 0; s < sources.count; s++) {
            const sb_f4 source = {x[s], y[s], z[s], 0};
            const bool none = !any || sources.apart[0][s] || sources.beyond[0][s];
            for (int p = 0; p < PARTICLES; p++) {
                const sb_f4 self = particle(low, high);
                const sb_f4 path = self - sb_reflect(near.facet[0].plane, source), way = self - source;
                if (sb_sum3(path * path) >= SUPPORT * SUPPORT || sb_sum3(way * way) >= SUPPORT * SUPPORT) continue;
                const float value = weight(self, source);
                pairs++;
                weighed += value > 0;
                beyond += none;
                if (none) assert_true(value == 0);
                if (none || !sources.whole[0][s] || !(standing.above[0] > 0)) continue;
                whole++;
                assert_true(value == 1);
            }
        }
    }
    printf("%zu pairs: %zu have weight, %zu were left out, %zu were known as whole\n", pairs, weighed, beyond, whole);
    assert_true(beyond > (pairs - weighed) / 4);
    assert_true(whole > weighed / 10);
}

/* ---- several reflections ---- */

enum { FACETS_MAX = 4, PLACES = 30 };

/* A facet with four edges about a place near the group. */
static void add_facet(void)
{
    const sb_f4 level = {0, 0, 1, 0}, any = {draw(-1, 1), draw(-1, 1), draw(-1, 1), 0};
    const sb_f4 n = draws % 3 == 0 ? level : unit(any), u = unit(across(n, (sb_f4){0.3f, 0.8f, 0.5f, 0}));
    const sb_f4 v = across(n, u), at = {draw(0, 4 * EDGE), draw(0, 4 * EDGE), draw(0, 4 * EDGE), 0};
    const sb_f4 inward[4] = {u, v, -u, -v};
    sb_near_facet *f = &near.facet[near.count++];
    *f = (sb_near_facet){.plane = n, .edge = (uint32_t)near.edge_count, .edges = 4, .both = draw(0, 1) < 0.3f};
    f->plane[3] = sb_sum3(n * at);
    for (size_t k = 0; k < 4; k++) {
        sb_near_edge *e = &near.edges[near.edge_count++];
        *e = (sb_near_edge){inward[k], draw(0, 1) < 0.2f ? SB_BEND_CONCAVE : SB_BEND_CONVEX};
        e->inward[3] = sb_sum3(inward[k] * at) - draw(0, 3 * SPACING);
    }
}

/* The weight of a path to this particle. */
static float weight_of(const size_t *by, int count, sb_f4 self, sb_f4 source, sb_f4 image)
{
    const sb_weigher w = {&near, &relations, self, SB_TRANSITION * SPACING, 1e-3f * SPACING, &standing};
    sb_weight_parts all;
    for (size_t a = 0; a < near.count; a++) {
        const sb_near_facet *f = &near.facet[a];
        standing.above[a] = sb_before_facet(f, self);
        standing.edge[a] = sb_about_edges(&near, f, self, standing.above[a], standing.angle + f->edge);
    }
    sb_path_weight(&w, by, count, source, image, &all);
    return all.value;
}

static void paths_that_are_left_out_have_no_weight(void **state)
{
    (void)state;
    size_t pairs = 0, weighed = 0, missed = 0;
    for (int trial = 0; trial < 20 * TRIALS; trial++) {
        near.count = near.edge_count = 0;
        near.simple = true;
        for (int k = 0; k < FACETS_MAX; k++) add_facet();
        const sb_f4 low = {EDGE + draw(0, EDGE), EDGE + draw(0, EDGE), EDGE + draw(0, EDGE), 0};
        const sb_f4 high = low + (sb_f4){draw(0, EDGE), draw(0, EDGE), draw(0, EDGE), 0};
        sb_cull_begin(lengths(), &near, low, high, &cull);
        const sb_f4 source = particle(low - sb_splat(EDGE), high + sb_splat(EDGE));
        const int count = 2 + (int)draw(0, 2.99f);
        size_t by[FACETS_MAX];
        uint32_t path = 0;
        sb_f4 image = source;
        for (int k = 0; k < count; k++) {
            do by[k] = (size_t)draw(0, FACETS_MAX - 0.01f);
            while (k > 0 && by[k] == by[k - 1]);
            path |= (uint32_t)(by[k] + 1) << (SB_REFLECTION_BITS * k);
            image = sb_reflect(near.facet[by[k]].plane, image);
        }
        const bool meets = sb_cull_meets(&near, &cull, path, image);
        for (int p = 0; p < PLACES; p++) {
            const sb_f4 self = particle(low, high), way = self - image;
            if (sb_sum3(way * way) >= 4 * SUPPORT * SUPPORT) continue;
            const float value = weight_of(by, count, self, source, image);
            pairs++;
            weighed += value > 0;
            missed += !meets;
            if (!meets) assert_true(value == 0);
        }
    }
    printf("%zu pairs: %zu have weight, %zu were left out\n", pairs, weighed, missed);
    assert_true(weighed > 100);
    assert_true(missed > (pairs - weighed) / 4);
}

/* ---- routes ---- */

/* How the facets stand to each other, for facets that all see each other. */
static void relate(void)
{
    near.skew = near.meeting = true;
    for (size_t a = 0; a < near.count; a++) {
        near.blunt[a] = false;
        for (size_t b = 0; b < near.count; b++) {
            const float along = sb_sum3(near.facet[a].plane * near.facet[b].plane);
            near.meets[a][b] = a != b && along < SB_BENT;
            near.sectors[a][b] = !near.meets[a][b]      ? 0
                                 : fabsf(along) < 1e-3f ? 2
                                 : along < -0.9999f     ? INFINITY
                                                        : (float)M_PI / acosf(-along);
            near.blunt[a] |= near.sectors[a][b] < 2 && near.sectors[a][b] > SB_SECTORS_LEAST;
        }
    }
    sb_relations_find(&near, &relations);
}

/* Whether a path by these facets is one that counts at all, however its ends lie. */
static bool is_route(const size_t *by, int count)
{
    sb_route so_far = {.depth = 0};
    for (int k = 0; k < count; k++) {
        for (int m = 0; m < k; m++)
            if (by[m] != by[k] && !(near.meets[by[m]][by[k]] && near.sectors[by[m]][by[k]] > SB_SECTORS_LEAST))
                return false;
        if (k > 0 && !sb_route_ordered(&near, &so_far, by[k])) return false;
        so_far.path |= (uint32_t)(by[k] + 1) << (SB_REFLECTION_BITS * so_far.depth++);
    }
    return true;
}

/* Whether the sets lead along these facets. */
static bool is_offered(const size_t *by, int count)
{
    sb_route from = {.beyond = sources.beyond[by[0]][0]};
    sb_route_begin(&near, &relations, by[0], &from);
    for (int k = 1; k < count; k++) {
        if (!(sb_route_facets(&near, &from, &sources.open[0], 0) >> by[k] & 1)) return false;
        sb_route to = {.beyond = from.beyond || sources.beyond[by[k]][0]};
        sb_route_append(&near, &relations, &from, by[k], &to);
        from = to;
    }
    return true;
}

static void routes_that_are_not_offered_have_no_weight(void **state)
{
    (void)state;
    size_t routes = 0, withheld = 0, weighed = 0;
    for (int trial = 0; trial < 20 * TRIALS; trial++) {
        near.count = near.edge_count = 0;
        near.simple = true;
        for (int k = 0; k < FACETS_MAX; k++) add_facet();
        relate();
        const sb_f4 low = {EDGE + draw(0, EDGE), EDGE + draw(0, EDGE), EDGE + draw(0, EDGE), 0};
        const sb_f4 high = low + (sb_f4){draw(0, EDGE), draw(0, EDGE), draw(0, EDGE), 0};
        const sb_f4 source = particle(low, high);
        sources = (sb_sources){.count = 1, .x = x, .y = y, .z = z};
        for (size_t a = 0; a < near.count; a++) sources.lowest[a] = INFINITY, sources.highest[a] = -INFINITY;
        x[0] = source[0], y[0] = source[1], z[0] = source[2];
        sb_cull_begin(lengths(), &near, low, high, &cull);
        if (!sb_cull_sources(&near, &cull, &sources)) continue;
        const int count = 2 + (int)draw(0, 2.99f);
        size_t by[FACETS_MAX];
        sb_f4 image = source;
        for (int k = 0; k < count; k++) {
            by[k] = (size_t)draw(0, FACETS_MAX - 0.01f);
            image = sb_reflect(near.facet[by[k]].plane, image);
        }
        if (!is_route(by, count)) continue;
        const bool offered = is_offered(by, count);
        routes++;
        withheld += !offered;
        for (int p = 0; p < PLACES; p++) {
            const float value = weight_of(by, count, particle(low, high), source, image);
            weighed += value >= SB_WEIGHT_LEAST;
            if (!offered) assert_true(value < SB_WEIGHT_LEAST);
        }
    }
    printf("%zu routes: %zu were not offered; %zu paths have weight\n", routes, withheld, weighed);
    assert_true(withheld > routes / 10);
    assert_true(weighed > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_left_out_has_no_weight),
                                       cmocka_unit_test(paths_that_are_left_out_have_no_weight),
                                       cmocka_unit_test(routes_that_are_not_offered_have_no_weight)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
