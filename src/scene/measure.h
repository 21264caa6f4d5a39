/* What a scene measures. */
#ifndef SB_SCENE_MEASURE_H
#define SB_SCENE_MEASURE_H

#include "scene/domain.h"

#include <stdbool.h>
#include <stddef.h>

/* Whose water a gauge reads. Without particles all read the grid. */
typedef enum sb_gauge_water { SB_GAUGE_PARTICLES, SB_GAUGE_GRID } sb_gauge_water;
typedef struct sb_gauge {
    char name[SB_NAME_MAX];
    double x, y;
    sb_gauge_water water;
} sb_gauge;
typedef struct sb_probe {
    char name[SB_NAME_MAX];
    sb_vec3 at;
    double radius; /* 0: support radius */
} sb_probe;
/* What the rate of overtopping at a plane is compared with. */
typedef struct sb_eurotop_settings {
    double height;        /* m, H_m0 of the incoming waves; 0: it is not compared */
    double crest;         /* m, z of the structure's crest */
    double slope, period; /* tangent of its slope, 0: vertical; s, T_m-1,0 of the waves, for slopes */
    double start;         /* s, from which the rate is the mean */
} sb_eurotop_settings;
/* A vertical plane from (ax, ay) to (bx, by), z_min..z_max. Flow to the right of a->b is positive. */
typedef struct sb_flow_plane {
    char name[SB_NAME_MAX];
    double ax, ay, bx, by, z_min, z_max;
    bool record;            /* surface and velocities along it are written to record.csv */
    double record_interval; /* s between rows, a multiple of the interval; 0: not recorded */
    double record_spacing;  /* m between points along the plane; 0: not recorded, or 2D */
    sb_eurotop_settings eurotop;
} sb_flow_plane;
/* A line from (ax, ay) to (bx, by). Run-up is the highest z of connected water within one spacing of it. */
typedef struct sb_runup_line {
    char name[SB_NAME_MAX];
    double ax, ay, bx, by;
} sb_runup_line;

/* The name of a gauge. */
typedef struct sb_gauge_name {
    char name[SB_NAME_MAX];
} sb_gauge_name;
/* Gauges in a line, whose waves are split into those that travel from the first gauge to the last, and those that come
   back. */
typedef struct sb_reflection_set {
    char name[SB_NAME_MAX];
    size_t gauge_count; /* at least 3 */
    sb_gauge_name *gauges;
    double period; /* s */
    int harmonics; /* period, period/2, ..., period/harmonics are split */
    double depth;  /* m, still-water depth, for the wave numbers */
    double length; /* m, of the first harmonic; 0: that of linear theory */
    double start;  /* s */
    double window; /* s, at least one period */
    bool bound;    /* harmonics above the first have free and bound waves; at least 4 gauges */
} sb_reflection_set;

typedef struct sb_map {
    bool present;
    double x_min, y_min, x_max, y_max, cell; /* m */
    double threshold; /* m; water has arrived when the depth at the start, or later its rise, is this */
} sb_map;

/* Heights and periods of the waves at all gauges. */
typedef struct sb_wave_settings {
    bool present;
    double start, period; /* s: first row that is used; period of the harmonics, 0: none */
} sb_wave_settings;

typedef struct sb_measure {
    double interval; /* s between rows of forces, gauges, probes */
    size_t gauge_count;
    sb_gauge *gauges;
    size_t probe_count;
    sb_probe *probes;
    size_t plane_count;
    sb_flow_plane *planes;
    size_t runup_count;
    sb_runup_line *runups;
    size_t reflection_count;
    sb_reflection_set *reflections;
    sb_map map;
    sb_wave_settings waves;
} sb_measure_settings;

#endif
