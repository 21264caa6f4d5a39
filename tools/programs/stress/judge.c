#include "stress.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void add(char *text, size_t size, const char *between, const char *format, va_list arguments)
{
    size_t length = strlen(text);
    if (length) length += (size_t)snprintf(text + length, size - length, "%s", between);
    if (length < size) vsnprintf(text + length, size - length, format, arguments);
}

void sb_require(sb_judged *judged, bool holds, const char *why, ...)
{
    if (holds) return;
    judged->fails = true;
    va_list arguments;
    va_start(arguments, why);
    add(judged->why, sizeof judged->why, "; ", why, arguments);
    va_end(arguments);
}

void sb_note(sb_judged *judged, const char *figure, ...)
{
    va_list arguments;
    va_start(arguments, figure);
    add(judged->figure, sizeof judged->figure, ", ", figure, arguments);
    va_end(arguments);
}

const sb_judged *sb_judged_find(const sb_judged *judged, const char *name)
{
    for (const sb_judged *j = judged->all; j < judged->all + judged->count; j++)
        if (strcmp(j->trial->name, name) == 0 && j->outcome.there) return j;
    return NULL;
}

sb_spread sb_judged_spread(const sb_judged *judged, const char *prefix, double (*value)(const sb_judged *judged))
{
    sb_spread spread = sb_spread_none;
    for (const sb_judged *j = judged->all; j < judged->all + judged->count; j++)
        if (j->outcome.there && strncmp(j->trial->name, prefix, strlen(prefix)) == 0) sb_spread_add(&spread, value(j));
    return spread;
}

double sb_energy_of(const sb_judged *judged, bool end)
{
    const char *at = end ? "energy_end" : "energy_start";
    return sb_outcome_number_in(&judged->outcome, at, "kinetic_J") +
           sb_outcome_number_in(&judged->outcome, at, "potential_J");
}

static void judge_end(sb_judged *judged)
{
    const sb_outcome *o = &judged->outcome;
    sb_require(judged, o->how & judged->trial->ends, "%s: %.200s", o->ended, o->last_line);
    /* A refusal or failure gives its reason in one line. */
    if (o->how & (SB_ENDS_REFUSED | SB_ENDS_FAILED))
        sb_require(judged, strncmp(o->last_line, "shorebreak: ", 12) == 0 && strlen(o->last_line) > 20,
                   "no reason given: \"%.100s\"", o->last_line);
    sb_require(judged, !o->not_a_number[0], "not a number in %s", o->not_a_number);
}

/* By the mass of the water, all particles that were not counted as having left must remain. */
static void judge_count(sb_judged *judged)
{
    const sb_outcome *o = &judged->outcome;
    const double all = sb_outcome_number(o, "fluid_particles"), left = sb_outcome_number(o, "left_domain");
    const double lost = sb_outcome_number(o, "lost_particles");
    const double first = sb_outcome_number_in(o, "energy_start", "mass_kg");
    const double last = sb_outcome_number_in(o, "energy_end", "mass_kg");
    if (!(all > 0 && first > 0)) return;
    sb_require(judged, lost <= judged->trial->may_lose * all, "%g particles lost", lost);
    if (lost > 0) sb_note(judged, "%g particles lost", lost);
    /* Particles that left before t = 0 are in neither mass, but the number at t = 0 must be whole. */
    const double now = all - left - lost, began = last > 0 ? now * first / last : now;
    sb_require(judged, (now > 0) == (last > 0) && fabs(began - round(began)) < 1e-6 * all && began < all + 0.5,
               "particles unaccounted for: %g of %g left, %g lost, %.9g kg remain of %.9g", left, all, lost, last,
               first);
    if (left > 0) sb_note(judged, "%g particles left the domain", left);
}

/* Largest energy that the contact resolution may add, as a fraction of the energy at the start: the error of assigning
   a step's work to its terms. */
static const double contact_gain = 1e-4;

static void judge_contact(sb_judged *judged)
{
    const sb_outcome *o = &judged->outcome;
    const double start =
        sb_outcome_number_in(o, "energy_start", "kinetic_J") + sb_outcome_number_in(o, "energy_start", "potential_J");
    const double contact = sb_outcome_number_in(o, "energy_work", "contact_J");
    sb_require(judged, !(contact > contact_gain * start), "contact with walls adds %.2g of the energy at the start",
               contact / start);
}

void sb_judge_common(sb_judged *judged)
{
    const sb_outcome *o = &judged->outcome;
    judge_end(judged);
    if (judged->trial->kind == SB_TRIAL_CHECK || o->how == SB_ENDS_REFUSED) return;
    if (!o->summary) {
        sb_require(judged, o->how != SB_ENDS_WELL, "no summary.json");
        return;
    }
    const double through = sb_outcome_number(o, "through_walls"),
                 unreported = sb_outcome_number(o, "unreported_solves");
    const double bad = sb_outcome_number(o, "not_finite");
    sb_require(judged, through == 0, "%g particles through walls", through);
    sb_require(judged, !(unreported > 0), "%g solves stopped above their tolerance unreported", unreported);
    sb_require(judged, !(bad > 0), "%g numbers not finite", bad);
    judge_count(judged);
    judge_contact(judged);
}
