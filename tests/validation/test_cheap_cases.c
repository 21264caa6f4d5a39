/* Two cheap cases through the validation program, with tolerances for their coarse forms; that a
   finished set is not run again; and what a bad command line says. */
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

static char folder[] = "/tmp/sb-validate-XXXXXX";
static sb_sheet results;

/* Exit status of the program with these arguments, its output in folder/said. */
static int validate(const char *arguments)
{
    char command[1024];
    snprintf(command, sizeof command,
             "'%s/shorebreak-validate' %s --out '%s' --jobs 2 >'%s/said' 2>&1", SB_BINARY_DIR,
             arguments, folder, folder);
    int how = system(command);
    return WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

static bool said(const char *words)
{
    char path[SB_PATH_MAX], line[1024];
    bool found = false;
    snprintf(path, sizeof path, "%s/said", folder);
    FILE *in = fopen(path, "r");
    while (in && fgets(line, sizeof line, in))
        if (strstr(line, words)) found = true;
    if (in) fclose(in);
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
    if (!mkdtemp(folder)) return -1;
    /* 0: all within reach, 4: some are short of it, which coarse forms may be. */
    int status = validate("--quick still-water-2d standing-wave");
    if (status != 0 && status != 4) return -1;
    char path[SB_PATH_MAX];
    snprintf(path, sizeof path, "%s/quick/validation/results.csv", folder);
    sb_error error = {0};
    if (sb_sheet_read(path, &results, &error) == SB_OK) return 0;
    print_error("%s\n", error.text);
    return -1;
}

static int tear_down(void **state)
{
    (void)state;
    sb_sheet_free(&results);
    return nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

/* Column of the judged figure. */
static double figure(const char *name, const char *quantity, const char *column)
{
    for (size_t row = 0; row < results.rows; row++)
        if (strcmp(sb_sheet_text(&results, row, sb_sheet_column(&results, "case")), name) == 0 &&
            strcmp(sb_sheet_text(&results, row, sb_sheet_column(&results, "judged")), "yes") == 0 &&
            strcmp(sb_sheet_text(&results, row, sb_sheet_column(&results, "quantity")), quantity) ==
                0)
            return sb_sheet_number(&results, row, sb_sheet_column(&results, column));
    fail_msg("no figure %s of %s", quantity, name);
    return (double)NAN;
}

static void test_still_water_stays_still(void **state)
{
    (void)state;
    const char *name = "still-water-2d";
    assert_near(figure(name, "force on all bodies, mean", "value"), 1, 0.002);
    assert_true(figure(name, "force on all bodies, standard deviation", "value") <= 1);
    assert_true(figure(name, "kinetic energy, growth", "value") <= 5);
    assert_true(figure(name, "level, worst gauge", "value") <= 0.5);
    assert_true(figure(name, "speed, root mean square", "value") <= 1);
}

/* At 25 particles over the depth the wave is a particle and a quarter high. */
static void test_a_coarse_standing_wave_swings(void **state)
{
    (void)state;
    const char *name = "standing-wave";
    assert_near(figure(name, "period", "error"), 0, 5);
    assert_true(figure(name, "decay of the amplitude", "value") < 0.5);
    assert_true(figure(name, "second wave, half the wave number", "value") <= 10);
    assert_true(figure(name, "second wave, 1.5 times the wave number", "value") <= 10);
}

static void test_what_has_run_is_not_run_again(void **state)
{
    (void)state;
    char path[SB_PATH_MAX], *text;
    size_t length;
    int status = validate("--quick still-water-2d");
    assert_true(status == 0 || status == 4);
    assert_false(said("0.05 m:"));
    assert_true(said("validation.md"));
    snprintf(path, sizeof path, "%s/quick/validation.md", folder);
    assert_int_equal(sb_file_read(path, 1 << 20, &text, &length, NULL), SB_OK);
    assert_non_null(strstr(text, "still-water-2d"));
    assert_non_null(strstr(text, "not run")); /* the other cases */
    sb_free(text);
}

static void test_bad_command_lines(void **state)
{
    (void)state;
    assert_int_equal(validate("still-watr"), 1);
    assert_true(said("validate: still-watr: no such case; --list names them"));
    assert_int_equal(validate("--quik"), 1);
    assert_true(said("--quik: no such option"));
    assert_int_equal(validate(""), 1);
    assert_true(said("no case named"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_still_water_stays_still),
        cmocka_unit_test(test_a_coarse_standing_wave_swings),
        cmocka_unit_test(test_what_has_run_is_not_run_again),
        cmocka_unit_test(test_bad_command_lines),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
