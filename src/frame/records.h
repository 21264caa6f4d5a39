/* The measurements of a run as plain records: src/measure makes them, src/output writes them. */
#ifndef SB_FRAME_RECORDS_H
#define SB_FRAME_RECORDS_H

#include "base/vec.h"
#include "frame/energy.h"
#include "scene/record_columns.h"

#include <stdbool.h>
#include <stddef.h>

/* Means over the interval that ends at `time`; N and Nm (per metre of width in 2D). */
typedef struct sb_force_record {
    size_t body;                               /* index into the model's bodies */
    double time;                               /* s, a multiple of the interval */
    sb_vec3 force, moment, pressure, friction; /* force = pressure + friction */
} sb_force_record;

/* The mean force of the water's pressure on a face of a body over the last interval. */
typedef struct sb_face_load {
    size_t body;    /* index into the model's bodies */
    sb_vec3 normal; /* unit, towards the water */
    double area;    /* m^2, with the dry part */
    sb_vec3 force;  /* N */
} sb_face_load;

/* The free surface at that instant; NaN when dry. */
typedef struct sb_gauge_record {
    size_t gauge;
    double time, eta, z; /* s; m above the still-water level (NaN in a scene without one); m, absolute */
} sb_gauge_record;

/* All NaN when dry. */
typedef struct sb_probe_record {
    size_t probe;
    double time;      /* s */
    sb_vec3 velocity; /* m/s */
    double pressure;  /* Pa */
} sb_probe_record;

/* Net volume through a plane since the start, and the mean flux over the interval. */
typedef struct sb_flow_record {
    size_t plane;
    double time, volume, flux; /* s, m^3, m^3/s (m^2, m^2/s in 2D) */
} sb_flow_record;

/* The run-up along a line: the highest point and the front of the water that is connected with the water at the line's
   first end. See runup.c. */
typedef struct sb_runup_record {
    size_t line;
    double time;   /* s */
    sb_vec3 place; /* m; z is the top of the water; NaN when there is no such water */
    double front;  /* m from the first end, 0 to the line's length; NaN when there is no water at all */
    double apart;  /* m of the line that only unconnected water covers: puddles, thin films, drops */
} sb_runup_record;

/* The waves of one period at a set of gauges in one window. NaN: the gauges do not determine them. */
typedef struct sb_reflection_record {
    size_t set, harmonic;                   /* harmonic: 1 for the set's period, 2 for half of it, ... */
    double from, time;                      /* s, the window */
    double period, wavelength;              /* s, m */
    double incident, reflected;             /* m, amplitudes */
    double misfit, separation;              /* m, and a number from 0 to 1: see physics/reflection.h */
    double bound_incident, bound_reflected; /* m, amplitudes; NaN also where no bound waves are fitted */
} sb_reflection_record;

/* The water at a point of a recorded plane. */
typedef struct sb_water_record {
    size_t plane;
    double time, x, y, surface, bed; /* s, m; surface: z, NaN when dry; bed: z */
    sb_vec3
        velocity[SB_RECORD_LAYERS]; /* m/s, in the middles of equal layers from the bed upwards; NaN: no particles */
} sb_water_record;

/* At the end of the first step that passed a multiple of the interval. */
typedef struct sb_energy_record {
    double time, kinetic, potential, mass; /* s, J, J, kg */
    sb_vec3 momentum;                      /* kg m/s */
    sb_ledger ledger;                      /* J since the start */
    double momentum_imbalance;             /* largest value of any step since the last row */
} sb_energy_record;

/* A paddle that absorbs, at the end of the first step that passed a multiple of the interval. */
typedef struct sb_absorber_record {
    size_t body;               /* index into the model's bodies */
    double time;               /* s */
    double offset, drift, law; /* m, as in sb_absorption */
} sb_absorber_record;

/* All records of the last step; the arrays are valid until the next one. */
typedef struct sb_measure_records {
    size_t force_count, gauge_count, probe_count, flow_count, runup_count, energy_count;
    const sb_force_record *forces;
    const sb_gauge_record *gauges;
    const sb_probe_record *probes;
    const sb_flow_record *flows;
    const sb_runup_record *runups;
    const sb_energy_record *energies;
    size_t reflection_count;
    const sb_reflection_record *reflections;
    size_t water_count;
    const sb_water_record *waters;
    size_t absorber_count;
    const sb_absorber_record *absorbers;
} sb_measure_records;

/* Totals of one body over the whole run. */
typedef struct sb_body_record {
    bool report;
    double peak, peak_time;  /* N, s: greatest |F| among interval means, and that interval's end */
    sb_vec3 impulse, moment; /* N s, N m s over the finished intervals: rows of force times interval */
    sb_vec3 force, torque;   /* N, Nm: means of the last finished interval */
    double layers;           /* depth of the flow towards its faces in spacings; NaN: not assessed */
} sb_body_record;

/* Depth of the flow towards a body in spacings below which its force is flagged as unreliable. */
#define SB_LAYERS_TRUSTED 4.0

/* Greatest values on a horizontal grid, row 0 at y_min. NaN: never wet (arrival: never arrived). */
typedef struct sb_map_record {
    size_t columns, rows;
    double x_min, y_min, cell; /* m */
    const float *depth;        /* m */
    const float *speed;        /* m/s, of the depth-averaged horizontal velocity */
    const float *flux;         /* m^3/s^2, depth times mean square of the horizontal speed */
    const float
        *arrival; /* s, when the depth at the start, or later the rise above it, was first at least the threshold */
    const float *duration; /* s of inundation of cells that were dry at the start; NULL: not recorded */
    const float *ground; /* m, z of the ground in the middle of the cell, NaN where a body stands on it, or water stood
                            at the start; NULL: not recorded */
} sb_map_record;

#endif
