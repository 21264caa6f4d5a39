/* The record of a plane over water whose surface and velocities are known. */
#include "../check.h"
#include "fake_sim.h"

/* Linear over depth and along the plane; z is above the bed. */
static sb_vec3 velocity_of(sb_vec3 at)
{
    return sb_vec(0.5 + 0.2 * at.z, -0.3 * at.z + 0.1 * at.y, 0.4 * at.z);
}

static void stir(fake_world *world)
{
    for (size_t i = 0; i < world->sim.report.fluid_count; i++)
        world->sim.samples[i].velocity = velocity_of(world->sim.samples[i].position);
}

/* A fit that is linear over depth is exact here, also in the outer layers, whose particles lie to one side. */
static void velocities_over_depth(void **state)
{
    (void)state;
    fake_world world;
    sb_measure *measure;
    fake_world_make(&world, 3, 0.1, sb_vec(0, 0, 0), sb_vec(4, 4, 3));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(4, 4, 2), 0.3, 0.1, 0, 1);
    stir(&world);
    sb_flow_plane plane = {"line", 2, 1, 2, 3, 0, 3, true, 0.2, 0.5, {.height = 0}};
    world.scene.measure.interval = 0.1;
    world.scene.measure.planes = &plane;
    world.scene.measure.plane_count = 1;
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    const sb_measure_records *records = sb_measure_latest(measure);
    assert_int_equal(records->water_count, 4); /* every 0.5 m of 2 m */
    for (size_t i = 0; i < 4; i++) {
        const sb_water_record *row = &records->waters[i];
        assert_near(row->x, 2, 0);
        assert_near(row->y, 1.25 + 0.5 * (double)i, 1e-12);
        assert_near(row->surface, 2, 0.005);
        assert_near(row->bed, 0, 0);
        for (int j = 0; j < SB_RECORD_LAYERS; j++) {
            const sb_vec3 expected = velocity_of(sb_vec(row->x, row->y, row->surface * (j + 0.5) / SB_RECORD_LAYERS));
            assert_near(row->velocity[j].x, expected.x, 1e-3);
            assert_near(row->velocity[j].y, expected.y, 2e-3); /* the lattice is not symmetric about the point in y */
            assert_near(row->velocity[j].z, expected.z, 1e-3);
        }
    }
    /* Rows are made at every second interval. */
    size_t rows = 0;
    for (int s = 1; s <= 10; s++) {
        world.sim.report.time = 0.1 * s;
        assert_int_equal(sb_measure_step(measure, &world.sim, NULL), SB_OK);
        records = sb_measure_latest(measure);
        assert_int_equal(records->water_count, s % 2 ? 0 : 4);
        rows += records->water_count;
        if (s % 2 == 0) assert_near(records->waters[3].time, 0.1 * s, 1e-12);
    }
    assert_int_equal(rows, 20);
    sb_measure_destroy(measure);
    fake_world_free(&world);
}

/* Two dimensions have one point. Water of two layers has velocities in all layers of the record, land has none. */
static void thin_water_and_land(void **state)
{
    (void)state;
    fake_world world;
    sb_measure *measure;
    fake_world_make(&world, 2, 0.1, sb_vec(0, 0, 0), sb_vec(4, 0, 3));
    fake_fill(&world, sb_vec(0, 0, 0), sb_vec(2, 0, 0.2), 0, 0, 0, 1);
    for (size_t i = 0; i < world.sim.report.fluid_count; i++) world.sim.samples[i].velocity = sb_vec(0.7, 0, 0);
    sb_flow_plane planes[] = {{"wet", 1, -0.5, 1, 0.5, 0, 3, true, 0.1, 0.4, {.height = 0}},
                              {"dry", 3, -0.5, 3, 0.5, 0, 3, true, 0.1, 0.4, {.height = 0}}};
    world.scene.measure.interval = 0.1;
    world.scene.measure.planes = planes;
    world.scene.measure.plane_count = 2;
    assert_int_equal(sb_measure_create(&world.scene, &world.model, &world.sim, &measure, NULL), SB_OK);
    const sb_measure_records *records = sb_measure_latest(measure);
    assert_int_equal(records->water_count, 2);
    assert_near(records->waters[0].surface, 0.2, 0.01);
    assert_true(isnan(records->waters[1].surface));
    for (int j = 0; j < SB_RECORD_LAYERS; j++) {
        assert_near(records->waters[0].velocity[j].x, 0.7, 1e-12);
        assert_true(isnan(records->waters[1].velocity[j].x));
    }
    sb_measure_destroy(measure);
    fake_world_free(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(velocities_over_depth),
        cmocka_unit_test(thin_water_and_land),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
