/* Chooses the lattice of each plane of a surface: the position of its rows and their distance. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"

/* Cosine up to which a lattice projected along an axis stays dense enough (half a cell's diagonal below
   SB_SAMPLE_FILL). */
static const double projected_cosine = 0.93;
/* In spacings: a tilted plane smaller than this gets no lattice of its own. */
static const double fitted_extent = 6;
/* In spacings: limits of the step of evenly spread rows. Nearer rows would not be accepted, and the cells of wider
   ones would be filled. */
static const double narrow = SB_SAMPLE_LATTICE, wide = 1.08;
/* Cosine between the normals of faces that count as perpendicular to each other. */
static const double upright = 0.05;

double sb_sample_fitted_step(double length, double spacing)
{
    double pieces = round(length / spacing);
    double step = pieces > 0 ? length / pieces : spacing;
    return step > 0.92 * spacing && step < 1.08 * spacing ? step : spacing;
}

double sb_sample_axis_step(const sb_sample_settings *settings, int axis)
{
    double length = sb_sample_along(sb_sub(settings->max, settings->min), axis);
    return settings->repeats[axis] ? sb_sample_fitted_step(length, settings->spacing) : settings->spacing;
}

bool sb_sample_is_axis(sb_vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))) > 1 - 1e-9;
}

static sb_vec3 axis_of(int k)
{
    return sb_vec(k == 0, k == 1, k == 2);
}

int sb_sample_dominant(sb_vec3 n)
{
    double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    return z >= x && z >= y ? 2 : x >= y ? 0 : 1;
}

/* Bounds of a plane's triangles along u and v, and which of these bounds are edges with water on both sides. */
enum { LOW = 1, HIGH = 2 };
typedef struct extent {
    sb_vec3 u, v;
    double min_u, max_u, min_v, max_v;
    unsigned edge_u, edge_v;
} extent;

static void plane_axes(sb_vec3 n, extent *e)
{
    sb_vec3 level = sb_cross(sb_vec(0, 0, 1), n);
    e->u = sb_norm(level) > 1e-9 ? sb_normalize(level) : sb_vec(1, 0, 0);
    e->v = sb_cross(n, e->u);
}

/* Lattice lines along one direction of a plane, at origin + (i + 1/2) step. */
typedef struct rows {
    double origin, step;
} rows;

/* Rows of the global lattice along an axis, otherwise evenly spread rows. */
static rows rows_between(const sb_sample_settings *settings, sb_vec3 axis, double min, double max)
{
    if (sb_sample_is_axis(axis))
        return (rows){sb_dot(settings->min, axis), sb_sample_axis_step(settings, sb_sample_dominant(axis))};
    return (rows){min, sb_sample_fitted_step(max - min, settings->spacing)};
}

/* Rows of a solid's face. At an edge one row lies at the offset behind both faces, so that the rows of the two faces
   coincide there. The other rows are spread evenly from there to the opposite edge, or, if the opposite end is not
   an edge but on the ground, to half a step before it. */
static rows rows_along(const sb_sample_settings *settings, sb_vec3 axis, double min, double max, unsigned edges)
{
    const double spacing = settings->spacing, offset = settings->offset;
    const double first = min + (edges & LOW ? offset : 0), last = max - (edges & HIGH ? offset : 0);
    const double half = edges == (LOW | HIGH) ? 0 : 0.5;
    const double pieces = round((last - first) / spacing - half) + half;
    const double step = pieces > 0 ? (last - first) / pieces : 0;
    const bool even = edges && step > narrow * spacing && step < wide * spacing;
    if (!even || (sb_sample_is_axis(axis) && settings->repeats[sb_sample_dominant(axis)]))
        return rows_between(settings, axis, min, max);
    return (rows){first - (edges & LOW ? 0.5 * step : 0), step};
}

static sb_lattice choose_lattice(const sb_sample_settings *settings, sb_vec3 n, const extent *e)
{
    const double c[3] = {fabs(n.x), fabs(n.y), fabs(n.z)};
    const int k = sb_sample_dominant(n), i = (k + 1) % 3, j = (k + 2) % 3;
    const bool edges = e->edge_u || e->edge_v;
    if (sb_dot(n, n) == 0) return (sb_lattice){.suits = false};
    if (!edges && c[k] > projected_cosine)
        return (sb_lattice){
            axis_of(i), axis_of(j), settings->min, sb_sample_axis_step(settings, i), sb_sample_axis_step(settings, j),
            true};
    if (!edges && !(fmin(e->max_u - e->min_u, e->max_v - e->min_v) > fitted_extent * settings->spacing))
        return (sb_lattice){.suits = false};
    const rows u = rows_along(settings, e->u, e->min_u, e->max_u, e->edge_u);
    const rows v = rows_along(settings, e->v, e->min_v, e->max_v, e->edge_v);
    const sb_vec3 origin = sb_add(sb_scale(e->u, u.origin), sb_scale(e->v, v.origin));
    return (sb_lattice){e->u, e->v, origin, u.step, v.step, true};
}

/* Measures the bounds of all planes of a surface, at index of their first triangle. */
static void measure_planes(const sb_surface *surface, extent *extents)
{
    const sb_mesh *mesh = sb_surface_mesh(surface);
    for (size_t t = 0; t < mesh->triangle_count; ++t) {
        extent *e = extents + surface->region[t];
        if (surface->region[t] == t) {
            *e = (extent){.min_u = HUGE_VAL, .max_u = -HUGE_VAL, .min_v = HUGE_VAL, .max_v = -HUGE_VAL};
            plane_axes(surface->normal[t], e);
        }
        for (int i = 0; i < 3; ++i) {
            const sb_vec3 corner = mesh->vertices[mesh->triangles[t][i]];
            double u = sb_dot(corner, e->u), v = sb_dot(corner, e->v);
            e->min_u = fmin(e->min_u, u);
            e->max_u = fmax(e->max_u, u);
            e->min_v = fmin(e->min_v, v);
            e->max_v = fmax(e->max_v, v);
        }
    }
}

/* Returns the end of [min, max] at which an edge lies as one bit, or 0. */
static unsigned end_of(double a, double b, double min, double max, double near)
{
    if (fabs(a - min) < near && fabs(b - min) < near) return LOW;
    return fabs(a - max) < near && fabs(b - max) < near ? HIGH : 0;
}

/* Marks the ends at edges with faces that are perpendicular to the plane. */
static void find_ends(const sb_sampler *sampler, uint32_t index, extent *extents)
{
    const sb_surface *surface = sampler->surfaces + index;
    const double near = 1e-6 * sampler->settings.spacing;
    for (size_t i = 0; i < surface->ridge_count; ++i)
        for (int side = 0; side < 2; ++side) {
            const sb_ridge *ridge = surface->ridges + i;
            extent *e = extents + surface->region[ridge->triangle[side]];
            const sb_vec3 own = surface->normal[ridge->triangle[side]];
            const sb_vec3 other = surface->normal[ridge->triangle[1 - side]];
            const sb_vec3 middle = sb_scale(sb_add(ridge->a, ridge->b), 0.5);
            if (fabs(sb_dot(own, other)) > upright || !sb_sample_exposed(sampler, index, middle, other)) continue;
            e->edge_u |= end_of(sb_dot(ridge->a, e->u), sb_dot(ridge->b, e->u), e->min_u, e->max_u, near);
            e->edge_v |= end_of(sb_dot(ridge->a, e->v), sb_dot(ridge->b, e->v), e->min_v, e->max_v, near);
        }
}

int sb_sample_planes(const sb_sampler *sampler, uint32_t index, sb_lattice *lattices)
{
    const sb_surface *surface = sampler->surfaces + index;
    const size_t count = sb_surface_mesh(surface)->triangle_count;
    extent *extents = sb_alloc_untouched(count, sizeof *extents);
    if (!extents) return -1;
    measure_planes(surface, extents);
    find_ends(sampler, index, extents);
    for (size_t t = 0; t < count; ++t)
        if (surface->region[t] == t) lattices[t] = choose_lattice(&sampler->settings, surface->normal[t], extents + t);
    sb_free(extents);
    return 0;
}
