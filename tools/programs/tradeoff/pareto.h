/* The Pareto front of time and error. Pure functions. */
#ifndef SB_TRADEOFF_PARETO_H
#define SB_TRADEOFF_PARETO_H

#include <stdbool.h>
#include <stddef.h>

/* front[i]: no other point has a time and an error that are both at most those of point i, and one of them smaller.
   Points with a NaN are ignored and not on the front. */
void sb_pareto_front(const double *time, const double *error, size_t count, bool *front);

#endif
