/* Normals along the convex edges of solids: the particles there stand for both faces, whichever face's they were
   placed as. */
#include "geometry/sample_parts.h"

#include "base/stop.h"

/* In offsets: how far a place is drawn back to ask for its next face, and how far that may be. */
static const double drawn_back = 0.2, in_reach = 1.3;
/* Cosines: normals this near are one face's; faces that look away from each other more than this bound a plate. */
static const double same_face = 0.95, plate = -0.5;
enum { FACES = 3 };

/* The face nearest to a place that water may stand before; false: none in reach. */
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

/* The mean of the faces at the offset from a place; each is found by drawing the place back from those known. */
static sb_vec3 normal_of(const sb_sampler *sampler, const sb_sample *sample)
{
    const double offset = sampler->settings.offset;
    const double step = drawn_back * offset, reach = in_reach * offset;
    sb_vec3 faces[FACES], sum = sample->normal;
    /* A chain in a concave edge has its mitre's normal, which is no face's. */
    if (!face_near(sampler, sample->source, sb_madd(sample->at, step, sum), reach, faces) ||
        sb_dot(faces[0], sum) < same_face)
        return sample->normal;
    int count = 1;
    while (count < FACES && face_near(sampler, sample->source, sb_madd(sample->at, -step, sum), reach, &faces[count]) &&
           is_new(faces, count, faces[count]))
        sum = sb_add(sum, faces[count++]);
    return sb_normalize(sum);
}

void sb_sample_round_edges(const sb_sampler *sampler, sb_sample_set *all)
{
#pragma omp parallel for schedule(dynamic, 256)
    for (size_t i = 0; i < all->count; ++i) {
        const sb_surface *surface = sampler->surfaces + all->sample[i].source;
        if (surface->source->role == SB_ROLE_SOLID && !surface->mixed && !sb_stop_signal())
            all->sample[i].normal = normal_of(sampler, &all->sample[i]);
    }
}
