/* Loads on the faces of bodies, by the real simulation. */
#include "../check.h"
#include "base/hash.h"
#include "measure/measure.h"
#include "sim/walls/basin.h"

#include <math.h>
#include <omp.h>
#include <string.h>

/* Water that collapses against a house, a round post and a sill. */
static const sb_override breaking[] = {
    {"resolution", "0.1"},
    {"domain", "{min: [0, 0, 0], max: [2.6, 0.8, 1.2]}"},
    {"water", "{boxes: [{min: [0, 0, 0], max: [0.8, 0.8, 0.8]}]}"},
    {"bodies", "[{name: house, shape: box, min: [1.2, 0.2, 0], max: [1.6, 0.6, 0.9]}, "
               "{name: post, shape: cylinder, center: [2, 0.3, 0], radius: 0.15, height: 0.8}, "
               "{name: sill, shape: box, min: [2.3, 0, 0], max: [2.6, 0.8, 0.2]}]"},
    {"measure.interval", "0.013"},
    {"measure.probes", "[{name: front, at: [1.2, 0.4, 0.3]}]"},
};

typedef struct sums {
    size_t rows, faces; /* rows of forces that were compared, and faces that ever had a load */
    double greatest;    /* N */
    uint64_t loads, probes;
    bool loaded[512];
} sums;

/* Compares the last row of forces on each body with its faces. A step may end several intervals. */
static void compare(const sb_measure *measure, const sb_model *model, double tolerance, sums *s)
{
    size_t count;
    const sb_face_load *faces = sb_measure_faces(measure, &count);
    const sb_measure_records *r = sb_measure_latest(measure);
    for (size_t i = 0; count > 0 && i < r->force_count; i++) {
        const sb_force_record *row = &r->forces[i];
        if (row->time < r->forces[r->force_count - 1].time) continue;
        if (model->bodies[row->body].mesh.triangle_count == 0) continue; /* the domain's sides */
        sb_vec3 sum = {0};
        for (size_t f = 0; f < count; f++)
            if (faces[f].body == row->body) sum = sb_add(sum, faces[f].force);
        const double off = sb_norm(sb_sub(sum, row->pressure));
        if (off > tolerance * (1 + sb_norm(row->pressure)))
            fail_msg("%s at %g s: the faces have %g %g %g N, the body %g %g %g N", model->bodies[row->body].name,
                     row->time, sum.x, sum.y, sum.z, row->pressure.x, row->pressure.y, row->pressure.z);
        s->rows++;
        s->greatest = fmax(s->greatest, sb_norm(sum));
    }
    assert_true(count <= sizeof s->loaded / sizeof *s->loaded);
    for (size_t f = 0; f < count; f++) s->loaded[f] |= sb_norm(faces[f].force) > 0;
    if (r->force_count > 0 && count > 0) s->loads = sb_hash(s->loads, faces, count * sizeof *faces);
    s->probes = sb_hash(s->probes, r->probes, r->probe_count * sizeof *r->probes);
}

static void step(basin *b, sb_measure *measure)
{
    sb_error error = {0};
    if (sb_sim_step(b->sim, &error) != SB_OK || sb_measure_step(measure, b->sim, &error) != SB_OK)
        fail_msg("%s", error.text);
}

static const char PERIODIC[] = "{min: [0, 0, 0], max: [2.6, 0.8, 1.2], sides: {y_min: periodic, y_max: periodic}}";

/* domain: NULL: that of `breaking`. */
static sums run_in(const char *domain, const char *numerics, double tolerance, const char *loads, int threads,
                   double until)
{
    enum { KEYS = sizeof breaking / sizeof *breaking, DOMAIN = 1 };
    sb_override set[KEYS + 2];
    basin b;
    sb_measure *measure;
    sums s = {0};
    memcpy(set, breaking, sizeof breaking);
    if (domain) set[DOMAIN] = (sb_override){"domain", domain};
    set[KEYS] = (sb_override){"numerics", numerics};
    set[KEYS + 1] = (sb_override){"render.loads", loads};
    omp_set_num_threads(threads);
    basin_fill_from(&b, set, KEYS + 2);
    assert_int_equal(sb_measure_create(&b.scene, &b.model, b.sim, &measure, NULL), SB_OK);
    while (sb_sim_report(b.sim)->time < until) {
        step(&b, measure);
        compare(measure, &b.model, tolerance, &s);
    }
    for (size_t f = 0; f < sizeof s.loaded / sizeof *s.loaded; f++) s.faces += s.loaded[f];
    sb_measure_destroy(measure);
    basin_free(&b);
    return s;
}

static sums run(const char *numerics, double tolerance, const char *loads, int threads, double until)
{
    return run_in(NULL, numerics, tolerance, loads, threads, until);
}

/* The force on a body by boundary particles comes from sums in single precision. */
static void loads_of_faces_sum_to_the_force(void **state)
{
    (void)state;
    const sums s = run("{walls: images}", 1e-9, "true", 2, 0.6),
               particles = run("{walls: particles, density: summed, stress_correction: 0}", 1e-5, "true", 2, 0.6);
    print_message("%zu rows, %zu faces with a load, at most %.0f N\n", s.rows, s.faces, s.greatest);
    assert_true(s.rows >= 60 && s.faces >= 8 && s.greatest > 300);
    const sums explicit = run("{preset: wen}", 1e-5, "true", 2, 0.4);
    print_message("explicit: %zu rows, %zu faces with a load, at most %.0f N\n", explicit.rows, explicit.faces,
                  explicit.greatest);
    assert_true(explicit.rows >= 60 && explicit.faces >= 4 && explicit.greatest > 100);
    assert_true(particles.rows >= 60 && particles.faces >= 8 && particles.greatest > 300);
}

/* Water that has passed a periodic side presses on the faces, too. */
static void loads_sum_to_the_force_beside_periodic_sides(void **state)
{
    (void)state;
    static const char *const numerics[] = {
        "{walls: images}", "{walls: particles, density: summed, stress_correction: 0}", "{preset: wen}"};
    for (int n = 0; n < 3; n++) {
        const sums s = run_in(PERIODIC, numerics[n], n == 0 ? 1e-9 : 1e-5, "true", 2, n == 2 ? 0.3 : 0.38);
        print_message("%s: %zu rows, %zu faces with a load, at most %.0f N\n", numerics[n], s.rows, s.faces,
                      s.greatest);
        assert_true(s.rows >= 40 && s.faces >= 3 && s.greatest > 100);
    }
}

static void loads_do_not_depend_on_threads_and_change_nothing(void **state)
{
    (void)state;
    const sums one = run("{walls: images}", 1e-9, "true", 1, 0.35),
               three = run("{walls: images}", 1e-9, "true", 3, 0.35);
    assert_true(one.loads != 0 && one.loads == three.loads);
    assert_true(run("{walls: images}", 1e-9, "false", 1, 0.35).probes == one.probes);
}

/* What a wall of the house carries in water at rest. */
static double hydrostatic(const basin *b, sb_vec3 normal)
{
    const double depth = sb_sim_energy(b->sim).mass / 1000 / (2.4 * 2.2 - 1.0 * 0.6);
    const double width = fabs(normal.x) > 0.5 ? 0.6 : fabs(normal.y) > 0.5 ? 1.0 : 0;
    return 0.5 * 9810 * depth * depth * width;
}

/* A house in water at rest: the loads of its walls at 0.5 s are hydrostatic, within 3 % of that on one metre. */
static void check_house_in_still_water(const char *sides, const char *house)
{
    char domain[200];
    snprintf(domain, sizeof domain, "{min: [0, 0, 0], max: [2.4, 2.2, 1.6], sides: %s}", sides);
    const sb_override set[] = {{"resolution", "0.1"},
                               {"domain", domain},
                               {"water", "{boxes: [{min: [0, 0, 0], max: [2.4, 2.2, 1]}]}"},
                               {"bodies", house},
                               {"measure.interval", "0.5"},
                               {"render.loads", "true"}};
    basin b;
    sb_measure *measure;
    size_t count = 0;
    omp_set_num_threads(2);
    basin_fill_from(&b, set, sizeof set / sizeof *set);
    basin_settle(&b);
    assert_int_equal(sb_measure_create(&b.scene, &b.model, b.sim, &measure, NULL), SB_OK);
    sb_measure_faces(measure, &count);
    assert_int_equal(count, 0); /* not known before the end of an interval */
    while (sb_sim_report(b.sim)->time < 0.5) step(&b, measure);
    const sb_face_load *faces = sb_measure_faces(measure, &count);
    assert_int_equal(count, 6);
    sb_frame *frame = sb_sim_snapshot(b.sim);
    assert_int_equal(sb_measure_fill_frame(measure, frame, NULL), SB_OK);
    assert_int_equal(frame->face_count, 6);
    const double metre = hydrostatic(&b, sb_vec(0, 1, 0));
    for (size_t f = 0; f < count; f++) {
        const sb_vec3 n = faces[f].normal;
        const double expected = hydrostatic(&b, n), load = -sb_dot(faces[f].force, n);
        print_message("normal %2.0f %2.0f %2.0f: %.0f N, expected %.0f N\n", n.x, n.y, n.z, load, expected);
        assert_true(fabs(load - expected) < 0.03 * metre);
        assert_true(fabs((double)frame->face_pressure[f] * faces[f].area - load) < 1e-5 * (1 + fabs(load)));
    }
    sb_frame_release(frame);
    sb_measure_destroy(measure);
    basin_free(&b);
}

/* Beside water at rest each wall of a house carries rho g h^2 / 2 per metre over the part that is wet, and the roof
   above it nothing. A face that took the forces of its neighbour would have twice as much, or none. */
static void walls_in_still_water_have_the_hydrostatic_load(void **state)
{
    (void)state;
    check_house_in_still_water("{x_min: wall}",
                               "[{name: house, shape: box, min: [0.8, 0.8, 0], max: [1.8, 1.4, 1.4]}]");
}

/* Two walls of the house are in a periodic side: the water before one of them is at the other end of the domain. */
static void walls_in_a_periodic_side_have_the_hydrostatic_load(void **state)
{
    (void)state;
    static const char sides[] = "{y_min: periodic, y_max: periodic}";
    static const char low[] = "[{name: house, shape: box, min: [0.8, 0, 0], max: [1.8, 0.6, 1.4]}]";
    check_house_in_still_water(sides, low);
}

static uint64_t finish(basin *b, sb_measure *measure, int steps)
{
    uint64_t hash = 0;
    for (int k = 0; k < steps; k++) {
        size_t count;
        step(b, measure);
        const sb_face_load *faces = sb_measure_faces(measure, &count);
        if (count > 0) hash = sb_hash(hash, faces, count * sizeof *faces);
    }
    return hash;
}

/* Saved between two multiples of the interval. */
static void loads_continue_after_resume(void **state)
{
    (void)state;
    enum { KEYS = sizeof breaking / sizeof *breaking };
    sb_override set[KEYS + 1];
    basin b;
    sb_measure *measure;
    sb_archive_out out = {0};
    sb_archive_in in;
    memcpy(set, breaking, sizeof breaking);
    set[KEYS] = (sb_override){"render.loads", "true"};
    basin_fill_from(&b, set, KEYS + 1);
    assert_int_equal(sb_measure_create(&b.scene, &b.model, b.sim, &measure, NULL), SB_OK);
    while (sb_sim_report(b.sim)->time < 0.4) step(&b, measure);
    sb_archive_begin(&out, "TEST", 1);
    sb_sim_save(b.sim, &out);
    sb_measure_save(measure, &out);
    assert_int_equal(sb_archive_close(&out, NULL), SB_OK);
    const uint64_t whole = finish(&b, measure, 30);
    sb_measure_destroy(measure);
    sb_sim_destroy(b.sim);
    basin_start(&b);
    assert_int_equal(sb_measure_create(&b.scene, &b.model, b.sim, &measure, NULL), SB_OK);
    assert_int_equal(sb_archive_parse(&in, "saved", out.bytes, out.used, "TEST", 1, NULL), SB_OK);
    assert_int_equal(sb_sim_load(b.sim, &in, NULL), SB_OK);
    assert_int_equal(sb_measure_load(measure, &in, NULL), SB_OK);
    assert_true(whole != 0 && finish(&b, measure, 30) == whole);
    sb_measure_destroy(measure);
    basin_free(&b);
    sb_archive_out_free(&out);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(loads_of_faces_sum_to_the_force),
        cmocka_unit_test(loads_do_not_depend_on_threads_and_change_nothing),
        cmocka_unit_test(loads_sum_to_the_force_beside_periodic_sides),
        cmocka_unit_test(walls_in_still_water_have_the_hydrostatic_load),
        cmocka_unit_test(walls_in_a_periodic_side_have_the_hydrostatic_load),
        cmocka_unit_test(loads_continue_after_resume),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
