#include "app/frames/insets.h"

#include "base/file.h"
#include "base/memory.h"
#include "render/overlay/inset.h"
#include "report/series_table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Rows that an archive may have: as many intervals as fit into a run. */
static const size_t ROWS_MAX = 100000000;

static sb_status find_body(const sb_inset *inset, const sb_model *model, size_t *index, sb_error *error)
{
    for (size_t b = 0; b < model->body_count; b++) {
        if (strcmp(model->bodies[b].name, inset->force) != 0) continue;
        *index = b;
        if (model->bodies[b].report) return SB_OK;
        return sb_fail(error, SB_BAD_INPUT,
                       "render.insets: %s has no rows in forces.csv, expected a body with report: true", inset->force);
    }
    return sb_fail(error, SB_BAD_INPUT, "render.insets: no body is named %s, expected the name of one", inset->force);
}

sb_status sb_insets_begin(sb_insets *insets, const sb_scene *scene, const sb_model *model, sb_error *error)
{
    const size_t count = scene->render.inset_count;
    *insets = (sb_insets){.scene = scene};
    if (count == 0) return SB_OK;
    insets->plots = sb_alloc(count, sizeof *insets->plots);
    if (!insets->plots) return sb_fail_memory(error, "the plots in pictures");
    pthread_mutex_init(&insets->lock, NULL);
    insets->count = count;
    sb_status status = SB_OK;
    for (size_t i = 0; i < count && status == SB_OK; i++) {
        const sb_inset *inset = &scene->render.insets[i];
        if (*inset->gauge)
            insets->plots[i].index = sb_scene_gauge(scene, inset->gauge);
        else
            status = find_body(inset, model, &insets->plots[i].index, error);
    }
    return status;
}

void sb_insets_free(sb_insets *insets)
{
    for (size_t i = 0; i < insets->count; i++) sb_free(insets->plots[i].rows);
    if (insets->count > 0) pthread_mutex_destroy(&insets->lock);
    sb_free(insets->plots);
    *insets = (sb_insets){0};
}

static sb_status add_row(sb_inset_rows *plot, double time, double value, sb_error *error)
{
    if (sb_grow((void **)&plot->rows, &plot->capacity, plot->count + 1, sizeof *plot->rows) != 0)
        return sb_fail_memory(error, "the plots in pictures");
    plot->rows[plot->count][0] = time;
    plot->rows[plot->count++][1] = value;
    return SB_OK;
}

static sb_status add_step(sb_insets *insets, const sb_measure_records *records, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t p = 0; p < insets->count; p++) {
        const sb_inset *inset = &insets->scene->render.insets[p];
        sb_inset_rows *plot = &insets->plots[p];
        for (size_t i = 0; !*inset->gauge && i < records->force_count && status == SB_OK; i++)
            if (records->forces[i].body == plot->index)
                status = add_row(plot, records->forces[i].time,
                                 sb_component(records->forces[i].force, (int)inset->axis), error);
        for (size_t i = 0; *inset->gauge && i < records->gauge_count && status == SB_OK; i++) {
            const sb_gauge_record *row = &records->gauges[i];
            const bool level = insets->scene->sea.present;
            if (row->gauge == plot->index) status = add_row(plot, row->time, level ? row->eta : row->z, error);
        }
    }
    return status;
}

sb_status sb_insets_add(sb_insets *insets, const sb_measure_records *records, sb_error *error)
{
    if (insets->count == 0 || records->force_count + records->gauge_count == 0) return SB_OK;
    pthread_mutex_lock(&insets->lock);
    const sb_status status = add_step(insets, records, error);
    pthread_mutex_unlock(&insets->lock);
    return status;
}

static sb_status read_plot(const sb_insets *insets, size_t p, const char *run, sb_error *error)
{
    const sb_inset *inset = &insets->scene->render.insets[p];
    const bool gauge = *inset->gauge;
    const size_t column = gauge ? (insets->scene->sea.present ? 1 : 2) : 1 + inset->axis;
    char path[SB_PATH_MAX];
    sb_series_table table = {0};
    sb_status status = sb_path_join(path, run, gauge ? "gauges.csv" : "forces.csv", error);
    if (status == SB_OK) status = sb_series_table_read(path, gauge ? 3 : 4, true, &table, error);
    if (status != SB_OK) return status;
    const sb_series *series = sb_series_table_find(&table, gauge ? inset->gauge : inset->force);
    for (size_t i = 0; series && i < series->rows && status == SB_OK; i++)
        status = add_row(&insets->plots[p], sb_series_table_value(&table, series, i, 0),
                         sb_series_table_value(&table, series, i, column), error);
    if (!series)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: has no rows of %s, which render.insets names", path,
                         gauge ? inset->gauge : inset->force);
    sb_series_table_free(&table);
    return status;
}

sb_status sb_insets_read(sb_insets *insets, const char *run, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t p = 0; p < insets->count && status == SB_OK; p++) status = read_plot(insets, p, run, error);
    return status;
}

void sb_insets_save(sb_insets *insets, sb_archive_out *out)
{
    for (size_t p = 0; p < insets->count; p++)
        sb_put_list(out, insets->plots[p].rows, insets->plots[p].count, sizeof *insets->plots[p].rows);
}

sb_status sb_insets_load(sb_insets *insets, sb_archive_in *in, sb_error *error)
{
    for (size_t p = 0; p < insets->count; p++) {
        sb_inset_rows *plot = &insets->plots[p];
        const size_t count = sb_take_length(in, sizeof *plot->rows, ROWS_MAX);
        plot->count = 0;
        if (sb_grow((void **)&plot->rows, &plot->capacity, count, sizeof *plot->rows) != 0)
            return sb_fail_memory(error, "the plots in pictures");
        sb_take_list(in, plot->rows, count, sizeof *plot->rows);
        plot->count = count;
    }
    return SB_OK;
}

/* The number of rows up to a time. */
static size_t rows_until(const sb_inset_rows *plot, double time)
{
    size_t count = plot->count;
    while (count > 0 && plot->rows[count - 1][0] > time * (1 + 1e-9)) count--;
    return count;
}

sb_status sb_insets_draw(sb_insets *insets, double time, sb_image *image, sb_error *error)
{
    sb_status status = SB_OK;
    if (insets->count == 0) return SB_OK;
    const bool flat = insets->scene->dimensions == 2;
    pthread_mutex_lock(&insets->lock);
    for (size_t p = 0; p < insets->count && status == SB_OK; p++) {
        const sb_inset *inset = &insets->scene->render.insets[p];
        char title[2 * SB_NAME_MAX];
        if (*inset->gauge)
            snprintf(title, sizeof title, "%s: %s", inset->gauge, insets->scene->sea.present ? "eta" : "z");
        else
            snprintf(title, sizeof title, "%s: F%c", inset->force, "xyz"[inset->axis]);
        const sb_inset_plot plot = {.title = title,
                                    .unit = *inset->gauge ? "m"
                                            : flat        ? "N/m"
                                                          : "N",
                                    .time = time,
                                    .rows = (const double(*)[2])insets->plots[p].rows,
                                    .count = rows_until(&insets->plots[p], time)};
        status = sb_inset_draw(image, p, &plot, error);
    }
    pthread_mutex_unlock(&insets->lock);
    return status;
}
