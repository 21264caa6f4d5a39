#include "output/tables/wave_table.h"

#include "base/file.h"
#include "base/memory.h"
#include "output/tables/csv_tables.h"
#include "output/tables/series.h"
#include "physics/records/reflection.h"

#include <math.h>
#include <string.h>

int sb_wave_table_harmonics(const sb_scene *scene)
{
    const double period = scene->measure.waves.period;
    if (!(period > 0)) return 0;
    const int most = sb_harmonics_most(period, scene->measure.interval);
    return most < SB_WAVE_HARMONICS ? most : SB_WAVE_HARMONICS;
}

enum { TIME = 0, Z = 3 }; /* columns of gauges.csv */

/* The rows of one gauge. */
typedef struct gauge_rows {
    double *t, *z;
    size_t count, dry;
} gauge_rows;

static void take_rows(const sb_series *series, const char *gauge, double start, gauge_rows *rows)
{
    rows->count = rows->dry = 0;
    for (size_t i = 0; i < series->row_count; i++) {
        const sb_series_row *row = &series->rows[i];
        if (strcmp(series->names[row->name], gauge) != 0 || row->values[TIME] < start) continue;
        if (isnan(row->values[Z])) {
            rows->dry++;
            continue;
        }
        rows->t[rows->count] = row->values[TIME];
        rows->z[rows->count++] = row->values[Z];
    }
}

/* As many harmonics as the rows distinguish. */
static sb_status find_harmonics(const sb_scene *scene, const gauge_rows *rows, sb_gauge_waves *waves, sb_error *error)
{
    const sb_wave_settings *settings = &scene->measure.waves;
    const size_t size = sb_harmonics_size(SB_WAVE_HARMONICS);
    bool solved = false;
    for (int h = 0; h < SB_WAVE_HARMONICS; h++) waves->harmonic[h] = (double)NAN;
    /* Less than a period does not distinguish harmonics. */
    if (!(settings->period > 0) || rows->count == 0) return SB_OK;
    if (rows->t[rows->count - 1] - rows->t[0] < settings->period * SB_LEAST_PERIODS) return SB_OK;
    double *sums = sb_alloc(2 * size, sizeof *sums), cosines[SB_WAVE_HARMONICS], sines[SB_WAVE_HARMONICS];
    if (!sums) return sb_fail_memory(error, "harmonics of waves");
    for (int count = sb_wave_table_harmonics(scene); count > 0 && !solved; count--) {
        for (size_t k = 0; k < size; k++) sums[k] = 0;
        for (size_t i = 0; i < rows->count; i++)
            sb_harmonics_add(sums, count, 2 * M_PI / settings->period, rows->t[i], rows->z[i]);
        solved = sb_harmonics_solve(sums, count, sums + size, cosines, sines);
        for (int h = 0; h < count && solved; h++) waves->harmonic[h] = hypot(cosines[h], sines[h]);
    }
    sb_free(sums);
    return SB_OK;
}

static void put_row(FILE *stream, const char *gauge, const sb_gauge_waves *waves)
{
    const sb_wave_heights *h = &waves->heights;
    const double values[] = {waves->from,    waves->to,  (double)h->count, h->level,   h->mean,
                             h->significant, h->highest, h->period,        h->spectral};
    fputs(gauge, stream);
    for (size_t k = 0; k < sizeof values / sizeof *values; k++) sb_csv_put_number(stream, values[k]);
    for (int k = 0; k < SB_WAVE_HARMONICS; k++) sb_csv_put_number(stream, waves->harmonic[k]);
    const double extremes[] = {h->crest, h->crest_time, h->trough, h->trough_time};
    for (size_t k = 0; k < sizeof extremes / sizeof *extremes; k++) sb_csv_put_number(stream, extremes[k]);
    fputc('\n', stream);
}

static sb_status find_all(const sb_scene *scene, const sb_series *series, sb_gauge_waves *waves, sb_error *error)
{
    gauge_rows rows = {sb_alloc(series->row_count, sizeof(double)), sb_alloc(series->row_count, sizeof(double)), 0, 0};
    sb_status status = SB_OK;
    if (series->row_count > 0 && (!rows.t || !rows.z)) status = sb_fail_memory(error, "waves at gauges");
    for (size_t g = 0; g < scene->measure.gauge_count && status == SB_OK; g++) {
        take_rows(series, scene->measure.gauges[g].name, scene->measure.waves.start, &rows);
        waves[g].rows = rows.count;
        waves[g].dry = rows.dry;
        waves[g].from = rows.count > 0 ? rows.t[0] : (double)NAN;
        waves[g].to = rows.count > 0 ? rows.t[rows.count - 1] : (double)NAN;
        status = sb_wave_heights_of(rows.t, rows.z, rows.count, &waves[g].heights, error);
        if (status == SB_OK) status = find_harmonics(scene, &rows, &waves[g], error);
    }
    sb_free(rows.t);
    sb_free(rows.z);
    return status;
}

static sb_status write_all(const char *directory, const sb_scene *scene, const sb_gauge_waves *waves, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open_in(&file, directory, "waves.csv", error);
    if (status != SB_OK) return status;
    fputs(SB_WAVE_TABLE_START "to_s,waves,mean_z_m,mean_height_m,significant_height_m,highest_m,mean_period_s,"
                              "spectral_height_m,harmonic_1_m,harmonic_2_m,harmonic_3_m,harmonic_4_m,harmonic_5_m,"
                              "crest_z_m,crest_s,trough_z_m,trough_s\n",
          file.stream);
    for (size_t g = 0; g < scene->measure.gauge_count; g++)
        put_row(file.stream, scene->measure.gauges[g].name, &waves[g]);
    return sb_atomic_commit(&file, 0, error);
}

sb_status sb_wave_table_write(const char *directory, const sb_scene *scene, sb_gauge_waves **waves, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_series series = {0};
    sb_status status = sb_path_join(path, directory, "gauges.csv", error);
    if (status == SB_OK) status = sb_series_read(path, true, &series, error);
    if (status != SB_OK) return status;
    sb_gauge_waves *made = sb_alloc(scene->measure.gauge_count, sizeof *made);
    if (scene->measure.gauge_count > 0 && !made) status = sb_fail_memory(error, "waves at gauges");
    if (status == SB_OK) status = find_all(scene, &series, made, error);
    if (status == SB_OK) status = write_all(directory, scene, made, error);
    sb_series_free(&series);
    if (status == SB_OK)
        *waves = made;
    else
        sb_free(made);
    return status;
}
