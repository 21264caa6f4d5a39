/* docs/scene.md documents every key: its tables, between the marks "<!-- keys: block -->" and "<!-- end -->", agree
   with the key tables. SB_UPDATE_DOCS=1 rewrites them instead. */
#include "../check.h"
#include "base/file.h"
#include "base/memory.h"
#include "scene/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DOCS SB_SOURCE_DIR "/docs/scene.md"

enum { BLOCKS_MAX = 64, TABLE_MAX = 16384 };

typedef struct block {
    char name[100]; /* "" for the top level, "bodies[]" */
    char table[TABLE_MAX];
} block;

typedef struct reference {
    block *blocks;
    size_t block_count, key_count, bare;
} reference;

static block *block_of(reference *all, const char *path)
{
    const char *dot = strrchr(path, '.');
    size_t length = dot ? (size_t)(dot - path) : 0;
    for (size_t i = 0; i < all->block_count; i++)
        if (strlen(all->blocks[i].name) == length && strncmp(all->blocks[i].name, path, length) == 0)
            return &all->blocks[i];
    assert_true(all->block_count < BLOCKS_MAX && length < sizeof all->blocks->name);
    block *made = &all->blocks[all->block_count++];
    memcpy(made->name, path, length);
    snprintf(made->table, sizeof made->table, "| key | unit | default | range | meaning |\n|---|---|---|---|---|\n");
    return made;
}

static void add_row(void *context, const sb_scene_key *key)
{
    reference *all = context;
    block *to = block_of(all, key->path);
    const char *dot = strrchr(key->path, '.');
    size_t used = strlen(to->table);
    int length = snprintf(to->table + used, sizeof to->table - used, "| `%s` | %s | %s | %s | %s%s%s%s |\n",
                          dot ? dot + 1 : key->path, *key->unit ? key->unit : "–",
                          key->required    ? "required"
                          : *key->fallback ? key->fallback
                                           : "see its keys",
                          key->range, key->doc ? key->doc : "", key->only ? " Only for " : "",
                          key->only ? key->only : "", key->only ? "." : "");
    assert_true(length > 0 && used + (size_t)length < sizeof to->table);
    all->key_count++;
    bool bare = !key->doc || !*key->doc || !*key->range;
    bool no_default = !key->required && !*key->fallback && strcmp(key->range, "a block of keys") != 0;
    if (bare || no_default) print_error("%s has no sentence, range or default\n", key->path);
    all->bare += bare || no_default;
}

/* The text between the block's marks; NULL if they are missing. */
static char *find_table(char *docs, const char *name, size_t *length)
{
    char mark[160];
    snprintf(mark, sizeof mark, "<!-- keys: %s -->\n", *name ? name : "top level");
    char *start = strstr(docs, mark);
    if (!start) return NULL;
    start += strlen(mark);
    char *end = strstr(start, "<!-- end -->");
    *length = end ? (size_t)(end - start) : 0;
    return end ? start : NULL;
}

static void rewrite(const char *before, size_t before_length, const char *table, const char *after)
{
    sb_error error = {0};
    sb_atomic_file file;
    if (sb_atomic_open(&file, DOCS, &error) != SB_OK) fail_msg("%s", error.text);
    fwrite(before, 1, before_length, file.stream);
    fputs(table, file.stream);
    fputs(after, file.stream);
    if (sb_atomic_commit(&file, 0, &error) != SB_OK) fail_msg("%s", error.text);
}

static int check_block(const block *expected, bool update)
{
    char *docs;
    size_t length;
    sb_error error = {0};
    if (sb_file_read(DOCS, 1u << 20, &docs, &length, &error) != SB_OK) fail_msg("%s", error.text);
    char *table = find_table(docs, expected->name, &length);
    int good = table && strlen(expected->table) == length && strncmp(table, expected->table, length) == 0;
    if (table && !good && update) {
        rewrite(docs, (size_t)(table - docs), expected->table, table + length);
        good = 1;
    }
    sb_free(docs);
    if (!good)
        print_error("docs/scene.md: the table of \"%s\" is %s; run with SB_UPDATE_DOCS=1\n",
                    *expected->name ? expected->name : "top level", table ? "old" : "missing");
    return good;
}

static void test_every_key(void **state)
{
    (void)state;
    reference all = {.blocks = sb_alloc(BLOCKS_MAX, sizeof *all.blocks)};
    assert_non_null(all.blocks);
    sb_scene_keys(add_row, &all);
    assert_true(all.key_count > 100);
    assert_int_equal(all.bare, 0);
    const char *update = getenv("SB_UPDATE_DOCS");
    size_t good = 0;
    for (size_t i = 0; i < all.block_count; i++) good += (size_t)check_block(&all.blocks[i], update && *update);
    assert_int_equal(good, all.block_count);
    sb_free(all.blocks);
}

/* Kernels and laws are rows of other tables; docs/scene.md must name each of them. */
static void test_every_row(void **state)
{
    (void)state;
    char *docs, name[80];
    size_t length;
    sb_error error = {0};
    assert_int_equal(sb_file_read(DOCS, 1u << 20, &docs, &length, &error), SB_OK);
    for (size_t i = 0; sb_kernels[i]; i++) assert_non_null(strstr(docs, sb_kernels[i]->name));
    for (size_t i = 0; sb_wavemakers[i]; i++) {
        snprintf(name, sizeof name, "`%s`", sb_wavemakers[i]->name);
        assert_non_null(strstr(docs, name));
    }
    sb_free(docs);
}

/* The example in docs/scene.md is a valid scene. */
static void test_example(void **state)
{
    (void)state;
    char *docs;
    size_t length;
    sb_error error = {0};
    assert_int_equal(sb_file_read(DOCS, 1u << 20, &docs, &length, &error), SB_OK);
    char *start = strstr(docs, "```yaml\n"), path[] = SB_BINARY_DIR "/docs-example-XXXXXX";
    assert_non_null(start);
    start += strlen("```yaml\n");
    char *end = strstr(start, "```");
    assert_non_null(end);
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "w");
    assert_non_null(file);
    fwrite(start, 1, (size_t)(end - start), file);
    assert_int_equal(fclose(file), 0);
    sb_scene scene;
    sb_status status = sb_scene_read(path, NULL, NULL, 0, &scene, &error);
    remove(path);
    sb_free(docs);
    if (status != SB_OK) fail_msg("%s", error.text);
    sb_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_key),
        cmocka_unit_test(test_every_row),
        cmocka_unit_test(test_example),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
