/* Bodies of a scene, what moves them, zones that slow water down, and foam. */
#ifndef SB_SCENE_BODIES_H
#define SB_SCENE_BODIES_H

#include "physics/absorption/sponge.h"
#include "physics/wavemakers/wavemaker.h"
#include "scene/domain.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum sb_shape {
    SB_SHAPE_MESH,
    SB_SHAPE_GRID, /* terrain heights */
    SB_SHAPE_BOX,
    SB_SHAPE_CYLINDER, /* upright, closed */
    SB_SHAPE_PLANE,    /* a rectangle; solid on the side away from its normal */
    SB_SHAPE_BASIN     /* open-topped tank: solid outside of [min, max] */
} sb_shape;

typedef enum sb_role {
    SB_ROLE_SOLID,  /* a closed surface; the winding number decides what is inside */
    SB_ROLE_TERRAIN /* a surface of the ground; solid everywhere below it */
} sb_role;

typedef enum sb_positive {
    SB_POSITIVE_UP,   /* a grid's values are heights */
    SB_POSITIVE_DOWN, /* a grid's values are depths */
    SB_POSITIVE_AUTO  /* as each file states, otherwise heights */
} sb_positive;

typedef enum sb_voids {
    SB_VOIDS_KEEP, /* missing heights are holes in the ground */
    SB_VOIDS_FILL, /* they are interpolated from the heights around them */
    /* of the grids of offshore; no key gives them */
    SB_VOIDS_SHOW,  /* holes that show an earlier grid */
    SB_VOIDS_COVER, /* holes that a later grid covers */
    SB_VOIDS_BARE,  /* holes in which no cell may lie */
    SB_VOIDS_ZERO   /* holes without uplift */
} sb_voids;

/* One file of a stack of grids. */
typedef struct sb_grid_file {
    char *file;   /* absolute path */
    char *crs;    /* its coordinate system; empty: as the file states */
    double datum; /* m, added to its heights */
} sb_grid_file;

/* A part of the ground, in m of the projection. */
typedef struct sb_window {
    bool present;
    double x_min, y_min, x_max, y_max;
} sb_window;

typedef struct sb_body {
    char name[SB_NAME_MAX];
    sb_shape shape;
    sb_role role;
    bool report; /* has rows in forces.csv */
    bool has_moment_point;
    sb_vec3 moment_point; /* default: centre of the footprint at the lowest level */
    float color[3];       /* in pictures; < 0: chosen by role */
    /* mesh and grid */
    char *file;           /* absolute path */
    char up;              /* 'y' or 'z': the file's up axis */
    double scale;         /* metres per file unit */
    bool split;           /* each named node becomes a body */
    sb_positive positive; /* direction in which a grid's values are positive */
    double datum;         /* m, added to a grid's heights */
    size_t file_count;    /* a grid's stack; 0: `file` alone */
    sb_grid_file *files;
    char *crs, *projection; /* of a grid's file, of its ground; empty: see geometry/grid/terrain.c */
    double origin[2];       /* m: place of the projection that becomes (0, 0) */
    sb_window window;       /* used part of a grid; not present: that of the domain */
    double resample;        /* m between the nodes of the ground; 0: those of the file, or the least of the stack */
    sb_voids voids;
    /* transform, applied in this order after scale and up-axis */
    sb_vec3 rotate;    /* degrees about x, then y, then z */
    sb_vec3 translate; /* m */
    /* analytic shapes (before the transform) */
    sb_vec3 min, max;      /* box, basin */
    sb_vec3 center;        /* cylinder: centre of its base; plane: its centre */
    double radius, height; /* cylinder */
    sb_vec3 normal;        /* plane, towards the water */
    double width, length;  /* plane: horizontal extent, and extent perpendicular to it */
} sb_body;

/* Push-plates, into which an absorbing paddle is divided. Those above each other read the same surface and move as one:
   the height acts on no motion. */
typedef struct sb_plate_settings {
    double width;  /* m, about that of each; 0: the paddle is one */
    double height; /* m, about that of each; 0: that of the paddle */
} sb_plate_settings;

/* A body's motion along `direction`: the law's displacement(t - start). */
typedef struct sb_wavemaker_use {
    char name[SB_NAME_MAX];
    char body[SB_NAME_MAX];
    sb_vec3 direction;           /* unit */
    sb_wavemaker_parameters law; /* kind, height, depth, stroke, ..., motion after the stroke */
    sb_plate_settings plates;
} sb_wavemaker_use;

/* A zone in which water is slowed down. */
typedef struct sb_sponge {
    char name[SB_NAME_MAX];
    sb_sponge_kind kind;
    int side;           /* SB_X_MIN to SB_Y_MAX: the strength grows towards it */
    double end, length; /* m: coordinate at which the strength is reached; length in which it grows */
    sb_sponge_profile profile;
    double period, depth; /* s, m, of the waves */
    double strength;      /* 1/s, at the end and behind it; 0 with kind viscous */
    double alpha;         /* artificial viscosity there, with kind viscous */
} sb_sponge;

/* Spray, foam and bubbles: particles for pictures, which do not act on the water. */
typedef struct sb_foam_settings {
    bool enabled;
    int most;        /* particles */
    double lifetime; /* s at the surface or below it; 0: from the depth of the water */
    double amount;   /* factor on the number of particles that water emits */
} sb_foam_settings;

#endif
