/* Samples surfaces as boundary particles: all static surfaces together, then each moving one alone. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

#include <string.h>

/* In spacings: a particle of a moving body this near to one of another moving body is a duplicate. A particle of a
   moving body at the place of a static one is kept, because it moves away and takes the water along. */
static const double same_place = 1e-3;

void sb_samples_free(sb_samples *samples)
{
    if (!samples) return;
    sb_free(samples->begin);
    sb_free(samples->position);
    sb_free(samples->normal);
    *samples = (sb_samples){0};
}

/* Samples the current group into sampler->set. */
static int sample_group(sb_sampler *sampler)
{
    return sb_sample_lattices(sampler) || sb_sample_grow(sampler) || sb_sample_voids(sampler);
}

/* Appends the group's particles except duplicates of earlier ones. near: distance of duplicates, m; 0: keep all. */
static int collect(sb_sample_set *found, double near, sb_sample_set *all)
{
    for (size_t i = 0; i < found->count; ++i)
        if (sb_stop_signal() || (!(near > 0 && sb_sample_set_any(all, found->sample[i].at, near)) &&
                                 sb_sample_set_add(all, found->sample + i)))
            return -1;
    sb_sample_set_free(found);
    return 0;
}

/* Samples the static surfaces together, then each moving surface alone. */
static int sample_groups(sb_sampler *sampler, sb_sample_set *all)
{
    sampler->moving = false;
    sampler->first = 0;
    sampler->last = (uint32_t)sampler->surface_count;
    sampler->set = *all;
    int failed = sample_group(sampler);
    *all = sampler->set;
    sampler->set = (sb_sample_set){.cell = all->cell, .origin = all->origin};
    sampler->moving = true;
    sb_sample_set moving = {.cell = all->cell, .origin = all->origin};
    for (uint32_t i = 0; i < sampler->surface_count && !failed; ++i) {
        sampler->first = i;
        sampler->last = i + 1;
        if (sb_sampler_takes(sampler, i))
            failed = sample_group(sampler) || collect(&sampler->set, same_place * sampler->settings.spacing, &moving);
    }
    failed = failed || collect(&moving, 0, all);
    sb_sample_set_free(&moving);
    return failed;
}

/* Whether a particle belongs to the domain. A particle beyond a periodic side is the image of a particle within the
   opposite side. */
static bool belongs(const sb_sample_settings *settings, sb_vec3 at)
{
    for (int axis = 0; axis < 3; ++axis)
        if (settings->repeats[axis] && !(sb_sample_beyond(settings, at, axis) < 0)) return false;
    return true;
}

/* Removes the particles that do not belong to the domain. */
static void clip(const sb_sample_settings *settings, sb_sample_set *all)
{
    size_t kept = 0;
    for (size_t i = 0; i < all->count; ++i)
        if (belongs(settings, all->sample[i].at)) all->sample[kept++] = all->sample[i];
    all->count = kept;
}

/* Sorts the particles by source. Those of one source stay in the order in which they were found. */
static int sort_out(const sb_sample_set *all, size_t source_count, sb_samples *out)
{
    *out = (sb_samples){.count = all->count, .source_count = source_count};
    out->begin = sb_alloc(source_count + 2, sizeof *out->begin);
    out->position = sb_alloc_untouched(all->count, sizeof *out->position);
    out->normal = sb_alloc_untouched(all->count, sizeof *out->normal);
    if (!out->begin || !out->position || !out->normal) {
        sb_samples_free(out);
        return -1;
    }
    for (size_t i = 0; i < all->count; ++i) ++out->begin[all->sample[i].source + 2];
    for (size_t s = 2; s <= source_count; ++s) out->begin[s] += out->begin[s - 1];
    for (size_t i = 0; i < all->count; ++i) {
        size_t at = out->begin[all->sample[i].source + 1]++;
        out->position[at] = all->sample[i].at;
        out->normal[at] = all->sample[i].normal;
    }
    return 0;
}

sb_status sb_sample_surfaces(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                             sb_samples *samples, sb_error *error)
{
    sb_sampler sampler = {.settings = *settings};
    /* With cells of one spacing, a query searches at most 27 cells, because its radius is smaller than a spacing. */
    sb_sample_set all = {.cell = settings->spacing, .origin = settings->min};
    sampler.set = all;
    sb_samples made = {0};
    sb_status status = SB_OK;
    sampler.surfaces = sb_alloc(count, sizeof *sampler.surfaces);
    if (!sampler.surfaces) return sb_fail_memory(error, "the sampling of surfaces");
    for (size_t i = 0; i < count && status == SB_OK; ++i) {
        status = sb_surface_build(sources + i, settings, sampler.surfaces + i, error);
        sampler.surface_count += status == SB_OK;
    }
    int failed = status == SB_OK && sample_groups(&sampler, &all);
    if (status == SB_OK && !failed) {
        clip(settings, &all); /* the set is not searched afterwards */
        sb_sample_round_edges(&sampler, &all);
        failed = sb_stop_signal() || sort_out(&all, count, &made);
    }
    if (failed) status = sb_fail_memory(error, "boundary particles");
    if (status == SB_OK) *samples = made;
    for (size_t i = 0; i < sampler.surface_count; ++i) sb_surface_free(sampler.surfaces + i);
    sb_free(sampler.surfaces);
    sb_sample_set_free(&sampler.set);
    sb_sample_set_free(&all);
    return status;
}
