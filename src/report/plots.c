#include "report/plots.h"

#include "base/memory.h"
#include "output/log/json.h"
#include "report/html.h"
#include "report/thin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PIXELS = 2400, PIXELS_LEAST = 8, CELL_BYTES = 12 };

static sb_status count_kept(const sb_plot *plot, size_t pixels, size_t *kept, sb_error *error)
{
    *kept = 0;
    for (size_t i = 0; i < plot->count; i++) {
        const sb_plot_line *line = &plot->lines[i];
        uint8_t *keep = sb_alloc(line->series->rows, 1);
        if (!keep) return sb_fail_memory(error, "the rows of a page");
        *kept += sb_thin(line->table, line->series, pixels, keep);
        sb_free(keep);
    }
    return SB_OK;
}

static size_t row_bytes(const sb_plot *plot)
{
    return plot->count > 0 ? CELL_BYTES * plot->lines[0].table->columns : 0;
}

/* What some plots do not need of their budgets goes to the others, in the order of the page. */
static void divide_budget(sb_plot *plots, size_t count)
{
    size_t rest = 0;
    for (size_t p = 0; p < count; p++) {
        const size_t needed = plots[p].rows * row_bytes(&plots[p]);
        if (needed >= plots[p].budget) continue;
        rest += plots[p].budget - needed;
        plots[p].budget = needed;
    }
    for (size_t p = 0; p < count; p++) {
        const size_t wanted = plots[p].rows * row_bytes(&plots[p]) - plots[p].budget;
        const size_t more = wanted < rest ? wanted : rest;
        plots[p].budget += more;
        rest -= more;
    }
}

/* Each attempt has at most nine tenths of the pixels of the one before. */
static sb_status fit(sb_plot *plot, sb_error *error)
{
    sb_status status = SB_OK;
    if (plot->rows == 0) return SB_OK;
    const size_t most = plot->budget / row_bytes(plot);
    for (size_t pixels = PIXELS; plot->kept > most && plot->pixels != PIXELS_LEAST && status == SB_OK;) {
        plot->pixels = pixels;
        status = count_kept(plot, pixels, &plot->kept, error);
        const size_t fitting = pixels * most / plot->kept, next = pixels * 9 / 10;
        pixels = fitting < next ? fitting : next;
        if (pixels < PIXELS_LEAST) pixels = PIXELS_LEAST;
    }
    return status;
}

sb_status sb_plots_fit(sb_plot *plots, size_t count, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t p = 0; p < count; p++) {
        plots[p].pixels = plots[p].rows = 0;
        for (size_t i = 0; i < plots[p].count; i++) plots[p].rows += plots[p].lines[i].series->rows;
        plots[p].kept = plots[p].rows;
    }
    divide_budget(plots, count);
    for (size_t p = 0; p < count && status == SB_OK; p++) status = fit(&plots[p], error);
    return status;
}

/* The same text as in the table's file. */
static void put_row(FILE *out, const sb_series_table *table, const sb_series *series, size_t row)
{
    fprintf(out, "%.12g", sb_series_table_value(table, series, row, 0));
    for (size_t c = 1; c < table->columns; c++) {
        const double value = sb_series_table_value(table, series, row, c);
        if (isnan(value))
            fputc(',', out);
        else
            fprintf(out, ",%.9g", value);
    }
    fputs("\\n", out);
}

static sb_status put_rows(FILE *out, const sb_plot *plot, const sb_plot_line *line, sb_error *error)
{
    uint8_t *keep = sb_alloc(line->series->rows, 1);
    if (!keep) return sb_fail_memory(error, "the rows of a page");
    if (plot->pixels > 0)
        sb_thin(line->table, line->series, plot->pixels, keep);
    else
        memset(keep, 1, line->series->rows);
    fputc('"', out);
    for (size_t row = 0; row < line->series->rows; row++)
        if (keep[row]) put_row(out, line->table, line->series, row);
    fputc('"', out);
    sb_free(keep);
    return SB_OK;
}

/* What the program of the page needs to know of the lines. */
static void put_about(FILE *out, const sb_plot *plot)
{
    sb_json json;
    sb_json_begin(&json, out, false);
    sb_json_open(&json, NULL, '{');
    sb_json_bool(&json, "thinned", plot->pixels > 0);
    sb_json_open(&json, "columns", '[');
    for (size_t c = 0; plot->count > 0 && c < plot->lines[0].table->columns; c++)
        sb_json_text(&json, NULL, plot->lines[0].table->names[c]);
    sb_json_close(&json);
    sb_json_open(&json, "names", '[');
    for (size_t i = 0; i < plot->count; i++) sb_json_text(&json, NULL, plot->lines[i].name);
    sb_json_close(&json);
    if (plot->count > 0 && plot->lines[0].item) {
        sb_json_open(&json, "items", '[');
        for (size_t i = 0; i < plot->count; i++) sb_json_text(&json, NULL, plot->lines[i].item);
        sb_json_close(&json);
        sb_json_open(&json, "colours", '[');
        for (size_t i = 0; i < plot->count; i++) sb_json_count(&json, NULL, (uint64_t)plot->lines[i].colour);
        sb_json_close(&json);
    }
    sb_json_close(&json);
}

static sb_status put_plot(FILE *out, const sb_plot *plot, sb_error *error)
{
    sb_status status = SB_OK;
    put_about(out, plot);
    fputs(",\n[", out);
    for (size_t i = 0; i < plot->count && status == SB_OK; i++) {
        if (i > 0) fputs(",\n", out);
        status = put_rows(out, plot, &plot->lines[i], error);
    }
    fputc(']', out);
    return status;
}

/* An object with two values for each table: {thinned, columns, names} and the rows of each name as a text. "<" occurs
   in names only, and is written so that no name ends the element. */
sb_status sb_plots_put_data(FILE *out, const sb_plot *plots, size_t count, sb_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (!memory) return sb_fail_memory(error, "the rows of a page");
    sb_status status = SB_OK;
    fputc('{', memory);
    for (size_t p = 0; p < count && status == SB_OK; p++) {
        fprintf(memory, "%s\"%s\":[", p ? ",\n" : "", plots[p].table);
        status = put_plot(memory, &plots[p], error);
        fputc(']', memory);
    }
    fputc('}', memory);
    if (fclose(memory) != 0 && status == SB_OK) status = sb_fail_memory(error, "the rows of a page");
    fputs("<script type=\"application/json\" id=\"data\">", out);
    for (size_t i = 0; i < size && status == SB_OK; i++)
        if (text[i] == '<')
            fputs("\\u003c", out);
        else
            fputc(text[i], out);
    fputs("</script>\n", out);
    free(text);
    return status;
}

void sb_plot_put(FILE *out, const sb_plot *plot, const char *caption)
{
    if (plot->rows == 0) return;
    sb_html_put(out, "<figure class=\"plot\" data-table=\"%s\"><div class=\"graph\"></div>", plot->table);
    fputs("<ul class=\"series\"></ul><figcaption>", out);
    sb_html_put(out, "%s ", caption);
    if (plot->count < plot->all) sb_html_put(out, "Shown are the first %z of %z series. ", plot->count, plot->all);
    if (plot->pixels > 0)
        sb_html_put(out,
                    "This page holds %z of the table's %z rows: of each 1/%z of the duration those with the least and "
                    "the greatest values, so that no peak is lost. %s.csv of the run has all.",
                    plot->kept, plot->rows, plot->pixels, plot->table);
    fputs("</figcaption></figure>\n", out);
}
