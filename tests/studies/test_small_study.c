/* A resolution study of a still tank by the program itself: impulses add up to the weight, finished
   runs are not repeated, quantities can be chosen, and what a bad command line says. */
#include "check.h"

#include "base/file.h"
#include "base/memory.h"
#include "sheet.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define SCENE "'" SB_SOURCE_DIR "/assets/validation/still-water/flat.yaml'"
#define TINY SCENE " --resolutions 0.1,0.2 --seeds 2 --set duration=0.5 --set numerics.time_step_max=0.005"

static char folder[] = "/tmp/sb-study-XXXXXX";

/* Exit status of the program with these arguments, its output in folder/said. */
static int study(const char *arguments)
{
    char command[2048];
    snprintf(command, sizeof command,
             "'%s/shorebreak-study' %s --out '%s/out' --jobs 2 >'%s/said' 2>&1", SB_BINARY_DIR,
             arguments, folder, folder);
    int how = system(command);
    return WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

static bool file_says(const char *name, const char *words)
{
    char path[SB_PATH_MAX], *text;
    size_t length;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (sb_file_read(path, 1 << 20, &text, &length, NULL) != SB_OK) return false;
    bool found = strstr(text, words) != NULL;
    sb_free(text);
    return found;
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)kind;
    (void)where;
    return remove(path);
}

static int set_up(void **state)
{
    (void)state;
    return mkdtemp(folder) && study(TINY) == 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    (void)state;
    return nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

/* 1000 kg/m rest for 0.5 s and a step at most: that is what the tank has borne, at every spacing. */
static void test_the_vertical_impulse_is_the_weight_times_the_duration(void **state)
{
    (void)state;
    char path[SB_PATH_MAX];
    sb_sheet sheet = {0};
    size_t met = 0;
    snprintf(path, sizeof path, "%s/out/runs.csv", folder);
    assert_int_equal(sb_sheet_read(path, &sheet, NULL), SB_OK);
    size_t value = sb_sheet_column(&sheet, "value"), seed = sb_sheet_column(&sheet, "seed");
    for (size_t r = 0; r < sheet.rows; r++) {
        if (!strstr(sb_sheet_text(&sheet, r, 0), "vertical impulse")) continue;
        assert_near(sb_sheet_number(&sheet, r, value), -9810 * 0.5, 0.02 * 9810 * 0.5);
        assert_near(sb_sheet_number(&sheet, r, seed), (double)(1 + met % 2), 0);
        assert_true(sb_sheet_number(&sheet, r, sb_sheet_column(&sheet, "cpu_s")) > 0);
        met++;
    }
    assert_int_equal(met, 4);
    sb_sheet_free(&sheet);
}

static void test_the_report_has_every_kind_of_quantity(void **state)
{
    (void)state;
    assert_true(file_says("out/study.md", "study.png") || file_says("out/study.md", "No plot"));
    assert_true(file_says("out/study.md", "| tank, impulse |"));
    assert_true(file_says("out/study.md", "| tank, peak |"));
    assert_true(file_says("out/study.md", "| g1, crest |"));
    assert_true(file_says("out/study.md", "two spacings: first order assumed"));
    assert_true(file_says("out/orders.csv", "two spacings: first order assumed"));
}

static void test_what_has_run_is_not_run_again_and_patterns_choose(void **state)
{
    (void)state;
    assert_int_equal(study(TINY " --quantity 'g?, *' --quantity 'tank, peak'"), 0);
    assert_false(file_says("said", "flat, 0.1 m:"));
    assert_true(file_says("said", "| g2, crest |"));
    assert_true(file_says("said", "| tank, peak |"));
    assert_false(file_says("said", "| tank, impulse |"));
    assert_int_equal(study(TINY " --quantity nothing"), 1);
    assert_true(file_says("said", "--quantity"));
}

static void test_bad_command_lines(void **state)
{
    (void)state;
    assert_int_equal(study(SCENE), 1);
    assert_true(file_says("said", "expected two spacings or more"));
    assert_int_equal(study(SCENE " --resolutions 0.1,x"), 1);
    assert_true(file_says("said", "--resolutions 0.1,x: expected metres > 0"));
    assert_int_equal(study(SCENE " --resolutions 0.1,0.2,0.1"), 1);
    assert_true(file_says("said", "0.1 is given twice"));
    assert_int_equal(study(SCENE " --resolutions 0.2,0.1 --set resolution=1"), 1);
    assert_true(file_says("said", "--resolutions, --seeds and --preset say this"));
    assert_int_equal(study(SCENE " --resolutions 0.2,0.1 --set nothing.there=1"), 1);
    assert_true(file_says("said", "nothing"));
    assert_int_equal(study("/nowhere.yaml --resolutions 0.2,0.1"), 1);
    assert_true(file_says("said", "/nowhere.yaml: no such file"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_vertical_impulse_is_the_weight_times_the_duration),
        cmocka_unit_test(test_the_report_has_every_kind_of_quantity),
        cmocka_unit_test(test_what_has_run_is_not_run_again_and_patterns_choose),
        cmocka_unit_test(test_bad_command_lines),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
