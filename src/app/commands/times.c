#include "app/commands/times.h"

#include <math.h>
#include <stdlib.h>

static sb_status choose_nearest(double time, const sb_particle_list *list, bool *chosen, sb_error *error)
{
    const sb_particle_entry *entries = list->entries;
    const size_t last = list->count - 1;
    const double before = last > 0 ? entries[1].time - entries[0].time : 0,
                 after = last > 0 ? entries[last].time - entries[last - 1].time : 0;
    size_t nearest = 0;
    if (time < entries[0].time - before || time > entries[last].time + after)
        return sb_fail(error, SB_BAD_INPUT, "--times %g: the particle files are from %g s to %g s", time,
                       entries[0].time, entries[last].time);
    for (size_t i = 1; i <= last; i++)
        if (fabs(entries[i].time - time) < fabs(entries[nearest].time - time)) nearest = i;
    chosen[nearest] = true;
    return SB_OK;
}

static sb_status choose_range(double from, double to, const sb_particle_list *list, bool *chosen, sb_error *error)
{
    bool any = false;
    for (size_t i = 0; i < list->count; i++)
        if (list->entries[i].time >= from && list->entries[i].time <= to) any = chosen[i] = true;
    if (any) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "--times %g:%g: no particle file has such a time; they are from %g s to %g s",
                   from, to, list->entries[0].time, list->entries[list->count - 1].time);
}

sb_status sb_times_choose(const char *text, const sb_particle_list *list, bool *chosen, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; i < list->count; i++) chosen[i] = !text;
    for (const char *at = text; at && status == SB_OK;) {
        char *end, *second;
        const double from = strtod(at, &end), to = *end == ':' ? strtod(end + 1, &second) : from;
        const bool range = *end == ':', empty = end == at || (range && second == end + 1);
        if (range) end = second;
        if (empty || (*end && *end != ',') || !isfinite(from) || !isfinite(to) || to < from)
            return sb_fail(error, SB_BAD_INPUT,
                           "--times %.200s: expected seconds and ranges FROM:TO, separated by commas", text);
        status = range ? choose_range(from, to, list, chosen, error) : choose_nearest(from, list, chosen, error);
        at = *end ? end + 1 : NULL;
    }
    return status;
}
