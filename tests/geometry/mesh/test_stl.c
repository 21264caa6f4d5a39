/* Tests STL files as other programs write them, and the messages for files that are not STL. */
#include "base/memory.h"
#include "geometry/mesh/mesh.h"
#include "mesh_samples.h"

#include <ctype.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static sb_error error;
static char path[] = "/tmp/shorebreak-stl-XXXXXX.stl";

static void save(const void *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

/* Expects the meshes' names, joined by commas. The first mesh has `triangles` triangles. */
static void expect_read(const char *names, size_t triangles)
{
    char found[128] = "";
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    for (size_t i = 0; i < count; ++i)
        snprintf(found + strlen(found), sizeof found - strlen(found), "%s%s", i ? "," : "", meshes[i].name);
    assert_string_equal(found, names);
    assert_int_equal(meshes[0].triangle_count, triangles);
    sample_free(meshes, count);
}

static void expect_refusal(const char *why)
{
    sb_mesh *meshes;
    size_t count;
    assert_int_equal(sb_mesh_import(path, &meshes, &count, &error), SB_BAD_INPUT);
    if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, why))
        fail_msg("\"%s\" should begin with the path and say \"%s\"", error.text, why);
}

#define FACET "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1 0 0\n  vertex 0 1 0\n endloop\nendfacet\n"
#define OTHER "facet normal 0 0 1\n outer loop\n  vertex 5 0 0\n  vertex 6 0 0\n  vertex 5 1e0 0\n endloop\nendfacet\n"

static void expect_text(const char *text, const char *names, size_t triangles)
{
    save(text, strlen(text));
    expect_read(names, triangles);
}

static void text_is_read_as_others_read_it(void **state)
{
    (void)state;
    expect_text("solid Good\n" FACET "endsolid Good\n", "Good", 1);
    /* Empty solids before, between and after others. */
    expect_text("solid none\nendsolid none\nsolid Good\n" FACET "endsolid Good\n", "Good", 1);
    expect_text("solid\nendsolid\n\nsolid a\n" FACET "endsolid a\nsolid no\nendsolid no\nsolid b\n" FACET OTHER
                "endsolid b\nsolid\nendsolid\n",
                "a,b", 1);
    expect_text("solid none\nsolid Good\n" FACET "endsolid Good", "Good", 1);
    expect_text("solid facet\nendsolid facet\nsolid Good\n" FACET "endsolid Good", "Good", 1);
    expect_text("solid all facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet "
                "endsolid all",
                "all", 1);
    /* Blank lines and a byte-order mark at the start. */
    expect_text("\n\n  solid Good\n" FACET "endsolid Good\n", "Good", 1);
    expect_text("\xef\xbb\xbfsolid Good\n" FACET "endsolid Good\n", "Good", 1);
    expect_text("solid solid\r\n" FACET OTHER "endsolid solid\r\n", "solid", 2);
}

static void upper_case_keywords_are_read(void **state)
{
    (void)state;
    char text[1024];
    const size_t length = (size_t)snprintf(text, sizeof text, "solid Name\n%s%sendsolid Name\n", FACET, OTHER);
    for (size_t i = 0; i < length; ++i)
        if (strncmp(text + i, "Name", 4) == 0)
            i += 4;
        else
            text[i] = (char)toupper((unsigned char)text[i]);
    save(text, length);
    expect_read("Name", 2);
    expect_text("Solid Name\nFacet Normal 0 0 1\nOuter Loop\nVertex 0 0 0\nVertex 1 0 0\nVertex 0 1 0\nEndLoop\n"
                "EndFacet\nEndSolid Name\n",
                "Name", 1);
}

static void binary_is_read_as_others_read_it(void **state)
{
    (void)state;
    static const char *const heads[] = {"solid of some CAD", "SOLID", "    ", "a header"};
    for (size_t h = 0; h < sizeof heads / sizeof *heads; ++h)
        for (size_t more = 0; more < 120; more += more < 3 ? 1 : 50) {
            sample_text text = {.length = 0};
            sample_make_stl_binary(&text);
            memset(text.bytes, ' ', 80);
            memcpy(text.bytes, heads[h], strlen(heads[h]));
            memset(text.bytes + text.length, 'x', more);
            save(text.bytes, text.length + more);
            expect_read("", 12);
        }
}

static void the_cause_is_named(void **state)
{
    (void)state;
    sample_text text = {.length = 0};
    sample_make_stl_binary(&text);
    save(text.bytes, text.length - 60);
    expect_refusal("its header counts 12 triangles, but it has data for 10: it is truncated");
    memset(text.bytes + 80, 0, 4);
    save(text.bytes, text.length);
    expect_refusal("its header counts 0 triangles");
    save("\x01\x02\x03", 3);
    expect_refusal("3 bytes of binary data");
    save("solid a\nendsolid a\n", 19);
    expect_refusal("its solids have no facets");
    save("hello, world\n", 13);
    expect_refusal("text that does not begin with \"solid\"");
}

int main(void)
{
    const int file = mkstemps(path, 4);
    if (file < 0 || close(file) != 0) return 1;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_is_read_as_others_read_it),
        cmocka_unit_test(upper_case_keywords_are_read),
        cmocka_unit_test(binary_is_read_as_others_read_it),
        cmocka_unit_test(the_cause_is_named),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    unlink(path);
    return failed;
}
