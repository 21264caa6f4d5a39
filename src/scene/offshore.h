/* The depth-averaged model of a scene. */
#ifndef SB_SCENE_OFFSHORE_H
#define SB_SCENE_OFFSHORE_H

#include "scene/bodies.h"
#include "scene/water.h"

/* Heights on a grid of the depth-averaged model: terrain, or an uplift of the surface. */
typedef struct sb_offshore_grid {
    char *file;             /* absolute path */
    double scale;           /* metres per file unit */
    sb_positive positive;   /* direction in which values are positive */
    double datum;           /* m, added to the heights */
    double x, y;            /* m, translation */
    char *crs, *projection; /* as those of sb_body */
} sb_offshore_grid;

typedef enum sb_grid_side {
    SB_GRID_SIDE_DOMAIN, /* that of the domain; of a grid that ends elsewhere: open */
    SB_GRID_SIDE_WALL,
    SB_GRID_SIDE_OPEN,
    SB_GRID_SIDE_PERIODIC,
    SB_GRID_SIDE_PADDLE
} sb_grid_side;
typedef enum sb_coupling {
    SB_COUPLING_ONE_WAY, /* the grid gives water to the particles */
    SB_COUPLING_TWO_WAY  /* and gets the waves that leave the particles */
} sb_coupling;

/* The depth-averaged model. A scene that has one has particles only if the sea's source is `offshore`. */
typedef struct sb_offshore_settings {
    bool present;
    double cell;                       /* m */
    double x_min, y_min, x_max, y_max; /* m, of the grid */
    size_t terrain_count;              /* 0: the bodies are the terrain */
    sb_offshore_grid *terrain;         /* later ones replace earlier ones where they have heights */
    double level;                      /* m, still water */
    double manning;                    /* s/m^(1/3) */
    bool dispersion;
    double threshold; /* m, depth or rise that counts in the maps */
    bool maps;
    double drawn; /* m, distance beyond the domain to which pictures show the grid's water */
    bool has_uplift;
    sb_offshore_grid uplift; /* m, added to the still surface at the start */
    sb_initial_wave wave;
    sb_grid_side side[4]; /* from x_min to y_max */
    bool has_paddle;
    sb_wavemaker_use paddle; /* the law of the sides of kind paddle; name and body are empty */
    double paddle_at;        /* m, x or y of its face before its motion */
    sb_coupling coupling;
} sb_offshore_settings;

#endif
