/* Conjugate gradients [Hestenes & Stiefel 1952] for a symmetric five-point system with diagonal 1. */
#include "offshore/dispersion.h"
#include "offshore/flux.h"

#include <string.h>

enum { MOST_ITERATIONS = 500 };

/* Cells below which threads cost more than they save. */
enum { SMALL = 20000 };

void sb_offshore_wrap(const sb_offshore *offshore, double *values, double other)
{
    const sb_offshore_options *o = &offshore->options;
    const bool around_x = o->side[SB_OFFSHORE_X_MIN] == SB_OFFSHORE_PERIODIC;
    const bool around_y = o->side[SB_OFFSHORE_Y_MIN] == SB_OFFSHORE_PERIODIC;
    for (size_t j = 0; j < o->rows; j++) {
        double *row = values + offshore->origin + j * offshore->stride;
        row[-1] = around_x ? row[o->columns - 1] : other * row[0];
        row[o->columns] = around_x ? row[0] : other * row[o->columns - 1];
    }
    if (sb_offshore_flat(offshore)) return;
    double *first = values + offshore->origin, *last = first + (o->rows - 1) * offshore->stride;
    for (size_t i = 0; i < o->columns; i++) {
        first[(ptrdiff_t)i - (ptrdiff_t)offshore->stride] = around_y ? last[i] : other * first[i];
        last[i + offshore->stride] = around_y ? first[i] : other * last[i];
    }
}

/* product = A direction; returns direction . product. `up` is 0 with one row. */
SB_MULTIVERSION static double multiply(const double *restrict d, const double *restrict east,
                                       const double *restrict north, double *restrict product, ptrdiff_t up,
                                       size_t count)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (ptrdiff_t i = 0; i < (ptrdiff_t)count; i++) {
        const double value =
            d[i] - east[i] * d[i + 1] - east[i - 1] * d[i - 1] - north[i] * d[i + up] - north[i - up] * d[i - up];
        product[i] = value;
        sum += d[i] * value;
    }
    return sum;
}

/* Moves along the direction; returns the square of the new residual. */
SB_MULTIVERSION static double move(double *restrict unknown, double *restrict residual,
                                   const double *restrict direction, const double *restrict product, double length,
                                   size_t count)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < count; i++) {
        unknown[i] += length * direction[i];
        const double r = residual[i] - length * product[i];
        residual[i] = r;
        sum += r * r;
    }
    return sum;
}

SB_MULTIVERSION static void turn(double *restrict direction, const double *restrict residual, double share,
                                 size_t count)
{
#pragma omp simd
    for (size_t i = 0; i < count; i++) direction[i] = residual[i] + share * direction[i];
}

/* Residual less A times the unknown, which `direction` holds; returns the square of the new residual. */
SB_MULTIVERSION static double subtract(double *restrict residual, const double *restrict product, size_t count)
{
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (size_t i = 0; i < count; i++) {
        const double r = residual[i] - product[i];
        residual[i] = r;
        sum += r * r;
    }
    return sum;
}

typedef enum act { MULTIPLY, MOVE, TURN, BEGIN, SUBTRACT } act;

/* Does one act on all rows and returns the sum of its rows' results, in the order of the rows. */
static double on_rows(const sb_offshore *o, const sb_offshore_system *s, act what, double factor)
{
    const ptrdiff_t up = sb_offshore_flat(o) ? 0 : (ptrdiff_t)o->stride;
    const size_t count = o->options.columns;
#pragma omp parallel for schedule(static) if (o->cells > SMALL)
    for (size_t j = 0; j < o->options.rows; j++) {
        const size_t at = o->origin + j * o->stride;
        double *direction = s->direction + at, *product = s->product + at;
        double *unknown = s->unknown + at, *residual = s->residual + at;
        if (what == MULTIPLY)
            s->line_sum[j] = multiply(direction, s->east + at, s->north + at, product, up, count);
        else if (what == MOVE)
            s->line_sum[j] = move(unknown, residual, direction, product, factor, count);
        else if (what == TURN)
            turn(direction, residual, factor, count);
        else if (what == SUBTRACT)
            s->line_sum[j] = subtract(residual, product, count);
        else {
            s->line_sum[j] = 0;
            for (size_t i = 0; i < count; i++) s->line_sum[j] += residual[i] * residual[i];
            memcpy(direction, unknown, count * sizeof *direction);
        }
    }
    double sum = 0;
    for (size_t j = 0; what != TURN && j < o->options.rows; j++) sum += s->line_sum[j];
    return sum;
}

int sb_offshore_solve(const sb_offshore *offshore, const sb_offshore_system *system, double tolerance)
{
    const double goal = tolerance * tolerance * on_rows(offshore, system, BEGIN, 0);
    sb_offshore_wrap(offshore, system->direction, 0);
    on_rows(offshore, system, MULTIPLY, 0);
    double square = on_rows(offshore, system, SUBTRACT, 0), share = 0;
    for (int k = 0; k < MOST_ITERATIONS; k++) {
        if (square <= goal || square < 1e-280) return k;
        if (k == 0) memset(system->direction, 0, offshore->cells * sizeof *system->direction);
        on_rows(offshore, system, TURN, share);
        sb_offshore_wrap(offshore, system->direction, 0);
        const double next = on_rows(offshore, system, MOVE, square / on_rows(offshore, system, MULTIPLY, 0));
        if (!isfinite(next)) return -1;
        share = next / square;
        square = next;
    }
    return -1;
}
