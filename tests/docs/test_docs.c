/* The documents: each relative link leads to a file, and to a heading of it where it names one; the README shows the
   scene that is delivered. */
#include "../check.h"

#include "base/file.h"
#include "base/memory.h"

#include <ctype.h>
#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PAGES_MAX = 256 };
static char *pages[PAGES_MAX];
static size_t page_count;

static int note_page(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)where;
    const size_t length = strlen(path);
    if (kind != FTW_F || length < 3 || strcmp(path + length - 3, ".md") != 0) return 0;
    assert_true(page_count < PAGES_MAX);
    pages[page_count++] = sb_strdup(path);
    return 0;
}

static int find_pages(void **state)
{
    (void)state;
    static const char *const places[] = {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs", "assets"};
    for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", SB_SOURCE_DIR, places[p]);
        if (nftw(path, note_page, 16, FTW_PHYS) != 0) return -1;
    }
    return 0;
}

static int forget_pages(void **state)
{
    (void)state;
    for (size_t p = 0; p < page_count; p++) sb_free(pages[p]);
    return 0;
}

static char *text_of(const char *path)
{
    sb_error error = {0};
    char *text = NULL;
    size_t length = 0;
    if (sb_file_read(path, (size_t)1 << 24, &text, &length, &error) != SB_OK) fail_msg("%s", error.text);
    return text;
}

/* Whether the page has an element of that id, or a heading whose anchor (lower case, spaces to hyphens, no
   punctuation) is the one given. */
static bool has_anchor(const char *page, const char *anchor)
{
    char *text = text_of(page), id[420];
    snprintf(id, sizeof id, "id=\"%s\"", anchor);
    bool found = strstr(text, id) != NULL;
    for (const char *line = text; line && *line && !found; line = strchr(line, '\n') ? strchr(line, '\n') + 1 : NULL) {
        const char *at = line;
        char slug[400];
        size_t n = 0;
        if (*at != '#') continue;
        while (*at == '#' || *at == ' ') at++;
        for (; *at && *at != '\n' && n + 1 < sizeof slug; at++) {
            const unsigned char c = (unsigned char)*at;
            if (c == ' ')
                slug[n++] = '-';
            else if (isalnum(c) || c == '-' || c == '_' || c > 127)
                slug[n++] = (char)tolower(c);
        }
        slug[n] = '\0';
        found = strcmp(slug, anchor) == 0;
    }
    sb_free(text);
    return found;
}

/* target: what stands in the brackets of a link on that page. */
static bool leads_somewhere(const char *page, const char *target)
{
    char path[2048], anchor[400] = "";
    if (strstr(target, "://")) return true;
    const char *hash = strchr(target, '#'), *slash = strrchr(page, '/');
    if (hash) snprintf(anchor, sizeof anchor, "%s", hash + 1);
    const int name = (int)(hash ? (size_t)(hash - target) : strlen(target));
    if (name == 0)
        snprintf(path, sizeof path, "%s", page);
    else
        snprintf(path, sizeof path, "%.*s/%.*s", (int)(slash - page), page, name, target);
    return access(path, R_OK) == 0 && (*anchor == '\0' || has_anchor(path, anchor));
}

static void links_lead_somewhere(void **state)
{
    (void)state;
    size_t links = 0, broken = 0;
    for (size_t p = 0; p < page_count; p++) {
        char *text = text_of(pages[p]);
        for (const char *at = text; (at = strstr(at, "](")); at += 2) {
            char target[1024];
            const char *end = strchr(at, ')');
            if (!end || (size_t)(end - at) - 2 >= sizeof target) continue;
            snprintf(target, sizeof target, "%.*s", (int)(end - at) - 2, at + 2);
            links++;
            if (leads_somewhere(pages[p], target)) continue;
            broken++;
            print_message("%s: %s leads nowhere\n", pages[p] + strlen(SB_SOURCE_DIR) + 1, target);
        }
        sb_free(text);
    }
    assert_true(links > 100);
    assert_int_equal(broken, 0);
}

static void the_readme_shows_the_delivered_scene(void **state)
{
    (void)state;
    char *readme = text_of(SB_SOURCE_DIR "/README.md"), *scene = text_of(SB_SOURCE_DIR "/assets/scenes/house.yaml");
    const char *shown = strstr(readme, "```yaml\n"), *first = scene;
    assert_non_null(shown);
    shown += strlen("```yaml\n");
    while (*first == '#') first = strchr(first, '\n') + 1; /* the file begins with comments */
    const size_t length = strlen(first);
    assert_true(strlen(shown) > length);
    assert_memory_equal(shown, first, length);
    assert_memory_equal(shown + length, "```", 3);
    sb_free(readme);
    sb_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(links_lead_somewhere),
                                       cmocka_unit_test(the_readme_shows_the_delivered_scene)};
    return cmocka_run_group_tests(tests, find_pages, forget_pages);
}
