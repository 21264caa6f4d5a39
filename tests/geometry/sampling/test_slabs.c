/* Tests that boundary particles are placed slab by slab: that a slab depends on few others, and that the particles are
   as good as those of a surface that is sampled as a whole. */
#include "geometry/sampling/parts.h"
#include "test_sample.h"

static test_surfaces s;

static int tear_down(void **state)
{
    (void)state;
    test_surfaces_free(&s);
    return 0;
}

/* Ground 168 long and 12 wide with a steep slope across the slabs, a tilted box, and two balls over borders of slabs.
 */
static void landscape(void)
{
    sb_error error;
    s.count = 4;
    test_hills(42, 3, 0.3, 0.3, &s.mesh[0]);
    for (size_t i = 0; i < s.mesh[0].vertex_count; ++i) {
        s.mesh[0].vertices[i].x *= 4;
        s.mesh[0].vertices[i].y *= 12.0 / 42;
    }
    assert_int_equal(sb_mesh_box(sb_vec(30, 2, 5), sb_vec(50, 9, 9), &s.mesh[1], &error), SB_OK);
    test_rotate(&s.mesh[1], 0.1, -0.1);
    test_ball(9, 16, &s.mesh[2]);
    test_ball(4, 8, &s.mesh[3]);
    for (size_t i = 0; i < s.mesh[2].vertex_count; ++i)
        s.mesh[2].vertices[i] = sb_add(s.mesh[2].vertices[i], sb_vec(130, 6, 4));
    for (size_t i = 0; i < s.mesh[3].vertex_count; ++i)
        s.mesh[3].vertices[i] = sb_add(s.mesh[3].vertices[i], sb_vec(33.9, 6, 12));
}

/* Builds the surfaces of `s` for a sampler of static surfaces. */
static sb_sampler sampler_of(double offset)
{
    sb_error error = {0};
    test_sample(&s, offset);
    sb_sampler sampler = {.settings = s.settings,
                          .surfaces = sb_alloc(s.count, sizeof *sampler.surfaces),
                          .surface_count = s.count,
                          .last = (uint32_t)s.count,
                          .set = {.cell = 1, .origin = s.settings.min}};
    assert_non_null(sampler.surfaces);
    sb_slabs_choose(&s.settings, &sampler.slabs, &sampler.rows);
    for (size_t i = 0; i < s.count; ++i)
        assert_int_equal(sb_surface_build(&s.source[i], &s.settings, &sampler.surfaces[i], &error), SB_OK);
    return sampler;
}

static void sampler_free(sb_sampler *sampler)
{
    for (size_t i = 0; i < sampler->surface_count; ++i) sb_surface_free(&sampler->surfaces[i]);
    sb_free(sampler->surfaces);
}

typedef struct found {
    sb_sample *sample;
    size_t count, capacity, most;
} found;

static int collect(void *context, sb_sample *samples, size_t count)
{
    found *all = context;
    assert_int_equal(sb_grow((void **)&all->sample, &all->capacity, all->count + count, sizeof *all->sample), 0);
    for (size_t i = 0; i < count; ++i) all->sample[all->count++] = samples[i];
    all->most = count > all->most ? count : all->most;
    return 0;
}

/* Each range of slabs, sampled alone, has the particles that it has in the whole, to the last bit. */
static void ranges_are_parts_of_the_whole(void **state)
{
    (void)state;
    landscape();
    sb_sampler sampler = sampler_of(0.6);
    found whole = {.count = 0}, part = {.count = 0};
    const uint32_t count = sampler.slabs.count, ranges[][2] = {{0, 1}, {1, 4}, {6, 7}, {7, 8}, {9, count}, {3, 3}};
    assert_in_range(count, 10, 11);
    assert_int_equal(sb_slabs_sample(&sampler, 0, count, collect, &whole), 0);
    print_message("%zu particles, at most %zu in a slab\n", whole.count, whole.most);
    assert_true(whole.count > 2500 && whole.most < whole.count / 4);
    for (size_t k = 0; k < sizeof ranges / sizeof *ranges; ++k) {
        size_t at = 0;
        part.count = 0;
        assert_int_equal(sb_slabs_sample(&sampler, ranges[k][0], ranges[k][1], collect, &part), 0);
        for (size_t i = 0; i < whole.count; ++i) {
            if (whole.sample[i].slab < ranges[k][0] || whole.sample[i].slab >= ranges[k][1]) continue;
            assert_true(at < part.count);
            assert_memory_equal(&part.sample[at++], &whole.sample[i], sizeof *whole.sample);
        }
        assert_int_equal(at, part.count);
        assert_true((at > 0) == (ranges[k][1] > ranges[k][0]));
    }
    sb_free(whole.sample);
    sb_free(part.sample);
    sampler_free(&sampler);
}

/* Returns the sum of the areas of the particles: the inverse of each one's kernel sum over a surface. */
static double sum_of_areas(const found *all, double range)
{
    double sum = 0;
    for (size_t i = 0; i < all->count; ++i) {
        double kernel = 0;
        for (size_t k = 0; k < all->count; ++k) {
            const sb_vec3 arm = sb_sub(all->sample[i].at, all->sample[k].at);
            const double q2 = sb_dot(arm, arm) / (range * range);
            if (q2 < 1) kernel += pow(1 - sqrt(q2), 4) * (1 + 4 * sqrt(q2));
        }
        sum += M_PI * range * range / (7 * kernel);
    }
    return sum;
}

/* Measures the rules of distances at few random points. */
static test_rules check(const found *all)
{
    sb_samples_free(&s.samples);
    s.samples.position = sb_alloc(all->count, sizeof *s.samples.position);
    assert_non_null(s.samples.position);
    for (size_t i = 0; i < all->count; ++i) s.samples.position[i] = all->sample[i].at;
    s.samples.count = all->count;
    const test_rules rules = test_measure(&s, 4);
    assert_true(rules.tested > 1000 && rules.nearest >= 0.7 && rules.farthest <= 0.75);
    return rules;
}

/* The same surfaces in one slab and in several: the particles obey the same rules of distances, and there are no more
   of them than the borders can explain, one in fifty. */
static void slabs_are_as_good_as_the_whole(void **state)
{
    (void)state;
    for (int k = 0; k < 2; ++k) {
        if (k == 0) {
            s.count = 1;
            test_ball(25, 24, &s.mesh[0]);
        } else {
            s.count = 1;
            s.role = SB_ROLE_TERRAIN;
            test_hills(60, 3, 0.9, 0.15, &s.mesh[0]);
        }
        sb_sampler sampler = sampler_of(0.6);
        found slabs = {.count = 0}, whole = {.count = 0};
        assert_true(sampler.slabs.count > 2);
        assert_int_equal(sb_slabs_sample(&sampler, 0, sampler.slabs.count, collect, &slabs), 0);
        const test_rules now = check(&slabs);
        sampler.slabs.count = 1;
        assert_int_equal(sb_slabs_sample(&sampler, 0, 1, collect, &whole), 0);
        const test_rules before = check(&whole);
        const double area = sum_of_areas(&slabs, 2.5), area_before = sum_of_areas(&whole, 2.5);
        print_message("%zu and %zu particles; farthest %.4f, %.4f; areas %.1f, %.1f\n", slabs.count, whole.count,
                      now.farthest, before.farthest, area, area_before);
        assert_true((double)slabs.count < 1.02 * (double)whole.count);
        assert_true(fabs(area - area_before) < 0.005 * area_before);
        sb_free(slabs.sample);
        sb_free(whole.sample);
        sampler_free(&sampler);
        test_surfaces_free(&s);
    }
}

/* Voids are filled row after row of each slab; rows are shorter here than in the program. A range of slabs is still a
   part of the whole, and the rules of distances hold where rows meet. */
static void rows_are_as_good_as_one(void **state)
{
    (void)state;
    s.count = 1;
    s.role = SB_ROLE_TERRAIN;
    test_hills(42, 3, 0.3, 0.3, &s.mesh[0]);
    for (size_t i = 0; i < s.mesh[0].vertex_count; ++i) {
        s.mesh[0].vertices[i].x *= 170.0 / 42;
        s.mesh[0].vertices[i].y *= 100.0 / 42;
    }
    sb_sampler sampler = sampler_of(0.6);
    found whole = {.count = 0}, part = {.count = 0};
    sampler.rows.width = 32 * s.settings.spacing;
    sampler.rows.count = 3;
    assert_int_equal(sb_slabs_sample(&sampler, 0, sampler.slabs.count, collect, &whole), 0);
    assert_int_equal(sb_slabs_sample(&sampler, 4, 6, collect, &part), 0);
    size_t at = 0;
    for (size_t i = 0; i < whole.count; ++i) {
        if (whole.sample[i].slab < 4 || whole.sample[i].slab >= 6) continue;
        assert_true(at < part.count);
        assert_memory_equal(&part.sample[at++], &whole.sample[i], sizeof *whole.sample);
    }
    assert_true(at == part.count && at > 1000);
    const test_rules rules = check(&whole);
    print_message("%zu particles, farthest %.4f\n", whole.count, rules.farthest);
    sb_free(whole.sample);
    sb_free(part.sample);
    sampler_free(&sampler);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(ranges_are_parts_of_the_whole, tear_down),
        cmocka_unit_test_teardown(slabs_are_as_good_as_the_whole, tear_down),
        cmocka_unit_test_teardown(rows_are_as_good_as_one, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
