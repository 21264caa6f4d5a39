/* A scene with given water, and files beside it. */
#ifndef SB_TESTS_SEA_SCENE_H
#define SB_TESTS_SEA_SCENE_H

#include "../check.h"
#include "sea/sea.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* 2D: 10 m long, 2 m high, still water at 1 m, 20 s. 3D: 6 m wide as well. */
#define SEA_FLAT                                                                                                       \
    "dimensions: 2\nresolution: 0.1\nduration: 20\ndomain: {min: [0, 0], max: [10, 2], sides: {x_min: sea}}\n"         \
    "water: {level: 1, seed: [1, 0.2]}\n"
#define SEA_SPACE                                                                                                      \
    "resolution: 0.1\nduration: 20\ndomain: {min: [0, 0, 0], max: [10, 6, 2], sides: {x_min: sea}}\n"                  \
    "water: {level: 1, seed: [1, 1, 0.2]}\n"

typedef struct sea_case {
    char folder[256], scene_path[300], table_path[300];
    sb_scene scene;
    sb_sea_source *sea;
    sb_error error;
} sea_case;

static inline void sea_write(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* Reads head and block as a scene beside table.csv with these contents (NULL: none), and creates its source. */
static inline sb_status sea_try(sea_case *c, const char *head, const char *block, const char *table)
{
    char text[4096];
    *c = (sea_case){0};
    snprintf(c->folder, sizeof c->folder, "%s/sea-XXXXXX", SB_BINARY_DIR);
    assert_non_null(mkdtemp(c->folder));
    snprintf(c->scene_path, sizeof c->scene_path, "%s/scene.yaml", c->folder);
    snprintf(c->table_path, sizeof c->table_path, "%s/table.csv", c->folder);
    snprintf(text, sizeof text, "%ssea: {%s}\n", head, block);
    sea_write(c->scene_path, text);
    if (table) sea_write(c->table_path, table);
    sb_status status = sb_scene_read(c->scene_path, NULL, NULL, 0, &c->scene, &c->error);
    return status == SB_OK ? sb_sea_create(&c->scene, NULL, &c->sea, &c->error) : status;
}

static inline void sea_make(sea_case *c, const char *head, const char *block, const char *table)
{
    if (sea_try(c, head, block, table) != SB_OK) fail_msg("%s", c->error.text);
}

static inline void sea_free(sea_case *c)
{
    sb_sea_destroy(c->sea);
    sb_scene_free(&c->scene);
    unlink(c->scene_path);
    unlink(c->table_path);
    rmdir(c->folder);
}

static inline sb_sea_point sea_at(const sea_case *c, double t, double x, double y, double z)
{
    sb_sea_point point;
    sb_sea_at(c->sea, t, x, y, z, 0, &point);
    return point;
}

/* Fails unless the case is refused with a line that contains `expected`. */
static inline void sea_refused(const char *head, const char *block, const char *table, const char *expected)
{
    sea_case c;
    const sb_status status = sea_try(&c, head, block, table);
    if (status != SB_BAD_INPUT || !strstr(c.error.text, expected) || strchr(c.error.text, '\n'))
        fail_msg("status %d: %s\n  expected: %s", (int)status, c.error.text, expected);
    sea_free(&c);
}

#endif
