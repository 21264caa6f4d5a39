/* The water of an exact solitary wave: a table over x and height, from the conformal map of its surface. */
#include "physics/waves/solitary_exact.h"
#include "base/memory.h"
#include "physics/waves/solitary_surface.h"

#include <math.h>
#include <stdbool.h>

enum { COLUMNS = 512, ROWS = 24, ROUNDS = 50 };

/* u - iw at a place, where z = x + iy, and its derivatives in z. */
typedef struct node {
    double complex flow, first, second;
} node;

/* The half ahead of the crest. Lengths are in depths and speeds in sqrt(g h). */
struct sb_solitary_exact {
    double depth, gravity, celerity, volume, pitch;
    double elevation[COLUMNS + 1], slope[COLUMNS + 1];
    node water[COLUMNS + 1][ROWS + 1]; /* from the bed to the surface */
};

/* The Z that is mapped on a place, by Newton's method from a near one; the map there. Returns whether it is found. */
static bool find_place(const sb_solitary_surface *surface, double complex wanted, double complex *at,
                       double complex z[4])
{
    static const double enough = 1e-13;
    for (int round = 0; round < ROUNDS; round++) {
        sb_solitary_surface_map(surface, *at, z);
        const double complex off = wanted - z[0];
        if (cabs(off) < enough * (1 + cabs(wanted))) return true;
        *at += off / z[1];
    }
    return false;
}

/* The surface at x: only the real part of Z is sought. */
static bool find_surface(const sb_solitary_surface *surface, double x, double *at, double complex z[4])
{
    static const double enough = 1e-13;
    for (int round = 0; round < ROUNDS; round++) {
        sb_solitary_surface_map(surface, *at + CMPLX(0, 1), z);
        const double off = x - creal(z[0]);
        if (fabs(off) < enough * (1 + x)) return true;
        *at += off / creal(z[1]);
    }
    return false;
}

/* The flow is dW/dz = -c/z' where the wave is at rest. */
static node flow_at(double celerity, const double complex z[4])
{
    const double complex cube = z[1] * z[1] * z[1];
    return (node){celerity * (1 - 1 / z[1]), celerity * z[2] / cube,
                  celerity * (z[3] * z[1] - 3 * z[2] * z[2]) / (cube * z[1] * z[1])};
}

static bool fill_column(sb_solitary_exact *wave, const sb_solitary_surface *surface, size_t column, double *along)
{
    const double x = wave->pitch * (double)column;
    double complex z[4];
    if (!find_surface(surface, x, along, z)) return false;
    wave->elevation[column] = cimag(z[0]) - 1;
    wave->slope[column] = cimag(z[1]) / creal(z[1]);
    double complex at = *along + CMPLX(0, 1);
    for (size_t row = ROWS + 1; row-- > 0;) {
        const double y = (1 + wave->elevation[column]) * (double)row / ROWS;
        if (!find_place(surface, CMPLX(x, y), &at, z)) return false;
        wave->water[column][row] = flow_at(wave->celerity, z);
    }
    return true;
}

static sb_status fill(sb_solitary_exact *wave, double height, const sb_solitary_surface *surface, sb_error *error)
{
    double along = 0;
    wave->celerity = surface->celerity;
    wave->volume = surface->volume;
    wave->pitch = surface->length * surface->stretch / COLUMNS;
    for (size_t column = 0; column <= COLUMNS; column++)
        if (!fill_column(wave, surface, column, &along))
            return sb_fail(error, SB_FAILED, "exact solitary wave of %g m on %g m: no place of the water at %g m",
                           height, wave->depth, wave->pitch * (double)column * wave->depth);
    return SB_OK;
}

sb_status sb_solitary_exact_create(double height, double depth, double gravity, sb_solitary_exact **wave,
                                   sb_error *error)
{
    const double lowest = SB_SOLITARY_EXACT_LOWEST * depth, highest = SB_SOLITARY_EXACT_HIGHEST * depth;
    if (!(height >= lowest * (1 - 1e-9) && height <= highest * (1 + 1e-9)))
        return sb_fail(error, SB_BAD_INPUT, "exact solitary wave of %g m on %g m, expected a height from %g to %g m",
                       height, depth, lowest, highest);
    sb_solitary_surface *surface = sb_alloc(1, sizeof *surface);
    sb_solitary_exact *made = sb_alloc(1, sizeof *made);
    const int found = surface && made ? sb_solitary_surface_find(height / depth, surface) : -1;
    sb_status status = SB_OK;
    if (found < 0)
        status = sb_fail_memory(error, "exact solitary wave");
    else if (found > 0)
        status = sb_fail(error, SB_FAILED, "exact solitary wave of %g m on %g m: not found", height, depth);
    if (status == SB_OK) {
        made->depth = depth;
        made->gravity = gravity;
        status = fill(made, height, surface, error);
    }
    sb_free(surface);
    if (status == SB_OK)
        *wave = made;
    else
        sb_free(made);
    return status;
}

void sb_solitary_exact_destroy(sb_solitary_exact *wave)
{
    sb_free(wave);
}

double sb_solitary_exact_celerity(const sb_solitary_exact *wave)
{
    return wave->celerity * sqrt(wave->gravity * wave->depth);
}

double sb_solitary_exact_volume(const sb_solitary_exact *wave)
{
    return wave->volume * wave->depth * wave->depth;
}

/* Cubic through two values with their derivatives over the distance between them. */
static double complex cubic(double complex a, double complex a1, double complex b, double complex b1, double t)
{
    const double s = 1 - t;
    return s * s * ((1 + 2 * t) * a + t * a1) + t * t * ((1 + 2 * s) * b - s * b1);
}

/* Column and fraction of a distance from the crest in depths; false: beyond the table, where water is at rest. */
static bool column_of(const sb_solitary_exact *wave, double distance, size_t *column, double *part)
{
    const double at = distance / wave->pitch;
    if (!(at < COLUMNS)) return false;
    *column = (size_t)at;
    *part = at - floor(at);
    return true;
}

static double elevation_in(const sb_solitary_exact *wave, size_t k, double part)
{
    const double *eta = wave->elevation + k, *rise = wave->slope + k;
    return creal(cubic(eta[0], rise[0] * wave->pitch, eta[1], rise[1] * wave->pitch, part));
}

double sb_solitary_exact_elevation(const sb_solitary_exact *wave, double xi)
{
    size_t k;
    double part;
    return column_of(wave, fabs(xi) / wave->depth, &k, &part) ? wave->depth * elevation_in(wave, k, part) : 0;
}

/* The water of a column at a share of its depth: flow, first, and second, which is linear. */
static node water_in(const sb_solitary_exact *wave, size_t column, double share)
{
    const double at = fmin(share * ROWS, ROWS), row = fmin(floor(at), ROWS - 1), part = at - row;
    const node *a = &wave->water[column][(size_t)row], *b = a + 1;
    const double complex step = CMPLX(0, (1 + wave->elevation[column]) / ROWS);
    return (node){cubic(a->flow, step * a->first, b->flow, step * b->first, part),
                  cubic(a->first, step * a->second, b->first, step * b->second, part),
                  a->second + part * (b->second - a->second)};
}

void sb_solitary_exact_motion(const sb_solitary_exact *wave, double xi, double z, sb_wave_motion *motion)
{
    const double speed = sqrt(wave->gravity * wave->depth), sign = xi < 0 ? -1 : 1;
    size_t k;
    double part;
    *motion = (sb_wave_motion){.elevation = 0};
    if (!column_of(wave, fabs(xi) / wave->depth, &k, &part)) return;
    const double eta = elevation_in(wave, k, part);
    const double share = fmin(fmax(z / wave->depth, 0) / (1 + eta), 1);
    const node a = water_in(wave, k, share), b = water_in(wave, k + 1, share);
    /* Along x at this share of the depth, z changes by 1 + i share eta'. */
    const double complex from = wave->pitch * CMPLX(1, share * wave->slope[k]),
                         to = wave->pitch * CMPLX(1, share * wave->slope[k + 1]);
    const double complex flow = cubic(a.flow, from * a.first, b.flow, to * b.first, part);
    const double complex first = cubic(a.first, from * a.second, b.first, to * b.second, part);
    /* Behind the crest u is the same and w is opposite. */
    motion->elevation = wave->depth * eta;
    motion->u = speed * creal(flow);
    motion->w = -sign * speed * cimag(flow);
    motion->u_rate = -sign * wave->gravity * wave->celerity * creal(first);
    motion->w_rate = wave->gravity * wave->celerity * cimag(first);
}
