#include "output/tables/overtopping_rate.h"

#include "base/file.h"
#include "base/memory.h"
#include "output/tables/csv_tables.h"
#include "output/tables/series.h"
#include "physics/records/eurotop.h"

#include <math.h>
#include <string.h>

enum { TIME = 0, VOLUME = 2 }; /* columns of overtopping.csv */

bool sb_overtopping_wanted(const sb_scene *scene)
{
    bool wanted = false;
    for (size_t p = 0; p < scene->measure.plane_count; p++) wanted |= scene->measure.planes[p].eurotop.height > 0;
    return wanted;
}

static sb_overtopping_rate rate_at(const sb_scene *scene, const sb_flow_plane *plane, const sb_series *series)
{
    const sb_eurotop_settings *e = &plane->eurotop;
    const double nan = (double)NAN, g = scene->fluid.gravity,
                 width = hypot(plane->bx - plane->ax, plane->by - plane->ay);
    sb_overtopping_rate found = {nan, nan, nan, nan, nan};
    double first = 0, last = 0;
    if (!(e->height > 0)) return found;
    for (size_t i = 0; i < series->row_count; i++) {
        const sb_series_row *row = &series->rows[i];
        if (strcmp(series->names[row->name], plane->name) != 0 || !(row->values[TIME] >= e->start)) continue;
        if (isnan(found.from)) {
            found.from = row->values[TIME];
            first = row->values[VOLUME];
        }
        found.to = row->values[TIME];
        last = row->values[VOLUME];
    }
    if (found.to > found.from) found.rate = (last - first) / ((found.to - found.from) * width);
    found.freeboard = e->crest - scene->sea.level;
    found.formula = sb_eurotop_rate(e->height, found.freeboard, e->slope, e->period, g);
    return found;
}

static sb_status write_all(const char *directory, const sb_scene *scene, const sb_overtopping_rate *rates,
                           sb_error *error)
{
    sb_atomic_file file;
    const sb_status status = sb_atomic_open_in(&file, directory, "eurotop.csv", error);
    if (status != SB_OK) return status;
    fputs(SB_EUROTOP_TABLE_START "to_s,rate_m2_s,eurotop_m2_s,freeboard_m,height_m\n", file.stream);
    for (size_t p = 0; p < scene->measure.plane_count; p++) {
        const sb_flow_plane *plane = &scene->measure.planes[p];
        const sb_overtopping_rate *r = &rates[p];
        if (!(plane->eurotop.height > 0)) continue;
        sb_csv_put_name(file.stream, plane->name);
        const double values[] = {r->from, r->to, r->rate, r->formula, r->freeboard, plane->eurotop.height};
        for (size_t k = 0; k < sizeof values / sizeof *values; k++) sb_csv_put_number(file.stream, values[k]);
        fputc('\n', file.stream);
    }
    return sb_atomic_commit(&file, 0, error);
}

sb_status sb_overtopping_write(const char *directory, const sb_scene *scene, sb_overtopping_rate **rates,
                               sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_series series = {0};
    sb_status status = sb_path_join(path, directory, "overtopping.csv", error);
    if (status == SB_OK) status = sb_series_read(path, true, &series, error);
    if (status != SB_OK) return status;
    sb_overtopping_rate *made = sb_alloc(scene->measure.plane_count, sizeof *made);
    for (size_t p = 0; made && p < scene->measure.plane_count; p++)
        made[p] = rate_at(scene, &scene->measure.planes[p], &series);
    sb_series_free(&series);
    if (!made) return sb_fail_memory(error, "rates of overtopping");
    status = write_all(directory, scene, made, error);
    if (status == SB_OK)
        *rates = made;
    else
        sb_free(made);
    return status;
}
