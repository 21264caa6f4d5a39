/* Measures the properties of sampled surfaces by brute force over random points of the boundary surface. */
#ifndef TEST_SAMPLE_H
#define TEST_SAMPLE_H

#include "base/memory.h"
#include "base/random.h"
#include "geometry/sampling/sample.h"
#include "geometry/sampling/set.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

enum { TEST_SOURCES = 4 };

typedef struct test_surfaces {
    sb_mesh mesh[TEST_SOURCES];
    sb_solid *solid[TEST_SOURCES];
    sb_sample_source source[TEST_SOURCES];
    size_t count;
    sb_role role;
    bool moving[TEST_SOURCES];
    sb_sample_settings settings;
    sb_samples samples;
} test_surfaces;

typedef struct test_rules {
    double nearest;  /* smallest distance between two particles */
    double farthest; /* largest distance from a point of the boundary surface to its nearest particle */
    double density;  /* particles per area of the boundary surface, estimated by the fraction of tested points */
    size_t tested;
} test_rules;

static inline sb_vec3 test_random(uint64_t seed, uint64_t i)
{
    return sb_vec(2 * sb_random(seed, 3 * i) - 1, 2 * sb_random(seed, 3 * i + 1) - 1,
                  2 * sb_random(seed, 3 * i + 2) - 1);
}

/* Samples at spacing 1 in a domain around all meshes. */
static inline void test_sample(test_surfaces *s, double offset)
{
    sb_error error = {0};
    sb_vec3 min = sb_vec(1e9, 1e9, 1e9), max = sb_scale(min, -1);
    for (size_t k = 0; k < s->count; ++k) {
        if (!s->solid[k]) assert_int_equal(sb_solid_create(&s->mesh[k], s->role, &s->solid[k], &error), SB_OK);
        s->source[k] = (sb_sample_source){&s->mesh[k], s->solid[k], s->role, s->moving[k]};
        for (size_t i = 0; i < s->mesh[k].vertex_count; ++i) {
            min = sb_min(min, s->mesh[k].vertices[i]);
            max = sb_max(max, s->mesh[k].vertices[i]);
        }
    }
    s->settings = (sb_sample_settings){.spacing = 1,
                                       .offset = offset,
                                       .support = 2,
                                       .dimensions = 3,
                                       .min = sb_vec(floor(min.x), floor(min.y), floor(min.z)),
                                       .max = max};
    sb_samples_free(&s->samples);
    assert_int_equal(sb_sample_surfaces(&s->settings, s->source, s->count, &s->samples, &error), SB_OK);
}

static inline void test_surfaces_free(test_surfaces *s)
{
    for (size_t k = 0; k < s->count; ++k) {
        sb_solid_destroy(s->solid[k]);
        sb_mesh_free(&s->mesh[k]);
    }
    sb_samples_free(&s->samples);
    memset(s, 0, sizeof *s);
}

static inline double test_area(const sb_mesh *mesh, size_t t)
{
    const uint32_t *c = mesh->triangles[t];
    sb_vec3 a = mesh->vertices[c[0]];
    return 0.5 * sb_norm(sb_cross(sb_sub(mesh->vertices[c[1]], a), sb_sub(mesh->vertices[c[2]], a)));
}

static inline sb_vec3 test_normal(const sb_mesh *mesh, size_t t)
{
    const uint32_t *c = mesh->triangles[t];
    sb_vec3 a = mesh->vertices[c[0]];
    return sb_normalize(sb_cross(sb_sub(mesh->vertices[c[1]], a), sb_sub(mesh->vertices[c[2]], a)));
}

static inline double test_total_area(const sb_mesh *mesh)
{
    double sum = 0;
    for (size_t t = 0; t < mesh->triangle_count; ++t) sum += test_area(mesh, t);
    return sum;
}

static inline sb_vec3 test_on_triangle(const sb_mesh *mesh, size_t t, uint64_t i)
{
    double u = sb_random(7, 2 * i), v = sb_random(7, 2 * i + 1);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    const uint32_t *c = mesh->triangles[t];
    sb_vec3 a = mesh->vertices[c[0]];
    return sb_madd(sb_madd(a, u, sb_sub(mesh->vertices[c[1]], a)), v, sb_sub(mesh->vertices[c[2]], a));
}

/* Whether a point of a surface, with its normal towards the water, is covered by another solid so far around that no
   water comes near. */
static inline bool test_buried(const test_surfaces *s, size_t k, sb_vec3 foot, sb_vec3 normal)
{
    const double ball = s->settings.offset + 0.25;
    const sb_vec3 center = sb_madd(foot, ball, normal);
    for (size_t j = 0; j < s->count; ++j)
        if (j != k && !s->moving[j] && !s->moving[k] && sb_solid_contains(s->solid[j], center) &&
            sb_solid_distance(s->solid[j], center, ball, NULL, NULL) >= ball - 1e-3)
            return true;
    return false;
}

/* Finds a random point of the boundary surface: the place `offset` behind the surface nearest to some point inside
   the solid. Returns false if that is not part of the boundary surface (nearer to other faces, or beyond an open
   border). */
static inline bool test_boundary_point(const test_surfaces *s, size_t k, size_t t, uint64_t i, sb_vec3 *at)
{
    double d = s->settings.offset;
    const sb_vec3 on = test_on_triangle(&s->mesh[k], t, i);
    *at = on;
    if (d <= 0) return !test_buried(s, k, on, test_normal(&s->mesh[k], t));
    sb_vec3 x = sb_madd(on, 1.5 * d, test_random(3, i)), foot, normal;
    if (!sb_solid_contains(s->solid[k], x)) return false;
    double distance = sb_solid_distance(s->solid[k], x, 9, &foot, &normal);
    sb_vec3 margin = sb_vec(0.01, 0.01, 0.01);
    sb_vec3 low = sb_add(s->settings.min, margin), high = sb_sub(s->settings.max, margin);
    bool rim = s->role == SB_ROLE_TERRAIN ? foot.x < low.x || foot.y < low.y || foot.x > high.x || foot.y > high.y
                                          : s->mesh[k].open_surface && foot.z > high.z;
    if (distance < 0.02 * d || rim || test_buried(s, k, foot, sb_scale(sb_sub(foot, x), 1 / distance))) return false;
    *at = sb_madd(foot, d / distance, sb_sub(x, foot));
    for (size_t j = 0; j < s->count; ++j)
        if (sb_solid_distance(s->solid[j], *at, d, NULL, NULL) < 0.97 * d) return false;
    return sb_solid_contains(s->solid[k], *at);
}

static inline test_rules test_measure(const test_surfaces *s, size_t points_per_area)
{
    test_rules rules = {.nearest = HUGE_VAL};
    sb_sample_set set = {.cell = 1, .origin = s->settings.min};
    for (size_t i = 0; i < s->samples.count; ++i) {
        sb_vec3 at = s->samples.position[i];
        rules.nearest = fmin(rules.nearest, sb_sample_set_nearest(&set, at, 2, NULL));
        assert_int_equal(sb_sample_set_add(&set, &(sb_sample){.at = at}), 0);
    }
    double area = 0;
    uint64_t i = 0;
    for (size_t k = 0; k < s->count; ++k) {
        double owed = 0;
        area += test_total_area(&s->mesh[k]);
        for (size_t t = 0; t < s->mesh[k].triangle_count; ++t) {
            owed += test_area(&s->mesh[k], t) * (double)points_per_area;
            for (; owed > 0; owed -= 1, ++i) {
                sb_vec3 at;
                if (!test_boundary_point(s, k, t, i, &at)) continue;
                ++rules.tested;
                rules.farthest = fmax(rules.farthest, sb_sample_set_nearest(&set, at, 3, NULL));
            }
        }
    }
    rules.density = (double)s->samples.count / area;
    sb_sample_set_free(&set);
    return rules;
}

/* Checks the two distance rules, and that no particle is in the water. */
static inline test_rules test_check(const test_surfaces *s, const char *name)
{
    test_rules rules = test_measure(s, 150);
    if (rules.nearest < 0.7 || rules.farthest > 0.75)
        print_message("%s, offset %g: nearest %.4f, farthest %.4f\n", name, s->settings.offset, rules.nearest,
                      rules.farthest);
    assert_true(rules.tested > 100);
    assert_true(rules.nearest >= 0.7);
    assert_true(rules.farthest <= 0.75);
    for (size_t i = 0; i < s->samples.count && s->settings.offset > 0 && s->role == SB_ROLE_SOLID; ++i) {
        bool inside = false;
        for (size_t k = 0; k < s->count && !inside; ++k)
            inside = sb_solid_contains(s->solid[k], s->samples.position[i]);
        assert_true(inside);
    }
    return rules;
}

static inline void test_rotate(sb_mesh *mesh, double about_z, double about_y)
{
    double c = cos(about_z), s = sin(about_z), d = cos(about_y), t = sin(about_y);
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        sb_vec3 p = mesh->vertices[i];
        p = sb_vec(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
        mesh->vertices[i] = sb_vec(d * p.x + t * p.z, p.y, d * p.z - t * p.x);
    }
}

/* Makes a ball of n bands; every ring has 2 n corners. */
static inline void test_ball(double radius, uint32_t n, sb_mesh *mesh)
{
    sb_error error;
    assert_int_equal(sb_mesh_alloc(mesh, (size_t)(n + 1) * 2 * n, (size_t)4 * n * n, &error), SB_OK);
    size_t t = 0;
    for (uint32_t i = 0; i <= n; ++i)
        for (uint32_t j = 0; j < 2 * n; ++j) {
            double a = M_PI * i / n, b = M_PI * j / n, s = i == 0 || i == n ? 0 : radius * sin(a);
            mesh->vertices[i * 2 * n + j] = sb_vec(s * cos(b), s * sin(b), radius * cos(a));
        }
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < 2 * n; ++j) {
            uint32_t a = i * 2 * n + j, b = i * 2 * n + (j + 1) % (2 * n), c = a + 2 * n, d = b + 2 * n;
            if (i > 0) memcpy(mesh->triangles[t++], (uint32_t[3]){a, c, b}, sizeof(uint32_t[3]));
            if (i + 1 < n) memcpy(mesh->triangles[t++], (uint32_t[3]){b, c, d}, sizeof(uint32_t[3]));
        }
    mesh->triangle_count = t;
}

/* Makes a hilly surface of (length/cell)^2 cells whose steepest slope is about `slope`. */
static inline void test_hills(double length, double cell, double slope, double wave, sb_mesh *mesh)
{
    sb_error error;
    uint32_t n = (uint32_t)lround(length / cell);
    assert_int_equal(sb_mesh_alloc(mesh, (size_t)(n + 1) * (n + 1), (size_t)2 * n * n, &error), SB_OK);
    size_t t = 0;
    for (uint32_t i = 0; i <= n; ++i)
        for (uint32_t j = 0; j <= n; ++j) {
            double x = i * cell, y = j * cell;
            double z = slope / wave * (sin(wave * x) + cos(wave * (1.3 * y + 0.4 * x)));
            mesh->vertices[i * (n + 1) + j] = sb_vec(x, y, z);
        }
    for (uint32_t i = 0; i < n; ++i)
        for (uint32_t j = 0; j < n; ++j) {
            uint32_t a = i * (n + 1) + j, b = a + n + 1;
            memcpy(mesh->triangles[t++], (uint32_t[3]){a, b, b + 1}, sizeof(uint32_t[3]));
            memcpy(mesh->triangles[t++], (uint32_t[3]){a, b + 1, a + 1}, sizeof(uint32_t[3]));
        }
}

#endif
