#include "sim/exchange/sums.h"

#include "sim/exchange/exchange.h"

#include <math.h>

void sb_sums_merge(sb_exact *total, const sb_exact *own, size_t count)
{
#pragma omp critical(sb_sums)
    for (size_t k = 0; k < count; k++) sb_exact_merge(&total[k], &own[k]);
}

/* Adds the sums over the own groups, and returns the largest value. */
static double sum_own(sb_sim *sim, size_t count, sb_group_terms *of, sb_exact sum[SB_SUMS_MAX])
{
    const size_t groups = sim->groups.count;
    double largest = -(double)INFINITY;
#pragma omp parallel
    {
        sb_exact own[SB_SUMS_MAX] = {0};
        double most = -(double)INFINITY; /* a reduction may begin with the least finite value */
#pragma omp for schedule(static) nowait
        for (size_t g = 0; g < groups; g++) {
            double terms[SB_SUMS_MAX] = {0};
            const double found = of(sim, &sim->groups.group[g], terms);
            most = found > most ? found : most;
            for (size_t k = 0; k < count; k++) sb_exact_add(&own[k], terms[k]);
        }
        sb_sums_merge(sum, own, count);
#pragma omp critical(sb_sums_largest)
        largest = most > largest ? most : largest;
    }
    return largest;
}

double sb_sum_groups(sb_sim *sim, size_t count, sb_group_terms *of, double *total)
{
    sb_exact sum[SB_SUMS_MAX] = {0};
    const double own = sum_own(sim, count, of, sum);
    const double largest = sim->exchange->sum_and_largest(sim, sum, count, own);
    for (size_t k = 0; k < count; k++) total[k] = sb_exact_value(&sum[k]);
    return largest;
}

void sb_sum_groups_begin(sb_sim *sim, size_t count, sb_group_terms *of)
{
    sb_exact sum[SB_SUMS_MAX] = {0};
    const double own = sum_own(sim, count, of, sum);
    sim->exchange->sum_begin(sim, sum, count, own);
}

double sb_sum_groups_end(sb_sim *sim, size_t count, double *total)
{
    sb_exact sum[SB_SUMS_MAX] = {0};
    const double largest = sim->exchange->sum_end(sim, sum);
    for (size_t k = 0; k < count; k++) total[k] = sb_exact_value(&sum[k]);
    return largest;
}
