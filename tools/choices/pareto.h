/* Which choices no other one beats. Pure. */
#ifndef SB_CHOICES_PARETO_H
#define SB_CHOICES_PARETO_H

#include <stdbool.h>
#include <stddef.h>

/* front[i]: no other point has a time and an error both at most this one's and one of them less.
   A point with a NaN is on no front and beats nobody. */
void sb_pareto_front(const double *time, const double *error, size_t count, bool *front);

#endif
