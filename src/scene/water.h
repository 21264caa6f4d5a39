/* The water of a scene: its properties, the sea, boxes of water, waves at the start, and the given sea beyond sides. */
#ifndef SB_SCENE_WATER_H
#define SB_SCENE_WATER_H

#include "physics/waves/regular_wave.h"
#include "physics/waves/stokes.h"
#include "physics/waves/wave_theory.h"
#include "scene/domain.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct sb_fluid_properties {
    double density;         /* kg/m^3, rest density */
    double gravity;         /* m/s^2, magnitude */
    double viscosity;       /* m^2/s, physical kinematic viscosity; 0: term is off */
    double surface_tension; /* N/m; 0: term is off */
} sb_fluid_properties;

/* The sea: all space below `level` that is connected with `seed`. */
typedef struct sb_sea {
    bool present;
    double level; /* m, still-water level */
    sb_vec3 seed; /* m, a point in the water */
} sb_sea;

typedef struct sb_fluid_box {
    sb_vec3 min, max;
    double level;     /* m, free surface of this box, <= max.z (default max.z) */
    sb_vec3 velocity; /* m/s */
} sb_fluid_box;

typedef enum sb_initial_wave_kind {
    SB_INITIAL_NONE,
    SB_INITIAL_SOLITARY,
    SB_INITIAL_STANDING,
    SB_INITIAL_REGULAR,
    SB_INITIAL_COMPONENTS
} sb_initial_wave_kind;
typedef enum sb_initial_order { SB_INITIAL_LINEAR, SB_INITIAL_SECOND, SB_INITIAL_FIFTH } sb_initial_order;

/* One linear wave of a sum. */
typedef struct sb_initial_component {
    double amplitude, wavelength; /* m */
    double phase;                 /* degrees, at `position` */
    int direction;                /* as of the wave */
} sb_initial_component;

typedef struct sb_initial_wave {
    sb_initial_wave_kind kind;
    double height;             /* m: wave height H, standing-wave amplitude, twice the largest component's amplitude */
    double depth;              /* m, still-water depth of the wave theory */
    double position;           /* m, x of the crest */
    double wavelength;         /* m, standing and regular waves only */
    double period;             /* s, of regular waves that are given by it; `wavelength` has what follows from it */
    int direction;             /* +1 towards +x, -1 towards -x */
    sb_solitary_theory theory; /* solitary wave only */
    sb_initial_order order;    /* regular waves only */
    sb_stokes stokes;          /* regular waves only: the wave */
    size_t component_count;
    sb_initial_component *components;
} sb_initial_wave;

/* initial_wave.c: elevation in m above the still level, at a distance (m) along x from the wave's position. */
double sb_initial_elevation(const sb_initial_wave *wave, double gravity, double ahead);
/* Velocities in m/s along x and upward, z above the bed of the theory. */
void sb_initial_velocity(const sb_initial_wave *wave, double gravity, double ahead, double z, double *u, double *w);
/* Upper bound of the elevation, m. */
double sb_initial_crest(const sb_initial_wave *wave);

/* Where the surface and velocity of the water at the sides of kind `sea` come from. NONE: still water. */
typedef enum sb_given_source {
    SB_GIVEN_NONE,
    SB_GIVEN_THEORY,
    SB_GIVEN_TABLE,
    SB_GIVEN_RECORD,
    SB_GIVEN_OFFSHORE /* the depth-averaged model, which is stepped together with the particles */
} sb_given_source;
typedef enum sb_given_wave { SB_GIVEN_SOLITARY, SB_GIVEN_REGULAR, SB_GIVEN_COMPONENTS } sb_given_wave;
typedef enum sb_given_side { SB_GIVEN_HERE, SB_GIVEN_STILL } sb_given_side;
typedef enum sb_given_unit { SB_UNIT_M, SB_UNIT_CM, SB_UNIT_MM, SB_UNIT_FT } sb_given_unit;

typedef struct sb_given_component {
    double amplitude, period, direction, phase; /* m, s, degrees, degrees */
} sb_given_component;

/* Theory of a given solitary wave. */
typedef enum sb_given_theory {
    SB_GIVEN_THIRD_ORDER,
    SB_GIVEN_BOUSSINESQ,
    SB_GIVEN_EXACT /* of the full equations */
} sb_given_theory;

/* The block `sea`. Values of other sources and waves are 0. */
typedef struct sb_given_sea {
    sb_given_source source;
    double level, start;   /* m, still-water level; s, time of the run at which the source has 0 s */
    sb_given_side side[4]; /* from x_min to y_max; still: its water is still, and only waves from within pass */
    /* theory */
    sb_given_wave wave;
    double depth, height, period; /* m, m, s */
    double direction;             /* degrees from +x towards +y, of travel */
    double origin[2];             /* m, where phases and times are given */
    double ramp;                  /* s in which the wave grows from nothing; 0: none */
    sb_wave_order order;          /* regular waves */
    sb_given_theory theory;       /* solitary wave */
    size_t component_count;
    sb_given_component *components;
    /* table, record */
    char *file; /* absolute path */
    sb_given_unit unit;
    double datum;            /* m, z of the table's zero */
    double zero[2];          /* m, place of the table that is (0, 0) of the scene */
    char plane[SB_NAME_MAX]; /* of the record */
} sb_given_sea;

#endif
