#include "measure/patch_region.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>

/* Points per radius; steps of the iteration, each of which halves the error or better; parts of a cell at the border.
 */
enum { PER_RADIUS = 8, ITERATIONS = 14, PARTS = 4 };

/* w(r) as a function of the squared distance in radii. */
static double bell(double q2)
{
    return q2 < 1 ? (1 - q2) * (1 - q2) : 0;
}

static size_t width_of(const sb_patch_region *r)
{
    return (size_t)(2 * r->half + 1);
}

static size_t index_of(const sb_patch_region *r, int i, int j)
{
    return (size_t)(j + r->rows) * width_of(r) + (size_t)(i + r->half);
}

static sb_vec3 point(const sb_patch_region *r, double i, double j)
{
    return sb_madd(sb_madd(r->center, i * r->cell, r->u), j * r->cell, r->v);
}

typedef struct face {
    sb_on_face *on;
    const void *context;
} face;

/* The part of the cell around point (i, j) that is on the face. */
static double share_of(const sb_patch_region *r, const face *f, int i, int j)
{
    const bool flat = r->rows == 0, middle = f->on(f->context, point(r, i, j));
    const int rows = flat ? 1 : PARTS;
    int inside = 0;
    bool same = true;
    for (int corner = 0; corner < 4 && same; corner++)
        same = middle ==
               f->on(f->context, point(r, i + (corner % 2 ? 0.5 : -0.5), flat ? 0 : j + (corner / 2 ? 0.5 : -0.5)));
    if (same) return middle;
    for (int b = 0; b < rows; b++)
        for (int a = 0; a < PARTS; a++)
            inside += f->on(f->context, point(r, i + (a + 0.5) / PARTS - 0.5, flat ? 0 : j + (b + 0.5) / PARTS - 0.5));
    return (double)inside / (PARTS * rows);
}

/* The integral of w(|x - c|) / a(x) over the face, for c at point (i, j). Beyond the square the face is endless, with
   the a of an endless face. */
static double integral(const sb_patch_region *r, int i, int j, double endless)
{
    const int reach = r->rows > 0 ? PER_RADIUS : 0;
    double sum = 0;
    for (int y = j - reach; y <= j + reach; y++)
        for (int x = i - PER_RADIUS; x <= i + PER_RADIUS; x++) {
            const double dx = (double)(x - i) / PER_RADIUS, dy = (double)(y - j) / PER_RADIUS,
                         w = bell(dx * dx + dy * dy);
            const bool known = abs(x) <= r->half && abs(y) <= r->rows;
            if (w > 0) sum += known ? w * r->share[index_of(r, x, y)] / r->norm[index_of(r, x, y)] : w / endless;
        }
    return sum * (r->rows > 0 ? r->cell * r->cell : r->cell);
}

/* Finds a with a(c) = integral of w / a, by the geometric mean of a and that integral, which converges monotonously. */
static void balance(sb_patch_region *r, double *next)
{
    double endless = 0;
    const int reach = r->rows > 0 ? PER_RADIUS : 0;
    for (int y = -reach; y <= reach; y++)
        for (int x = -PER_RADIUS; x <= PER_RADIUS; x++)
            endless +=
                bell((double)(x * x + y * y) / (PER_RADIUS * PER_RADIUS)) * (r->rows > 0 ? r->cell * r->cell : r->cell);
    endless = sqrt(endless);
    const size_t count = width_of(r) * (size_t)(2 * r->rows + 1);
    for (size_t k = 0; k < count; k++) r->norm[k] = endless;
    bool whole = true;
    for (size_t k = 0; k < count; k++) whole &= r->share[k] == 1;
    for (int step = 0; step < ITERATIONS && !whole; step++) {
        for (int j = -r->rows; j <= r->rows; j++)
            for (int i = -r->half; i <= r->half; i++) {
                const size_t k = index_of(r, i, j);
                const double sum = integral(r, i, j, endless); /* also beside the face, for the interpolation */
                next[k] = sum > 0 ? sqrt(r->norm[k] * sum) : endless;
            }
        for (size_t k = 0; k < count; k++) r->norm[k] = next[k];
    }
}

/* The point of the lattice on the face that is nearest to (x, y), in cells. False: there is none. */
static bool nearest_inside(const sb_patch_region *r, double x, double y, int *i, int *j)
{
    double best = (double)INFINITY;
    for (int b = -r->rows; b <= r->rows; b++)
        for (int a = -r->half; a <= r->half; a++) {
            const double away = (a - x) * (a - x) + (b - y) * (b - y);
            if (away >= best || r->share[index_of(r, a, b)] == 0) continue;
            best = away;
            *i = a;
            *j = b;
        }
    return isfinite(best);
}

sb_status sb_patch_region_make(sb_patch_region *region, sb_vec3 center, sb_vec3 normal, double radius, bool flat,
                               sb_on_face *on_face, const void *context, sb_error *error)
{
    sb_patch_region made = {.half = (int)(SB_PATCH_REGION * PER_RADIUS), .cell = radius / PER_RADIUS, .radius = radius};
    made.rows = flat ? 0 : made.half;
    made.center = center;
    made.u = fabs(normal.y) < 0.9 ? sb_normalize(sb_cross(sb_vec(0, 1, 0), normal)) : sb_vec(1, 0, 0);
    made.v = sb_cross(normal, made.u);
    const size_t count = width_of(&made) * (size_t)(2 * made.rows + 1);
    made.share = sb_alloc(count, sizeof *made.share);
    made.norm = sb_alloc(count, sizeof *made.norm);
    double *next = sb_alloc(count, sizeof *next);
    if (!made.share || !made.norm || !next) {
        sb_free(next);
        sb_patch_region_free(&made);
        return sb_fail_memory(error, "the wall around a probe");
    }
    const face f = {on_face, context};
    for (int j = -made.rows; j <= made.rows; j++)
        for (int i = -made.half; i <= made.half; i++) made.share[index_of(&made, i, j)] = share_of(&made, &f, i, j);
    balance(&made, next);
    sb_free(next);
    int i = 0, j = 0;
    made.off = (double)INFINITY;
    if (nearest_inside(&made, 0, 0, &i, &j)) {
        made.at_center = made.norm[index_of(&made, i, j)];
        made.off = made.cell * hypot(i, j);
    }
    *region = made;
    return SB_OK;
}

size_t sb_patch_region_bytes(const sb_patch_region *region)
{
    const size_t points = region->share ? width_of(region) * (size_t)(2 * region->rows + 1) : 0;
    return points * (sizeof *region->share + sizeof *region->norm);
}

void sb_patch_region_free(sb_patch_region *region)
{
    sb_free(region->share);
    sb_free(region->norm);
    *region = (sb_patch_region){0};
}

/* a at (x, y), in cells within the square. */
static double norm_at(const sb_patch_region *r, double x, double y)
{
    const int i = (int)fmin(fmax(floor(x), -r->half), r->half - 1);
    const int j = r->rows > 0 ? (int)fmin(fmax(floor(y), -r->rows), r->rows - 1) : 0, above = r->rows > 0;
    const double u = x - i, v = y - j;
    const double *low = &r->norm[index_of(r, i, j)], *high = &r->norm[index_of(r, i, j + above)];
    return (1 - v) * ((1 - u) * low[0] + u * low[1]) + v * ((1 - u) * high[0] + u * high[1]);
}

double sb_patch_region_weight(const sb_patch_region *r, sb_vec3 at)
{
    const sb_vec3 way = sb_sub(at, r->center);
    double x = sb_dot(way, r->u) / r->cell, y = r->rows > 0 ? sb_dot(way, r->v) / r->cell : 0;
    int i = (int)lround(x), j = (int)lround(y);
    if (abs(i) > r->half || abs(j) > r->rows) return 0;
    if (r->share[index_of(r, i, j)] == 0) {
        if (!nearest_inside(r, x, y, &i, &j)) return 0;
        x = i;
        y = j;
    }
    const double w = bell((x * x + y * y) / (PER_RADIUS * PER_RADIUS));
    return w > 0 ? w / (norm_at(r, x, y) * r->at_center) : 0;
}
