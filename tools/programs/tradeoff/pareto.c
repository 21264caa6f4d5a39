#include "pareto.h"

#include <math.h>

static bool dominates(double time, double error, double other_time, double other_error)
{
    return time <= other_time && error <= other_error && (time < other_time || error < other_error);
}

void sb_pareto_front(const double *time, const double *error, size_t count, bool *front)
{
    for (size_t i = 0; i < count; i++) {
        front[i] = !isnan(time[i]) && !isnan(error[i]);
        /* Comparisons with NaN are false: such points dominate no other. */
        for (size_t k = 0; front[i] && k < count; k++) front[i] = !dominates(time[k], error[k], time[i], error[i]);
    }
}
