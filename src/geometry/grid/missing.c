#include "geometry/grid/missing.h"

#include "base/memory.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A height counts as missing if it is farther from all others than this many times their range and than this many
   times the height of the box. */
static const double FAR_OFF = 10;

/* Heights of the nodes within the box, in ascending order. Owned. */
typedef struct heights {
    double *z;
    size_t count, first, end; /* [first, end): those of the ground */
} heights;

static bool is_within(sb_vec3 min, sb_vec3 max, const sb_mesh *mesh, size_t triangle)
{
    const uint32_t *of = mesh->triangles[triangle];
    sb_vec3 low = mesh->vertices[of[0]], high = low;
    for (int k = 1; k < 3; ++k) {
        low = sb_min(low, mesh->vertices[of[k]]);
        high = sb_max(high, mesh->vertices[of[k]]);
    }
    return high.x >= min.x && low.x <= max.x && high.y >= min.y && low.y <= max.y;
}

static int compare_numbers(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    return (a > b) - (a < b);
}

/* Selects the ground: of the groups of heights that are separated by wide gaps, the one within the range of z with the
   most nodes. */
static void find_ground(double floor, double top, heights *all)
{
    const double gap = FAR_OFF * (top - floor);
    for (size_t i = 0, end; i < all->count; i = end) {
        for (end = i + 1; end < all->count && all->z[end] - all->z[end - 1] <= gap;) ++end;
        if (all->z[i] > top || all->z[end - 1] < floor || end - i <= all->end - all->first) continue;
        all->first = i;
        all->end = end;
    }
}

/* Marks the nodes within the box. Returns the range of their heights. */
static double mark_nodes(sb_vec3 min, sb_vec3 max, const sb_mesh *mesh, uint8_t *within, size_t *count)
{
    double least = (double)INFINITY, most = -(double)INFINITY;
    for (size_t t = 0; t < mesh->triangle_count; ++t)
        for (int k = 0; k < 3 && is_within(min, max, mesh, t); ++k) within[mesh->triangles[t][k]] = 1;
    for (size_t i = 0; i < mesh->node_count; ++i) {
        if (!within[i]) continue;
        ++*count;
        least = fmin(least, mesh->vertices[i].z);
        most = fmax(most, mesh->vertices[i].z);
    }
    return most - least;
}

static sb_status sort_heights(const sb_mesh *mesh, const uint8_t *within, heights *all, sb_error *error)
{
    all->z = sb_alloc_untouched(all->count, sizeof *all->z);
    if (!all->z) return sb_fail_memory(error, "the heights of a grid");
    for (size_t i = 0, next = 0; i < mesh->node_count; ++i)
        if (within[i]) all->z[next++] = mesh->vertices[i].z;
    qsort(all->z, all->count, sizeof *all->z, compare_numbers);
    return SB_OK;
}

/* Counts the nodes that are far from the ground. */
static void count_missing(const sb_mesh *mesh, const uint8_t *within, double far, sb_missing *found)
{
    found->least = (double)INFINITY;
    found->most = -(double)INFINITY;
    for (size_t i = mesh->node_count; i-- > 0;) {
        const double z = mesh->vertices[i].z;
        if (!within[i] || (z >= found->low - far && z <= found->high + far)) continue;
        ++found->count;
        found->first = i;
        found->least = fmin(found->least, z);
        found->most = fmax(found->most, z);
    }
}

sb_status sb_missing_find(const sb_mesh *mesh, sb_vec3 min, sb_vec3 max, sb_missing *found, sb_error *error)
{
    heights all = {.count = 0};
    sb_status status = SB_OK;
    *found = (sb_missing){.count = 0};
    if (mesh->node_count == 0) return SB_OK;
    uint8_t *within = sb_alloc(mesh->vertex_count, 1);
    if (!within) return sb_fail_memory(error, "the heights of a grid");
    /* Without a wide gap there is one group of heights, and no need to sort them. */
    if (mark_nodes(min, max, mesh, within, &all.count) > FAR_OFF * (max.z - min.z)) {
        status = sort_heights(mesh, within, &all, error);
        if (status == SB_OK) find_ground(min.z, max.z, &all);
    }
    if (status == SB_OK && all.end > all.first) {
        found->low = all.z[all.first];
        found->high = all.z[all.end - 1];
        count_missing(mesh, within, FAR_OFF * fmax(max.z - min.z, found->high - found->low), found);
    }
    sb_free(within);
    sb_free(all.z);
    return status;
}

void sb_missing_tell(const sb_missing *found, const sb_mesh *mesh, const char *box, char *text, size_t size)
{
    const sb_vec3 first = mesh->vertices[found->first];
    snprintf(
        text, size,
        "%zu of its grid's nodes within the %s %s at z = %g m%s, far %s all others, which are from %g to %g m; the "
        "first is at (%g, %g): most likely missing heights (nodata) whose value the file does not state; expected "
        "their NODATA_value in the header, or no lines for them in an .xyz file",
        found->count, box, found->count > 1 ? "are" : "is", found->least, found->most > found->least ? " and more" : "",
        found->most < found->low     ? "below"
        : found->least > found->high ? "above"
                                     : "from",
        found->low, found->high, first.x, first.y);
}
