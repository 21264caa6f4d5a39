/* Surface and velocities of a level, and the speed of its fastest waves. */
#include "offshore/flux.h"
#include "offshore/state.h"

typedef struct line {
    const double *bed, *h, *hu, *hv;
    double *surface, *u, *v;
    double gravity, dry; /* dry: square of the dry depth */
} line;

/* The velocity 2 h q / (h^2 + max(h^2, dry^2)) is q / h in water deeper than dry_depth, and goes to 0 with the depth
   [Kurganov & Petrova 2007, with powers of two instead of four]. Returns the greatest |u| + c + (|v| + c in two
   dimensions), NaN if a value is NaN. */
SB_MULTIVERSION static double find_line(line l, size_t count, bool flat)
{
    const double both = flat ? 0 : 1;
    double greatest = 0, total = 0;
#pragma omp simd reduction(max : greatest) reduction(+ : total)
    for (size_t i = 0; i < count; i++) {
        const double h = l.h[i], square = h * h;
        const double factor = 2 * h / (square + most(square, l.dry));
        const double u = factor * l.hu[i], v = factor * l.hv[i];
        const double c = sqrt(l.gravity * h);
        const double speed = fabs(u) + c + both * (fabs(v) + c);
        l.surface[i] = h + l.bed[i];
        l.u[i] = u;
        l.v[i] = v;
        greatest = speed > greatest ? speed : greatest;
        total += speed;
    }
    return isfinite(total) ? greatest : (double)NAN;
}

void sb_offshore_find_primitives(sb_offshore *offshore, const sb_offshore_level *level)
{
    const double dry = offshore->options.dry_depth * offshore->options.dry_depth;
    const bool flat = sb_offshore_flat(offshore);
#pragma omp parallel for schedule(static) if (offshore->cells > 20000)
    for (size_t j = 0; j < offshore->lines; j++) {
        const size_t at = j * offshore->stride;
        const line l = {offshore->bed + at,
                        level->h + at,
                        level->hu + at,
                        level->hv + at,
                        offshore->surface + at,
                        offshore->u + at,
                        offshore->v + at,
                        offshore->options.gravity,
                        dry};
        offshore->line_speed[j] = find_line(l, offshore->stride, flat) / offshore->options.cell;
    }
}
