#include "report/loads.h"

#include "base/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TIME, FX, FY, FZ, MX, MY };

static void raise_to(double *peak, double *time, double value, double now)
{
    if (!(value > *peak)) return;
    *peak = value;
    *time = now;
}

/* A row holds means over the interval that ends at its time. The first interval begins at 0. */
static void take_rows(const sb_series_table *table, sb_load *load)
{
    double sum[3] = {0}, before = 0;
    const sb_series *series = load->series;
    for (size_t row = 0; row < series->rows; row++) {
        const double *value = series->values + row * table->columns, horizontal = hypot(value[FX], value[FY]);
        if (horizontal > load->horizontal) memcpy(load->direction, value + FX, sizeof load->direction);
        raise_to(&load->horizontal, &load->horizontal_time, horizontal, value[TIME]);
        raise_to(&load->total, &load->total_time, hypot(horizontal, value[FZ]), value[TIME]);
        raise_to(&load->moment, &load->moment_time, hypot(value[MX], value[MY]), value[TIME]);
        load->up = fmax(load->up, value[FZ]);
        load->down = fmin(load->down, value[FZ]);
        for (int c = 0; c < 3; c++)
            if (!isnan(value[FX + c])) sum[c] += value[FX + c] * (value[TIME] - before);
        before = value[TIME];
    }
    load->impulse_horizontal = hypot(sum[0], sum[1]);
    load->impulse = hypot(load->impulse_horizontal, sum[2]);
}

static void take_trust(const json_t *bodies, sb_load *load)
{
    size_t i;
    json_t *body;
    load->layers = load->gap = NAN;
    json_array_foreach(bodies, i, body)
    {
        const char *name = json_string_value(json_object_get(body, "name"));
        if (!name || strcmp(name, load->name) != 0) continue;
        const json_t *point = json_object_get(body, "moment_point_m");
        load->judged = json_object_get(body, "too_coarse") != NULL;
        load->layers = sb_report_item_number(body, "flow_layers");
        load->gap = sb_report_item_number(body, "gap_m");
        load->coarse = json_is_true(json_object_get(body, "too_coarse"));
        load->narrow = json_is_true(json_object_get(body, "narrow_gap"));
        load->has_point = json_array_size(point) == 3;
        for (size_t c = 0; load->has_point && c < 3; c++) load->point[c] = json_number_value(json_array_get(point, c));
    }
}

static int by_load(const void *a, const void *b)
{
    const sb_load *one = a, *other = b;
    if (one->horizontal != other->horizontal) return one->horizontal > other->horizontal ? -1 : 1;
    if (one->total != other->total) return one->total > other->total ? -1 : 1;
    return strcmp(one->name, other->name);
}

sb_status sb_loads_make(const sb_report_run *run, sb_loads *loads, sb_error *error)
{
    const sb_series_table *table = &run->tables[SB_REPORT_FORCES];
    const json_t *bodies = json_object_get(run->summary, "bodies");
    *loads = (sb_loads){.loads = sb_alloc(table->count, sizeof *loads->loads)};
    if (!loads->loads) return sb_fail_memory(error, "the loads of a report");
    for (size_t i = 0; i < table->count; i++) {
        sb_load *load = &loads->loads[loads->count++];
        *load = (sb_load){.name = table->series[i].name, .series = &table->series[i]};
        take_rows(table, load);
        take_trust(bodies, load);
        loads->reached += load->total > 0;
    }
    qsort(loads->loads, loads->count, sizeof *loads->loads, by_load);
    return SB_OK;
}

void sb_loads_free(sb_loads *loads)
{
    sb_free(loads->loads);
    *loads = (sb_loads){0};
}

double sb_force_unit(double greatest, bool per_m, const char **name)
{
    const bool mega = greatest >= 1e7, kilo = greatest >= 1e3;
    *name = mega ? per_m ? "MN/m" : "MN" : kilo ? per_m ? "kN/m" : "kN" : per_m ? "N/m" : "N";
    return mega ? 1e-6 : kilo ? 1e-3 : 1;
}
