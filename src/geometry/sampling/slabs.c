/* Samples slab after slab, so that a particle depends only on what is near, and so that little is in memory at a time.

   In each stage the even slabs come first: no slab beside them is in this stage yet, so that they do not depend on each
   other. The odd ones then see what was placed beside them. A slab is begun as soon as those beside it have done what
   it sees, and is visited as soon as no other slab sees it any more.

   Voids are filled row after row of a slab: a surface that lies along a slab has many. */
#include "geometry/sampling/parts.h"

#include "base/memory.h"
#include "base/stop.h"

/* In spacings: width of a slab, length of a row of it, and distance of the first border from the domain's side less one
   width. The latter is no round number, so that no face of a usual scene lies in a border. */
static const double WIDTH = SB_SAMPLE_SLAB, LENGTH = 256, SHIFT = 1.888;

/* A stage of the turn `turn` is that of slab 2 turn - behind. Before it, the slabs beside this one have passed the
   stages that it needs, and no others. */
static const struct {
    uint32_t behind;
    int (*sample)(sb_sampler *);
} stages[] = {{0, sb_sample_lattices}, {1, sb_sample_lattices}, {2, sb_sample_grow},
              {3, sb_sample_grow},     {4, sb_sample_voids},    {5, sb_sample_voids}};
enum { STAGES = sizeof stages / sizeof *stages, BEHIND = 5 };

static sb_slabs across(const sb_sample_settings *settings, int axis, double width)
{
    const double length = sb_sample_along(sb_sub(settings->max, settings->min), axis);
    const double shift = SHIFT * settings->spacing, count = floor((length - shift) / (width * settings->spacing));
    return (sb_slabs){axis, sb_sample_along(settings->min, axis) + shift, width * settings->spacing,
                      count < 1                        ? 1
                      : count < (double)UINT32_MAX / 4 ? (uint32_t)count
                                                       : UINT32_MAX / 4};
}

int sb_sample_axis(sb_vec3 min, sb_vec3 max, int dimensions)
{
    const sb_vec3 size = sb_sub(max, min);
    const bool flat = dimensions == 2;
    return size.x >= size.z && (flat || size.x >= size.y) ? 0 : flat || size.z > size.y ? 2 : 1;
}

void sb_slabs_choose(const sb_sample_settings *settings, sb_slabs *slabs, sb_slabs *rows)
{
    const sb_vec3 size = sb_sub(settings->max, settings->min);
    const bool flat = settings->dimensions == 2;
    const int axis = sb_sample_axis(settings->min, settings->max, settings->dimensions);
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const bool first_wider = sb_sample_along(size, next) >= sb_sample_along(size, last);
    const int beside = flat ? 2 - axis : first_wider ? next : last;
    *slabs = across(settings, axis, WIDTH);
    *rows = across(settings, beside, LENGTH);
}

static void enter(sb_sampler *sampler, uint32_t slab)
{
    const sb_slabs *slabs = &sampler->slabs;
    sampler->slab = slab;
    sampler->low = slab == 0 ? -HUGE_VAL : slabs->from + slab * slabs->width;
    sampler->high = slab + 1 == slabs->count ? HUGE_VAL : slabs->from + (slab + 1) * slabs->width;
}

/* Visits the particles of a slab. */
static int visit_slab(const sb_sample_set *set, uint32_t slab, sb_slab_visit *visit, void *context)
{
    size_t count = 0;
    for (size_t i = 0; i < set->count; ++i) count += set->sample[i].slab == slab;
    sb_sample *found = sb_alloc_untouched(count, sizeof *found);
    if (!found) return -1;
    count = 0;
    for (size_t i = 0; i < set->count; ++i)
        if (set->sample[i].slab == slab) found[count++] = set->sample[i];
    const int failed = visit(context, found, count);
    sb_free(found);
    return failed;
}

/* Whether slabs in [first, last) depend on a stage of a slab. What a slab sees beside it has passed only earlier
   stages. */
static bool is_needed(uint32_t slab, int stage, uint32_t first, uint32_t last)
{
    const uint32_t beyond = slab < first ? first - slab : slab >= last ? slab - last + 1 : 0;
    return (uint32_t)stage + beyond <= BEHIND;
}

/* One turn: each stage of one slab. Two slabs are final after it. */
static int turn(sb_sampler *sampler, uint32_t now, uint32_t first, uint32_t last, sb_slab_visit *visit, void *context)
{
    for (int s = 0; s < STAGES; ++s) {
        if (2 * now < stages[s].behind || 2 * now - stages[s].behind >= sampler->slabs.count) continue;
        if (!is_needed(2 * now - stages[s].behind, s, first, last)) continue;
        enter(sampler, 2 * now - stages[s].behind);
        if (sb_stop_signal() || stages[s].sample(sampler)) return -1;
    }
    if (2 * now < BEHIND) return 0;
    const uint32_t end = 2 * now - BEHIND + 1;
    for (uint32_t slab = end - 2; slab < end; ++slab)
        if (slab >= first && slab < last && visit_slab(&sampler->set, slab, visit, context)) return -1;
    return sb_sample_set_keep(&sampler->set, end);
}

int sb_slabs_sample(sb_sampler *sampler, uint32_t first, uint32_t last, sb_slab_visit *visit, void *context)
{
    /* Slab k in its last stage depends on those up to BEHIND before and after it. */
    const uint32_t begin = first > BEHIND ? (first - BEHIND) / 2 : 0;
    int failed = 0;
    for (uint32_t now = begin; 2 * now < last + BEHIND + 1 && first < last && !failed; ++now)
        failed = turn(sampler, now, first, last, visit, context);
    sb_sample_set_free(&sampler->set);
    return failed;
}
