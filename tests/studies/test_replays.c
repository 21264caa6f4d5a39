/* Tests of the trade-off's replays: the run whose record they replay is made first, and its time counts apart. Runs are
   files as a run leaves them. */
#include "check.h"

#include "base/memory.h"
#include "contest_report.h"
#include "process.h"
#include "scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { SEEDS = 2 };

static const sb_common_options options = {.report_only = true, .jobs = 1, .command = "test"};
static sb_store store;
static sb_contest contest;
static const sb_entry *replay; /* of the contest */

static void begin(void)
{
    const sb_contest_selection selection = {.quick = true, .seeds = SEEDS, .choice = "sea replayed"};
    const sb_subject *plant = sb_subjects;
    sb_error error = {0};
    while (strcmp(plant->name, "plant") != 0) plant++;
    if (sb_contest_begin(&contest, plant, &store, &selection, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(contest.entry_count, 3); /* reference, default, replay */
    assert_int_equal(contest.record_count, SEEDS);
    replay = &contest.entries[2];
}

static void make(void)
{
    sb_error error = {0};
    if (sb_contest_make(&contest, &store, &error) != SB_OK) fail_msg("%s", error.text);
}

static int set_up(void **state)
{
    static char folder[] = "/tmp/test-replays-XXXXXX";
    (void)state;
    store = (sb_store){.options = &options, .assets = SB_SOURCE_DIR "/assets/validation", .build = 1, .machine = "m"};
    if (!mkdtemp(folder)) return -1;
    snprintf(store.out, sizeof store.out, "%s", folder);
    snprintf(store.report, sizeof store.report, "%s/report", folder);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    return sb_folder_remove(store.out, NULL) == SB_OK ? 0 : -1;
}

static void write_file(const char *folder, const char *name, const char *text)
{
    char path[SB_PATH_MAX];
    assert_int_equal(sb_path_join(path, folder, name, NULL), SB_OK);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* Leaves what a finished run of a request leaves; record: contents of its record.csv, NULL: it has none. */
static void finish(const sb_request *request, double seconds, const char *record)
{
    char folder[SB_PATH_MAX], path[SB_PATH_MAX], summary[256];
    sb_settings settings;
    sb_scene scene;
    sb_error error = {0};
    if (sb_run_folder(&store, request, folder, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(sb_process_claim(folder, &error), SB_OK);
    assert_int_equal(sb_path_join(path, store.assets, request->of->scene, NULL), SB_OK);
    sb_request_settings(request, &settings);
    if (sb_settings_scene(path, "default", settings.list, settings.count, &scene, &error) != SB_OK)
        fail_msg("%s", error.text);
    assert_int_equal(sb_path_join(path, folder, "scene.yaml", NULL), SB_OK);
    assert_int_equal(sb_scene_write(&scene, path, &error), SB_OK);
    sb_scene_free(&scene);
    snprintf(summary, sizeof summary,
             "{\"wall_s\": %g, \"processor_seconds\": %g, \"threads\": 2, \"steps\": 1, \"mean_iterations\": 1, "
             "\"fluid_particles\": 1}\n",
             seconds, 2 * seconds);
    write_file(folder, "summary.json", summary);
    if (record) write_file(folder, "record.csv", record);
    assert_int_equal(sb_run_finish(&store, folder, 2 * seconds, &error), SB_OK);
}

/* The run that is recorded is the whole plant with a plane; the replay has no grid, and the same seed and spacing. */
static void a_replay_is_not_run_without_its_record(void **state)
{
    (void)state;
    begin();
    make();
    for (size_t i = 0; i < SEEDS; i++) {
        const sb_request *record = &contest.records[i].request, *trial = &contest.trials[replay->first + i].request;
        assert_string_equal(record->of->scene, "../scenes/plant.yaml");
        assert_int_equal(record->seed, trial->seed);
        assert_near(record->plan->resolution, trial->plan->resolution, 0);
        assert_int_equal(contest.trials[replay->first + i].state, SB_RESULT_NOT_RUN);
        assert_null(trial->replays);
        assert_ptr_equal(trial->of, &replay->other);
    }
    assert_int_equal(sb_contest_judge(&contest, false, NULL), SB_OK);
    assert_true(isnan(replay->time.mean) && isnan(replay->record_time.mean));
    sb_contest_free(&contest);
}

static void expect_in_report(const char *name, const char *text)
{
    char path[SB_PATH_MAX], *report;
    size_t length;
    assert_int_equal(sb_path_join(path, store.report, name, NULL), SB_OK);
    assert_int_equal(sb_file_read(path, 1 << 20, &report, &length, NULL), SB_OK);
    if (!strstr(report, text)) fail_msg("no \"%s\" in\n%s", text, report);
    sb_free(report);
}

static void the_time_is_that_of_the_replay(void **state)
{
    (void)state;
    begin();
    for (size_t i = 0; i < SEEDS; i++) finish(&contest.records[i].request, 50 + 10 * (double)i, i ? "b\n" : "a\n");
    make();
    for (size_t i = 0; i < SEEDS; i++) {
        const sb_result *trial = &contest.trials[replay->first + i],
                        *record = sb_contest_record(&contest, replay, replay->first + i);
        assert_int_equal(record->state, SB_RESULT_DONE);
        assert_string_equal(trial->request.replays, record->run.folder);
        assert_int_equal(trial->state, SB_RESULT_NOT_RUN);
        finish(&trial->request, 10 + 2 * (double)i, NULL);
    }
    make();
    assert_int_equal(sb_contest_judge(&contest, true, NULL), SB_OK);
    assert_near(replay->time.mean, 22, 1e-12);
    assert_near(replay->record_time.mean, 110, 1e-12);
    assert_int_equal(sb_contest_judge(&contest, false, NULL), SB_OK);
    assert_near(replay->time.mean, 11, 1e-12);
    assert_near(replay->record_time.mean, 55, 1e-12);
    const sb_contest_report report = {.store = &store, .contests = &contest, .count = 1};
    assert_int_equal(sb_contest_write(&report, NULL), SB_OK);
    expect_in_report("tradeoff.md", "| sea replayed from x = 400 | 12 |");
    expect_in_report("tradeoff.md", "whose record it replays took 55 s");
    expect_in_report("tradeoff.csv", ",50.000,100.000\n");
    sb_contest_free(&contest);
}

/* A replay of another record is another run; the place of a record has no meaning. */
static void a_replay_belongs_to_the_contents_of_its_record(void **state)
{
    (void)state;
    uint64_t hash[3] = {0};
    char place[3][SB_PATH_MAX + 8];
    begin();
    sb_request request = contest.trials[replay->first].request;
    for (int i = 0; i < 3; i++) {
        snprintf(place[i], sizeof place[i], "%s/%d", store.out, i);
        assert_int_equal(sb_process_claim(place[i], NULL), SB_OK);
        write_file(place[i], "record.csv", i == 1 ? "a\n" : "b\n");
        request.replays = place[i];
        assert_int_equal(sb_request_hash(&request, store.assets, &hash[i], NULL), SB_OK);
    }
    assert_true(hash[0] == hash[2] && hash[0] != hash[1]);
    sb_contest_free(&contest);
}

static void a_failed_recording_fails_the_replay(void **state)
{
    (void)state;
    char folder[SB_PATH_MAX];
    begin();
    assert_int_equal(sb_run_folder(&store, &contest.records[1].request, folder, NULL), SB_OK);
    assert_int_equal(sb_process_claim(folder, NULL), SB_OK);
    assert_int_equal(sb_run_fail(folder, "no room\n", NULL), SB_OK);
    make();
    assert_int_equal(contest.trials[replay->first + 1].state, SB_RESULT_FAILED);
    assert_string_equal(contest.trials[replay->first + 1].problem, "the run whose record it replays: no room");
    assert_int_equal(contest.trials[replay->first].state, SB_RESULT_DONE);
    sb_contest_free(&contest);
}

/* A failure that another tool noted while the run went on does not count once it has ended. */
static void a_run_that_ends_has_not_failed(void **state)
{
    (void)state;
    char folder[SB_PATH_MAX], reason[64];
    begin();
    const sb_request *request = &contest.records[1].request;
    assert_int_equal(sb_run_folder(&store, request, folder, NULL), SB_OK);
    assert_int_equal(sb_process_claim(folder, NULL), SB_OK);
    assert_int_equal(sb_run_fail(folder, "another run writes here\n", NULL), SB_OK);
    assert_true(sb_run_failed(&store, request, reason, sizeof reason));
    finish(request, 20, "t_s\n");
    assert_false(sb_run_failed(&store, request, reason, sizeof reason));
    sb_contest_free(&contest);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_replay_is_not_run_without_its_record),
        cmocka_unit_test(the_time_is_that_of_the_replay),
        cmocka_unit_test(a_replay_belongs_to_the_contents_of_its_record),
        cmocka_unit_test(a_failed_recording_fails_the_replay),
        cmocka_unit_test(a_run_that_ends_has_not_failed),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
