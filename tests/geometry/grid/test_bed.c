/* Heights at cell centres. */
#include "../../check.h"
#include "geometry/grid/bed.h"

static sb_scene scene_of(sb_body *bodies, size_t count)
{
    sb_scene scene = {.dimensions = 3, .bodies = bodies, .body_count = count};
    scene.domain.min = sb_vec(0, 0, -5);
    scene.domain.max = sb_vec(10, 6, 5);
    scene.offshore = (sb_offshore_settings){.present = true, .cell = 0.5, .x_max = 10, .y_max = 6};
    return scene;
}

/* A sloping plane is exact at each centre; a box on it counts where it is higher; the domain's floor is under all. */
static void bodies_are_seen_from_above(void **state)
{
    (void)state;
    sb_body bodies[2] = {{.name = "slope",
                          .shape = SB_SHAPE_PLANE,
                          .role = SB_ROLE_TERRAIN,
                          .center = {5, 3, -1},
                          .normal = {-0.0995037190209989, 0, 0.9950371902099892}, /* z rises by 0.1 along x */
                          .width = 20,
                          .length = 8},
                         {.name = "box", .shape = SB_SHAPE_BOX, .min = {4, 2, -9}, .max = {6, 4, 1}}};
    sb_scene scene = scene_of(bodies, 2);
    double bed[20 * 12];
    sb_offshore_start start = {.bed = bed};
    sb_error error = {0};
    assert_int_equal(sb_bed_columns(&scene), 20);
    assert_int_equal(sb_bed_rows(&scene), 12);
    assert_int_equal(sb_bed_fill(&scene, &start, &error), SB_OK);
    size_t floor = 0;
    for (size_t k = 0; k < 20 * 12; k++) {
        const double x = 0.25 + 0.5 * (double)(k % 20), y = 0.25 + 0.5 * (double)(k / 20);
        const bool on_box = x > 4 && x < 6 && y > 2 && y < 4, on_slope = fabs(x - 5) < 3.98; /* 8 cos of its angle */
        floor += !on_slope;
        assert_near(bed[k], on_box ? 1 : on_slope ? -1 + 0.1 * (x - 5) : -5, 1e-12);
    }
    assert_int_equal(start.uncovered, floor);
    assert_int_equal(start.told.count, 0);
}

/* Without bodies the bed is the domain's floor; in 2D there is one row. */
static void a_flat_floor(void **state)
{
    (void)state;
    sb_scene scene = scene_of(NULL, 0);
    scene.dimensions = 2;
    double bed[20], depth[20];
    sb_offshore_start start = {.bed = bed, .depth = depth};
    sb_error error = {0};
    assert_int_equal(sb_bed_rows(&scene), 1);
    assert_int_equal(sb_bed_fill(&scene, &start, &error), SB_OK);
    for (size_t k = 0; k < 20; k++) assert_near(bed[k], -5, 0);
    assert_int_equal(start.uncovered, 0);
    assert_int_equal(sb_uplift_fill(&scene, &start, &error), SB_OK);
    for (size_t k = 0; k < 20; k++) assert_near(depth[k], 0, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bodies_are_seen_from_above),
        cmocka_unit_test(a_flat_floor),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
