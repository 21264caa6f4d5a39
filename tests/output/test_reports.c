/* run.jsonl, summary.json, map grids and progress. */
#include "output/log/progress.h"
#include "output/log/runlog.h"
#include "output/log/summary.h"
#include "output/maps/maps.h"

#include "../check.h"
#include "folder.h"
#include "json_check.h"

#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <sys/resource.h>

#include <cmocka.h>

static sb_model_body bodies[] = {{.name = "sea wall", .report = true},
                                 {.name = "floor", .report = false},
                                 {.name = "unit \"1\"", .report = true, .gap = 0.25}};
static char *warnings[] = {"body sea wall: 0.3 m thick, thinner than the support"};
static const sb_model model = {.body_count = 3,
                               .bodies = bodies,
                               .fluid_count = 1000,
                               .wall_count = 500,
                               .warning_count = 1,
                               .warnings = warnings};
static const sb_body_record records[] = {
    {.report = true, .peak = 5e6, .peak_time = 31.2, .impulse = {3, 0, 4}, .layers = 2.5},
    {.report = false},
    {.report = true, .peak = 1, .layers = (double)NAN},
};
static const sb_stage_time stages[] = {{"neighbours", 1.5, 10}, {"pressure", 3.5, 10}};

static sb_scene make_scene(void)
{
    return (sb_scene){.title = (char *)"A \"title\"",
                      .path = (char *)"plant.yaml",
                      .dimensions = 3,
                      .resolution = 6,
                      .duration = 90,
                      .numerics = {.preset = SB_PRESET_PAPER, .density = SB_DENSITY_COMPLETED, .solver = SB_SOLVER_CG}};
}

static void summary_has_the_documented_keys(void **state)
{
    (void)state;
    const char *const keys[] = {"wall_s",
                                "simulated_s",
                                "steps",
                                "fluid_particles",
                                "boundary_particles",
                                "mean_iterations",
                                "bytes_per_particle",
                                "lost_particles",
                                "bodies",
                                "name",
                                "peak_N",
                                "peak_time_s",
                                "impulse_Ns",
                                "version",
                                "preset",
                                "stages",
                                "energy_end",
                                "energy_work",
                                "contact_J",
                                "packing_stress_J",
                                "sea_J",
                                "sponge_J",
                                "surface_tension_J",
                                "processor_seconds",
                                "wall_setup_s",
                                "wall_settling_s"};
    sb_scene scene = make_scene();
    const sb_summary summary = {
        .scene = &scene,
        .model = &model,
        .spent =
            {.wall = 12.5,
             .settling = 3,
             .stage_count = 1,
             .stage = {{.name = "pressure", .seconds = 6, .settling_seconds = 2, .calls = 9, .settling_calls = 5}}},
        .simulated = 90,
        .steps = 4,
        .iterations = 10,
        .fluid_particles = 1000,
        .bytes = 250000,
        .compression = 0.5,
        .compression_max = 0.25,
        .lost = 2,
        .threads = 2,
        .bodies = records,
        .work = &(sb_ledger){.contact = -0.25},
        .hash = 7};
    assert_int_equal(sb_summary_write(in_folder("summary.json"), &summary, NULL), SB_OK);
    char *text = text_of("summary.json");
    assert_true(json_valid(text));
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (!json_find(text, keys[i])) fail_msg("summary.json has no key %s", keys[i]);
    }
    assert_true(strtod(json_find(text, "mean_iterations"), NULL) == 2.5);
    assert_true(strtod(json_find(text, "compression_mean"), NULL) == 0.125); /* of four steps */
    assert_true(strtod(json_find(text, "compression_max"), NULL) == 0.25);
    assert_true(strtod(json_find(text, "bytes_per_particle"), NULL) == 250);
    assert_true(strtod(json_find(text, "boundary_particles"), NULL) == 500);
    assert_true(strtod(json_find(text, "lost_particles"), NULL) == 2);
    assert_true(strtod(json_find(text, "impulse_Ns"), NULL) == 5);
    assert_true(strtod(json_find(text, "wall_s"), NULL) == 12.5);
    assert_true(strtod(json_find(text, "wall_settling_s"), NULL) == 3);
    assert_true(strtod(json_find(text, "settling_seconds"), NULL) == 2);
    assert_true(strtod(json_find(text, "calls"), NULL) == 9);
    assert_true(strtod(json_find(text, "peak_time_s"), NULL) == 31.2);
    assert_true(strncmp(json_find(text, "preset"), "\"paper\"", 7) == 0);
    assert_true(strncmp(json_find(text, "too_coarse"), "true", 4) == 0);
    assert_true(strncmp(json_find(text, "gap_m"), "null", 4) == 0);
    assert_true(strncmp(json_find(text, "narrow_gap"), "false", 5) == 0);
    assert_non_null(strstr(text, "\"gap_m\": 0.25"));
    assert_null(strstr(text, "floor")); /* this body does not report */
    sb_free(text);
    sb_error error = {0};
    assert_int_equal(sb_summary_write("/nonexistent/s.json", &summary, &error), SB_FAILED);
}

static void a_run_that_did_not_start_has_a_summary(void **state)
{
    (void)state;
    sb_scene scene = make_scene();
    const sb_summary summary = {
        .scene = &scene, .model = &model, .status = SB_FAILED, .reason = "diverged at step 3\nnear (1, 2, 3)"};
    assert_int_equal(sb_summary_write(in_folder("s.json"), &summary, NULL), SB_OK);
    char *text = text_of("s.json");
    assert_true(json_valid(text));
    assert_non_null(strstr(text, "\"failed\""));
    sb_free(text);
}

static void *shout(void *log)
{
    for (int i = 0; i < 200; i++) sb_runlog_warning(log, "number %d", i);
    return NULL;
}

static void every_line_of_the_log_is_json(void **state)
{
    (void)state;
    static const sb_skipped skipped[] = {{"viscosity: 0", 1, 0}, {"probes: none", 0, 4000}, {.what = NULL}};
    sb_scene scene = make_scene();
    sb_runlog *log;
    assert_int_equal(sb_runlog_open(in_folder("run.jsonl"), &log, NULL), SB_OK);
    sb_runlog_start(log, &scene, &model, 2, 12345);
    sb_runlog_skipped(log, skipped);
    sb_runlog_saved(log, &(sb_saved){.passes = 1, .seconds = 2.5, .bytes = 4000});
    pthread_t thread;
    assert_int_equal(pthread_create(&thread, NULL, shout, log), 0);
    shout(log);
    pthread_join(thread, NULL);
    const sb_step_report report = {
        .step = 10, .time = 0.5, .time_step = 0.05, .iterations = 3, .error_max = (double)NAN, .fluid_count = 1000};
    const sb_energy energy = {.kinetic = 1, .potential = 2};
    sb_runlog_step(log, &(sb_runlog_state){&report, &energy, stages, 2, true, true, 0xff});
    sb_runlog_bodies(log, &model, records);
    sb_runlog_event(log, "frame", "%s", "line\nbreak");
    sb_runlog_end(log, SB_INTERRUPTED, NULL);
    assert_int_equal(sb_runlog_check(log, NULL), SB_OK);
    assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
    char *text = text_of("run.jsonl"), *rest = NULL, last[512] = "";
    size_t lines = 0;
    bool has_left_out = false, has_saved = false;
    bool has_stage = false, has_version = false, has_body = false, has_gap = false, has_density = false;
    for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
        assert_true(json_valid(line));
        assert_true(json_find(line, "event") && json_find(line, "wall_s"));
        has_version = has_version || (lines == 0 && json_find(line, "version"));
        has_density = has_density || strstr(line, "\"density\":\"completed\"");
        has_left_out = has_left_out || strstr(line, "\"probes: none\",\"bytes\":4000}");
        has_saved = has_saved || strstr(line, "\"pair_passes_per_step\":1,\"seconds\":2.5,\"bytes\":4000}");
        has_stage = has_stage || (strstr(line, "\"step\"") && strstr(line, "\"pressure\":3.5"));
        has_body =
            has_body || strstr(line, "\"flow_layers\":2.5,\"too_coarse\":true,\"gap_m\":null,\"narrow_gap\":false");
        has_gap =
            has_gap || strstr(line, "\"flow_layers\":null,\"too_coarse\":false,\"gap_m\":0.25,\"narrow_gap\":true");
        snprintf(last, sizeof last, "%s", line);
        lines++;
    }
    assert_int_equal(lines, 1 + 2 + 1 + 400 + 1 + 2 + 1 + 1);
    assert_true(has_left_out && has_saved);
    assert_true(has_version && has_stage && has_body && has_gap && has_density);
    assert_non_null(strstr(last, "interrupted"));
    sb_free(text);
    sb_runlog_warning(NULL, "no log, no harm");
}

/* A killed run leaves an incomplete line, which the next line replaces. */
static void a_log_continues_after_its_last_complete_line(void **state)
{
    (void)state;
    static const char *const torn[] = {"{\"event\":\"a\"}\n{\"event\":\"b\"}\n{\"ev", "{\"event\":\"a\"}\n", "{\"ev",
                                       ""};
    static const size_t whole[] = {2, 1, 0, 0};
    for (size_t k = 0; k < sizeof torn / sizeof *torn; k++) {
        FILE *file = fopen(in_folder("torn.jsonl"), "w");
        assert_non_null(file);
        fputs(torn[k], file);
        assert_int_equal(fclose(file), 0);
        sb_runlog *log;
        assert_int_equal(sb_runlog_append(in_folder("torn.jsonl"), &log, NULL), SB_OK);
        sb_runlog_event(log, "resumed", "here");
        assert_int_equal(sb_runlog_sync(log, NULL), SB_OK);
        assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
        char *text = text_of("torn.jsonl"), *rest = NULL;
        size_t lines = 0;
        for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest), lines++)
            assert_true(json_valid(line));
        assert_int_equal(lines, whole[k] + 1);
        sb_free(text);
    }
    unlink(in_folder("torn.jsonl"));
    sb_runlog *log;
    assert_int_equal(sb_runlog_append(in_folder("torn.jsonl"), &log, NULL), SB_OK); /* a missing log is created */
    assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
}

static void a_full_disk_is_reported_by_the_log(void **state)
{
    (void)state;
    struct rlimit kept, none;
    sb_runlog *log;
    sb_error error = {0};
    assert_int_equal(sb_runlog_open(in_folder("full.jsonl"), &log, NULL), SB_OK);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &kept), 0);
    none = kept;
    none.rlim_cur = 0;
    signal(SIGXFSZ, SIG_IGN); /* as in a run: the write fails instead */
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &none), 0);
    sb_runlog_warning(log, "x");
    const sb_status status = sb_runlog_check(log, &error), closed = sb_runlog_close(log, NULL);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &kept), 0);
    assert_int_equal(status, SB_FAILED);
    assert_non_null(strstr(error.text, "File too large"));
    assert_int_equal(closed, SB_FAILED);
}

static void grids_begin_with_the_northernmost_row(void **state)
{
    (void)state;
    const float values[] = {1, 2, 3, 4, 5, NAN};
    const sb_map_record map = {3, 2, 100, -50, 2.5, values, values, values, values, values, values};
    assert_int_equal(sb_maps_write(folder, &map, false, NULL), SB_OK);
    const char *const names[] = {"maps/max_depth.asc",    "maps/max_speed.asc",       "maps/max_momentum_flux.asc",
                                 "maps/arrival_time.asc", "maps/inundation_time.asc", "maps/ground.asc"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char *text = text_of(names[i]);
        assert_string_equal(text, "ncols 3\nnrows 2\nxllcorner 100\nyllcorner -50\ncellsize 2.5\n"
                                  "NODATA_value -9999\n4 5 -9999\n1 2 3\n");
        sb_free(text);
    }
}

static void progress_prints_when_due(void **state)
{
    (void)state;
    FILE *stream = fopen(in_folder("progress"), "w");
    sb_progress progress;
    sb_step_report report = {.time = 22.5, .time_step = 0.05, .iterations = 4};
    sb_progress_begin(&progress, stream, 90);
    assert_true(sb_progress_eta(&progress) < 0); /* not known yet */
    usleep(20000);
    sb_progress_update(&progress, &report); /* too early for a line */
    double wall = sb_progress_wall(&progress), eta = sb_progress_eta(&progress);
    assert_true(wall >= 0.02 && eta > 2.5 * 0.02 && eta <= 3 * wall);
    report.time = 90;
    sb_progress_update(&progress, &report);
    assert_true(sb_progress_eta(&progress) == 0);
    sb_progress_end(&progress, &report);
    fclose(stream);
    char *text = text_of("progress");
    assert_non_null(strstr(text, "100.0 %"));
    assert_true(strchr(text, '\n') == text + strlen(text) - 1 && !strchr(text, '\r'));
    sb_free(text);
    sb_progress_begin(&progress, NULL, 90); /* quiet */
    sb_progress_settling(&progress, 1, 500, 0.1);
    sb_progress_settled(&progress);
    sb_progress_update(&progress, &report);
    sb_progress_end(&progress, &report);
    char duration[32];
    sb_progress_duration(duration, 3725);
    assert_string_equal(duration, "1h 02m");
    sb_progress_duration(duration, 185);
    assert_string_equal(duration, "3m 05s");
    sb_progress_duration(duration, (double)NAN);
    assert_string_equal(duration, "?");
}

static void a_difference_that_rounds_to_nothing_has_no_sign(void **state)
{
    (void)state;
    static const struct {
        double percent;
        const char *text;
    } cases[] = {{-0.004, "0.00"},  {0.004, "0.00"},  {0, "0.00"},     {-0.0, "0.00"},
                 {-0.006, "-0.01"}, {0.006, "+0.01"}, {-1.5, "-1.50"}, {12, "+12.00"}};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char text[32];
        sb_progress_percent(text, cases[c].percent);
        assert_string_equal(text, cases[c].text);
    }
}

static void progress_prints_settling(void **state)
{
    (void)state;
    FILE *stream = fopen(in_folder("settling"), "w");
    sb_progress progress;
    sb_progress_begin(&progress, stream, 90);
    sb_progress_plan(&progress, 300, 2, 1000);
    progress.settling_begun -= 10;
    sb_progress_settling(&progress, 3, 500, 0.2); /* too early for a line */
    assert_near(sb_progress_eta(&progress), 10 * (297 + 1000), 1000);
    progress.shown -= 11;
    sb_progress_settling(&progress, 4, 500, 0.25);
    sb_progress_settling(&progress, 102, 500, 0.25); /* 0.1 s each; 198 steps of settling and the run remain */
    assert_near(sb_progress_eta(&progress), 0.1 * (198 + 1000), 10);
    sb_progress_settling(&progress, 102, 132, 0.25); /* a smaller largest number of steps */
    assert_near(sb_progress_eta(&progress), 0.1 * (30 + 1000), 10);
    sb_progress_settling(&progress, 402, 500, 0.25); /* more steps than expected */
    assert_near(sb_progress_eta(&progress), 0.025 * 1000, 2.5);
    sb_progress_settled(&progress);
    fclose(stream);
    char *text = text_of("settling");
    assert_string_equal(text, "settling: step 4 of at most 500  max 0.250 m/s  0s elapsed, 1h 48m left\n");
    sb_free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(summary_has_the_documented_keys),
        cmocka_unit_test(a_run_that_did_not_start_has_a_summary),
        cmocka_unit_test(every_line_of_the_log_is_json),
        cmocka_unit_test(a_log_continues_after_its_last_complete_line),
        cmocka_unit_test(a_full_disk_is_reported_by_the_log),
        cmocka_unit_test(grids_begin_with_the_northernmost_row),
        cmocka_unit_test(progress_prints_when_due),
        cmocka_unit_test(a_difference_that_rounds_to_nothing_has_no_sign),
        cmocka_unit_test(progress_prints_settling),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
