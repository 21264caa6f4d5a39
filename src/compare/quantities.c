#include "compare/quantities.h"

#include "base/memory.h"
#include "compare/near_body.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const sb_item_row sb_item_rows[SB_ITEM_KINDS] = {
    [SB_ITEM_BODY] = {"body",
                      "Loads on bodies",
                      {{"force", "Horizontal force", "N", SB_OF_FORCE},
                       {"force_time", "at", "s", SB_OF_TIME},
                       {"impulse", "Impulse", "N s", SB_OF_FORCE},
                       {"moment", "Overturning moment", "N m", SB_OF_FORCE},
                       {"depth", "Greatest depth in front", "m", SB_OF_LENGTH},
                       {"first_wet", "First wet", "s", SB_OF_TIME}}},
    [SB_ITEM_GAUGE] = {"gauge",
                       "Water level at gauges",
                       {{"surface", "Highest, z", "m", SB_OF_LENGTH}, {"surface_time", "at", "s", SB_OF_TIME}}},
    [SB_ITEM_RUNUP] = {"line",
                       "Run-up",
                       {{"runup", "Highest run-up, z", "m", SB_OF_LENGTH},
                        {"runup_time", "at", "s", SB_OF_TIME},
                        {"front", "Farthest front along the line", "m", SB_OF_LENGTH}}},
    [SB_ITEM_PLANE] = {"plane",
                       "Overtopping",
                       {{"volume", "Greatest net volume", "m³", SB_OF_VOLUME},
                        {"volume_end", "Net volume at the end", "m³", SB_OF_VOLUME}}},
    [SB_ITEM_MAP] = {"map",
                     "Flooded ground",
                     {{"flooded_area", "Area that was dry at the start", "m²", SB_OF_AREA},
                      {"flooded_depth", "Greatest depth on it", "m", SB_OF_LENGTH}}},
};

static const sb_report_table table_of[] = {[SB_ITEM_BODY] = SB_REPORT_FORCES,
                                           [SB_ITEM_GAUGE] = SB_REPORT_GAUGES,
                                           [SB_ITEM_RUNUP] = SB_REPORT_RUNUP,
                                           [SB_ITEM_PLANE] = SB_REPORT_OVERTOPPING};

/* ---- values of one run ---- */

/* The greatest value of a column, and its time; NaN: there is none. */
static void greatest(const sb_series_table *table, const sb_series *series, size_t column, double *most, double *time)
{
    *most = *time = NAN;
    for (size_t row = 0; row < series->rows; row++) {
        const double value = sb_series_table_value(table, series, row, column);
        if (isnan(value) || value <= *most) continue;
        *most = value;
        *time = sb_series_table_value(table, series, row, 0);
    }
}

/* End of the first interval with a force. */
static double first_wet(const sb_series_table *table, const sb_series *series)
{
    for (size_t row = 0; row < series->rows; row++)
        for (size_t c = 1; c <= 3; c++) {
            const double force = sb_series_table_value(table, series, row, c);
            if (!isnan(force) && force != 0) return sb_series_table_value(table, series, row, 0);
        }
    return NAN;
}

static void take_body(const sb_compared_run *run, const sb_series *series, const sb_grid *depth,
                      double values[SB_QUANTITIES_MAX])
{
    const sb_load *load = NULL;
    for (size_t i = 0; i < run->loads.count; i++)
        if (run->loads.loads[i].series == series) load = &run->loads.loads[i];
    if (!load) return;
    const bool hit = load->horizontal > 0;
    values[0] = load->horizontal;
    values[1] = hit ? load->horizontal_time : (double)NAN;
    values[2] = load->impulse_horizontal;
    values[3] = load->moment;
    values[4] = sb_depth_near(&run->run, load->name, depth);
    values[5] = first_wet(&run->run.tables[SB_REPORT_FORCES], series);
}

static void take(const sb_compared_run *run, sb_item_kind kind, const sb_series *series, const sb_grid *depth,
                 double values[SB_QUANTITIES_MAX])
{
    const sb_series_table *table = &run->run.tables[table_of[kind]];
    double unused;
    if (kind == SB_ITEM_BODY) take_body(run, series, depth, values);
    if (kind == SB_ITEM_GAUGE) greatest(table, series, 2, &values[0], &values[1]);
    if (kind == SB_ITEM_RUNUP) {
        greatest(table, series, 3, &values[0], &values[1]);
        greatest(table, series, 4, &values[2], &unused);
    }
    if (kind == SB_ITEM_PLANE) {
        greatest(table, series, 1, &values[0], &unused);
        if (series->rows > 0) values[1] = sb_series_table_value(table, series, series->rows - 1, 1);
    }
}

/* ---- items ---- */

static sb_item *item_of(const sb_comparison *c, sb_items *all, sb_item_kind kind, const char *name)
{
    for (size_t i = 0; i < all->count; i++)
        if (all->items[i].kind == kind && strcmp(all->items[i].name, name) == 0) return &all->items[i];
    if (sb_grow((void **)&all->items, &all->capacity, all->count + 1, sizeof *all->items) != 0) return NULL;
    sb_item made = {.kind = kind,
                    .name = name,
                    .present = sb_alloc(c->count, sizeof *made.present),
                    .values = sb_alloc(SB_QUANTITIES_MAX * c->count, sizeof *made.values),
                    .spread = sb_alloc(SB_QUANTITIES_MAX * c->groups, sizeof *made.spread)};
    all->items[all->count++] = made;
    if (!made.present || !made.values || !made.spread) return NULL;
    for (size_t k = 0; k < SB_QUANTITIES_MAX * c->count; k++) made.values[k] = NAN;
    return &all->items[all->count - 1];
}

static sb_status put_values(const sb_comparison *c, sb_items *all, sb_item_kind kind, const char *name, size_t run,
                            const double values[SB_QUANTITIES_MAX], sb_error *error)
{
    sb_item *item = item_of(c, all, kind, name);
    if (!item) return sb_fail_memory(error, "a comparison");
    item->present[run] = true;
    for (size_t q = 0; q < SB_QUANTITIES_MAX; q++) item->values[q * c->count + run] = values[q];
    return SB_OK;
}

/* Whether all runs have a map. */
static bool have_all(const sb_comparison *c, const char *name)
{
    bool all = true;
    for (size_t run = 0; run < c->count && all; run++) {
        sb_grid grid = {0};
        all = sb_map_of(&c->runs[run].run, name, &grid);
        sb_grid_free(&grid);
    }
    return all;
}

/* bare: only what ground.asc has is ground. */
static sb_status take_map(const sb_comparison *c, sb_items *all, size_t run, const sb_grid *depth, bool bare,
                          sb_error *error)
{
    double values[SB_QUANTITIES_MAX] = {NAN, NAN, NAN, NAN, NAN, NAN};
    sb_grid wet = {0}, ground = {0};
    /* A depth-averaged run has arrival times at sea, too, but times of inundation only on land. */
    if (!sb_map_of(&c->runs[run].run, "inundation_time", &wet) && !sb_map_of(&c->runs[run].run, "arrival_time", &wet))
        return SB_OK;
    if (bare) sb_map_of(&c->runs[run].run, "ground", &ground);
    sb_flooded(&wet, depth, &ground, &values[0], &values[1]);
    sb_grid_free(&wet);
    sb_grid_free(&ground);
    return put_values(c, all, SB_ITEM_MAP, "all", run, values, error);
}

static sb_status take_run(const sb_comparison *c, sb_items *all, size_t run, bool bare, sb_error *error)
{
    sb_status status = SB_OK;
    sb_grid depth = {0};
    sb_map_of(&c->runs[run].run, "max_depth", &depth);
    for (size_t kind = 0; kind < SB_ITEM_MAP && status == SB_OK; kind++) {
        const sb_series_table *table = &c->runs[run].run.tables[table_of[kind]];
        for (size_t i = 0; i < table->count && status == SB_OK; i++) {
            double values[SB_QUANTITIES_MAX] = {NAN, NAN, NAN, NAN, NAN, NAN};
            take(&c->runs[run], (sb_item_kind)kind, &table->series[i], &depth, values);
            status = put_values(c, all, (sb_item_kind)kind, table->series[i].name, run, values, error);
        }
    }
    if (status == SB_OK) status = take_map(c, all, run, &depth, bare, error);
    sb_grid_free(&depth);
    return status;
}

/* ---- spreads ---- */

static sb_spread spread_of(const sb_comparison *c, const double *values, size_t group)
{
    sb_spread made = {.least = INFINITY, .most = -INFINITY};
    double sum = 0;
    for (size_t r = 0; r < c->count; r++) {
        if (c->runs[r].group != group || isnan(values[r])) continue;
        made.count++;
        sum += values[r];
        made.least = fmin(made.least, values[r]);
        made.most = fmax(made.most, values[r]);
    }
    if (made.count == 0) return (sb_spread){0, NAN, NAN, NAN};
    made.mean = sum / (double)made.count;
    return made;
}

static void spread(const sb_comparison *c, sb_item *item)
{
    item->greatest = -INFINITY;
    item->everywhere = true;
    for (size_t r = 0; r < c->count; r++) item->everywhere &= item->present[r];
    for (size_t r = 0; r < c->count; r++)
        if (!isnan(item->values[r])) item->greatest = fmax(item->greatest, item->values[r]);
    for (size_t q = 0; q < SB_QUANTITIES_MAX; q++)
        for (size_t g = 0; g < c->groups; g++)
            item->spread[q * c->groups + g] = spread_of(c, item->values + q * c->count, g);
}

static int by_kind(const void *a, const void *b)
{
    const sb_item *one = a, *other = b;
    if (one->kind != other->kind) return one->kind < other->kind ? -1 : 1;
    if (one->everywhere != other->everywhere) return one->everywhere ? -1 : 1;
    if (one->kind == SB_ITEM_BODY && one->greatest != other->greatest) return one->greatest > other->greatest ? -1 : 1;
    return strcmp(one->name, other->name);
}

sb_status sb_items_make(const sb_comparison *comparison, sb_items *items, sb_error *error)
{
    sb_items made = {0};
    sb_status status = SB_OK;
    /* With runs of earlier versions, what stands on the ground counts in all of them. */
    const bool bare = have_all(comparison, "ground");
    for (size_t r = 0; r < comparison->count && status == SB_OK; r++)
        status = take_run(comparison, &made, r, bare, error);
    if (status != SB_OK) {
        sb_items_free(&made);
        return status;
    }
    for (size_t i = 0; i < made.count; i++) spread(comparison, &made.items[i]);
    if (made.count > 1) qsort(made.items, made.count, sizeof *made.items, by_kind);
    *items = made;
    return SB_OK;
}

void sb_items_free(sb_items *items)
{
    for (size_t i = 0; i < items->count; i++) {
        sb_free(items->items[i].present);
        sb_free(items->items[i].values);
        sb_free(items->items[i].spread);
    }
    sb_free(items->items);
    *items = (sb_items){0};
}

const sb_spread *sb_item_spread(const sb_comparison *comparison, const sb_item *item, size_t quantity, size_t group)
{
    return &item->spread[quantity * comparison->groups + group];
}

bool sb_item_present(const sb_comparison *comparison, const sb_item *item, size_t group)
{
    bool present = false;
    for (size_t r = 0; r < comparison->count; r++) present |= comparison->runs[r].group == group && item->present[r];
    return present;
}

bool sb_item_doubtful(const sb_comparison *comparison, const sb_item *item, size_t group)
{
    for (size_t r = 0; item->kind == SB_ITEM_BODY && r < comparison->count; r++) {
        const sb_loads *loads = &comparison->runs[r].loads;
        for (size_t i = 0; comparison->runs[r].group == group && i < loads->count; i++)
            if (strcmp(loads->loads[i].name, item->name) == 0 && (loads->loads[i].coarse || loads->loads[i].narrow))
                return true;
    }
    return false;
}

const sb_item *sb_items_most_changed(const sb_comparison *comparison, const sb_items *items, sb_item_kind kind,
                                     size_t one, size_t other)
{
    const sb_item *found = NULL;
    double most = -1;
    for (size_t i = 0; i < items->count; i++) {
        const sb_item *item = &items->items[i];
        if (item->kind != kind) continue;
        const double change =
            fabs(sb_item_spread(comparison, item, 0, other)->mean - sb_item_spread(comparison, item, 0, one)->mean);
        if (!(change > most)) continue; /* NaN: one of them has no value */
        most = change;
        found = item;
    }
    return found;
}

bool sb_spread_apart(const sb_spread *one, const sb_spread *other)
{
    return one->count > 1 && other->count > 1 && (one->least > other->most || other->least > one->most);
}
