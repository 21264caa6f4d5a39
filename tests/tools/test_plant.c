/* Tests of tools/make-plant: the meshes have the geometry that the scenes assume. */
#include "base/file.h"
#include "base/memory.h"
#include "form.h"
#include "plant.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

typedef struct plant {
    sb_plant_options options;
    sb_mesh *meshes;
    size_t count;
} plant;

static int set_up(void **state)
{
    static plant made;
    sb_error error = {0};
    made.options = sb_plant_defaults();
    if (sb_plant_build(&made.options, &made.meshes, &made.count, &error) != SB_OK) {
        print_error("%s\n", error.text);
        return -1;
    }
    *state = &made;
    return 0;
}

static int tear_down(void **state)
{
    plant *made = *state;
    sb_plant_free(made->meshes, made->count);
    return 0;
}

static const sb_mesh *find(const plant *made, const char *name)
{
    for (size_t i = 0; i < made->count; i++)
        if (strcmp(made->meshes[i].name, name) == 0) return &made->meshes[i];
    fail_msg("no body named %s", name);
    return NULL;
}

static sb_mesh_report diagnosed(const plant *made, const char *name)
{
    sb_mesh_report report;
    assert_int_equal(sb_mesh_diagnose(find(made, name), &report, NULL), SB_OK);
    return report;
}

static void test_names_are_unique_and_complete(void **state)
{
    const plant *made = *state;
    static const char *const expected[] = {
        "terrain",   "breakwater-north", "breakwater-south", "quay",      "intake",    "reactor-1", "reactor-2",
        "reactor-3", "reactor-4",        "reactor-5",        "reactor-6", "turbine-1", "turbine-2", "turbine-3",
        "turbine-4", "turbine-5",        "turbine-6",        "stack-1",   "tank-1",    "cavity"};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) assert_non_null(find(made, expected[i]));
    for (size_t i = 0; i < made->count; i++)
        for (size_t k = 0; k < i; k++) assert_string_not_equal(made->meshes[i].name, made->meshes[k].name);
    assert_string_equal(made->meshes[0].name, "terrain");
}

static void test_buildings_are_closed_and_face_outward(void **state)
{
    const plant *made = *state;
    for (size_t i = 1; i < made->count; i++) {
        sb_mesh_report report;
        assert_int_equal(sb_mesh_diagnose(&made->meshes[i], &report, NULL), SB_OK);
        if (!report.watertight || report.open_edges || report.flipped_faces || report.degenerate_faces ||
            report.doubled_faces || report.volume < 1000)
            fail_msg("%s: open %zu flipped %zu degenerate %zu doubled %zu volume %g", made->meshes[i].name,
                     report.open_edges, report.flipped_faces, report.degenerate_faces, report.doubled_faces,
                     report.volume);
    }
}

static void test_forms_have_the_volume_of_their_formula(void **state)
{
    (void)state;
    sb_error error = {0};
    sb_mesh mesh = {0};
    sb_mesh_report report;
    /* A concave ring like that of the cavity: 30 x 20 minus a pocket of 10 x 10. */
    sb_ring low = {.count = 8, .x = {0, 20, 20, 0, 0, 10, 10, 0}, .y = {0, 0, 30, 30, 20, 20, 10, 10}};
    sb_ring rings[2] = {low, low};
    rings[1].z = 7;
    sb_form form = {0};
    sb_form_loft(&form, rings, 2);
    assert_int_equal(sb_form_finish(&form, "u", &mesh, &error), SB_OK);
    assert_int_equal(sb_mesh_diagnose(&mesh, &report, NULL), SB_OK);
    assert_true(report.watertight);
    assert_true(fabs(report.volume - 3500) < 1e-6);
    sb_mesh_free(&mesh);

    /* A straight dike with sloping heads is a frustum of rectangles: prismatoid formula. */
    static const double line[2][2] = {{0, 0}, {100, 0}}, foot[2] = {-4, -4};
    sb_dike dike = {line, foot, 2, 6, 12, 1.5};
    sb_form_dike(&form, &dike);
    assert_int_equal(sb_form_finish(&form, "dike", &mesh, &error), SB_OK);
    assert_int_equal(sb_mesh_diagnose(&mesh, &report, NULL), SB_OK);
    double top = 100 * 12, middle = 115 * 27, bottom = 130 * 42;
    assert_true(report.watertight);
    assert_true(fabs(report.volume - 10.0 / 6 * (top + 4 * middle + bottom)) < 1e-6);
    sb_mesh_free(&mesh);
}

static void test_six_reactors_of_45_m_with_halls_on_the_sea_side(void **state)
{
    const plant *made = *state;
    double y_last = -1;
    static const int along_the_shore[] = {6, 5, 1, 2, 3, 4};
    for (int i = 0; i < 6; i++) {
        char name[32];
        snprintf(name, sizeof name, "reactor-%d", along_the_shore[i]);
        sb_mesh_report reactor = diagnosed(made, name);
        snprintf(name, sizeof name, "turbine-%d", along_the_shore[i]);
        sb_mesh_report hall = diagnosed(made, name);
        assert_true(fabs(reactor.max.x - reactor.min.x - 45) < 1e-9);
        assert_true(fabs(reactor.max.y - reactor.min.y - 45) < 1e-9);
        assert_true(fabs(reactor.max.z - 55) < 1e-9);
        assert_true(reactor.min.z <= 10 - 3);
        assert_true(hall.max.x < reactor.min.x - 12 && hall.min.x > SB_PLANT_SHORE);
        assert_true(hall.max.z < reactor.max.z);
        assert_true(hall.max.y - hall.min.y > 45 && hall.min.y > y_last + 12);
        y_last = hall.max.y;
    }
}

static void test_heights_of_coast_and_structures(void **state)
{
    const plant *made = *state;
    sb_mesh_report ground = diagnosed(made, "terrain");
    assert_true(ground.min.x == -20 && ground.max.x == 1300);
    assert_true(ground.min.y == 0 && ground.max.y == 1150);
    assert_true(ground.min.z == -38);
    assert_true(ground.max.z > 34 && ground.max.z <= 35);
    assert_true(diagnosed(made, "breakwater-north").max.z == 5.7);
    assert_true(diagnosed(made, "breakwater-south").max.z == 5.7);
    assert_true(diagnosed(made, "stack-1").max.z == 130);
    assert_true(diagnosed(made, "quay").max.z == 4.5);
    static const double depth[][2] = {{0, -38}, {150, -38}, {400, -14}, {700, -6}, {800, 0}};
    for (size_t i = 0; i < 5; i++)
        for (double y = 20; y < 1150; y += i < 4 ? 110 : 1110)
            assert_true(fabs(sb_plant_ground(&made->options, depth[i][0], y) - depth[i][1]) < 1e-9);
    for (double x = 857; x <= 1025; x += 7) /* the terrace is level under every building */
        for (double y = 205; y <= 895; y += 10) assert_true(fabs(sb_plant_ground(&made->options, x, y) - 10) < 1e-9);
}

static void test_buildings_are_rooted_and_apart(void **state)
{
    const plant *made = *state;
    for (size_t i = 1; i < made->count; i++) {
        sb_mesh_report a;
        assert_int_equal(sb_mesh_diagnose(&made->meshes[i], &a, NULL), SB_OK);
        for (double x = a.min.x; x <= a.max.x; x += 5)
            for (double y = a.min.y; y <= a.max.y; y += 5)
                if (a.min.x > 860) assert_true(sb_plant_ground(&made->options, x, y) >= a.min.z + 3);
        for (size_t k = 1; k < i; k++) {
            sb_mesh_report b;
            assert_int_equal(sb_mesh_diagnose(&made->meshes[k], &b, NULL), SB_OK);
            if (a.min.x <= 860 || b.min.x <= 860) continue; /* the structures of the waterfront touch */
            double dx = fmax(a.min.x - b.max.x, b.min.x - a.max.x);
            double dy = fmax(a.min.y - b.max.y, b.min.y - a.max.y);
            if (dx < 12 && dy < 12)
                fail_msg("%s and %s are %g m apart", made->meshes[i].name, made->meshes[k].name, fmax(dx, dy));
        }
    }
}

/* Vertical columns, CELL m apart, through all meshes. */
enum { COLUMNS_X = 400, COLUMNS_Y = 575, CROSSINGS = 16 };
#define CELL 2.0

typedef struct column {
    double ground;
    int count;
    double z[CROSSINGS]; /* of solids' surfaces */
    int way[CROSSINGS];  /* -1: the upward line enters a solid, +1: it leaves a solid */
} column;

static void strike(column *columns, const sb_mesh *mesh, const uint32_t triangle[3], bool ground)
{
    sb_vec3 a = mesh->vertices[triangle[0]], b = mesh->vertices[triangle[1]];
    sb_vec3 c = mesh->vertices[triangle[2]], low = sb_min(sb_min(a, b), c);
    sb_vec3 high = sb_max(sb_max(a, b), c);
    double area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
    if (area == 0) return;
    for (int i = (int)fmax(0, low.x / CELL - 1); i < COLUMNS_X && i * CELL < high.x; i++)
        for (int j = (int)fmax(0, low.y / CELL - 1); j < COLUMNS_Y && j * CELL < high.y; j++) {
            /* Off the grid lines of the mesh, so that no column meets an edge. */
            double x = (i + 0.4987) * CELL, y = (j + 0.5021) * CELL;
            double u = ((x - a.x) * (c.y - a.y) - (c.x - a.x) * (y - a.y)) / area;
            double v = ((b.x - a.x) * (y - a.y) - (x - a.x) * (b.y - a.y)) / area;
            if (u < 0 || v < 0 || u + v > 1) continue;
            double z = a.z + u * (b.z - a.z) + v * (c.z - a.z);
            column *at = &columns[i * COLUMNS_Y + j];
            if (ground) {
                at->ground = z;
                continue;
            }
            assert_true(at->count < CROSSINGS);
            at->z[at->count] = z;
            at->way[at->count++] = area > 0 ? 1 : -1;
        }
}

/* Metres of water in a column: below z = 0, above ground, outside solids. */
static double wet(const column *at)
{
    double step = 0.05, sum = 0;
    for (double z = -step / 2; z > at->ground; z -= step) {
        int inside = 0; /* number of solids that contain the point, from the surfaces above it */
        for (int k = 0; k < at->count; k++) inside += at->z[k] > z ? at->way[k] : 0;
        sum += inside > 0 ? 0 : step;
    }
    return sum;
}

static void test_sea_has_18_million_cubic_metres(void **state)
{
    const plant *made = *state;
    column *columns = sb_alloc(COLUMNS_X * COLUMNS_Y, sizeof *columns);
    assert_non_null(columns);
    for (size_t m = 0; m < made->count; m++)
        for (size_t t = 0; t < made->meshes[m].triangle_count; t++)
            strike(columns, &made->meshes[m], made->meshes[m].triangles[t], m == 0);
    double volume = 0;
    for (size_t i = 0; i < COLUMNS_X * COLUMNS_Y; i++) volume += wet(&columns[i]) * CELL * CELL;
    sb_free(columns);
    print_message("still water: %.4g m^3\n", volume);
    assert_true(fabs(volume - 18.0e6) < 0.02 * 18.0e6);
    /* Landward of the shore nothing is below sea level, except inside the quay. */
    for (double x = 801; x < 1300; x += 3)
        for (double y = 1; y < 1150; y += 3)
            if (x > 822 || y < 234 || y > 856) assert_true(sb_plant_ground(&made->options, x, y) > 0);
}

static void test_options_set_heights(void **state)
{
    (void)state;
    sb_error error = {0};
    plant made = {.options = sb_plant_defaults()};
    made.options.grade = 13;
    made.options.breakwater = 8;
    made.options.hill = 42;
    made.options.stack = 90;
    made.options.reactor = 50;
    made.options.quay = 5;
    made.options.harbour = 9;
    assert_int_equal(sb_plant_build(&made.options, &made.meshes, &made.count, &error), SB_OK);
    assert_true(diagnosed(&made, "reactor-3").max.z == 63);
    assert_true(diagnosed(&made, "breakwater-south").max.z == 8);
    assert_true(diagnosed(&made, "stack-2").max.z == 103);
    assert_true(diagnosed(&made, "quay").max.z == 5);
    assert_true(sb_plant_ground(&made.options, 950, 500) == 13);
    assert_true(sb_plant_ground(&made.options, 750, 500) == -9);
    double top = diagnosed(&made, "terrain").max.z;
    assert_true(top > 41 && top <= 42);
    sb_plant_free(made.meshes, made.count);
}

static void test_extreme_heights_give_closed_meshes(void **state)
{
    (void)state;
    for (const sb_plant_option *row = sb_plant_option_table; row->name; row++)
        for (int side = 0; side < 2; side++) {
            sb_error error = {0};
            plant made = {.options = sb_plant_defaults()};
            *(double *)((char *)&made.options + row->offset) = side ? row->most : row->least;
            made.options.quay = fmin(made.options.quay, made.options.grade);
            made.options.hill = fmax(made.options.hill, made.options.grade);
            if (strcmp(row->name, "quay") == 0) made.options.grade = fmax(made.options.grade, made.options.quay);
            if (strcmp(row->name, "hill") == 0) made.options.grade = fmin(made.options.grade, made.options.hill);
            assert_int_equal(sb_plant_build(&made.options, &made.meshes, &made.count, &error), SB_OK);
            test_buildings_are_closed_and_face_outward((void *[]){&made});
            sb_plant_free(made.meshes, made.count);
        }
}

static void test_invalid_heights_are_refused(void **state)
{
    (void)state;
    sb_error error = {0};
    sb_mesh *meshes = NULL;
    size_t count = 0;
    sb_plant_options options = sb_plant_defaults();
    options.hill = 6;
    assert_int_equal(sb_plant_build(&options, &meshes, &count, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "hill"));
    options = sb_plant_defaults();
    options.stack = (double)NAN;
    assert_int_equal(sb_plant_build(&options, &meshes, &count, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "stack"));
    assert_null(meshes);
}

static void test_every_failed_allocation_is_reported(void **state)
{
    (void)state;
    sb_plant_options options = sb_plant_defaults();
    sb_status status = SB_FAILED;
    long n = 0;
    while (status != SB_OK && ++n < 2000) {
        sb_error error = {0};
        sb_mesh *meshes = NULL;
        size_t count = 0;
        sb_memory_fail_at(n);
        status = sb_plant_build(&options, &meshes, &count, &error);
        sb_memory_fail_at(0);
        assert_true(status == SB_OK || (status == SB_FAILED && strlen(error.text) > 0));
        sb_plant_free(meshes, count);
    }
    assert_true(n > 50 && status == SB_OK);
}

static int run(const char *arguments)
{
    char command[2 * SB_PATH_MAX];
    snprintf(command, sizeof command, "%s/shorebreak-make-plant %s >/dev/null 2>&1", SB_BINARY_DIR, arguments);
    int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static const char *const parts[] = {"terrain",  "breakwaters", "waterfront", "reactors",
                                    "turbines", "stacks",      "tanks",      "annexes"};
enum { PARTS = sizeof parts / sizeof *parts };

static void test_program_writes_committed_meshes(void **state)
{
    (void)state;
    char folder[] = "/tmp/sb-plant-XXXXXX", path[128];
    size_t total = 0;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "--parts %s", folder);
    assert_int_equal(run(path), 0);
    for (size_t i = 0; i < PARTS; i++) {
        sb_error error = {0};
        char *made = NULL, *kept = NULL, committed[SB_PATH_MAX];
        size_t made_length, kept_length;
        snprintf(path, sizeof path, "%s/%s.obj", folder, parts[i]);
        snprintf(committed, sizeof committed, SB_SOURCE_DIR "/assets/meshes/plant/%s.obj", parts[i]);
        assert_int_equal(sb_file_read(path, 1 << 20, &made, &made_length, &error), SB_OK);
        assert_int_equal(sb_file_read(committed, 1 << 20, &kept, &kept_length, &error), SB_OK);
        assert_int_equal(made_length, kept_length);
        assert_memory_equal(made, kept, kept_length);
        total += kept_length;
        sb_free(made);
        sb_free(kept);
        unlink(path);
    }
    assert_int_equal(rmdir(folder), 0);
    assert_true(total <= 400000);
}

static void test_program_refuses_bad_arguments(void **state)
{
    (void)state;
    assert_int_equal(run("--help"), 0);
    assert_int_equal(run("--version"), 0);
    assert_int_equal(run("--grade"), 1);
    assert_int_equal(run("--grade ten"), 1);
    assert_int_equal(run("--grade 400"), 1);
    assert_int_equal(run("--colour 3"), 1);
    assert_int_equal(run("plant.obj"), 1);
    assert_int_equal(run("--out /nonexistent/plant.obj"), 2);
}

/* Imports a file and compares its bodies with those that were made; returns their number. */
static size_t compare(const plant *made, const char *path)
{
    sb_error error = {0};
    sb_mesh *meshes = NULL;
    size_t count = 0;
    if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    for (size_t i = 0; i < count; i++) {
        sb_mesh_report here, there = diagnosed(made, meshes[i].name);
        assert_int_equal(sb_mesh_diagnose(&meshes[i], &here, NULL), SB_OK);
        assert_int_equal(here.watertight, there.watertight);
        assert_int_equal(here.degenerate_faces, 0);
        assert_true(fabs(here.area - there.area) < 1e-3 * there.area);
        assert_true(sb_norm(sb_sub(here.max, there.max)) < 0.02);
        assert_true(sb_norm(sb_sub(here.min, there.min)) < 0.02);
    }
    sb_plant_free(meshes, count);
    return count;
}

static void test_import_gives_same_bodies(void **state)
{
    const plant *made = *state;
    size_t count = 0;
    for (size_t i = 0; i < PARTS; i++) {
        char path[SB_PATH_MAX];
        snprintf(path, sizeof path, SB_SOURCE_DIR "/assets/meshes/plant/%s.obj", parts[i]);
        count += compare(made, path);
    }
    assert_int_equal(count, made->count);

    sb_error error = {0};
    char folder[] = "/tmp/sb-plant-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/whole.obj", folder);
    assert_int_equal(sb_plant_write(&made->options, made->meshes, made->count, path, &error), SB_OK);
    assert_int_equal(compare(made, path), made->count);
    unlink(path);
    rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names_are_unique_and_complete),
        cmocka_unit_test(test_buildings_are_closed_and_face_outward),
        cmocka_unit_test(test_forms_have_the_volume_of_their_formula),
        cmocka_unit_test(test_six_reactors_of_45_m_with_halls_on_the_sea_side),
        cmocka_unit_test(test_heights_of_coast_and_structures),
        cmocka_unit_test(test_buildings_are_rooted_and_apart),
        cmocka_unit_test(test_sea_has_18_million_cubic_metres),
        cmocka_unit_test(test_options_set_heights),
        cmocka_unit_test(test_extreme_heights_give_closed_meshes),
        cmocka_unit_test(test_invalid_heights_are_refused),
        cmocka_unit_test(test_every_failed_allocation_is_reported),
        cmocka_unit_test(test_program_writes_committed_meshes),
        cmocka_unit_test(test_program_refuses_bad_arguments),
        cmocka_unit_test(test_import_gives_same_bodies),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
