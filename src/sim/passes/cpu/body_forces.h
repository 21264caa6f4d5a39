/* Forces on bodies, summed by one thread over groups of particles, independent of the order of groups. */
#ifndef SB_SIM_CPU_BODY_FORCES_H
#define SB_SIM_CPU_BODY_FORCES_H

#include "sim/exchange/sums.h"
#include "sim/search/around.h"

typedef struct sb_body_forces {
    double *sum;    /* of the present group: sum[body][SB_FORCE_VALUES] */
    uint32_t *body; /* those that the group acts on */
    size_t count;   /* of them */
    bool *acted_on; /* per body */
    sb_exact *all;  /* of all groups so far: all[body][SB_FORCE_VALUES] */
} sb_body_forces;

/* Returns 0, or -1 without memory. */
int sb_body_forces_create(sb_body_forces *f, size_t bodies);
void sb_body_forces_free(sb_body_forces *f);

/* Vector from an image of a boundary particle to the original. A force across a periodic side acts on the original. */
sb_vec3 sb_wall_to_original(const sb_space *space, sb_record image);
/* Records a force (N) between particle i and a boundary particle, as in wall_pairs, for probes. */
void sb_wall_push_record(const sb_sim *sim, size_t i, uint32_t wall, sb_vec3 force);

/* Adds a force on a body. pressure, drag: N; at: m, the point of application. */
void sb_body_forces_add(const sb_sim *sim, sb_body_forces *to, uint32_t body, sb_vec3 at, sb_vec3 pressure,
                        sb_vec3 drag);
/* Adds a pressure force (N) on a facet. normal: 0 0 0 if the force is not along the facet's. */
void sb_body_forces_of_facet(const sb_sim *sim, sb_body_forces *to, uint32_t mirror, sb_vec3 at, sb_vec3 force,
                             sb_vec3 normal);
/* The same, along the normal of a group's plane. */
void sb_body_forces_along(const sb_sim *sim, sb_body_forces *to, const sb_group_plane *plane, sb_vec3 at,
                          sb_vec3 force);
/* Ends a group. */
void sb_body_forces_close(sb_body_forces *f);

/* Reactions of a particle's walls to its accelerations by images, summed by plane of its group. Of a pair that acts
   from i to its image and from j to the image of i, each reflection takes what it turns round. */
enum { SB_REACTIONS_MAX = 200 };
typedef struct sb_reactions {
    uint32_t count, plane[SB_REACTIONS_MAX]; /* those that react */
    float along[SB_REACTIONS_MAX];           /* m/s^2 along each plane's normal, by plane; 0 before */
    sb_f4 across[SB_REACTIONS_MAX];          /* m/s^2, other parts along the normal included, which do not count */
    bool known[SB_REACTIONS_MAX];
} sb_reactions;

SB_INLINE void sb_reaction(sb_reactions *r, uint32_t plane, float along)
{
    if (!r->known[plane]) {
        r->known[plane] = true;
        r->plane[r->count++] = plane;
    }
    r->along[plane] += along;
}

/* Adds the part across the normal of the acceleration `a` by an image, of which sb_reaction had the other part. */
SB_INLINE void sb_reaction_across(sb_reactions *r, uint32_t plane, sb_f4 a)
{
    r->across[plane] -= a;
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

/* Adds the acceleration `a` that images give the particle alone. Each plane of the path takes the part of what is left
   along its normal, the last one the rest. */
SB_INLINE void sb_reactions_whole(sb_reactions *r, const sb_group_plane *planes, uint32_t path, sb_f4 a)
{
    for (; path; path >>= SB_REFLECTION_BITS) {
        const uint32_t plane = (path & SB_REFLECTION_MASK) - 1;
        const float along = sb_sum3(planes[plane].plane * a);
        a -= planes[plane].plane * (sb_f4){along, along, along, 0};
        sb_reaction(r, plane, -along);
        if (path <= SB_REFLECTION_MASK) sb_reaction_across(r, plane, a);
    }
}

/* Adds the reactions to the bodies and clears them. at: m, the particle. */
void sb_reactions_close(const sb_sim *sim, const sb_group_plane *planes, sb_vec3 at, sb_reactions *r,
                        sb_body_forces *to);

/* By how much q of an image below its original is larger, per quantum: beyond a wall the pressure goes on as in water
   at rest. With the same pressure on both sides the pressure at a floor would have no gradient. */
SB_INLINE float sb_hydrostatic(const sb_sim *sim)
{
    return sim->constant.gravity * (float)sim->space.quantum / sim->constant.rest_density;
}

#endif
