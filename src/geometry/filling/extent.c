/* How far the water of a column reaches. A column whose centre is free counts as water in its whole width elsewhere,
   and one whose centre is in a body as none. Along a wall that stands between two rows of columns that would be up to
   half a column too much or too little water, which runs off as a wave when the water comes to rest
   (docs/decisions/0080). */
#include "geometry/filling/parts.h"

/* A distance that differs from half a column by less, in columns, is half a column: the wall stands where two columns
   meet. */
static const double same_place = 1e-9;

/* Mean over the layers of a run of the distance from the column's axis to a surface, at most `limit`; half of a
   column's width `step` if no surface is so near. */
static double reach(const sb_columns *c, int64_t i, int64_t j, const sb_run *run, sb_vec3 direction, double step,
                    double limit)
{
    const int32_t count = run->count > 0 ? run->count : 1;
    double sum = 0;
    bool found = false;
    for (int32_t k = 0; k < count; ++k) {
        sb_vec3 from = sb_columns_center(c, i, j, run->first + k);
        if (run->count == 0) from.z = 0.5 * (run->low + run->high);
        double nearest = limit;
        for (size_t s = 0; s < c->solid_count; ++s) {
            const double hit = sb_solid_raycast(c->solids[s].solid, from, direction, nearest);
            if (!(hit > 0)) continue;
            nearest = hit;
            found = true;
        }
        sum += nearest;
    }
    const double mean = sum / count;
    return found && fabs(mean - 0.5 * step) > same_place * step ? mean : 0.5 * step;
}

/* Whether water of this run goes on in the next column. *edge: there is none. */
static bool goes_on(const sb_columns *c, int64_t i, int64_t j, const sb_run *run, int side, bool *edge)
{
    const bool ahead = side % 2, along_x = side < 2;
    const int64_t move = ahead ? 1 : -1, x = along_x ? i + move : i, y = along_x ? j : j + move;
    *edge = x < 0 || y < 0 || x >= c->nx || y >= c->ny;
    if (*edge) return false;
    const uint8_t bit = along_x ? SB_CELL_BLOCK_X : SB_CELL_BLOCK_Y;
    const size_t next = (size_t)(y * c->nx + x);
    for (size_t r = c->begin[next]; r < c->begin[next + 1]; ++r) {
        const sb_run *other = c->runs + r;
        if (other->wet && (ahead ? sb_columns_joined(c, run, other, bit) : sb_columns_joined(c, other, run, bit)))
            return true;
    }
    return false;
}

sb_run_extent sb_columns_extent(const sb_columns *c, int64_t i, int64_t j, const sb_run *run)
{
    static const sb_vec3 out[4] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}};
    const int sides = c->ny > 1 ? 4 : 2;
    sb_run_extent extent = {.part = 1};
    for (int s = 0; s < sides && c->sea; ++s) {
        bool edge;
        if (goes_on(c, i, j, run, s, &edge)) continue;
        const double step = s < 2 ? c->dx : c->dy, limit = edge ? 0.5 * step : step;
        const double excess = reach(c, i, j, run, out[s], step, limit) - 0.5 * step;
        extent.part += excess / step;
        extent.shift = sb_madd(extent.shift, 0.5 * excess, out[s]);
    }
    extent.part = fmax(extent.part, 0);
    return extent;
}
