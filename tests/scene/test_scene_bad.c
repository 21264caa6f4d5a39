/* Every file of tests/scene/bad is refused with the message in its first line. */
#include "../check.h"
#include "base/memory.h"
#include "scene/scene.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BAD SB_SOURCE_DIR "/tests/scene/bad"

static bool expected_text(const char *path, char *text, size_t size)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    char line[400] = "";
    bool found = fgets(line, sizeof line, file) && strncmp(line, "# expect: ", 10) == 0;
    fclose(file);
    line[strcspn(line, "\n")] = '\0';
    snprintf(text, size, "%s", line + (found ? 10 : 0));
    return found && *text;
}

/* "path:line:column: " with both numbers from 1. */
static bool is_placed(const char *message, const char *path)
{
    size_t length = strlen(path);
    unsigned line = 0, column = 0;
    int used = 0;
    return strncmp(message, path, length) == 0 && sscanf(message + length, ":%u:%u: %n", &line, &column, &used) == 2 &&
           used > 0 && line > 0 && column > 0;
}

static int refuses(const char *path)
{
    char expected[400];
    if (!expected_text(path, expected, sizeof expected)) {
        print_error("%s: no line \"# expect: ...\"\n", path);
        return 0;
    }
    sb_scene scene;
    memset(&scene, 0xa5, sizeof scene);
    sb_scene before = scene;
    sb_error error = {0};
    sb_status status = sb_scene_read(path, NULL, NULL, 0, &scene, &error);
    if (status == SB_BAD_INPUT && error.status == status && is_placed(error.text, path) &&
        strstr(error.text, expected) && !strchr(error.text, '\n') && memcmp(&scene, &before, sizeof scene) == 0)
        return 1;
    print_error("%s\n  status %d: %s\n  expected: %s\n", path, (int)status, error.text, expected);
    return 0;
}

static void test_corpus(void **state)
{
    (void)state;
    DIR *folder = opendir(BAD);
    assert_non_null(folder);
    int files = 0, refused = 0;
    for (struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        if (!strstr(entry->d_name, ".yaml")) continue;
        char path[600];
        snprintf(path, sizeof path, BAD "/%s", entry->d_name);
        files++;
        refused += refuses(path);
    }
    closedir(folder);
    assert_true(files >= 100);
    assert_int_equal(refused, files);
}

static void check_text(const char *bytes, size_t length, const char *expected)
{
    char path[] = SB_BINARY_DIR "/bad-scene-XXXXXX";
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    sb_scene scene;
    sb_error error = {0};
    sb_status status = sb_scene_read(path, NULL, NULL, 0, &scene, &error);
    remove(path);
    assert_int_equal(status, SB_BAD_INPUT);
    if (!strstr(error.text, expected)) fail_msg("%s\nexpected: %s", error.text, expected);
}

/* Bad inputs that a text file with a comment cannot contain. */
static void test_generated(void **state)
{
    (void)state;
    check_text("", 0, ":1:1: the file is empty");
    check_text("title: a\0b\n", 11, ":1:9: not UTF-8 text: control characters are not allowed");
    check_text("\xff\xfet\0", 4, "not UTF-8 text");
    size_t length = (4u << 20) + 1;
    char *large = sb_alloc(length, 1);
    assert_non_null(large);
    memset(large, '#', length);
    check_text(large, length, "larger than the 4194304 bytes allowed");
    memset(large, '[', length);
    check_text(large, 4u << 20, ":1:34: nested deeper than 32 levels");
    memset(large, ' ', 34);
    large[0] = '#';
    large[33] = '\n';
    check_text(large, 4u << 20, ":2:34: nested deeper than 32 levels");
    for (size_t i = 0; i < length; i++) large[i] = "- &a x\n"[i % 7];
    check_text(large, 4u << 20, "more than 1000 anchors");
    for (size_t i = 0; i < length; i++) large[i] = "- x\n"[i % 4];
    check_text(large, 1u << 19, "list of more than 100000 items");
    sb_free(large);
}

static void test_many_keys(void **state)
{
    (void)state;
    char text[32000];
    size_t used = 0;
    for (int i = 0; i < 1001; i++) used += (size_t)snprintf(text + used, sizeof text - used, "k%d: 1\n", i);
    check_text(text, used, ":1:1: block of more than 1000 keys");
}

static void test_many_items(void **state)
{
    (void)state;
    size_t length = 0, size = 1u << 19;
    char *text = sb_alloc(size, 1);
    assert_non_null(text);
    length += (size_t)snprintf(text, size,
                               "resolution: 0.1\nduration: 1\n"
                               "domain: {min: [0, 0, 0], max: [2, 1, 1]}\n"
                               "water: {level: 0.5, seed: [1, 0.5, 0.2]}\n"
                               "measure:\n  gauges:\n");
    for (int i = 0; i < 10001; i++)
        length += (size_t)snprintf(text + length, size - length, "  - {name: g%d, x: 1, y: 0}\n", i);
    check_text(text, length, "measure.gauges: has 10001 items, expected at most 10000");
    sb_free(text);
}

static void test_unreadable(void **state)
{
    (void)state;
    sb_scene scene;
    sb_error error = {0};
    assert_int_equal(sb_scene_read(BAD "/none.yaml", NULL, NULL, 0, &scene, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "none.yaml: cannot read: No such file"));
    assert_int_equal(sb_scene_read("/no/such/folder/a.yaml", NULL, NULL, 0, &scene, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "a.yaml: cannot read: No such file"));
    assert_int_equal(sb_scene_read(BAD, NULL, NULL, 0, &scene, &error), SB_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_corpus),     cmocka_unit_test(test_generated),  cmocka_unit_test(test_many_keys),
        cmocka_unit_test(test_many_items), cmocka_unit_test(test_unreadable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
