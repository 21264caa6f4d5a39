/* The ground: a sea bed that descends from a straight shore, a dredged harbour, the terrace of the plant in the coast,
   and hills behind and beside it. */
#include "plant.h"

#include "base/memory.h"
#include "base/random.h"
#include "form.h"

#include <math.h>

/* Plan of the harbour basin and of the terrace. The levels change in steps between these lines. */
static const double basin_y[4] = {235, 250, 840, 855};   /* bank, floor ... floor, bank */
static const double terrace_y[4] = {130, 195, 905, 970}; /* hillside, flat ... flat, hillside */
static const double terrace_x[2] = {1030, 1105};         /* end of the flat part, start of the hill */

static double clamp01(double t)
{
    return t < 0 ? 0 : t > 1 ? 1 : t;
}
static double ramp(double x, double from, double to)
{
    return clamp01((x - from) / (to - from));
}
static double smooth(double x, double from, double to)
{
    double t = ramp(x, from, to);
    return t * t * (3 - 2 * t);
}
static double mix(double a, double b, double t)
{
    return a + (b - a) * t;
}

/* Value noise in [0, 1] with one knot per unit. */
static double noise(double x, double y, uint64_t seed)
{
    double fx = floor(x), fy = floor(y), tx = smooth(x - fx, 0, 1), ty = smooth(y - fy, 0, 1);
    uint64_t column = (uint64_t)(int64_t)fx, row = (uint64_t)(int64_t)fy;
    double corner[2][2];
    for (unsigned i = 0; i < 2; i++)
        for (unsigned j = 0; j < 2; j++) corner[i][j] = sb_random(seed, (column + i) * 65537u + (row + j));
    return mix(mix(corner[0][0], corner[1][0], tx), mix(corner[0][1], corner[1][1], tx), ty);
}

/* Three octaves, in [0, 1]. */
static double relief(double x, double y)
{
    return (4 * noise(x / 110, y / 110, 1) + 2 * noise(x / 52, y / 52, 2) + noise(x / 27, y / 27, 3)) / 7;
}

/* Height of the sea bed without the harbour: 38 m deep to x = 150, 14 m at 400, 6 m at 700. */
static double sea_bed(double x)
{
    static const double bed[][2] = {{150, -38}, {400, -14}, {700, -6}, {SB_PLANT_SHORE, 0}};
    if (x <= bed[0][0]) return bed[0][1];
    size_t i = 1;
    while (i < 3 && x > bed[i][0]) i++;
    return mix(bed[i - 1][1], bed[i][1], ramp(x, bed[i - 1][0], bed[i][0]));
}

/* 1 over the harbour's floor, falling to 0 along its banks. */
static double basin(double y)
{
    return ramp(y, basin_y[0], basin_y[1]) * (1 - ramp(y, basin_y[2], basin_y[3]));
}

/* The coast without the plant: a narrow beach, bluffs, and a plateau not above the hill level. */
static double coast(const sb_plant_options *options, double x, double y)
{
    double beach = 2.5 * ramp(x, SB_PLANT_SHORE, 820);
    double foot = 812 + 34 * noise(y / 70, 0.5, 4), rough = relief(x, y);
    double plateau = options->hill * (0.74 + 0.40 * rough);
    double rise = smooth(x, foot, foot + 75 + 40 * noise(y / 90, 0.5, 5));
    double height = mix(beach, plateau, rise);
    return height < options->hill ? height : options->hill;
}

/* The terrace and its seaward side: quay apron, revetment, grade. Behind the wall of the quay the ground rises steeply,
   hidden inside it. */
static double terrace(const sb_plant_options *options, double x, double y)
{
    double apron = options->quay - 0.5;
    double foot = mix(0, -options->harbour, basin(y));
    double low =
        x < 812 ? mix(foot, apron - 1, ramp(x, SB_PLANT_SHORE, 812)) : mix(apron - 1, apron, ramp(x, 812, 822));
    return mix(low, options->grade, ramp(x, 845, 857));
}

double sb_plant_ground(const sb_plant_options *options, double x, double y)
{
    if (x < SB_PLANT_SHORE) {
        double bed = sea_bed(x), dredged = mix(bed, -options->harbour, ramp(x, 700, 712));
        double height = mix(bed, dredged < bed ? dredged : bed, basin(y));
        return height;
    }
    double sway = 14 * (noise(x / 60, 0.5, 6) - 0.5), back = 30 * noise(y / 80, 0.5, 7);
    double along = smooth(y, terrace_y[0] + sway, terrace_y[1]) * (1 - smooth(y, terrace_y[2], terrace_y[3] + sway));
    double across = 1 - smooth(x, terrace_x[0], terrace_x[1] + back);
    return mix(coast(options, x, y), terrace(options, x, y), along * across);
}

/* Grid lines from breaks[0] to the last break; each gap is divided evenly into steps of at most step[i]. */
static size_t lines(const double *breaks, const double *step, size_t count, double *out)
{
    size_t n = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        double gap = breaks[i + 1] - breaks[i];
        size_t parts = (size_t)ceil(gap / step[i] - 1e-9);
        for (size_t k = 0; k < parts; k++) out[n++] = breaks[i] + gap * (double)k / (double)parts;
    }
    out[n++] = breaks[count - 1];
    return n;
}

/* Splits a grid cell along the more level diagonal, so that ridges and quay edges are straight. */
static void cell(sb_form *form, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    const sb_vec3 *v = form->mesh.vertices;
    if (fabs(v[a].z - v[c].z) <= fabs(v[b].z - v[d].z))
        sb_form_quad(form, a, b, c, d);
    else
        sb_form_quad(form, b, c, d, a);
}

sb_status sb_plant_terrain(const sb_plant_options *options, sb_mesh *mesh, sb_error *error)
{
    static const double x_break[] = {SB_PLANT_X_MIN, 150,           400, 700, 712, SB_PLANT_SHORE, 812, 822, 845, 857,
                                     1030,           SB_PLANT_X_MAX};
    static const double x_step[] = {60, 50, 50, 12, 22, 12, 10, 12, 12, 12.5, 12.5};
    static const double y_break[] = {0, 235, 250, 840, 855, SB_PLANT_Y_MAX};
    static const double y_step[] = {12.5, 15, 12.5, 15, 12.5};
    double x[128], y[128];
    size_t columns = lines(x_break, x_step, sizeof x_break / sizeof *x_break, x);
    size_t rows = lines(y_break, y_step, sizeof y_break / sizeof *y_break, y);
    sb_form form = {0};
    for (size_t i = 0; i < columns; i++)
        for (size_t j = 0; j < rows; j++)
            sb_form_vertex(&form, sb_vec(x[i], y[j], sb_plant_ground(options, x[i], y[j])));
    for (uint32_t i = 0; i + 1 < columns && !form.failed; i++)
        for (uint32_t j = 0; j + 1 < rows; j++) {
            uint32_t a = i * (uint32_t)rows + j, b = a + (uint32_t)rows;
            cell(&form, a, b, b + 1, a + 1);
        }
    return sb_form_finish(&form, "terrain", mesh, error);
}
