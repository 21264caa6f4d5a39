/* The energy ledger: itemises the change of the water's mechanical energy in each step, and checks the momentum balance
   (docs/method.md, section 11). It only sums; it does not change the run. */
#ifndef SB_SIM_LEDGER_H
#define SB_SIM_LEDGER_H

#include "sim/state.h"

#include <math.h>

/* Partial sums over one block's particles in one step, per unit of mass. v is the velocity at the step's start, after
   the stress correction; v* that before the pressure; w that at the step's end. With u = (v + w)/2 a change d of the
   velocity does the work d.u. */
typedef struct sb_ledger_sums {
    double forces;         /* (v* - v).u: gravity, viscosity, friction */
    double solve;          /* (w - v*).u: pressure and contact */
    double fall;           /* z component of u, m/s */
    double rise;           /* change of z in the step, quanta */
    double gain[3], size;  /* w - v, and |w - v| */
    double friction;       /* part of the forces, over dt */
    double contact;        /* part of the solve */
    double contact_bodies; /* work of moving bodies by contact */
} sb_ledger_sums;

/* d.u in double precision; d is the difference of two velocities of one particle. */
SB_INLINE double sb_ledger_work(sb_f4 from, sb_f4 to, sb_f4 start, sb_f4 end)
{
    double work = 0;
    for (int axis = 0; axis < 3; axis++)
        work += ((double)to[axis] - (double)from[axis]) * 0.5 * ((double)start[axis] + (double)end[axis]);
    return work;
}

/* Running sums of one block, filled in the loop that moves its particles: a separate pass would cost twice as much. */
typedef double sb_d4 __attribute__((vector_size(32)));
typedef struct sb_ledger_tally {
    sb_d4 forces, solve, start, end; /* twice (v* - v) u, twice (w - v*) u, v, w, by axis; last lanes meaningless */
    double size;
    int64_t rise;
} sb_ledger_tally;

SB_INLINE void sb_ledger_add(sb_ledger_tally *t, sb_f4 start, sb_f4 predicted, sb_f4 end, int64_t rise)
{
    const sb_d4 v = __builtin_convertvector(start, sb_d4), w = __builtin_convertvector(end, sb_d4);
    const sb_d4 star = __builtin_convertvector(predicted, sb_d4), both = v + w;
    const sb_f4 change = end - start;
    t->forces += (star - v) * both;
    t->solve += (w - star) * both;
    t->start += v;
    t->end += w;
    t->size += (double)sqrtf(sb_sum3(change * change));
    t->rise += rise;
}

SB_INLINE void sb_ledger_store(const sb_ledger_tally *t, sb_ledger_sums *sums)
{
    sums->forces = 0.5 * (t->forces[0] + t->forces[1] + t->forces[2]);
    sums->solve = 0.5 * (t->solve[0] + t->solve[1] + t->solve[2]);
    sums->fall = 0.5 * (t->start[2] + t->end[2]);
    sums->rise = (double)t->rise;
    for (int axis = 0; axis < 3; axis++) sums->gain[axis] = t->end[axis] - t->start[axis];
    sums->size = t->size;
}

/* Ends the step: computes sim->ledger and the report's momentum balance from the blocks' sums and the body forces. */
void sb_ledger_close(sb_sim *sim);

/* Enters the energy of particles [first, end), which leave the domain. */
void sb_ledger_leave(sb_sim *sim, size_t first, size_t end);

#endif
