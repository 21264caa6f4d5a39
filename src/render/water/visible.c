/* Selects the visible particles. */
#include "render/water/visible.h"

#include "base/memory.h"
#include "render/camera/lens.h"

/* A particle is hidden if the density at a distance of cover_spacings towards the eye is above this. In a slice,
   whose particles lie in a plane, none is hidden. */
static const float dense = 0.68f, cover_spacings = 1.6f;
/* The density at and above which a particle is not drawn as a single drop. */
static const float crowd_density = 0.35f;

/* The normal is opposite to the density gradient. The gradient is taken slightly above the particle, because it
   vanishes within a single layer of particles on land. */
static void surface_normal(const sb_density *density, const float *p, float spacing, const float *to_eye,
                           signed char normal[4])
{
    float d = density->cell, x = p[0], y = p[1], z = p[2] + 0.7f * spacing;
    float g[3] = {sb_density_at(density, x - d, y, z) - sb_density_at(density, x + d, y, z),
                  sb_density_at(density, x, y - d, z) - sb_density_at(density, x, y + d, z),
                  sb_density_at(density, x, y, z - d) - sb_density_at(density, x, y, z + d)};
    float length = sqrtf(sb_dot3(g, g));
    if (length < 1e-4f) {
        for (int a = 0; a < 3; a++) g[a] = to_eye[a];
        length = sqrtf(sb_dot3(g, g));
    }
    for (int a = 0; a < 3; a++) normal[a] = (signed char)lrintf(127 * g[a] / length);
    normal[3] = 0;
}

static void collect(sb_visible *visible, const sb_frame *frame, const float *values, const sb_view *view)
{
    const sb_density *density = &visible->density;
    const sb_lens lens = sb_lens_of(view, frame->origin, frame->spacing);
    const float spacing = (float)frame->spacing;
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        float to_eye[3] = {lens.eye[0] - p[0], lens.eye[1] - p[1], lens.eye[2] - p[2]};
        if (!sb_density_counts(p) || sb_lens_outside(&lens, to_eye) || sb_lens_cut(&lens, p)) continue;
        float step = cover_spacings * spacing / sqrtf(sb_dot3(to_eye, to_eye));
        if (!density->slice &&
            sb_density_at(density, p[0] + step * to_eye[0], p[1] + step * to_eye[1], p[2] + step * to_eye[2]) > dense)
            continue;
        const float value = values[i] > 0 ? values[i] < 1 ? values[i] : 1 : 0;
        float crowd = sb_density_at(density, p[0], p[1], p[2]) / crowd_density;
        sb_visible_point *point = &visible->points[visible->count++];
        *point = (sb_visible_point){
            .position = {p[0], p[1], p[2]},
            .value = (unsigned short)(65535 * value),
            .crowd = (unsigned short)(65535 * (crowd < 1 ? crowd : 1)),
        };
        surface_normal(density, p, spacing, to_eye, point->normal);
    }
}

sb_status sb_visible_collect(sb_visible *visible, const sb_frame *frame, const float *values, const sb_ground *ground,
                             const sb_view *view, int threads, sb_error *error)
{
    visible->count = 0;
    if (sb_grow((void **)&visible->points, &visible->capacity, frame->count, sizeof *visible->points) != 0)
        return sb_fail_memory(error, "the visible particles");
    sb_status status = sb_density_build(&visible->density, frame, ground, threads, error);
    if (status == SB_OK) collect(visible, frame, values, view);
    return status;
}

void sb_visible_free(sb_visible *visible)
{
    sb_free(visible->points);
    sb_density_free(&visible->density);
    *visible = (sb_visible){0};
}
