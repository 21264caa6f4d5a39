/* Strips of given water: the water next to sides of kind sea, one strip per side. A particle is held while it is in a
   strip: it has the velocity and the pressure of the given water. Particles come in and leave at the strip's outer edge
   (docs/method.md, section 10). */
#ifndef SB_SIM_STRIP_H
#define SB_SIM_STRIP_H

#include "sea/sea.h"
#include "sim/simulation.h"

/* The outgoing wave where it is some seconds later, with the derivatives of its value. */
typedef struct sb_late {
    double delay, value, rate, curvature; /* s, m/s, m/s^2, m/s^3 */
} sb_late;

/* The outgoing wave inside of a strip, over a few spacings along the side. */
typedef struct sb_outgoing {
    double share;          /* volume of the water over that of its particles, at rest; 0: not known yet */
    double filtered, rate; /* m/s, m/s^2: y and y' of sb_outgoing_law */
    double curvature;      /* m/s^3, y''; of the present step only */
    double value;          /* m/s, what the wave adds to u - 2 sqrt(g h) at the strip, u inwards; likewise */
    double smooth, smooth_rate, part, part_rate; /* value by the filters that delay it to the line of a grid */
    sb_late late;                                /* at this line; of the present step only */
} sb_outgoing;

/* One side. Distances are inwards from the side and along it, from the domain's corner. */
typedef struct sb_strip_side {
    int side, axis, other;              /* axis across the side, and along it */
    int64_t edge, width;                /* quanta: position of the side, width of the strip */
    double strip;                       /* m, the same width */
    double far;                         /* m from the strip's inner edge to the line of a grid; 0: one-way, or none */
    size_t stations;                    /* where the outgoing wave is measured */
    double station_from, station_pitch; /* m, along the side, without the strips of neighbouring sides */
    sb_outgoing *station;               /* state */
    uint64_t *sums;                     /* stations * SB_STATION_SUMS, of a step */
    size_t columns;                     /* lines of cells inwards, at whose outer end particles come in */
    size_t rows;                        /* room for rows in a column */
    int *row_count;                     /* state: rows of a column; its particles are that many layers deep */
    int *still_rows;                    /* the same at rest */
    double *owed;      /* state: columns * rows, water that has come in, in particles, less particles that have */
    float *correction; /* state: columns * rows at rest, density correction; NAN: not known */
    uint64_t *left;    /* columns * rows, particles that left in this step */
} sb_strip_side;

enum { SB_STATION_SUMS = 2 };

/* A held particle in one step. */
typedef struct sb_held {
    uint32_t particle;
    float pressure;
    sb_f4 given;     /* m/s, its velocity at the step's end */
    sb_f4 predicted; /* m/s, the velocity that it would have before the pressure */
    sb_f4 push;      /* m/s^2, by the pressure */
} sb_held;

typedef struct sb_strip {
    sb_sea_source *sea;
    size_t count;
    sb_strip_side side[4];
    sb_held *held; /* of a step, in the order of the particles */
    size_t held_count, held_capacity;
    sb_offshore_jump *jumps; /* of the grid's present step */
    size_t jump_capacity;
    double solve_work, hold_work; /* per unit of mass, of a step: by the pressure, and by holding */
    sb_vec3 push;                 /* kg m/s, momentum that held particles got in a step to have their velocity */
    bool still;                   /* the water starts at rest, at the level of the scene */
    bool known;                   /* state: density corrections at rest are known */
} sb_strip;

/* The given water at a place of a side, outgoing wave included. */
typedef struct sb_given {
    double velocity[3]; /* m/s */
    double surface, bed, pressure;
} sb_given;

/* create.c: makes the strips if the scene has a side of kind sea. */
sb_status sb_strip_create(sb_sim *sim, sb_error *error);
void sb_strip_destroy(sb_sim *sim);
size_t sb_strip_bytes(const sb_sim *sim);

/* The side in whose strip a position is; NULL: in none. In a corner, the side that is nearer. */
const sb_strip_side *sb_strip_side_of(const sb_strip *strip, sb_record at);
/* Distance inwards from a side, quanta. */
static inline int64_t sb_strip_inwards(const sb_strip_side *s, sb_record at)
{
    return s->side % 2 ? s->edge - (int64_t)at[s->axis] : (int64_t)at[s->axis] - s->edge;
}

/* Distance along a side, m; 0 in 2D. Its column. */
double sb_strip_along(const sb_sim *sim, const sb_strip_side *s, sb_record at);
size_t sb_strip_column(const sb_sim *sim, const sb_strip_side *s, double along);
/* The row of a height in water between bed and surface that has this number of rows, at least 1. */
size_t sb_strip_row(double z, double bed, double surface, int rows);

/* given.c: the water at a place `inwards` (m, negative: beyond the side), `along` and z at time t. */
void sb_strip_given(const sb_sim *sim, const sb_strip_side *s, double t, double inwards, double along, double z,
                    sb_given *out);
/* What the source says at (x, y), z and time t for a side: still water where the scene says so. */
void sb_strip_source(const sb_sim *sim, const sb_strip_side *s, double t, sb_vec3 at, double bed, sb_sea_point *out);
/* Height of the ground there, m. */
double sb_strip_bed(const sb_sim *sim, const sb_strip_side *s, double inwards, double along);

/* Water over its depth: depth, m, mean velocity inwards, m/s, integrated non-hydrostatic pressure over density,
   m^3/s^2. sb_strip_total adds the outgoing wave of a place beyond the side, `later` seconds after the measurement, and
   sets the pressure to that of this wave. */
typedef struct sb_column {
    double depth, inwards, pressure;
} sb_column;
void sb_strip_total(const sb_sim *sim, const sb_strip_side *s, double later, double inwards, double along,
                    sb_column *water);

/* 1 in water that is free, falling to 0 at the strip of a neighbouring side, whose water is given and not measured. */
double sb_strip_free_part(const sb_sim *sim, const sb_strip_side *s, double along);

/* measure.c: measures the outgoing waves of all sides at the present time, and advances them by the time step. */
sb_status sb_strip_measure(sb_sim *sim, sb_error *error);

/* nest.c: distance from the strip's inner edge to the line at which the waves that leave enter the depth-averaged
   model, m; 0: there is none. */
double sb_strip_to_line(const sb_sim *sim, const sb_strip_side *s);
/* Steps the depth-averaged model, if it gives the water, to the end of the present step or beyond; two-way it
   gets the outgoing waves, which must be measured before. */
sb_status sb_strip_advance_grid(sb_sim *sim, sb_error *error);

/* Stages. inflow.c: measures, and lets particles in; what is outside of the domain leaves with the sort. */
sb_status sb_stage_inflow(sb_sim *sim, sb_error *error);
/* hold.c: lists the held particles; after the density correction. */
sb_status sb_stage_held(sb_sim *sim, sb_error *error);
/* Gives them their velocity and pressure; after the forces. */
sb_status sb_stage_hold(sb_sim *sim, sb_error *error);
/* Books what this has done to them; before they move. */
sb_status sb_stage_book(sb_sim *sim, sb_error *error);
/* Sets the pressure argument of held particles; removes their acceleration by the pressure after a product. */
void sb_strip_set_unknown(sb_sim *sim);
void sb_strip_hold_acceleration(sb_sim *sim);

/* save.c */
void sb_strip_save(const sb_sim *sim, sb_archive_out *out);
void sb_strip_load(sb_sim *sim, sb_archive_in *in);
uint64_t sb_strip_hash(const sb_sim *sim, uint64_t hash);

#endif
