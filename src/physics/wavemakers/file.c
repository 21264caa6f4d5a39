/* A paddle that follows a table of lines "t x" (s after the start, m), for example one measured in a flume. */
#include "base/memory.h"
#include "physics/wavemakers/number_rows.h"
#include "physics/wavemakers/wavemaker.h"

#include <math.h>

static const double SPEED_LIMIT = 1e9; /* m/s */

typedef struct knot {
    double t, x, slope; /* s, m above the first, m/s */
} knot;

typedef struct table {
    knot *knots;
    size_t count, capacity;
} table;

/* A table that is being read. */
typedef struct reading {
    const char *path;
    table *law;
} reading;

static void destroy(void *state)
{
    table *law = state;
    if (law) sb_free(law->knots);
    sb_free(law);
}

static sb_status add_knot(void *context, size_t line, const double *values, sb_error *error)
{
    const char *path = ((const reading *)context)->path;
    table *law = ((const reading *)context)->law;
    const knot next = {.t = values[0], .x = values[1]}, *last = law->count > 0 ? &law->knots[law->count - 1] : NULL;
    if (!last && next.t < 0)
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: time %g s is before the start, expected 0 or later", path,
                       line, next.t);
    if (last && !(next.t > last->t))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: time %g s does not follow %g s, expected increasing times",
                       path, line, next.t, last->t);
    const double speed = last ? (next.x - last->x) / (next.t - last->t) : 0;
    if (!(fabs(speed) <= SPEED_LIMIT))
        return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: a speed of %g m/s, expected below 1e9", path, line, speed);
    if (sb_grow((void **)&law->knots, &law->capacity, law->count + 1, sizeof next) != 0)
        return sb_fail_memory(error, path);
    law->knots[law->count++] = next;
    return SB_OK;
}

/* Finds the slopes of a cubic that is monotone wherever the table is (Steffen 1990, eq. 11): the slope of the parabola
   through three knots, limited by the slopes of the neighbouring chords, and 0 at a turning point. The slopes at both
   ends are 0, so that the speed has no jump there. */
static void find_slopes(table *law)
{
    knot *k = law->knots;
    double first = k[0].x;
    for (size_t i = 0; i < law->count; i++) k[i].x -= first;
    for (size_t i = 1; i + 1 < law->count; i++) {
        double before = k[i].t - k[i - 1].t, after = k[i + 1].t - k[i].t;
        double left = (k[i].x - k[i - 1].x) / before, right = (k[i + 1].x - k[i].x) / after;
        double parabola = (left * after + right * before) / (before + after);
        double bound = 2 * fmin(fabs(left), fabs(right));
        k[i].slope = left * right <= 0 ? 0 : copysign(fmin(fabs(parabola), bound), left);
    }
}

static sb_status create(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    table *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, parameters->file);
    reading of = {parameters->file, made};
    sb_status status = sb_number_rows_visit(of.path, 2, 2, "time (s) displacement (m)", add_knot, &of, error);
    if (status != SB_OK) {
        destroy(made);
        return status;
    }
    find_slopes(made);
    *state = made;
    return SB_OK;
}

static double displacement(const void *state, double t)
{
    const table *law = state;
    const knot *knots = law->knots;
    size_t low = 0, high = law->count - 1;
    if (t <= knots[low].t) return 0;
    if (t >= knots[high].t) return knots[high].x;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (knots[middle].t <= t)
            low = middle;
        else
            high = middle;
    }
    const knot *a = &knots[low], *b = &knots[high];
    double span = b->t - a->t, s = (t - a->t) / span, rest = 1 - s;
    return rest * rest * (a->x * (1 + 2 * s) + a->slope * span * s) +
           s * s * (b->x * (1 + 2 * rest) - b->slope * span * rest);
}

static double duration(const void *state)
{
    const table *law = state;
    return law->knots[law->count - 1].t;
}

const sb_wavemaker sb_wavemaker_file = {
    .name = "file",
    .summary = "paddle that follows a table of times and displacements",
    .reference = "interpolation: Steffen 1990",
    .needs = SB_WM_FILE,
    .create = create,
    .displacement = displacement,
    .duration = duration,
    .destroy = destroy,
};
