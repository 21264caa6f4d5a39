/* tools/scenarios: each listed scenario has its page with marks, its pictures and its scenes; its tables have the
   values of the tables that they are made of. */
#include "../check.h"

#include "base/file.h"
#include "base/memory.h"
#include "tools/tool.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static int begin(void **state)
{
    (void)state;
    return tool_begin();
}

static int end(void **state)
{
    (void)state;
    return tool_end();
}

/* Exit status of a command of the shell; its output goes to the file `output`. */
static int shell(const char *command)
{
    char line[8192];
    snprintf(line, sizeof line, "(%s) >'%s' 2>&1", command, tool_path("output"));
    const int how = system(line);
    return WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(tool_path(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

static void expect_output(const char *text)
{
    char *output = tool_text("output");
    if (!output || !strstr(output, text)) fail_msg("expected \"%s\" in:\n%s", text, output ? output : "");
    sb_free(output);
}

static void expect_file(const char *format, const char *name)
{
    char path[1024] = SB_SOURCE_DIR "/";
    const size_t root = strlen(path);
    snprintf(path + root, sizeof path - root, format, name);
    if (access(path, R_OK) != 0) fail_msg("no %s", path);
}

static void every_scenario_is_complete(void **state)
{
    (void)state;
    assert_int_equal(shell("'" SB_SOURCE_DIR "/tools/scenarios' --list"), 0);
    char *list = tool_text("output");
    assert_non_null(list);
    int count = 0;
    for (char *next, *line = list; *line; line = next) {
        char page[64], scenes[256], marks[1100];
        next = line + strcspn(line, "\n");
        if (*next) *next++ = '\0';
        assert_int_equal(sscanf(line, "%63s %255s", page, scenes), 2);
        expect_file("docs/scenarios/%s.md", page);
        expect_file("docs/scenarios/%s.png", page);
        for (const char *scene = strtok(scenes, ","); scene; scene = strtok(NULL, ","))
            expect_file("assets/scenes/%s.yaml", scene);
        snprintf(marks, sizeof marks,
                 "grep -c '^<!-- tools/scenarios: \\(begin\\|end\\) -->$' '%s/docs/scenarios/%s.md'", SB_SOURCE_DIR,
                 page);
        assert_int_equal(shell(marks), 0);
        expect_output("2");
        snprintf(marks, sizeof marks, "grep '(%s.md)' '%s/docs/scenarios/README.md'", page, SB_SOURCE_DIR);
        assert_int_equal(shell(marks), 0);
        count++;
    }
    sb_free(list);
    assert_true(count >= 2);
}

static void wrong_names_and_factors_are_refused(void **state)
{
    (void)state;
    assert_int_equal(shell("'" SB_SOURCE_DIR "/tools/scenarios' nowhere"), 1);
    expect_output("nowhere: no such scenario; --list prints them");
    assert_int_equal(shell("'" SB_SOURCE_DIR "/tools/scenarios' --coarser finer"), 1);
    expect_output("--coarser finer: expected a factor, such as 2");
}

#define AWK "awk -F, -f '" SB_SOURCE_DIR "/tools/programs/scenarios/"

static void compared_tables_have_values_and_rows_of_bodies(void **state)
{
    (void)state;
    write_file("compare.csv", "kind,item,quantity,unit,run,runs,mean,least,greatest,difference,percent,reliable\n"
                              "body,house-1-1,force,N,a,1,2000,2000,2000,,,no\n"
                              "body,house-1-1,force,N,b,1,500,500,500,,,yes\n"
                              "body,house-1-2,force,N,a,1,4000,4000,4000,,,yes\n"
                              "body,house-1-2,force,N,b,1,0,0,0,,,\n"
                              "body,house-1-1,first_wet,s,a,1,3,3,3,,,\n"
                              "body,house-1-1,first_wet,s,b,1,,,,,,\n"
                              "gauge,street,surface,m,a,1,1.5,1.5,1.5,,,\n"
                              "gauge,street,surface,m,b,1,,,,,,\n");
    write_file(
        "a.csv",
        "time_s,gauge,eta_m,z_m\n0,street,,\n0,sea,0,0\n1,street,,\n1,sea,1,1\n2.5,street,1.5,1.5\n3,street,1,1\n");
    write_file("b.csv", "time_s,gauge,eta_m,z_m\n0,street,,\n0,sea,0,0\n3,street,,\n");
    char command[4096];
    snprintf(command, sizeof command,
             "cd '%s'; (cat compare.csv; " AWK "arrivals.awk' -v scene=a a.csv; " AWK
             "arrivals.awk' -v scene=b b.csv) | " AWK "compare.awk'",
             tool_path("."));
    assert_int_equal(shell(command), 0);
    expect_output("| house-1 | 3.00 (2.00–4.00) → 0.250 (0–0.500) |");
    expect_output("| house-1-1 | 2.00 → 0.500 |");
    expect_output("| street | 1.50 → – | – | 2.50 → dry |");
    expect_output("1 of 2 in `a`, 0 of 1 in `b`");
}

static void column_table_has_peaks_from_the_arrival(void **state)
{
    (void)state;
    FILE *lab = fopen(tool_path("force.csv"), "w");
    assert_non_null(lab);
    fputs("# source\ntime_s,set,force_N\n", lab);
    for (int i = 0; i < 200; i++)
        fprintf(lab, "%.2f,a,%d\n%.2f,b,99\n", 0.01 * i, i < 40 ? 0 : i == 50 ? 30 : 10, 0.01 * i);
    assert_int_equal(fclose(lab), 0);
    FILE *run = fopen(tool_path("forces.csv"), "w");
    assert_non_null(run);
    fputs("time_s,body,Fx_N\n", run);
    for (int i = 0; i < 400; i++) fprintf(run, "%.3f,column,%d\n", 0.005 * i, i < 60 ? 0 : 20);
    assert_int_equal(fclose(run), 0);
    char command[2048];
    snprintf(command, sizeof command, "cd '%s'; awk -f '%s/tools/programs/scenarios/column.awk' force.csv forces.csv",
             tool_path("."), SB_SOURCE_DIR);
    assert_int_equal(shell(command), 0);
    expect_output("| peak, N | 20.0 | 20.0 |"); /* the mean of 10 and 30 */
    expect_output("| mean from 0.15 to 0.35 s, N | 10.0 | 20.0 |");
    expect_output("| impulse until 0.95 s, N s | 9."); /* 10 N x 0.95 s, and the peak */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_scenario_is_complete),
        cmocka_unit_test(wrong_names_and_factors_are_refused),
        cmocka_unit_test(compared_tables_have_values_and_rows_of_bodies),
        cmocka_unit_test(column_table_has_peaks_from_the_arrival),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
