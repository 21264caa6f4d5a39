/* Forces on bodies and elevations at gauges. */
#include "panel.h"
#include "text.h"

#include <stdio.h>

enum { NUMBER = 10, SPARK_MIN = 6 };

/* The columns of a table of this width: name, sparkline, numbers. Numbers that do not fit are left out, the last ones
   first. */
typedef struct columns {
    int name, spark, numbers;
} columns;

static columns choose(int width, const int *allowed)
{
    columns made = {.name = width >= 60 ? 20 : 11};
    const int room = width - made.name - 1 - SPARK_MIN;
    for (; *allowed; allowed++) {
        made.numbers = *allowed;
        if (*allowed * (NUMBER + 1) <= room) break;
    }
    made.spark = width - made.name - made.numbers * (NUMBER + 1) - 1;
    if (made.spark > SB_HISTORY) made.spark = SB_HISTORY;
    if (made.spark < SPARK_MIN) made.spark = -1; /* no sparkline and no gap before it */
    return made;
}

static void put_name(sb_strip *strip, const columns *set, const char *name)
{
    sb_strip_left(strip, SB_STYLE_PLAIN, set->name, 1, name);
}

static void put_heads(sb_strip strip, const columns *set, const char *first, const char *course,
                      const char *const *heads)
{
    sb_strip_left(&strip, SB_STYLE_BOLD, set->name, 1, first);
    if (set->spark > 0) sb_strip_left(&strip, SB_STYLE_BOLD, set->spark, 0, course);
    for (int i = 0; i < set->numbers; i++) {
        sb_strip_left(&strip, SB_STYLE_PLAIN, 1, 0, "");
        sb_strip_right(&strip, SB_STYLE_BOLD, NUMBER, 0, heads[i]);
    }
}

static void put_number(sb_strip *strip, double value, bool sign)
{
    char text[40];
    sb_text_number(text, sizeof text, value, sign);
    sb_strip_left(strip, SB_STYLE_PLAIN, 1, 0, "");
    sb_strip_right(strip, SB_STYLE_PLAIN, NUMBER, 0, text);
}

/* ---- forces ---- */

static const int force_numbers[] = {6, 3, 2, 0}; /* |Fxy|, peak, time of the peak, Fx, Fy, Fz */

static size_t count_forces(const sb_monitor_state *state)
{
    return state->body_count;
}

static void head_forces(sb_strip strip, const sb_monitor_state *state)
{
    const columns set = choose(strip.width, force_numbers);
    char force[24];
    snprintf(force, sizeof force, "|Fxy| %s%s", sb_text_force_unit(state->peak).name, state->per_metre ? "/m" : "");
    const char *heads[] = {force, "peak", "at t [s]", "Fx", "Fy", "Fz"};
    put_heads(strip, &set, "body", "so far", heads);
}

static void row_forces(sb_strip strip, const sb_monitor_state *state, size_t index)
{
    const columns set = choose(strip.width, force_numbers);
    const sb_monitor_body *body = &state->bodies[index];
    const double unit = sb_text_force_unit(state->peak).size;
    put_name(&strip, &set, body->name);
    if (body->course.count == 0) return; /* its message was lost */
    if (set.spark > 0) sb_strip_spark(&strip, set.spark, 0, &body->course, 0, body->peak);
    const double values[] = {body->horizontal / unit, body->peak / unit,     body->peak_time,
                             body->force[0] / unit,   body->force[1] / unit, body->force[2] / unit};
    for (int i = 0; i < set.numbers; i++) put_number(&strip, values[i], i >= 3);
}

static void remark_forces(char *out, size_t size, const sb_monitor_state *state)
{
    if (state->has_forces) snprintf(out, size, "peaks since %.4g s", state->forces_since);
}

const sb_panel sb_panel_forces = {
    "Forces", count_forces, head_forces, row_forces, remark_forces, "no forces yet",
};

/* ---- gauges ---- */

static const int gauge_numbers[] = {4, 2, 1, 0}; /* eta, z, lowest and highest eta */

static size_t count_gauges(const sb_monitor_state *state)
{
    return state->gauge_count;
}

static void head_gauges(sb_strip strip, const sb_monitor_state *state)
{
    (void)state;
    const columns set = choose(strip.width, gauge_numbers);
    static const char *const heads[] = {"eta [m]", "z [m]", "lowest", "highest"};
    put_heads(strip, &set, "gauge", "so far", heads);
}

static void row_gauges(sb_strip strip, const sb_monitor_state *state, size_t index)
{
    const columns set = choose(strip.width, gauge_numbers);
    const sb_monitor_gauge *gauge = &state->gauges[index];
    put_name(&strip, &set, gauge->name);
    if (set.spark > 0) sb_strip_spark(&strip, set.spark, 0, &gauge->course, gauge->eta_low, gauge->eta_high);
    const double values[] = {gauge->eta, gauge->z, gauge->eta_low, gauge->eta_high};
    for (int i = 0; i < set.numbers; i++) {
        if (i < 2 ? gauge->wet : gauge->seen) {
            put_number(&strip, values[i], i != 1);
            continue;
        }
        sb_strip_left(&strip, SB_STYLE_PLAIN, 1, 0, "");
        sb_strip_right(&strip, SB_STYLE_DIM, NUMBER, 0, i == 0 ? "dry" : "-");
    }
}

const sb_panel sb_panel_gauges = {
    "Gauges", count_gauges, head_gauges, row_gauges, NULL, "no gauges yet",
};
