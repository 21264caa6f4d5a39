#include "cost.h"

#include "summary_text.h"

#include <math.h>
#include <string.h>

/* Adds the time of one stage to its part of the cost. */
static void sort_in(sb_cost *cost, const char *name, double seconds)
{
    if (strncmp(name, "pressure\"", 9) == 0)
        cost->pressure += seconds;
    else if (strncmp(name, "neighbours\"", 11) == 0)
        cost->query += seconds;
    else if (strncmp(name, "sort\"", 5) == 0 || strncmp(name, "ghosts\"", 7) == 0)
        cost->structure += seconds;
    else
        cost->advection += seconds;
}

sb_status sb_cost_read(const char *summary, sb_cost *cost, sb_error *error)
{
    static const char name[] = "\"name\": \"";
    const char *stages = strstr(summary, "\"stages\": [");
    *cost = (sb_cost){.fluid = sb_json_number_in(summary, "fluid_particles"),
                      .boundary = sb_json_number_in(summary, "boundary_particles"),
                      .threads = sb_json_number_in(summary, "threads"),
                      .steps = sb_json_number_in(summary, "steps"),
                      .simulated = sb_json_number_in(summary, "simulated_s"),
                      .sweeps = sb_json_number_in(summary, "mean_iterations"),
                      .setup = sb_json_number_in(summary, "wall_setup_s"),
                      .settling = sb_json_number_in(summary, "wall_settling_s")};
    if (cost->settling < 1e-3) cost->settling = 0; /* no settling: the rest is the resolution of the clock */
    const char *end = stages ? strchr(stages, ']') : NULL;
    if (!end) return sb_fail(error, SB_BAD_INPUT, "summary.json: no list of stages");
    for (const char *at = strstr(stages, name); at && at < end; at = strstr(at + 1, name))
        sort_in(cost, at + sizeof name - 1,
                sb_json_number_in(at, "seconds") - sb_json_number_in(at, "settling_seconds"));
    cost->total = cost->structure + cost->query + cost->advection + cost->pressure;
    cost->other = sb_json_number_in(summary, "wall_s") - cost->settling - cost->total;
    return SB_OK;
}

double sb_cost_per_particle_step(double seconds, double fluid, double steps)
{
    return 1e9 * seconds / (fluid * steps);
}

sb_cost sb_cost_extrapolate(const sb_cost *some, double steps, double sweeps)
{
    const double more = steps / some->steps, swept = more * sweeps / some->sweeps;
    sb_cost whole = *some;
    whole.steps = steps;
    whole.sweeps = sweeps;
    whole.simulated *= more;
    whole.structure *= more;
    whole.query *= more;
    whole.advection *= more;
    whole.pressure *= swept;
    whole.total = whole.structure + whole.query + whole.advection + whole.pressure;
    return whole;
}
