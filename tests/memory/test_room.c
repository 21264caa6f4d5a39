/* A scene that needs more memory than is available fails before it starts, with an error that states both amounts. */
#include "../check.h"

#include "app/check/room.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

/* 3D: a thin layer of water on the floor of a wide domain, as on a coast. */
static const char text[] = "resolution: 0.05\n"
                           "duration: 1\n"
                           "domain: {min: [0, 0, 0], max: [4, 4, 4]}\n"
                           "water: {boxes: [{min: [0, 0, 0], max: [2, 2, 0.5]}]}\n"
                           "bodies: [{name: post, shape: box, min: [1, 1, 0], max: [1.5, 1.5, 2]}]\n";

static sb_status build(const char *resolution, sb_model_need *need, size_t *fluid, sb_error *error)
{
    char path[] = "/tmp/shorebreak-room-XXXXXX";
    int file = mkstemp(path);
    assert_true(file >= 0 && write(file, text, sizeof text - 1) == (ssize_t)sizeof text - 1);
    close(file);
    sb_scene scene = {0};
    sb_model model = {0};
    const sb_override finer = {"resolution", resolution};
    sb_status status = sb_scene_read(path, NULL, &finer, 1, &scene, error);
    if (status == SB_OK) status = sb_model_build_for(&scene, need, &model, error);
    if (status == SB_OK) *fluid = model.fluid_count;
    sb_model_free(&model);
    sb_scene_free(&scene);
    unlink(path);
    return status;
}

static void test_too_fine_a_spacing(void **state)
{
    (void)state;
    size_t fluid;
    sb_error error = {0};
    assert_int_equal(build("0.05", NULL, &fluid, &error), SB_OK);
    const double finer = pow(0.05 / 1e-4, 3) * (double)fluid;
    assert_int_equal(build("0.0001", NULL, &fluid, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "GB are available, of which a fifth is left free"));
    const char *found = strstr(error.text, "makes about ");
    assert_non_null(found);
    assert_near(strtod(found + 12, NULL) / finer, 1, 0.15);
}

/* In a process of its own that may take so many bytes more: whether what `say` writes there is what was expected. */
static void limited(size_t bytes, const char *resolution, sb_model_need *need, const char *words)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip(); /* they map terabytes */
#endif
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        size_t fluid;
        sb_error error = {0};
        struct rlimit limit = {RLIM_INFINITY, RLIM_INFINITY};
        unsigned long pages = 0;
        FILE *file = fopen("/proc/self/statm", "r");
        if (!file || fscanf(file, "%lu", &pages) != 1) _exit(2);
        fclose(file);
        limit.rlim_cur = pages * (rlim_t)sysconf(_SC_PAGESIZE) + bytes;
        if (setrlimit(RLIMIT_AS, &limit) != 0) _exit(3);
        const sb_status status = build(resolution, need, &fluid, &error);
        const bool good = words ? status == SB_BAD_INPUT && strstr(error.text, words) : status == SB_OK;
        if (!good) fprintf(stderr, "%s at %s m\n", status == SB_OK ? "built" : error.text, resolution);
        _exit(good ? 0 : 1);
    }
    int how;
    assert_int_equal(waitpid(child, &how, 0), child);
    assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 0);
}

static double half_a_kilobyte_each(const sb_scene *scene, const sb_model *model)
{
    (void)scene;
    return 512 * (double)model->fluid_count;
}

/* 0.025 m: 119 000 fluid particles, 7 MB, and 225 000 boundary particles, 50 MB while they are placed. That is refused
   where it would leave less than a fifth of what there is. Where address space is limited, as here, arrays that grow by
   doubling take up to twice that. */
static void test_a_fifth_is_left_free(void **state)
{
    (void)state;
    limited((size_t)64 << 20, "0.025", NULL, "placing them takes about 0.05");
    limited((size_t)64 << 20, "0.025", NULL, ", of which a fifth is left free; expected 0.02");
    limited((size_t)70 << 20, "0.025", half_a_kilobyte_each, "a run takes about 0.06");
    limited((size_t)250 << 20, "0.025", half_a_kilobyte_each, NULL);
}

static void test_a_run_beyond_memory(void **state)
{
    (void)state;
    const sb_scene scene = {.dimensions = 3, .resolution = 1, .numerics.support = 2.5};
    const sb_model small = {.fluid_count = 1000}, large = {.fluid_count = (size_t)1 << 40};
    sb_error error = {0};
    assert_int_equal(sb_room_check(&scene, &small, &error), SB_OK);
    assert_int_equal(sb_room_check(&scene, &large, &error), SB_FAILED);
    const char *found = strstr(error.text, "needs about ");
    assert_non_null(found);
    assert_near(strtod(found + 12, NULL) / (sb_room_needed(&scene, &large) / 1e9), 1, 0.01);
    assert_non_null(strstr(error.text, "GB are available, of which a fifth is left free"));
}

/* Of a cell of a map: its sums, and two words of levels and a ground, as the domain of these scenes is flat; bytes. */
static const double map_cell = 48 + 2 * 8 + 4;

/* Each rank holds the model, the program, foam and maps whole; the rest of the water is shared. */
static void test_ranks_of_a_host_share_its_memory(void **state)
{
    (void)state;
    sb_scene scene = {.dimensions = 3, .resolution = 1, .numerics.support = 2.5};
    const sb_model model = {.fluid_count = 1000000, .wall_count = 500000}, large = {.fluid_count = (size_t)1 << 40};
    sb_error error = {0};
    const double alone = sb_room_needed(&scene, &model), model_bytes = 1e6 * 56 + 5e5 * 48;
    sb_room_share(4);
    const double four = sb_room_needed(&scene, &model);
    assert_near(four - alone, 3 * (1e7 + model_bytes), 1);
    scene.measure.map = (sb_map){.present = true, .x_max = 4000, .y_max = 5000, .cell = 1};
    assert_near(sb_room_needed(&scene, &model) - four, 4 * 2e7 * map_cell, 1);
    assert_int_equal(sb_room_check(&scene, &large, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "or fewer ranks"));
    sb_room_share(1);
}

static void test_outputs_need_memory(void **state)
{
    (void)state;
    sb_scene scene = {.dimensions = 3, .resolution = 1, .numerics.support = 2.5};
    const sb_model model = {.fluid_count = 18000000};
    const double bare = sb_room_needed(&scene, &model);
    scene.output.particle_interval = 1;
    const double files = sb_room_needed(&scene, &model);
    assert_near(files - bare, 18e6 * 32 * 3, 1e6);
    scene.output.checkpoint.minutes = 10;
    assert_near(sb_room_needed(&scene, &model), files, 0); /* a checkpoint is written without a copy in memory */
    sb_camera camera = {0};
    scene.render =
        (sb_render_settings){.interval = 1, .width = 7680, .height = 4320, .cameras = &camera, .camera_count = 1};
    const double drawn = sb_room_needed(&scene, &model);
    assert_true(drawn - files > 7680.0 * 4320 * 40);
    scene.measure.map = (sb_map){.present = true, .x_max = 4000, .y_max = 5000, .cell = 1};
    assert_near(sb_room_needed(&scene, &model) - drawn, 2e7 * map_cell, 1);
    const sb_model town = {.fluid_count = model.fluid_count, .body_count = 5000};
    assert_near(sb_room_needed(&scene, &town) - sb_room_needed(&scene, &model), 18e6 / 1024 * 5000 * 72, 1e3);
    assert_int_equal(sb_room_waiting(1000), 3);
    assert_int_equal(sb_room_waiting(model.fluid_count), 1);
    assert_int_equal(sb_room_waiting(0), 3);
}

/* Tested in a child process, because the limit cannot be raised again. */
static void test_limits_of_the_process(void **state)
{
    (void)state;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    skip(); /* sanitizers map terabytes of address space */
#endif
    assert_true(sb_memory_available() > 0);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        const struct rlimit limit = {(rlim_t)600 << 20, (rlim_t)600 << 20};
        size_t left = setrlimit(RLIMIT_AS, &limit) == 0 ? sb_memory_available() : 0;
        _exit(left > 0 && left < (size_t)600 << 20 ? 0 : 1);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_fifth_is_left_free), /* first: a fork has none of the threads that OpenMP has started */
        cmocka_unit_test(test_too_fine_a_spacing),
        cmocka_unit_test(test_a_run_beyond_memory),
        cmocka_unit_test(test_ranks_of_a_host_share_its_memory),
        cmocka_unit_test(test_outputs_need_memory),
        cmocka_unit_test(test_limits_of_the_process),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
