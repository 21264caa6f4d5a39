/* Tests of the table reader, of every reference table, and of every scene of a case. */
#include "check.h"

#include "base/file.h"
#include "cases.h"
#include "request.h"
#include "results.h"
#include "sensitivity.h"
#include "sheet.h"

#include "base/memory.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[] = "/tmp/sb-sheet-XXXXXX";

static const char *written(const char *text)
{
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
    return path;
}

static void test_table_columns_are_read(void **state)
{
    (void)state;
    sb_sheet sheet;
    sb_curve curve = {0};
    assert_int_equal(sb_sheet_read(written("# cited\ntime_s,body,Fx_N_per_m\r\n0,a,1\n0,\"b \"\"q\"\", c\",2\n"
                                           "1,a,\n1,\"b \"\"q\"\", c\",4\n2,a,5"),
                                   &sheet, NULL),
                     SB_OK);
    assert_int_equal(sheet.rows, 4); /* the last line is not finished */
    assert_int_equal(sb_sheet_column(&sheet, "Fx_N"), 2);
    assert_int_equal(sb_sheet_column(&sheet, "F"), (size_t)-1);
    assert_string_equal(sb_sheet_text(&sheet, 1, 1), "b \"q\", c");
    assert_int_equal(sb_sheet_curve(&sheet, "a", "time_s", "Fx_N", &curve, NULL), SB_OK);
    assert_int_equal(curve.count, 2);
    assert_near(curve.y[0], 1, 0);
    assert_true(isnan(curve.y[1]));
    sb_curve_free(&curve);
    sb_error error = {0};
    assert_int_equal(sb_sheet_curve(&sheet, "c", "time_s", "Fx_N", &curve, &error), SB_BAD_INPUT);
    assert_int_equal(sb_sheet_curve(&sheet, "a", "time_s", "Fy_N", &curve, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "Fy_N"));
    sb_sheet_free(&sheet);
}

static void test_row_with_missing_fields_is_refused(void **state)
{
    (void)state;
    sb_sheet sheet;
    sb_error error = {0};
    assert_int_equal(sb_sheet_read(written("# c\na,b\n1,2\n3\n"), &sheet, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, ":4: 1 fields, expected 2"));
    assert_int_equal(sb_sheet_read(written(""), &sheet, &error), SB_BAD_INPUT);
}

/* A case does not check its curves: after a missing column all are empty, and the end of the case reports it once. */
static void test_missing_column_is_reported_at_end(void **state)
{
    (void)state;
    sb_curves made = {0};
    sb_sheet_slot slot = {0};
    sb_error first = {0}, why = {0};
    const sb_case_run run = {.folder = "/tmp", .slot = &slot, .made = &made, .error = &first};
    const char *table = strrchr(written("t,a\n0,1\n"), '/') + 1;
    assert_int_equal(sb_run_curve(&run, table, NULL, "t", "a")->count, 1);
    assert_true(isnan(sb_curve_last(sb_run_curve(&run, table, NULL, "t", "b"))));
    assert_int_equal(sb_run_curve(&run, table, NULL, "t", "a")->count, 0);
    assert_int_equal(sb_run_sheet(&run, table)->rows, 0);
    assert_int_equal(sb_run_close(&run, &why), SB_BAD_INPUT);
    assert_non_null(strstr(why.text, "no column b"));
    assert_int_equal(sb_run_curve(&run, table, NULL, "t", "a")->count, 1);
    assert_int_equal(sb_run_close(&run, &why), SB_OK);
    sb_sheet_free(&slot.sheet);
    sb_free(slot.path);
}

static int tables;

/* A table cites its source, has numbers in all columns other than that of names, and is small. */
static int look(const char *file, const struct stat *info, int kind, struct FTW *where)
{
    (void)where;
    size_t length = strlen(file);
    if (kind != FTW_F || length < 4 || strcmp(file + length - 4, ".csv") != 0) return 0;
    sb_sheet sheet;
    sb_error error = {0};
    if (sb_sheet_read(file, &sheet, &error) != SB_OK) fail_msg("%s", error.text);
    if (sheet.text[0] != '#') fail_msg("%s cites no source", file);
    if (info->st_size > 100000) fail_msg("%s has %ld bytes", file, (long)info->st_size);
    assert_true(sheet.rows >= 2 && sheet.columns >= 2);
    for (size_t row = 0; row < sheet.rows; row++)
        for (size_t k = 0; k < sheet.columns; k++)
            if (k != 1 && isnan(sb_sheet_number(&sheet, row, k)) && *sb_sheet_text(&sheet, row, k))
                fail_msg("%s, row %zu: %s is not a number", file, row + 1, sb_sheet_text(&sheet, row, k));
    sb_sheet_free(&sheet);
    tables++;
    return 0;
}

static void test_reference_tables_are_valid(void **state)
{
    (void)state;
    assert_int_equal(nftw(SB_SOURCE_DIR "/assets/validation", look, 16, FTW_PHYS), 0);
    assert_true(tables >= 2);
}

/* Checks that neither the scene of a case nor its settings change a default: all cases judge one set of defaults. */
static void check_defaults(const sb_request *request)
{
    char file[SB_PATH_MAX];
    sb_override set[16] = {{"numerics.seed", "1"}};
    char keys[16][64];
    size_t count = 1;
    sb_scene scene, plain;
    sb_error error = {0};
    if (request->preset) return;
    assert_int_equal(sb_path_join(file, SB_SOURCE_DIR "/assets/validation", request->of->scene, NULL), SB_OK);
    for (const char *const *more = request->plan->settings; more && *more; more++, count++) {
        const char *equals = strchr(*more, '=');
        assert_true(equals && count < 16);
        snprintf(keys[count], sizeof keys[count], "%.*s", (int)(equals - *more), *more);
        set[count] = (sb_override){keys[count], equals + 1};
    }
    if (sb_scene_read(file, NULL, set, count, &scene, &error) != SB_OK) fail_msg("%s", error.text);
    const char *bare = scene.dimensions == 2 ? SB_SOURCE_DIR "/assets/scenes/solitary-flume.yaml"
                                             : SB_SOURCE_DIR "/assets/scenes/house.yaml";
    if (sb_scene_read(bare, "default", set, 1, &plain, &error) != SB_OK) fail_msg("%s", error.text);
    if (memcmp(&scene.numerics, &plain.numerics, sizeof plain.numerics) != 0)
        fail_msg("%s: numerics differ from those of the default preset", request->of->name);
    sb_scene_free(&scene);
    sb_scene_free(&plain);
}

/* Every case has a unique name, its functions, one judged spacing, and scenes that can be read with their settings. */
static void test_cases_are_valid(void **state)
{
    (void)state;
    for (size_t i = 0; sb_cases[i]; i++) {
        const sb_case *of = sb_cases[i];
        assert_non_null(of->evaluate);
        assert_non_null(of->plot);
        /* The last row ends a list. */
        assert_true(of->full[SB_PLANS_MAX].resolution == 0 && of->quick[SB_PLANS_MAX].resolution == 0);
        for (size_t k = 0; k < i; k++) assert_string_not_equal(of->name, sb_cases[k]->name);
        for (int quick = 0; quick < 2; quick++) {
            sb_request *requests = NULL;
            sb_error error = {0};
            size_t count = 0, judged = 0;
            assert_int_equal(sb_case_requests(of, quick, &requests, &count, NULL), SB_OK);
            for (size_t r = 0; r < count; r++) {
                uint64_t hash = 0;
                if (sb_request_hash(&requests[r], SB_SOURCE_DIR "/assets/validation", &hash, &error) != SB_OK)
                    fail_msg("%s: %s", of->name, error.text);
                check_defaults(&requests[r]);
                judged += requests[r].plan->judged && !requests[r].preset && requests[r].seed == 1;
            }
            if (judged != 1) fail_msg("%s: %zu judged spacings, expected 1", of->name, judged);
            sb_free(requests);
        }
    }
}

/* The default comes first, then each other preset at the spacings that ask for it, then seeds; each has its scene. */
static void test_presets_run_beside_the_default(void **state)
{
    (void)state;
    static const sb_case of = {.scene = "column/column.yaml",
                               .full = {{.resolution = 0.02, .paper = true, .wen = true},
                                        {.resolution = 0.01, .wen = true, .seeds = 2, .judged = true}}};
    static const char *const presets[] = {"default", "default", "paper", "wen", "wen", "default"};
    static const int seeds[] = {1, 1, 1, 1, 1, 2};
    sb_request *requests = NULL;
    size_t count = 0;
    uint64_t hash[6];
    assert_int_equal(sb_case_requests(&of, false, &requests, &count, NULL), SB_OK);
    assert_int_equal(count, 6);
    for (size_t r = 0; r < count; r++) {
        assert_string_equal(sb_request_preset(&requests[r]), presets[r]);
        assert_int_equal(requests[r].seed, seeds[r]);
        assert_int_equal(sb_request_hash(&requests[r], SB_SOURCE_DIR "/assets/validation", &hash[r], NULL), SB_OK);
        for (size_t k = 0; k < r; k++) assert_true(hash[k] != hash[r]);
    }
    sb_free(requests);
}

static void test_hash_depends_on_request(void **state)
{
    (void)state;
    static const char *const longer[] = {"duration=21", NULL};
    sb_plan plan = {.resolution = 0.05}, other = {.resolution = 0.05, .settings = longer};
    const char *assets = SB_SOURCE_DIR "/assets/validation";
    sb_request base = {.of = sb_cases[0], .plan = &plan, .seed = 1}, changed[4];
    for (int i = 0; i < 4; i++) changed[i] = base;
    changed[0].seed = 2;
    changed[1].preset = "paper";
    changed[2].plan = &other;
    snprintf(changed[3].change, sizeof changed[3].change, "numerics.cfl=0.3");
    uint64_t first = 0, again = 0;
    assert_int_equal(sb_request_hash(&base, assets, &first, NULL), SB_OK);
    assert_int_equal(sb_request_hash(&base, assets, &again, NULL), SB_OK);
    assert_true(first == again);
    for (int i = 0; i < 4; i++) {
        uint64_t hash = 0;
        assert_int_equal(sb_request_hash(&changed[i], assets, &hash, NULL), SB_OK);
        assert_true(hash != first);
    }
}

/* The scene that a run writes shows with which defaults it ran. */
static void test_written_scene_has_same_defaults_hash(void **state)
{
    (void)state;
    char file_name[] = "/tmp/shorebreak-defaults-XXXXXX";
    const char *scene = SB_SOURCE_DIR "/assets/validation/solitary-runup/breaking.yaml";
    const sb_plan plan = {.resolution = 0.05};
    const sb_case of = {.name = "breaking", .scene = scene};
    const sb_request request = {.of = &of, .plan = &plan, .seed = 1};
    const sb_override set[] = {{"resolution", "0.05"}, {"numerics.seed", "1"}, {"output.plots", "false"}};
    uint64_t expected, written_hash;
    sb_scene made, back;
    const int file = mkstemp(file_name);
    assert_true(file >= 0);
    close(file);
    assert_int_equal(sb_request_defaults_hash(&request, "", &expected, NULL), SB_OK);
    assert_int_equal(sb_scene_read(scene, "default", set, 3, &made, NULL), SB_OK);
    for (int other = 0; other < 2; other++) {
        made.numerics.artificial_viscosity += other * 1e-4;
        assert_int_equal(sb_scene_write(&made, file_name, NULL), SB_OK);
        assert_int_equal(sb_scene_read(file_name, NULL, NULL, 0, &back, NULL), SB_OK);
        assert_int_equal(sb_scene_defaults_hash(&back, &written_hash, NULL), SB_OK);
        assert_int_equal(written_hash == expected, !other);
        sb_scene_free(&back);
    }
    sb_scene_free(&made);
    unlink(file_name);
}

static void test_changed_defaults_stay_within_bounds(void **state)
{
    (void)state;
    sb_scene scene;
    char change[64];
    assert_int_equal(
        sb_scene_read(SB_SOURCE_DIR "/assets/validation/still-water/flat.yaml", NULL, NULL, 0, &scene, NULL), SB_OK);
    scene.numerics.warm_start = 0.9;
    scene.numerics.cfl = 0.4;
    scene.numerics.wall_friction = 0;
    for (const sb_sensitivity_key *key = sb_sensitivity_keys; key->key; key++) {
        sb_sensitivity_change(key, &scene.numerics, 1.25, change);
        if (strcmp(key->key, "warm_start") == 0) assert_string_equal(change, "numerics.warm_start=1");
        if (strcmp(key->key, "cfl") == 0) assert_string_equal(change, "numerics.cfl=0.5");
        if (strcmp(key->key, "wall_friction") == 0) assert_string_equal(change, "");
    }
    sb_scene_free(&scene);
}

static int set_up(void **state)
{
    (void)state;
    int file = mkstemp(path);
    return file < 0 ? -1 : close(file);
}

static int tear_down(void **state)
{
    (void)state;
    return unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_table_columns_are_read),
        cmocka_unit_test(test_row_with_missing_fields_is_refused),
        cmocka_unit_test(test_missing_column_is_reported_at_end),
        cmocka_unit_test(test_reference_tables_are_valid),
        cmocka_unit_test(test_cases_are_valid),
        cmocka_unit_test(test_presets_run_beside_the_default),
        cmocka_unit_test(test_hash_depends_on_request),
        cmocka_unit_test(test_written_scene_has_same_defaults_hash),
        cmocka_unit_test(test_changed_defaults_stay_within_bounds),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
