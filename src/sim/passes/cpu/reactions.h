/* Forces of the pairs with images on the facets that reflect them. Of a pair that acts from i to its image and from j
   to the image of i, each reflection takes what it turns round. What depends on the image alone is computed once per
   group. */
#ifndef SB_SIM_CPU_REACTIONS_H
#define SB_SIM_CPU_REACTIONS_H

#include "sim/passes/cpu/body_forces.h"
#include "sim/walls/mirrors.h"

/* Of one particle, by plane of its group. */
typedef struct sb_reactions {
    uint32_t count, plane[SB_NEAR_MAX]; /* those that react */
    float along[SB_NEAR_MAX];           /* m/s^2 along each plane's normal, by plane; 0 before */
    sb_f4 whole[SB_NEAR_MAX];           /* m/s^2 in any direction, in addition */
    bool known[SB_NEAR_MAX];
} sb_reactions;

SB_INLINE void sb_reaction(sb_reactions *r, uint32_t plane, float along)
{
    if (!r->known[plane]) {
        r->known[plane] = true;
        r->plane[r->count++] = plane;
    }
    r->along[plane] += along;
}

SB_INLINE void sb_reaction_whole(sb_reactions *r, uint32_t plane, sb_f4 a)
{
    sb_reaction(r, plane, 0);
    r->whole[plane] += a;
}

/* Adds the acceleration `a` by an image. */
SB_INLINE void sb_reactions_reflected(sb_reactions *r, const sb_group_plane *planes, uint32_t path, sb_f4 a)
{
    if (path <= SB_REFLECTION_MASK) {
        sb_reaction(r, path - 1, -sb_sum3(planes[path - 1].plane * a));
        return;
    }
    for (int k = SB_REFLECTIONS_MAX; k-- > 0;) { /* from the particle on: the last reflection of the image first */
        const uint32_t index = path >> (SB_REFLECTION_BITS * k) & SB_REFLECTION_MASK;
        if (index == 0) continue;
        sb_reaction(r, index - 1, -sb_sum3(planes[index - 1].plane * a));
        a = sb_reflect_vector(planes[index - 1].plane, a);
    }
}

/* Adds the reactions to the bodies and clears them. at: m, the particle. */
void sb_reactions_close(const sb_sim *sim, const sb_group_plane *planes, sb_vec3 at, sb_reactions *r,
                        sb_body_forces *to);

#define SB_PLANES_SEVERAL UINT32_MAX

/* An image for the reactions to the pressure. */
typedef struct sb_pull {
    float q, head;  /* of the original; what the image has more at rest (sb_hydrostatic) */
    float above;    /* of the original before the plane, quanta */
    uint32_t plane; /* of the group, or SB_PLANES_SEVERAL: reflected more than once */
} sb_pull;

/* pulls: one for each image of the group. */
void sb_pulls_find(const sb_sim *sim, const sb_group *group, sb_pull *pulls);

/* Adds the forces on bodies by pairs of particle i with images and by its pairs at edges. Each reflection of a path
   takes the normal part of the pair's force; what remains acts between the two particles. What the image has more at
   rest acts on i alone: each reflection takes all of the force by the part of the head that it adds, so that a floor
   beside a wall takes the force of the images below it, and the wall does not. records: sb_around_count. */
void sb_react_images(const sb_sim *sim, const sb_group *group, uint32_t records, const sb_pull *pulls, size_t i,
                     sb_reactions *reactions, sb_body_forces *to);

/* A symmetric tensor without trace, in the form of sb_reflect_tensor, times a vector. */
SB_INLINE sb_f4 sb_tensor_times(sb_f4 at, sb_f4 rest, sb_f4 v)
{
    const float xx = at[3], yy = rest[0];
    return (sb_f4){xx * v[0] + rest[1] * v[1] + rest[2] * v[2], rest[1] * v[0] + yy * v[1] + rest[3] * v[2],
                   rest[2] * v[0] + rest[3] * v[1] - (xx + yy) * v[2], 0};
}

/* An image for the reactions to the stress correction. through: its tensor times the plane's normal. */
typedef struct sb_stretch {
    sb_f4 through;
    uint32_t plane; /* as in sb_pull */
} sb_stretch;

/* around: the images in the form of sb_around_tensors. */
SB_INLINE void sb_stretches_find(const sb_sim *sim, const sb_group *group, const sb_f4 *around, sb_stretch *stretches)
{
    const sb_image *image = sim->groups.image + group->image;
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    for (uint32_t k = 0; k < group->images; k++) {
        const bool several = image[k].path > SB_REFLECTION_MASK;
        stretches[k].plane = several ? SB_PLANES_SEVERAL : image[k].path - 1;
        if (!several)
            stretches[k].through =
                sb_tensor_times(around[2 * k], around[2 * k + 1], sb_path_plane(planes, image[k].path));
    }
}

#endif
