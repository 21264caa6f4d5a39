/* Places the points of the boundary surface. A surface point goes behind the surface by the offset, or to the middle
   of a part that is thinner than twice the offset, or it gets no particle. */
#include "geometry/sampling/parts.h"

/* In offsets: a point nearer than this to another face lies beyond the border of its own face's boundary surface. */
static const double crowded_share = 0.9;
/* Cosine between normals: faces whose normals oppose each other more than this are the two sides of a thin part;
   others meet in an edge. */
static const double thin_cosine = -0.5;
/* In spacings, in addition to the offset: a surface this deep below a solid that stands on it has no contact with
   water. */
static const double burial = 0.25;
enum { THIN_STEPS = 8 };

static bool inside_box(const sb_surface *surface, sb_vec3 at, double margin)
{
    return at.x > surface->min.x - margin && at.x < surface->max.x + margin && at.y > surface->min.y - margin &&
           at.y < surface->max.y + margin && at.z > surface->min.z - margin && at.z < surface->max.z + margin;
}

static bool contains(const sb_surface *surface, sb_vec3 at)
{
    if (surface->bounded) {
        /* A terrain extends downwards without limit. */
        bool beside = at.x < surface->min.x || at.x > surface->max.x || at.y < surface->min.y ||
                      at.y > surface->max.y || at.z > surface->max.z;
        if (beside || (surface->source->role == SB_ROLE_SOLID && at.z < surface->min.z)) return false;
    }
    return sb_solid_contains(surface->source->solid, at);
}

/* Whether another surface may cover a point of this one. Only static surfaces do, and only static ones are covered. */
static bool may_cover(const sb_sampler *sampler, uint32_t surface, uint32_t other)
{
    return other != surface && !sampler->surfaces[surface].source->moving && !sampler->surfaces[other].source->moving;
}

/* Whether a surface can bury parts of itself: a wall added at the end of a terrain continues below lower ground. */
static bool buries_itself(const sb_sampler *sampler, uint32_t surface)
{
    return sb_surface_mesh(sampler->surfaces + surface)->ends > 0;
}

/* A point is buried if a ball that touches the surface from the water's side lies inside another solid. The ball is
   so large that the other solid's boundary surface, which is in contact with the water, is nearer to it than this
   surface. */
bool sb_sample_buried(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, double radius)
{
    if (sampler->surfaces[surface].source->moving) return false;
    const sb_sample_settings *settings = &sampler->settings;
    sb_vec3 out = sb_max(sb_sub(settings->min, at), sb_sub(at, settings->max));
    out = sb_max(out, sb_vec(0, 0, 0));
    if (settings->dimensions == 2) out.y = 0;
    if (sb_norm(out) > settings->support + radius) return true;
    for (int axis = 0; axis < 3; ++axis)
        if (settings->repeats[axis] && sb_sample_beyond(settings, at, axis) > settings->offset + radius) return true;
    double ball = settings->offset + burial * settings->spacing + radius;
    sb_vec3 center = sb_madd(at, -(1 + 1e-6) * ball, inward);
    for (uint32_t i = 0; i < sampler->surface_count; ++i) {
        const sb_surface *other = sampler->surfaces + i;
        if ((may_cover(sampler, surface, i) || (i == surface && buries_itself(sampler, i))) &&
            contains(other, center) && sb_solid_distance(other->source->solid, center, ball, NULL, NULL) >= ball)
            return true;
    }
    return false;
}

bool sb_sample_exposed(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 normal)
{
    sb_vec3 front = sb_madd(at, 0.02 * sampler->settings.spacing, normal);
    for (uint32_t i = 0; i < sampler->surface_count; ++i)
        if (may_cover(sampler, surface, i) && contains(sampler->surfaces + i, front)) return false;
    return true;
}

/* Returns the mesh's normal turned towards the water. */
static sb_vec3 water_normal(const sb_surface *surface, sb_vec3 normal)
{
    if (surface->source->role == SB_ROLE_TERRAIN) return normal.z < -SB_SAMPLE_UPRIGHT ? sb_scale(normal, -1) : normal;
    return sb_scale(normal, surface->sign);
}

/* Whether a point lies in a periodic side. */
static bool in_side(const sb_sample_settings *settings, sb_vec3 at)
{
    bool in = false;
    for (int axis = 0; axis < 3; ++axis)
        in = in || (settings->repeats[axis] &&
                    fabs(sb_sample_beyond(settings, at, axis)) < SB_SAMPLE_SIDE * settings->spacing);
    return in;
}

/* Returns the step that moves a point at least `distance` inside the domain along its periodic axes. */
static sb_vec3 step_inside(const sb_sample_settings *settings, sb_vec3 at, double distance)
{
    double step[3] = {0};
    for (int axis = 0; axis < 3; ++axis) {
        double depth = distance + sb_sample_beyond(settings, at, axis);
        double low = sb_sample_along(at, axis) - sb_sample_along(settings->min, axis);
        double high = sb_sample_along(settings->max, axis) - sb_sample_along(at, axis);
        if (settings->repeats[axis] && depth > 0) step[axis] = low < high ? depth : -depth;
    }
    return sb_vec(step[0], step[1], step[2]);
}

/* A query for the nearest point of a surface; the point at `at` is moved by `step`. */
typedef struct query {
    const sb_sampler *sampler;
    uint32_t surface;
    sb_vec3 at, step;
} query;

/* Returns the normal towards the water; if the surface's orientation is inconsistent, towards the query's point. */
static sb_vec3 facing(const query *a, sb_vec3 place, sb_vec3 normal)
{
    const sb_surface *on = a->sampler->surfaces + a->surface;
    normal = water_normal(on, normal);
    return on->mixed && sb_dot(normal, sb_sub(place, a->at)) < 0 ? sb_scale(normal, -1) : normal;
}

static bool is_exposed(const void *context, sb_vec3 nearest, sb_vec3 normal)
{
    const query *a = context;
    const sb_vec3 place = sb_sub(nearest, a->step);
    return sb_sample_exposed(a->sampler, a->surface, place, facing(a, place, normal));
}

double sb_sample_distance(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, double limit, sb_vec3 *nearest,
                          sb_vec3 *normal)
{
    const sb_sample_settings *settings = &sampler->settings;
    const sb_solid *solid = sampler->surfaces[surface].source->solid;
    query a = {.sampler = sampler, .surface = surface, .at = at};
    double distance = sb_solid_distance_where(solid, at, limit, is_exposed, &a, nearest, normal);
    if (distance < limit && in_side(settings, *nearest)) {
        a.step = step_inside(settings, at, limit);
        distance = sb_solid_distance_where(solid, sb_add(at, a.step), limit, is_exposed, &a, nearest, normal);
        *nearest = sb_sub(*nearest, a.step);
    }
    if (distance < limit) *normal = facing(&a, *nearest, *normal);
    return distance;
}

/* Returns the distance from a point of the boundary surface to the nearest exposed surface, at most limit. */
static double clearance(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, double limit, sb_vec3 *nearest,
                        sb_vec3 *normal)
{
    double best = limit;
    for (uint32_t i = 0; i < sampler->surface_count; ++i) {
        if ((i != surface && !may_cover(sampler, surface, i)) || !inside_box(sampler->surfaces + i, at, best)) continue;
        sb_vec3 place, toward;
        double distance = sb_sample_distance(sampler, i, at, best, &place, &toward);
        if (distance >= best) continue;
        best = distance;
        *nearest = place;
        *normal = toward;
    }
    return best;
}

bool sb_sample_fits(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, double offset)
{
    sb_vec3 nearest, normal;
    double least = crowded_share * offset;
    return !sb_sample_buried(sampler, surface, sb_madd(at, -offset, inward), inward, 0) &&
           !(clearance(sampler, surface, at, least, &nearest, &normal) < least);
}

sb_placement sb_sample_place(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_vec3 inward, sb_vec3 *placed,
                             double *margin)
{
    *margin = 0;
    if (sb_sample_buried(sampler, surface, at, inward, 0)) return SB_BURIED;
    double offset = sampler->settings.offset;
    for (int step = 0; step < THIN_STEPS; ++step) {
        *placed = sb_madd(at, offset, inward);
        sb_vec3 nearest, normal;
        double limit = offset * (1 - 1e-3);
        double room = clearance(sampler, surface, *placed, limit, &nearest, &normal);
        if (!(room < limit)) break;
        sb_vec3 chord = sb_sub(nearest, at);
        double along = sb_dot(chord, inward);
        if (-sb_dot(normal, inward) >= thin_cosine || !(along > 0)) {
            *margin = crowded_share * offset - room;
            return *margin > 0 ? SB_CROWDED : SB_PLACED;
        }
        /* The nearest face is the far side of a thin part. The ball through both points has its centre in the middle
           of the part. */
        offset = sb_dot(chord, chord) / (2 * along);
    }
    return SB_PLACED;
}

bool sb_sample_project(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, sb_sample *sample)
{
    const sb_surface *on = sampler->surfaces + surface;
    double limit = sampler->settings.offset + 2 * sampler->settings.spacing;
    sb_vec3 foot, normal;
    if (on->mixed || sb_solid_distance(on->source->solid, at, limit, &foot, &normal) >= limit ||
        in_side(&sampler->settings, foot))
        return false;
    normal = water_normal(on, normal);
    sb_vec3 inward = sb_scale(normal, -1);
    double margin;
    if (sb_sample_place(sampler, surface, foot, inward, &sample->at, &margin) != SB_PLACED) return false;
    if (sampler->settings.dimensions == 2) sample->at.y = 0;
    sample->normal = sb_scale(inward, -1);
    sample->source = surface;
    sample->slab = sampler->slab;
    return true;
}
