/* The energy ledger: itemises the change of the water's mechanical energy in each step, and checks the momentum balance
   (docs/method.md, section 11). It only sums; it does not change the run. */
#ifndef SB_SIM_LEDGER_H
#define SB_SIM_LEDGER_H

#include "sim/simulation.h"

#include <math.h>

/* d.u in double precision; d is the difference of two velocities of one particle. */
SB_INLINE double sb_ledger_work(sb_f4 from, sb_f4 to, sb_f4 start, sb_f4 end)
{
    double work = 0;
    for (int axis = 0; axis < 3; axis++)
        work += ((double)to[axis] - (double)from[axis]) * 0.5 * ((double)start[axis] + (double)end[axis]);
    return work;
}

/* The velocity at the step's start. That of the state is the same but in the second half of an explicit step, where it
   is that of the middle. */
SB_INLINE sb_f4 sb_ledger_start(const sb_sim *sim, size_t i)
{
    return sim->state.step_begin ? sim->state.step_begin[i] : sim->state.velocity[i];
}

/* Running sums of one group, filled in the loop that moves its particles: a separate pass would cost twice as much. */
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

/* Terms of sb_ledger_sums that a tally has, in its order: from `forces` to `size`. */
enum { SB_TALLY_TERMS = 8 };

SB_INLINE void sb_ledger_terms(const sb_ledger_tally *t, double terms[SB_TALLY_TERMS])
{
    terms[0] = 0.5 * (t->forces[0] + t->forces[1] + t->forces[2]);
    terms[1] = 0.5 * (t->solve[0] + t->solve[1] + t->solve[2]);
    terms[2] = 0.5 * (t->start[2] + t->end[2]);
    terms[3] = (double)t->rise;
    for (int axis = 0; axis < 3; axis++) terms[4 + axis] = t->end[axis] - t->start[axis];
    terms[7] = t->size;
}

/* Ends the step: computes sim->state.ledger and the report's momentum balance from the step's sums and the body forces.
 */
void sb_ledger_close(sb_sim *sim);

/* Enters the energy of particles [first, end), which leave the domain. */
void sb_ledger_leave(sb_sim *sim, size_t first, size_t end);

/* The same for particles that leave to a given sea. */
void sb_ledger_cross(sb_sim *sim, size_t first, size_t end);

#endif
