/* The persistent state of a simulation: what one step leaves for the next. Together with the scene and the model it
   determines the rest of the run. */
#ifndef SB_SIM_STATE_H
#define SB_SIM_STATE_H

#include "base/archive.h"
#include "sim/needs.h"
#include "sim/sim.h"
#include "sim/state/simd.h"

/* Progress of settling between two of its steps. */
typedef struct sb_settle {
    bool under_way;
    int done, most; /* steps */
    int calm;       /* calm steps in a row */
    double speed;   /* m/s, highest speed after the last step done; each step sets it, so that no checkpoint has it */
    double kinetic; /* J, at the last trial; INFINITY: no trial yet */
} sb_settle;

typedef struct sb_state {
    uint64_t step;          /* steps of the run done */
    double time, time_step; /* s: present time, and the last time step; 0 where no step has been done */
    double max_speed;       /* m/s */
    int sweeps;             /* iterations of the last solve; 0: no step before */

    /* Particle fields, one row of sb_state_fields each. Entries: n owned particles; those from which neighbours read
       have ghosts after them. */
    size_t n;
    size_t owned, capacity;    /* entries allocated: without ghosts, and with them */
    sb_record *position;       /* last lane: argument of the pressure operator, which is no part of the state */
    sb_f4 *velocity;           /* last lane: pressure in Pa, with which the next solve starts */
    uint32_t *id;              /* a particle keeps its number, and no number is used twice */
    float *excess;             /* kg/m^3, density above the rest density, of wcsph; NULL: steps are implicit */
    sb_f4 *step_begin;         /* velocity and, last lane, excess at the step's start, of wcsph; NULL: not needed */
    float *density_correction; /* c_i (sim/terms/density_correction.h); NULL: off; NAN: not known yet */
    sb_f4 *steady_stress;      /* means over the last time (sim/terms/steady_stress.h): yy, xy, xz, yz; NULL: off */
    float *steady_stress_xx, *steady_unknown; /* xx, and q */
    sb_f4 *start_velocity;                    /* of t = 0; NULL after settling, and where all are 0 */

    sb_settle settle;
    sb_body_impulse *impulse; /* per body */
    sb_ledger ledger;
    uint32_t next_id;           /* of the next particle that comes in */
    sb_crossing crossing;       /* through sides of kind sea */
    uint64_t left_domain, lost; /* particles that left through open sides, and that passed a wall side */
    sb_departures departures;
} sb_state;

/* A particle field. It is allocated, sorted, saved and freed by its row. */
typedef struct sb_state_field {
    const char *name, *unit;
    size_t pointer; /* offset in sb_state */
    size_t size;    /* bytes of an entry: 4 or 16 */
    bool ghosts;    /* whether neighbours read it, so that ghosts have it too */
    size_t needed;  /* flag of sb_needs, or SB_ALWAYS */
    bool apart;     /* not saved with the others (sim/wcsph/save.c) */
} sb_state_field;

/* Ends with a row without name. */
extern const sb_state_field sb_state_fields[];

static inline void *sb_state_entries(const sb_state *state, const sb_state_field *field)
{
    return *(void *const *)((const char *)state + field->pointer);
}

/* Allocates the fields that the scene needs, and the bodies' impulses. Returns 0, or -1 without memory. */
int sb_state_create(sb_state *state, const sb_needs *needs, size_t particles, size_t bodies);
/* Allocates `owned` entries, and the same number more than now with ghosts; the first `used` keep their values. Returns
   0, or -1 without memory. */
int sb_state_grow(sb_state *state, size_t used, size_t owned);
/* Allocates `capacity` entries for the fields that have ghosts; the first `used` keep their values. Returns 0, or -1
   without memory. */
int sb_state_lengthen(sb_state *state, size_t used, size_t capacity);
void sb_state_destroy(sb_state *state);
size_t sb_state_bytes(const sb_state *state);

#endif
