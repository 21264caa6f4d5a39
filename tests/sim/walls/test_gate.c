/* A gate that is lifted and stays in the water: its lower face, which stood on the floor, has a load, and no water
   enters the gate. */
#include "../../check.h"
#include "scene/scene_files.h"
#include "sim/tank.h"

#include <math.h>
#include <stdio.h>

static const char text[] = "dimensions: 2\nresolution: 0.04\nduration: 3\n"
                           "domain: {min: [0, 0], max: [2, 1]}\n"
                           "water: {level: 0.6, seed: [0.3, 0.3], boxes: [{min: [1.1, 0], max: [2, 0.6]}]}\n"
                           "bodies:\n"
                           "  - {name: gate, shape: box, min: [0.9, 0], max: [1.1, 0.9]}\n"
                           "wavemakers:\n"
                           "  - {name: lift, body: gate, kind: gate, direction: [0, 1], stroke: 0.12, speed: 0.2}\n";

static size_t facets_at(const sb_model *model, size_t body, sb_facet_when when)
{
    size_t count = 0;
    for (size_t f = 0; f < model->facets.count; f++)
        count += model->facets.facets[f].body == body && model->facets.facets[f].when == when;
    return count;
}

/* The gate's mean vertical pressure force from 2 s to 3 s, N/m. */
static double lift_of(sb_sim *sim, size_t gate)
{
    while (sb_sim_report(sim)->time < 2) assert_int_equal(tank_steps(sim, 1), 0);
    const double from = sb_sim_report(sim)->time, before = sb_sim_impulse(sim, gate)->pressure.z;
    while (sb_sim_report(sim)->time < 3) assert_int_equal(tank_steps(sim, 1), 0);
    return (sb_sim_impulse(sim, gate)->pressure.z - before) / (sb_sim_report(sim)->time - from);
}

static void a_lifted_gate_has_the_load_of_the_water_below_it(void **state)
{
    (void)state;
    sb_error error = {0};
    sb_scene scene;
    sb_model model = {0};
    sb_sim *sim;
    scene_must_read(text, NULL, NULL, 0, &scene);
    if (sb_model_build(&scene, &model, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_create(&scene, &model, NULL, &sim, &error) != SB_OK) fail_msg("%s", error.text);
    if (sb_sim_settle(sim, &error) != SB_OK) fail_msg("%s", error.text);
    const size_t gate = 0;
    /* the top; its sides, whose feet end at the floor, then in the water; the lower face */
    assert_int_equal(facets_at(&model, gate, SB_FACET_ALWAYS), 1);
    assert_int_equal(facets_at(&model, gate, SB_FACET_AT_REST), 2);
    assert_int_equal(facets_at(&model, gate, SB_FACET_AWAY), 3);
    const double lift = lift_of(sim, gate);
    /* the slot fills, so that the surface falls */
    const double level = 0.6 - 0.2 * 0.12 / 1.8, right = 1000 * 9.81 * (level - 0.12) * 0.2;
    printf("lift %.1f N/m, buoyancy %.1f N/m\n", lift, right);
    assert_near(lift, right, 0.03 * right);
    assert_int_equal(sb_sim_report(sim)->lost, 0);
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_vec3 at = sb_sim_particle(sim, i).position;
        assert_false(at.x > 0.91 && at.x < 1.09 && at.z > 0.13);
    }
    sb_sim_destroy(sim);
    sb_model_free(&model);
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_lifted_gate_has_the_load_of_the_water_below_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
