/* tools/includes accepts the source tree, and finds includes against the order of folders and cycles that are planted
   in a small tree. */
#include "../check.h"

#include "base/file.h"
#include "tools/tool.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static void write_file(const char *name, const char *text)
{
    char path[SB_PATH_MAX], parent[SB_PATH_MAX];
    sb_error error = {0};
    snprintf(path, sizeof path, "%s", tool_path(name));
    sb_path_folder(parent, path);
    if (sb_make_directories(parent, &error) != SB_OK) fail_msg("%s", error.text);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* A tree of two folders of src and two of tools, without faults. */
static int plant_tree(void **state)
{
    (void)state;
    if (tool_begin() != 0) return -1;
    write_file("docs/architecture.md", "| folder | contents | includes | |\n|---|---|---|---|\n"
                                       "| `src/base` | a | none | |\n"
                                       "| `src/scene` | b | base | |\n"
                                       "| `src/mesh` | c | base | |\n"
                                       "| `src/app` | d | all | |\n");
    write_file("src/base/file.h", "");
    write_file("src/base/file.c", "#include \"base/file.h\"\n#include <stdio.h>\n#include \"made_by_the_build.h\"\n");
    write_file("src/scene/scene.h", "#include \"base/file.h\"\n");
    write_file("src/scene/parts/key.h", "#include \"scene/scene.h\"\n");
    write_file("src/scene/scene.c", "#include \"scene/scene.h\"\n#include \"scene/parts/key.h\"\n");
    write_file("src/mesh/mesh.h", "#include \"base/file.h\"\n");
    write_file("src/app/main.c", "#include \"scene/scene.h\"\n#include \"mesh/mesh.h\"\n");
    write_file("tools/common/plot.h", "#include \"base/file.h\"\n");
    write_file("tools/bench/bench.c", "#include \"plot.h\"\n#include \"bench.h\"\n");
    write_file("tools/bench/bench.h", "");
    write_file("tests/base/check.h", "#include \"base/file.h\"\n");
    return 0;
}

static int remove_tree(void **state)
{
    (void)state;
    return tool_end();
}

/* Runs the script on a tree; returns its exit status. Its output is in the file "output". */
static int check_tree(const char *root)
{
    char command[3 * SB_PATH_MAX];
    int length = snprintf(command, sizeof command, "'%s/tools/includes' --root '%s' ", SB_SOURCE_DIR, root);
    snprintf(command + length, sizeof command - (size_t)length, ">'%s' 2>&1", tool_path("output"));
    const int how = system(command);
    return WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

static void assert_accepted(const char *root)
{
    if (check_tree(root) != 0) fail_msg("%s", tool_text("output"));
    assert_true(tool_contains("output", " 0 faults\n"));
}

static void assert_refused(const char *expected)
{
    assert_int_equal(check_tree(tool_path("")), 1);
    if (!tool_contains("output", expected)) fail_msg("expected: %s\nfound: %s", expected, tool_text("output"));
    assert_true(tool_contains("output", " 1 faults\n"));
}

static void the_source_tree_has_no_faults(void **state)
{
    (void)state;
    assert_accepted(SB_SOURCE_DIR);
}

static void a_cycle_of_two_modules_is_listed(void **state)
{
    (void)state;
    assert_accepted(tool_path(""));
    assert_true(tool_contains("output", "pair: src/scene/scene and src/scene/parts/key\n") ||
                tool_contains("output", "pair: src/scene/parts/key and src/scene/scene\n"));
}

/* a.c includes b.h, b.h c.h, c.c a.h: no header includes itself, but no module can be understood alone. */
static void a_cycle_of_three_modules_is_found(void **state)
{
    (void)state;
    write_file("src/mesh/a.h", "");
    write_file("src/mesh/a.c", "#include \"mesh/a.h\"\n#include \"mesh/b.h\"\n");
    write_file("src/mesh/b.h", "#include \"mesh/c.h\"\n");
    write_file("src/mesh/c.h", "");
    assert_accepted(tool_path(""));
    write_file("src/mesh/c.c", "#include \"mesh/c.h\"\n#  include \"mesh/a.h\"\n");
    assert_refused("cycle of 3 modules:\n");
    assert_true(tool_contains("output", "  src/mesh/a.c:2: src/mesh/a includes src/mesh/b\n"));
    assert_true(tool_contains("output", "  src/mesh/b.h:1: src/mesh/b includes src/mesh/c\n"));
    assert_true(tool_contains("output", "  src/mesh/c.c:2: src/mesh/c includes src/mesh/a\n"));
    assert_int_equal(remove(tool_path("src/mesh/c.c")), 0);
    assert_accepted(tool_path(""));
}

/* Writes one more file, which must be refused with this line, and removes it. */
static void refuse(const char *name, const char *text, const char *expected)
{
    write_file(name, text);
    assert_refused(expected);
    assert_int_equal(remove(tool_path(name)), 0);
}

static void an_include_against_the_order_is_found(void **state)
{
    (void)state;
    refuse("src/base/up.h", "\n#include \"scene/scene.h\"\n",
           "src/base/up.h:2: includes src/scene/scene.h, but the row of src/base in docs/architecture.md does not name "
           "src/scene\n");
    refuse("src/scene/parts/up.h", "#include \"../../app/main.h\"\n#include \"../../mesh/mesh.h\"\n",
           "src/scene/parts/up.h:2: includes src/mesh/mesh.h, but");
    refuse("src/app/up.c", "#include \"../../tools/bench/bench.h\"\n",
           "src/app/up.c:1: includes tools/bench/bench.h, but src includes nothing of tools\n");
    refuse("src/app/up.c", "#include \"../../tests/base/check.h\"\n",
           "src/app/up.c:1: includes tests/base/check.h, but src includes nothing of tests\n");
    refuse("tools/bench/up.c", "#include \"../../tests/base/check.h\"\n",
           "tools/bench/up.c:1: includes tests/base/check.h, but tools includes nothing of tests\n");
    assert_accepted(tool_path(""));
}

static void a_cycle_of_folders_of_tools_is_found(void **state)
{
    (void)state;
    refuse("tools/common/up.c", "#include \"bench.h\"\n", "cycle of 2 folders:\n");
    assert_accepted(tool_path(""));
}

static void a_row_names_only_rows_above_it(void **state)
{
    (void)state;
    write_file("docs/architecture.md", "| `src/base` | a | none | |\n| `src/scene` | b | base, app | |\n"
                                       "| `src/mesh` | c | base | |\n| `src/app` | d | all | |\n");
    assert_refused("docs/architecture.md: src/scene names src/app, which has no row above it\n");
    write_file("docs/architecture.md", "no table\n");
    assert_int_equal(check_tree(tool_path("")), 1);
    assert_true(tool_contains("output", "docs/architecture.md: has no table of the folders of src\n"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_source_tree_has_no_faults, plant_tree, remove_tree),
        cmocka_unit_test_setup_teardown(a_cycle_of_two_modules_is_listed, plant_tree, remove_tree),
        cmocka_unit_test_setup_teardown(a_cycle_of_three_modules_is_found, plant_tree, remove_tree),
        cmocka_unit_test_setup_teardown(an_include_against_the_order_is_found, plant_tree, remove_tree),
        cmocka_unit_test_setup_teardown(a_cycle_of_folders_of_tools_is_found, plant_tree, remove_tree),
        cmocka_unit_test_setup_teardown(a_row_names_only_rows_above_it, plant_tree, remove_tree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
