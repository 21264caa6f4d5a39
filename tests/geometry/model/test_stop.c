/* Tests a signal while a model is built: at any stage the result is SB_INTERRUPTED and there is no model. */
#include "base/clock.h"
#include "base/stop.h"
#include "geometry/model/model.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <signal.h>
#include <string.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOMENTS = 24 };

static sb_body bodies[2] = {
    {.name = "tower", .shape = SB_SHAPE_CYLINDER, .color = {-1}, .center = {6, 4, 0}, .radius = 1, .height = 4},
    {.name = "block", .shape = SB_SHAPE_BOX, .color = {-1}, .min = {2, 2, 0}, .max = {4, 3, 4}},
};
static sb_fluid_box box = {.min = {7, 5, 3}, .max = {8, 6, 4}, .level = 4};

static sb_scene make_scene(double resolution)
{
    sb_scene scene = {.dimensions = 3, .resolution = resolution, .body_count = 2, .box_count = 1};
    scene.fluid = (sb_fluid_properties){.density = 1000, .gravity = 9.81};
    scene.domain.max = sb_vec(10, 8, 5);
    scene.domain.side[SB_Z_MAX] = SB_SIDE_OPEN;
    scene.sea = (sb_sea){true, 2, {1, 1, 1}};
    scene.numerics.support = 2;
    scene.numerics.wall_offset = 0.5;
    scene.numerics.wall_spacing = 1;
    scene.bodies = bodies;
    scene.boxes = &box;
    return scene;
}

/* Builds a model in a process of its own, which is stopped `delay` seconds after the start. The exit status gives
   the result. */
static int build_and_stop(const sb_scene *scene, double delay)
{
    sb_model model = {.spacing = 77};
    sb_error error = {0};
    const struct itimerval alarm = {.it_value = {.tv_usec = (suseconds_t)(1e6 * delay) + 1}};
    sb_stop_watch();
    struct sigaction action;
    sigaction(SIGTERM, NULL, &action);
    sigaction(SIGALRM, &action, NULL);
    setitimer(ITIMER_REAL, &alarm, NULL);
    const sb_status status = sb_model_build(scene, &model, &error);
    if (status == SB_OK) {
        sb_model_free(&model);
        return SB_OK;
    }
    const bool clean = status == SB_INTERRUPTED && error.status == SB_INTERRUPTED && model.spacing == 77 &&
                       model.fluid_count == 0 && strstr(error.text, "stopped by a signal");
    return clean ? SB_INTERRUPTED : 99;
}

static void a_stop_at_any_time_is_clean(void **state)
{
    (void)state;
    const sb_scene scene = make_scene(0.15);
    sb_model model;
    sb_error error = {0};
    const double start = sb_clock();
    int stopped = 0;
    assert_int_equal(sb_model_build(&scene, &model, &error), SB_OK);
    sb_model_free(&model);
    const double whole = sb_clock() - start;
    for (int k = 0; k < MOMENTS; k++) {
        int how = 0;
        pid_t process = fork();
        assert_true(process >= 0);
        if (process == 0) _exit(build_and_stop(&scene, whole * k / MOMENTS));
        assert_int_equal(waitpid(process, &how, 0), process);
        if (!WIFEXITED(how) || (WEXITSTATUS(how) != SB_INTERRUPTED && WEXITSTATUS(how) != SB_OK))
            fail_msg("stopped after %d of %d of the time: %s %d", k, MOMENTS, WIFEXITED(how) ? "exit status" : "signal",
                     WIFEXITED(how) ? WEXITSTATUS(how) : WTERMSIG(how));
        stopped += WEXITSTATUS(how) == SB_INTERRUPTED;
    }
    assert_true(stopped > MOMENTS / 4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_stop_at_any_time_is_clean)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
