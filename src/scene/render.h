/* The pictures of a scene. */
#ifndef SB_SCENE_RENDER_H
#define SB_SCENE_RENDER_H

#include "scene/domain.h"

#include <stdbool.h>
#include <stddef.h>

/* How a camera moves from a key of its path to the next one. */
typedef enum sb_ease { SB_EASE_SMOOTH, SB_EASE_LINEAR, SB_EASE_IN, SB_EASE_OUT } sb_ease;

typedef struct sb_camera_key {
    double time;
    sb_vec3 eye, target;
    double fov;
    sb_ease ease;
} sb_camera_key;

typedef enum sb_camera_kind { SB_CAMERA_KEYS, SB_CAMERA_FOLLOW, SB_CAMERA_ORBIT, SB_CAMERA_CLOSEUP } sb_camera_kind;

/* A camera that follows the highest water along the line from (ax, ay) to (bx, by). */
typedef struct sb_follow {
    unsigned what; /* 0: the crest */
    double ax, ay, bx, by;
    double width;     /* m, of the strip along the line whose water counts; 0: all water */
    double smoothing; /* s */
    bool travel;      /* the eye moves with the target */
} sb_follow;

/* A circle about a vertical axis. */
typedef struct sb_orbit {
    sb_vec3 target;
    double radius, height; /* m; height of the eye above the target */
    double period;         /* s per turn, counter-clockwise seen from above if > 0 */
    double turns;          /* only while a scene is read: over the run's duration, from which the period follows */
    double from;           /* degrees from +x, at t = 0 */
} sb_orbit;

typedef enum sb_water_style { SB_WATER_SURFACE, SB_WATER_PARTICLES } sb_water_style;
typedef enum sb_water_color {
    SB_COLOR_SPEED,
    SB_COLOR_PRESSURE,
    SB_COLOR_VORTICITY,
    SB_COLOR_DEPTH,
    SB_COLOR_MOMENTUM_FLUX,
    SB_COLOR_DENSITY_ERROR,
    SB_WATER_COLORS
} sb_water_color;

/* A plane through the water. What lies between it and the eye is not drawn. */
typedef struct sb_slice {
    sb_vec3 point, normal;       /* m; of any length, its sign has no meaning; a normal of 0: there is no slice */
    bool behind;                 /* what lies behind the plane is drawn */
    sb_water_color field;        /* colours the cut water */
    double field_min, field_max; /* as color_min and color_max of the camera */
    double vectors;              /* m between arrows; 0: none */
    double vector_speed;         /* m/s, whose arrow has this length; 0: sqrt(g D) / 2 */
    double streamlines;          /* m between streamlines; 0: none */
} sb_slice;

typedef struct sb_camera {
    char name[SB_NAME_MAX];
    sb_camera_kind kind;
    size_t key_count; /* 1: fixed, or follows; more: a path through keys in time; 0: the other kinds */
    sb_camera_key *keys;
    double fov; /* degrees; of a path, those of its keys instead */
    sb_follow follow;
    sb_orbit orbit;
    char body[SB_NAME_MAX]; /* close-up: it fills the picture */
    sb_vec3 direction;      /* from the body to the eye, of any length */
    double margin;          /* distance, over that at which the body's box just fits */
    sb_water_style style;
    sb_water_color color;
    double color_min, color_max; /* in the unit of the colour's field; both 0: a range that fits the scene */
    sb_slice slice;
} sb_camera;

/* A picture of a size of its own at one time. */
typedef struct sb_still {
    double time;
} sb_still;

/* A plot in each picture: the force on a body along an axis, or the water level at a gauge. */
typedef struct sb_inset {
    char force[SB_NAME_MAX]; /* the body; empty: a gauge */
    unsigned axis;           /* 0, 1, 2 */
    char gauge[SB_NAME_MAX];
} sb_inset;

typedef struct sb_render_settings {
    double interval;   /* s between pictures; 0: off */
    int width, height; /* px */
    double speed_max;  /* m/s at the top of the colour map; 0: 2 sqrt(g D) of the scene */
    int video_rate;    /* pictures per second of video */
    size_t still_count;
    sb_still *stills;              /* in increasing order */
    int still_width, still_height; /* px */
    size_t inset_count;
    sb_inset *insets;
    bool scale_bar;
    sb_vec3 north; /* horizontal; 0: no arrow */
    bool shadows, occlusion;
    bool wet_ground;     /* ground and bodies at rest that the water has reached are darker */
    bool greatest_depth; /* the greatest depth so far is painted there, above the still water */
    bool loads;      /* bodies have the colour of the mean pressure on their faces; the two above are on terrain only */
    double load_max; /* Pa, at the upper end of these colours; 0: rho g D / 10 */
    bool video;      /* join pictures to <camera>.mp4 if ffmpeg is installed */
    size_t camera_count;
    sb_camera *cameras;
} sb_render_settings;

#endif
