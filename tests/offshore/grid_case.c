#include "grid_case.h"

#include <stdlib.h>

sb_offshore *grid_create(const sb_offshore_options *options, grid_bed *bed, grid_state *state)
{
    const size_t cells = options->columns * options->rows;
    double *values = malloc(4 * cells * sizeof *values);
    assert_non_null(values);
    for (size_t k = 0; k < cells; k++) {
        const double x = options->x + ((double)(k % options->columns) + 0.5) * options->cell;
        const double y = options->y + ((double)(k / options->columns) + 0.5) * options->cell;
        const grid_water water = state(x, y, 0);
        values[k] = bed(x, y);
        values[cells + k] = water.h;
        values[2 * cells + k] = water.h * water.u;
        values[3 * cells + k] = water.h * water.v;
    }
    sb_offshore *made = NULL;
    sb_error error = {0};
    if (sb_offshore_create(options, values, values + cells, values + 2 * cells, values + 3 * cells, &made, &error) !=
        SB_OK)
        fail_msg("%s", error.text);
    free(values);
    return made;
}

void grid_run(sb_offshore *offshore, double until)
{
    sb_error error = {0};
    double time = sb_offshore_read(offshore).time, taken;
    while (time < until * (1 - 1e-14)) {
        if (sb_offshore_step(offshore, until - time, &taken, &error) != SB_OK) fail_msg("%s", error.text);
        time = sb_offshore_read(offshore).time;
    }
}

double grid_error(const sb_offshore *offshore, grid_state *exact)
{
    const sb_offshore_view v = sb_offshore_read(offshore);
    double sum = 0;
    for (size_t j = 0; j < v.rows; j++)
        for (size_t i = 0; i < v.columns; i++)
            sum += fabs(v.h[j * v.stride + i] -
                        exact(v.x + ((double)i + 0.5) * v.cell, v.y + ((double)j + 0.5) * v.cell, v.time).h);
    return sum / (double)(v.rows * v.columns);
}

double grid_fastest(const sb_offshore *offshore)
{
    const sb_offshore_view v = sb_offshore_read(offshore);
    double greatest = 0;
    for (size_t j = 0; j < v.rows; j++)
        for (size_t i = 0; i < v.columns; i++) {
            const size_t at = j * v.stride + i;
            if (v.h[at] > v.dry_depth) greatest = fmax(greatest, fmax(fabs(v.hu[at]), fabs(v.hv[at])) / v.h[at]);
        }
    return greatest;
}

double grid_imbalance(const sb_offshore *offshore)
{
    const sb_offshore_balance b = sb_offshore_find_balance(offshore);
    double expected = b.first + b.added + b.repaired;
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) expected += b.entered[s];
    return fabs(b.now - expected) / b.first;
}
