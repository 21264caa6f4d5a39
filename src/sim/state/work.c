#include "sim/state/work.h"

#include "base/memory.h"

#include <assert.h>
#include <string.h>

#define VIEW(member) .pointer = offsetof(sb_work, member), .size = sizeof *((sb_work *)0)->member
#define WORK(member) #member, VIEW(member)
#define FROM(phase, end) .first = SB_PHASE_##phase, .last = SB_PHASE_##end

const sb_work_view sb_work_views[] = {
    {WORK(sort_words), FROM(SORT, SORT), .unit = "", .needed = SB_ALWAYS},
    {WORK(sort_other), FROM(SORT, SORT), .unit = "", .needed = SB_ALWAYS},
    {WORK(sorted), FROM(SORT, SORT), .unit = "", .needed = SB_ALWAYS},
    {WORK(images), FROM(GHOSTS, GHOSTS), .unit = "quanta", .ghosts = true, .needed = SB_ALWAYS},
    {"water_lists", VIEW(pairs.first), FROM(NEIGHBOURS, AFTER), .unit = "", .needed = SB_ALWAYS},
    {"water_counts", VIEW(pairs.count), FROM(NEIGHBOURS, AFTER), .unit = "", .needed = SB_ALWAYS},
    {"water_direct", VIEW(pairs.direct), FROM(NEIGHBOURS, AFTER), .unit = "", .needed = SB_NEEDS(images)},
    {"wall_lists", VIEW(wall_pairs.first), FROM(NEIGHBOURS, AFTER), .unit = "", .needed = SB_NEEDS(wall_lists)},
    {"wall_counts", VIEW(wall_pairs.count), FROM(NEIGHBOURS, AFTER), .unit = "", .needed = SB_NEEDS(wall_lists)},
    {"edge_lists", VIEW(edge_pairs.first), FROM(NEIGHBOURS, AFTER), .unit = "", .needed = SB_NEEDS(images)},
    {"edge_counts", VIEW(edge_pairs.count), FROM(NEIGHBOURS, AFTER), .unit = "", .needed = SB_NEEDS(images)},
    {WORK(wall), FROM(NEIGHBOURS, FOAM), .unit = "kg/m^4", .needed = SB_NEEDS(wall_lists)},
    {WORK(flux), FROM(NEIGHBOURS, PRESSURE), .unit = "kg/m^3/s", .needed = SB_NEEDS(images)},
    {WORK(image_push), FROM(NEIGHBOURS, FORCES), .unit = "m/s^2", .needed = SB_NEEDS(images)},
    {WORK(density), FROM(NEIGHBOURS, AFTER), .unit = "kg/m^3", .needed = SB_ALWAYS},
    {WORK(water_squared), FROM(NEIGHBOURS, DENSITY_CORRECTION), .unit = "kg^2/m^8",
     .needed = SB_NEEDS(density_correction)},
    {WORK(diagonal), FROM(NEIGHBOURS, AFTER), .unit = "kg^2 s^2/m^8", .needed = SB_ALWAYS},
    {WORK(last_unknown), FROM(DEVIATOR, DEVIATOR), .unit = "Pa m^6/kg^2", .needed = SB_NEEDS(stress_correction)},
    {WORK(strained), FROM(STRAIN, STRAIN), .unit = "kg/m^3/s", .needed = SB_NEEDS(packing_strain)},
    {WORK(deviator_xx), FROM(STRAIN, STRESS), .unit = "Pa m^6/kg^2", .needed = SB_NEEDS(stress_correction)},
    {WORK(deviator), FROM(STRAIN, STRESS), .unit = "Pa m^6/kg^2", .ghosts = true,
     .needed = SB_NEEDS(stress_correction)},
    {WORK(stress_xx), FROM(STRAIN, CORRECTED), .unit = "Pa m^6/kg^2", .needed = SB_NEEDS(stress_correction)},
    {WORK(stress), FROM(STRAIN, CORRECTED), .unit = "Pa m^6/kg^2", .ghosts = true,
     .needed = SB_NEEDS(stress_correction)},
    /* Nothing reads ghosts of it: so it is where the deviators were. */
    {WORK(corrected), FROM(CORRECTED, CORRECTED), .unit = "m/s", .ghosts = true, .needed = SB_NEEDS(stress_correction)},
    {WORK(eddy), FROM(TURBULENCE, FORCES), .unit = "m^2/s", .ghosts = true, .needed = SB_NEEDS(eddy)},
    {WORK(wall_drag), FROM(FORCES, IMPULSE), .unit = "m/s^2", .replaces = "image_push", .needed = SB_NEEDS(wall_drag)},
    {WORK(wall_body), FROM(FORCES, IMPULSE), .unit = "", .needed = SB_NEEDS(wall_body)},
    {WORK(pull), FROM(FORCES, MOVE), .unit = "m/s^2", .needed = SB_NEEDS(surface_tension)},
    {WORK(differences), FROM(FORCES, FORCES), .unit = "m/s", .ghosts = true, .needed = SB_NEEDS(hyperviscosity)},
    {WORK(predicted), FROM(FORCES, MOVE), .unit = "m/s", .ghosts = true, .needed = SB_ALWAYS},
    {WORK(source), FROM(SOURCE, PRESSURE), .unit = "kg/m^3", .needed = SB_NEEDS(implicit)},
    {WORK(rate), FROM(PRESSURE, MOVE), .unit = "kg/m^3/s", .needed = SB_NEEDS(wcsph)},
    {WORK(unknown), FROM(PRESSURE, AFTER), .unit = "Pa m^6/kg^2", .needed = SB_ALWAYS},
    {WORK(residual), FROM(PRESSURE, PRESSURE), .unit = "kg/m^3", .needed = SB_NEEDS(implicit)},
    {WORK(direction), FROM(PRESSURE, PRESSURE), .unit = "Pa m^6/kg^2", .replaces = "flux",
     .needed = SB_NEEDS(direction)},
    {WORK(product), FROM(PRESSURE, PRESSURE), .unit = "kg/m^3", .needed = SB_NEEDS(product)},
    {WORK(acceleration), FROM(PRESSURE, ACCELERATE), .unit = "m/s^2", .ghosts = true, .needed = SB_ALWAYS},
    {WORK(unknown_ahead), FROM(PRESSURE, AFTER), .unit = "Pa m^6/kg^2", .needed = SB_NEEDS(ahead)},
    {WORK(acceleration_ahead), FROM(PRESSURE, ACCELERATE), .unit = "m/s^2", .ghosts = true, .needed = SB_NEEDS(ahead)},
    {WORK(end_velocity), FROM(ACCELERATE, MOVE), .unit = "m/s", .ghosts = true, .replaces = "acceleration",
     .needed = SB_ALWAYS},
    {WORK(surface), FROM(FOAM, FOAM), .unit = "1", .ghosts = true, .needed = SB_NEEDS(foam)},
    {WORK(emission), FROM(FOAM, FOAM), .unit = "", .needed = SB_NEEDS(foam)},
    {WORK(virial), FROM(AFTER, AFTER), .unit = "Pa", .needed = SB_ALWAYS},
    {.name = NULL},
};

enum { VIEWS = sizeof sb_work_views / sizeof sb_work_views[0] - 1, LANES = 32 /* entries: 64 bytes of the smallest */ };

/* Place of a view: bytes per entry before it in its part of the block. */
typedef struct place {
    const sb_work_view *view;
    size_t at;
} place;

static bool lives_with(const sb_work_view *a, const sb_work_view *b)
{
    return a->ghosts == b->ghosts && a->first <= b->last && b->first <= a->last;
}

/* The first place where the view fits beside those placed already. */
static size_t fit(const place *placed, size_t count, const sb_work_view *view)
{
    size_t at = 0;
    for (size_t k = 0; k < count; k++) {
        if (view->replaces && strcmp(placed[k].view->name, view->replaces) == 0) return placed[k].at;
        const bool apart = at >= placed[k].at + placed[k].view->size || at + view->size <= placed[k].at;
        if (apart || !lives_with(placed[k].view, view)) continue;
        at = placed[k].at + placed[k].view->size;
        k = (size_t)-1; /* look at all again */
    }
    return at;
}

/* Places the views that the scene needs, and the one named `also`, the largest first. Returns their number. */
static size_t place_all(const sb_needs *needs, const char *also, place placed[VIEWS])
{
    size_t count = 0;
    for (size_t size = 16; size > 0; size /= 2)
        for (const sb_work_view *v = sb_work_views; v->name; v++)
            if (v->size == size && (sb_needed(needs, v->needed) || (also && strcmp(v->name, also) == 0))) {
                const size_t at = fit(placed, count, v);
                placed[count++] = (place){v, at};
            }
    return count;
}

/* Bytes per entry of a part of the block. */
static size_t extent(const place *placed, size_t count, bool ghosts)
{
    size_t end = 0;
    for (size_t k = 0; k < count; k++)
        if (placed[k].view->ghosts == ghosts && placed[k].at + placed[k].view->size > end)
            end = placed[k].at + placed[k].view->size;
    return end;
}

size_t sb_work_cost(const sb_needs *needs, const char *name)
{
    place placed[VIEWS];
    size_t bytes[2];
    for (int with = 0; with < 2; with++) {
        const size_t count = place_all(needs, with ? name : NULL, placed);
        bytes[with] = extent(placed, count, false) + extent(placed, count, true);
    }
    return bytes[1] - bytes[0];
}

static void set_pointer(sb_work *work, const sb_work_view *view, void *entries)
{
    memcpy((char *)work + view->pointer, &entries, sizeof entries);
}

int sb_work_create(sb_work *work, const sb_needs *needs, size_t owned, size_t capacity)
{
    enum { ALIGNMENT = 64 };
    place placed[VIEWS];
    const size_t count = place_all(needs, NULL, placed);
    const size_t few = (owned + LANES - 1) / LANES * LANES, many = (capacity + LANES - 1) / LANES * LANES;
    const size_t first_part = extent(placed, count, false) * few;
    sb_work_destroy(work);
    work->owned = owned;
    work->capacity = capacity;
    work->bytes = first_part + extent(placed, count, true) * many + ALIGNMENT;
    work->block = sb_alloc(work->bytes, 1);
    if (!work->block) return -1;
    char *base = work->block;
    base += (ALIGNMENT - (uintptr_t)base % ALIGNMENT) % ALIGNMENT;
    for (size_t k = 0; k < count; k++) {
        const sb_work_view *v = placed[k].view;
        set_pointer(work, v, base + (v->ghosts ? first_part + placed[k].at * many : placed[k].at * few));
    }
    return 0;
}

void sb_work_destroy(sb_work *work)
{
    for (const sb_work_view *v = sb_work_views; v->name; v++) set_pointer(work, v, NULL);
    sb_free(work->block);
    sb_free(work->cell_sum);
    sb_free(work->node);
    work->block = NULL;
    work->cell_sum = NULL;
    work->cell_sum_capacity = 0;
    work->node = NULL;
    work->node_capacity = 0;
    work->bytes = 0;
}

#ifdef SB_DEBUG
void sb_work_enter(sb_work *work, sb_phase phase)
{
    for (const sb_work_view *v = sb_work_views; v->name; v++) {
        void *entries;
        memcpy(&entries, (const char *)work + v->pointer, sizeof entries);
        const size_t count = v->ghosts ? work->capacity : work->owned;
        if (entries && v->first == phase && !v->replaces) memset(entries, 0xff, count * v->size);
    }
}
#endif
