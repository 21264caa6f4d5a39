/* Sets the normals along the convex edges of solids to the mean of the faces there, so that they do not depend on
   which face a particle was placed for. */
#include "geometry/sampling/parts.h"

#include "base/stop.h"

/* In offsets: distance by which a point is moved back to find its next face, and largest distance of that face. */
static const double step_back = 0.2, search_limit = 1.3;
/* Cosines: normals closer than same_face belong to one face; faces whose normals oppose each other more than `plate`
   are the two sides of a plate. */
static const double same_face = 0.95, plate = -0.5;
enum { FACES = 3 };

/* Finds the nearest exposed face within `limit`. Returns false if there is none. */
static bool face_near(const sb_sampler *sampler, uint32_t surface, sb_vec3 at, double limit, sb_vec3 *normal)
{
    sb_vec3 nearest;
    return sb_sample_distance(sampler, surface, at, limit, &nearest, normal) < limit;
}

static bool is_new(const sb_vec3 *faces, int count, sb_vec3 normal)
{
    for (int i = 0; i < count; ++i) {
        double cosine = sb_dot(faces[i], normal);
        if (cosine > same_face || cosine < plate) return false;
    }
    return true;
}

/* Returns the mean normal of the faces at the offset from a particle. Each face is found by moving the point back
   from those already found. */
static sb_vec3 normal_of(const sb_sampler *sampler, const sb_sample *sample)
{
    const double offset = sampler->settings.offset;
    const double step = step_back * offset, limit = search_limit * offset;
    sb_vec3 faces[FACES], sum = sample->normal;
    /* A particle in a concave edge has the mean normal of the edge, which is the normal of no face. */
    if (!face_near(sampler, sample->source, sb_madd(sample->at, step, sum), limit, faces) ||
        sb_dot(faces[0], sum) < same_face)
        return sample->normal;
    int count = 1;
    while (count < FACES && face_near(sampler, sample->source, sb_madd(sample->at, -step, sum), limit, &faces[count]) &&
           is_new(faces, count, faces[count]))
        sum = sb_add(sum, faces[count++]);
    return sb_normalize(sum);
}

void sb_sample_round_edges(const sb_sampler *sampler, sb_sample *found, size_t count)
{
#pragma omp parallel for schedule(dynamic, 64)
    for (size_t i = 0; i < count; ++i) {
        const sb_surface *surface = sampler->surfaces + found[i].source;
        if (surface->source->role == SB_ROLE_SOLID && !surface->mixed && !sb_stop_signal())
            found[i].normal = normal_of(sampler, &found[i]);
    }
}
