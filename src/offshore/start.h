/* The depth-averaged model of a scene at t = 0. */
#ifndef SB_OFFSHORE_START_H
#define SB_OFFSHORE_START_H

#include "offshore/offshore.h"
#include "scene/scene.h"

/* What `check` tells of a grid that is part of the bed. */
typedef struct sb_offshore_told {
    char name[SB_NAME_MAX]; /* offshore.terrain[0], offshore.uplift, or that of a body */
    bool is_key;            /* the name is a key of the scene */
    char *text;             /* lines */
} sb_offshore_told;

/* Owns its items and its warnings, which are lines; zero is an empty list. */
typedef struct sb_offshore_told_list {
    size_t count, warning_count;
    sb_offshore_told *items;
    char **warnings; /* what is probably not meant */
} sb_offshore_told_list;

void sb_offshore_told_free(sb_offshore_told_list *told);

/* Adds a warning. SB_FAILED without memory. */
sb_status sb_offshore_warn(sb_offshore_told_list *told, sb_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Values of columns x rows cells, [row * columns + column]. Owns its arrays; zero is an empty one. */
typedef struct sb_offshore_start {
    size_t columns, rows;
    size_t wet, uncovered;    /* cells with water; beside all bodies */
    double deepest;           /* m, the largest depth */
    double highest;           /* m, z of the highest surface */
    double fastest;           /* m/s, the highest speed */
    double *bed, *depth, *hu; /* m, m, m^2/s */
    char *projection;         /* coordinate system of the terrain's grids; NULL: none states one */
    sb_offshore_told_list told;
} sb_offshore_start;

void sb_offshore_start_free(sb_offshore_start *start);

/* The options of the scene's grid of so many cells. */
sb_offshore_options sb_offshore_options_of(const sb_scene *scene, size_t columns, size_t rows);

/* Adds still water and the scene's wave to the bed. depth holds the uplift on entry. Sets wet, deepest, highest and
   fastest, and warns in start->told of a wave for another depth. SB_BAD_INPUT if there is no water. */
sb_status sb_offshore_start_water(const sb_scene *scene, sb_offshore_start *start, sb_error *error);

/* Makes the model; as sb_offshore_create. */
sb_status sb_offshore_begin(const sb_scene *scene, const sb_offshore_start *start, sb_offshore **offshore,
                            sb_error *error);

#endif
