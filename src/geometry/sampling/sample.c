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
    sb_free(samples->slab);
    *samples = (sb_samples){0};
}

/* Whether a particle belongs to the domain. A particle beyond a periodic side is the image of a particle within the
   opposite side. */
static bool belongs(const sb_sample_settings *settings, sb_vec3 at)
{
    for (int axis = 0; axis < 3; ++axis)
        if (settings->repeats[axis] && !(sb_sample_beyond(settings, at, axis) < 0)) return false;
    return true;
}

/* Particles of one source. */
typedef struct share {
    size_t count, position_capacity, normal_capacity, slab_capacity;
    sb_vec3 *position, *normal;
    uint32_t *slab; /* NULL: all slabs are sampled */
} share;

/* What is collected of all groups. */
typedef struct collection {
    const sb_sampler *sampler;
    bool whole;           /* all slabs are sampled */
    uint32_t first, last; /* slabs of static surfaces that are sampled */
    share *shares;        /* per source */
    sb_sample_set moving; /* particles of all moving surfaces */
} collection;

static int add(const collection *all, const sb_sample *one)
{
    share *to = &all->shares[one->source];
    if (!all->whole && sb_grow((void **)&to->slab, &to->slab_capacity, to->count + 1, sizeof *to->slab)) return -1;
    if (sb_grow((void **)&to->position, &to->position_capacity, to->count + 1, sizeof *to->position) ||
        sb_grow((void **)&to->normal, &to->normal_capacity, to->count + 1, sizeof *to->normal))
        return -1;
    if (to->slab) to->slab[to->count] = one->slab;
    to->position[to->count] = one->at;
    to->normal[to->count++] = one->normal;
    return 0;
}

static void release(share *of)
{
    sb_free(of->position);
    sb_free(of->normal);
    sb_free(of->slab);
    *of = (share){.count = 0};
}

/* Keeps the particles that belong to the domain. */
static int keep(void *context, sb_sample *found, size_t count)
{
    collection *all = context;
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i)
        if (belongs(&all->sampler->settings, found[i].at)) found[kept++] = found[i];
    sb_sample_round_edges(all->sampler, found, kept);
    for (size_t i = 0; i < kept; ++i)
        if (sb_stop_signal() || add(all, &found[i])) return -1;
    return 0;
}

/* Collects particles of moving surfaces except duplicates. */
static int keep_moving(void *context, sb_sample *found, size_t count)
{
    collection *all = context;
    const double near = same_place * all->sampler->settings.spacing;
    for (size_t i = 0; i < count; ++i)
        if (sb_stop_signal() ||
            (!sb_sample_set_any(&all->moving, found[i].at, near) && sb_sample_set_add(&all->moving, &found[i])))
            return -1;
    return 0;
}

/* Samples slabs of the static surfaces together, then each moving surface alone and whole. */
static int sample_groups(sb_sampler *sampler, collection *all)
{
    sampler->moving = false;
    sampler->first = 0;
    sampler->last = (uint32_t)sampler->surface_count;
    int failed = sb_slabs_sample(sampler, all->first, all->last, keep, all);
    sampler->moving = true;
    for (uint32_t i = 0; i < sampler->surface_count && !failed; ++i) {
        sampler->first = i;
        sampler->last = i + 1;
        if (sb_sampler_takes(sampler, i)) failed = sb_slabs_sample(sampler, 0, sampler->slabs.count, keep_moving, all);
    }
    return failed || keep(all, all->moving.sample, all->moving.count);
}

/* Joins the particles of all sources, one source after another, and frees them. */
static int join(share *shares, size_t source_count, bool whole, sb_samples *out)
{
    *out = (sb_samples){.source_count = source_count, .begin = sb_alloc(source_count + 1, sizeof *out->begin)};
    if (!out->begin) return -1;
    for (size_t s = 0; s < source_count; ++s) out->begin[s + 1] = out->count += shares[s].count;
    out->position = sb_alloc_untouched(out->count, sizeof *out->position);
    out->normal = sb_alloc_untouched(out->count, sizeof *out->normal);
    if (!whole) out->slab = sb_alloc_untouched(out->count, sizeof *out->slab);
    if (!out->position || !out->normal || (!whole && !out->slab)) {
        sb_samples_free(out);
        return -1;
    }
    for (size_t s = 0; s < source_count; ++s) {
        if (shares[s].count == 0) continue;
        memcpy(out->position + out->begin[s], shares[s].position, shares[s].count * sizeof *out->position);
        memcpy(out->normal + out->begin[s], shares[s].normal, shares[s].count * sizeof *out->normal);
        if (!whole) memcpy(out->slab + out->begin[s], shares[s].slab, shares[s].count * sizeof *out->slab);
        release(&shares[s]);
    }
    return 0;
}

/* Samples the slabs [first, last) of static sources; whole: all of them. */
static sb_status sample(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count, bool whole,
                        uint32_t first, uint32_t last, sb_samples *samples, sb_error *error)
{
    sb_sampler sampler = {.settings = *settings};
    /* With cells of one spacing, a query searches at most 27 cells, because its radius is smaller than a spacing. */
    const sb_sample_set none = {.cell = settings->spacing, .origin = settings->min};
    collection all = {
        .sampler = &sampler, .whole = whole, .shares = sb_alloc(count, sizeof *all.shares), .moving = none};
    sb_samples made = {0};
    sb_status status = SB_OK;
    sampler.set = none;
    sb_slabs_choose(settings, &sampler.slabs, &sampler.rows);
    all.first = whole ? 0 : first;
    all.last = whole ? sampler.slabs.count : last;
    sampler.surfaces = sb_alloc(count, sizeof *sampler.surfaces);
    if (!sampler.surfaces || !all.shares) status = sb_fail_memory(error, "the sampling of surfaces");
    for (size_t i = 0; i < count && status == SB_OK; ++i) {
        status = sb_surface_build(sources + i, settings, sampler.surfaces + i, error);
        sampler.surface_count += status == SB_OK;
    }
    if (status == SB_OK && (sample_groups(&sampler, &all) || sb_stop_signal() || join(all.shares, count, whole, &made)))
        status = sb_fail_memory(error, "boundary particles");
    if (status == SB_OK) *samples = made;
    for (size_t i = 0; i < sampler.surface_count; ++i) sb_surface_free(sampler.surfaces + i);
    for (size_t i = 0; all.shares && i < count; ++i) release(&all.shares[i]);
    sb_free(sampler.surfaces);
    sb_free(all.shares);
    sb_sample_set_free(&all.moving);
    return status;
}

sb_status sb_sample_surfaces(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                             sb_samples *samples, sb_error *error)
{
    return sample(settings, sources, count, true, 0, 0, samples, error);
}

sb_status sb_sample_slabs(const sb_sample_settings *settings, const sb_sample_source *sources, size_t count,
                          uint32_t first, uint32_t last, sb_samples *samples, sb_error *error)
{
    return sample(settings, sources, count, false, first, last, samples, error);
}
