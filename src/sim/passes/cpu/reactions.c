#include "sim/passes/cpu/reactions.h"

void sb_reactions_close(const sb_sim *sim, const sb_group_plane *planes, sb_vec3 at, sb_reactions *r,
                        sb_body_forces *to)
{
    for (uint32_t k = 0; k < r->count; k++) {
        const uint32_t plane = r->plane[k];
        const sb_f4 normal = planes[plane].plane;
        const sb_vec3 n = sb_vec((double)normal[0], (double)normal[1], (double)normal[2]);
        const sb_f4 w = r->whole[plane];
        const sb_vec3 a = sb_madd(sb_vec((double)w[0], (double)w[1], (double)w[2]), (double)r->along[plane], n);
        sb_body_forces_of_facet(sim, to, planes[plane].mirror, at, sb_scale(a, (double)sim->constant.mass), n);
        r->known[plane] = false;
        r->along[plane] = 0;
        r->whole[plane] = (sb_f4){0};
    }
    r->count = 0;
}

void sb_pulls_find(const sb_sim *sim, const sb_group *group, sb_pull *pulls)
{
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    const float hydrostatic = sb_hydrostatic(sim);
    for (uint32_t k = 0; k < group->images; k++) {
        const sb_image *image = &sim->groups.image[group->image + k];
        const sb_f4 from = sb_offset(sim->state.position[image->from], group->corner);
        const sb_f4 plane = sb_path_plane(planes, image->path);
        pulls[k].head = hydrostatic * (from[2] - image->at[2]);
        pulls[k].q = sim->work.unknown[sb_entry_owner(sim, image->from)];
        pulls[k].above = sb_sum3(plane * from) - plane[3];
        pulls[k].plane = image->path > SB_REFLECTION_MASK ? SB_PLANES_SEVERAL : image->path - 1;
    }
}

static sb_f4 place_of(const sb_image *image)
{
    return (sb_f4){image->at[0], image->at[1], image->at[2], 0};
}

/* Adds a pair with an image by several reflections. slope: 1/s^2 for an offset in quanta and q. */
static void react_several(const sb_sim *sim, const sb_group *group, const sb_image *image, float slope, size_t i,
                          sb_reactions *reactions)
{
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    const sb_f4 self = sb_offset(sim->state.position[i], group->corner);
    const float q = sim->work.unknown[i] + sim->work.unknown[sb_entry_owner(sim, image->from)];
    const float hydrostatic = sb_hydrostatic(sim);
    const sb_f4 pull = (self - place_of(image)) * sb_splat(-slope);
    sb_reactions_reflected(reactions, planes, image->path, pull * sb_splat(q));
    sb_f4 from = sb_offset(sim->state.position[image->from], group->corner);
    for (uint32_t path = image->path; path; path >>= SB_REFLECTION_BITS) {
        const uint32_t plane = (path & SB_REFLECTION_MASK) - 1;
        const sb_f4 to = sb_reflect(planes[plane].plane, from);
        sb_reaction_whole(reactions, plane, pull * sb_splat(hydrostatic * (to[2] - from[2])));
        from = to;
    }
}

/* The force of a pair with an image by one reflection is along the plane's normal the sum of both ends' distances
   before the plane, times a factor; and the force by the head. */
SB_APART void react_reflected(const sb_sim *sim, const sb_group *group, uint32_t records, const sb_pull *pulls,
                              size_t i, sb_reactions *reactions)
{
    const sb_lists *lists = &sim->work.pairs;
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    const sb_f4 self = sb_offset(sim->state.position[i], group->corner);
    const float own = sim->work.unknown[i];
    float above[SB_NEAR_MAX];
    for (uint32_t p = 0; p < group->planes; p++) above[p] = sb_sum3(planes[p].plane * self) - planes[p].plane[3];
    const size_t first = lists->first[i];
    for (size_t f = first + lists->direct[i]; f < first + lists->count[i]; f++) {
        const sb_f4 slope = sb_slopes(&lists->four[f]) * sb_splat(lists->unit);
        for (size_t k = 0; k < 4; k++) {
            if (slope[k] == 0) continue;
            const uint32_t image = lists->four[f].place[k] / SB_PLACE_STEP - records;
            const sb_pull *pull = &pulls[image];
            if (pull->plane == SB_PLANES_SEVERAL) {
                react_several(sim, group, &sim->groups.image[group->image + image], slope[k], i, reactions);
                continue;
            }
            sb_reaction(reactions, pull->plane, slope[k] * (own + pull->q) * (above[pull->plane] + pull->above));
            if (pull->head == 0) continue;
            const sb_f4 place = place_of(&sim->groups.image[group->image + image]);
            sb_reaction_whole(reactions, pull->plane, (self - place) * sb_splat(slope[k] * pull->head));
        }
    }
}

void sb_react_images(const sb_sim *sim, const sb_group *group, uint32_t records, const sb_pull *pulls, size_t i,
                     sb_reactions *reactions, sb_body_forces *to)
{
    const double mass = (double)sim->constant.mass, hydrostatic = (double)sb_hydrostatic(sim);
    const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
    react_reflected(sim, group, records, pulls, i, reactions);
    sb_reactions_close(sim, sim->groups.plane + group->plane, at, reactions, to);
    for (uint32_t k = 0; k < sim->work.edge_pairs.count[i]; k++) {
        const sb_edge_pair *e = &sim->work.edge_pairs.pair[sim->work.edge_pairs.first[i] + k];
        const double q = (double)sim->work.unknown[i] + (double)sim->work.unknown[sb_entry_owner(sim, e->entry)];
        const sb_vec3 pull = sb_vec(q * (double)e->own[0] + hydrostatic * (double)e->head[0],
                                    q * (double)e->own[1] + hydrostatic * (double)e->head[1],
                                    q * (double)e->own[2] + hydrostatic * (double)e->head[2]);
        sb_body_forces_of_facet(sim, to, e->mirror, at, sb_scale(pull, mass), (sb_vec3){0});
    }
}
