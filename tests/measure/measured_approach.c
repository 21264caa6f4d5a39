/* The flow depth at a body, by which its force is flagged, is that of a bore of known depth that strikes a wall, and
   not that of the splash. 2D; the spacing is 5 cm. */
#include "geometry/model/model.h"
#include "measure/measure.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmocka.h>

static void check_ok(sb_status status, const sb_error *error)
{
    if (status != SB_OK) fail_msg("%s", error->text);
}

static void read_scene(const char *walls, int layers, sb_scene *scene)
{
    char path[] = "/tmp/shorebreak-approach-XXXXXX";
    sb_error error = {0};
    int file = mkstemp(path);
    assert_true(file >= 0);
    assert_true(
        dprintf(file,
                "dimensions: 2\nresolution: 0.05\nduration: 0.8\nnumerics: {walls: %s}\nmeasure: {interval: 0.01}\n"
                "domain: {min: [0, 0], max: [4, 3]}\n"
                "water: {boxes: [{min: [0, 0], max: [2, %g], velocity: [3, 0]}]}\n"
                "bodies: [{name: wall, shape: box, min: [3, -0.2], max: [3.5, 3]}]\n",
                walls, 0.05 * layers) > 0);
    close(file);
    sb_status status = sb_scene_read(path, NULL, NULL, 0, scene, &error);
    unlink(path);
    check_ok(status, &error);
}

/* Returns the flow depth at the wall. *splash: the height that water reached before it, in spacings. */
static double flow_depth(const char *walls, int layers, double *splash)
{
    sb_scene scene = {0};
    sb_model model = {0};
    sb_sim *sim = NULL;
    sb_measure *measure = NULL;
    sb_error error = {0};
    read_scene(walls, layers, &scene);
    check_ok(sb_model_build(&scene, &model, &error), &error);
    check_ok(sb_sim_create(&scene, &model, NULL, &sim, &error), &error);
    check_ok(sb_sim_settle(sim, &error), &error);
    check_ok(sb_measure_create(&scene, &model, sim, &measure, &error), &error);
    *splash = 0;
    while (sb_sim_report(sim)->time < scene.duration) {
        check_ok(sb_sim_step(sim, &error), &error);
        check_ok(sb_measure_step(measure, sim, &error), &error);
        for (size_t i = 0; i < sb_sim_report(sim)->fluid_count; i++)
            *splash = fmax(*splash, sb_sim_particle(sim, i).position.z / model.spacing);
    }
    const double depth = sb_measure_bodies(measure)[0].layers;
    sb_measure_destroy(measure);
    sb_sim_destroy(sim);
    sb_model_free(&model);
    sb_scene_free(&scene);
    return depth;
}

static void flow_depth_is_that_of_the_bore(void **state)
{
    (void)state;
    static const char *const walls[] = {"particles, density: summed, stress_correction: 0", "images"};
    for (int w = 0; w < 2; w++)
        for (int layers = 2; layers <= 4; layers += 2) {
            double splash;
            const double depth = flow_depth(walls[w], layers, &splash);
            print_message("%s, %d layers: flow depth %.2f, splash %.0f\n", walls[w], layers, depth, splash);
            assert_true(splash > 5 * layers);
            assert_true(fabs(depth - layers) < 0.7);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(flow_depth_is_that_of_the_bore)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
