/* The rows of the tables in the page: what is plotted, and what the links to CSV files contain. */
#include "report/sections.h"

#include "base/memory.h"
#include "output/json.h"
#include "report/html.h"
#include "report/thin.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Bytes of a table's rows in the page; the parts of a page add up to less than SB_REPORT_BYTES_MAX. */
static const size_t budget[] = {
    [SB_REPORT_FORCES] = 1600000,     [SB_REPORT_GAUGES] = 160000, [SB_REPORT_RUNUP] = 100000,
    [SB_REPORT_OVERTOPPING] = 100000, [SB_REPORT_PROBES] = 160000,
};
enum { SERIES_MAX = 100, PIXELS = 2400, PIXELS_LEAST = 8, CELL_BYTES = 12 };

const sb_series *sb_report_series(const sb_report_page *page, sb_report_table table, size_t i)
{
    return table == SB_REPORT_FORCES ? page->loads->loads[i].series : &page->run->tables[table].series[i];
}

static sb_status count_kept(const sb_report_page *page, sb_report_table t, size_t pixels, size_t *kept, sb_error *error)
{
    const sb_series_table *table = &page->run->tables[t];
    *kept = 0;
    for (size_t i = 0; i < page->shares[t].series; i++) {
        const sb_series *series = sb_report_series(page, t, i);
        uint8_t *keep = sb_alloc(series->rows, 1);
        if (!keep) return sb_fail_memory(error, "the rows of a report");
        *kept += sb_thin(table, series, pixels, keep);
        sb_free(keep);
    }
    return SB_OK;
}

static size_t bytes_of(const sb_report_page *page, sb_report_table t)
{
    return page->shares[t].rows * page->run->tables[t].columns * CELL_BYTES;
}

/* What some tables do not need of their budgets goes to the others, in the order of the page. */
static void divide_budget(const sb_report_page *page, size_t granted[SB_REPORT_PLOTS])
{
    size_t rest = 0;
    for (size_t t = 0; t < SB_REPORT_PLOTS; t++) {
        const size_t needed = bytes_of(page, t);
        granted[t] = needed < budget[t] ? needed : budget[t];
        rest += budget[t] - granted[t];
    }
    for (size_t t = 0; t < SB_REPORT_PLOTS; t++) {
        const size_t wanted = bytes_of(page, t) - granted[t], more = wanted < rest ? wanted : rest;
        granted[t] += more;
        rest -= more;
    }
}

/* Thins until the rows fit into the bytes. Each attempt has at most nine tenths of the pixels of the one before. */
static sb_status fit(sb_report_page *page, sb_report_table t, size_t bytes, sb_error *error)
{
    sb_report_share *share = &page->shares[t];
    sb_status status = SB_OK;
    if (share->rows == 0) return SB_OK;
    const size_t most = bytes / (CELL_BYTES * page->run->tables[t].columns);
    for (size_t pixels = PIXELS; share->kept > most && share->pixels != PIXELS_LEAST && status == SB_OK;) {
        share->pixels = pixels;
        status = count_kept(page, t, pixels, &share->kept, error);
        const size_t fitting = pixels * most / share->kept, next = pixels * 9 / 10;
        pixels = fitting < next ? fitting : next;
        if (pixels < PIXELS_LEAST) pixels = PIXELS_LEAST;
    }
    return status;
}

sb_status sb_section_data_plan(sb_report_page *page, sb_error *error)
{
    size_t granted[SB_REPORT_PLOTS];
    sb_status status = SB_OK;
    for (size_t t = 0; t < SB_REPORT_PLOTS; t++) {
        const size_t count = page->run->tables[t].count;
        sb_report_share *share = &page->shares[t];
        *share = (sb_report_share){.series = count < SERIES_MAX ? count : SERIES_MAX};
        for (size_t i = 0; i < share->series; i++) share->rows += sb_report_series(page, t, i)->rows;
        share->kept = share->rows;
    }
    divide_budget(page, granted);
    for (size_t t = 0; t < SB_REPORT_PLOTS && status == SB_OK; t++) status = fit(page, t, granted[t], error);
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

static sb_status put_rows(FILE *out, const sb_report_page *page, sb_report_table t, const sb_series *series,
                          sb_error *error)
{
    const sb_series_table *table = &page->run->tables[t];
    uint8_t *keep = sb_alloc(series->rows, 1);
    if (!keep) return sb_fail_memory(error, "the rows of a report");
    if (page->shares[t].pixels > 0)
        sb_thin(table, series, page->shares[t].pixels, keep);
    else
        memset(keep, 1, series->rows);
    fputc('"', out);
    for (size_t row = 0; row < series->rows; row++)
        if (keep[row]) put_row(out, table, series, row);
    fputc('"', out);
    sb_free(keep);
    return SB_OK;
}

static sb_status put_table(FILE *out, const sb_report_page *page, sb_report_table t, sb_error *error)
{
    const sb_series_table *table = &page->run->tables[t];
    sb_status status = SB_OK;
    sb_json json;
    sb_json_begin(&json, out, false);
    sb_json_open(&json, NULL, '{');
    sb_json_bool(&json, "thinned", page->shares[t].pixels > 0);
    sb_json_open(&json, "columns", '[');
    for (size_t c = 0; c < table->columns; c++) sb_json_text(&json, NULL, table->names[c]);
    sb_json_close(&json);
    sb_json_open(&json, "names", '[');
    for (size_t i = 0; i < page->shares[t].series; i++) sb_json_text(&json, NULL, sb_report_series(page, t, i)->name);
    sb_json_close(&json);
    sb_json_close(&json);
    fputs(",\n[", out);
    for (size_t i = 0; i < page->shares[t].series && status == SB_OK; i++) {
        if (i > 0) fputs(",\n", out);
        status = put_rows(out, page, t, sb_report_series(page, t, i), error);
    }
    fputc(']', out);
    return status;
}

/* An object with two values for each table: {thinned, columns, names} and the rows of each name as a text. "<" occurs
   in names only, and is written so that no name ends the element. */
sb_status sb_section_data(FILE *out, const sb_report_page *page, sb_error *error)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (!memory) return sb_fail_memory(error, "the rows of a report");
    sb_status status = SB_OK;
    fputc('{', memory);
    for (size_t t = 0; t < SB_REPORT_PLOTS && status == SB_OK; t++) {
        fprintf(memory, "%s\"%s\":[", t ? ",\n" : "", sb_report_table_names[t]);
        status = put_table(memory, page, t, error);
        fputc(']', memory);
    }
    fputc('}', memory);
    if (fclose(memory) != 0 && status == SB_OK) status = sb_fail_memory(error, "the rows of a report");
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

void sb_report_plot(FILE *out, const sb_report_page *page, sb_report_table t, const char *caption)
{
    const sb_report_share *share = &page->shares[t];
    const char *name = sb_report_table_names[t];
    if (share->rows == 0) return;
    sb_html_put(out, "<figure class=\"plot\" data-table=\"%s\"><div class=\"graph\"></div>", name);
    fputs("<ul class=\"series\"></ul><figcaption>", out);
    sb_html_put(out, "%s ", caption);
    if (share->series < page->run->tables[t].count)
        sb_html_put(out, "Shown are the first %z of %z series. ", share->series, page->run->tables[t].count);
    if (share->pixels > 0)
        sb_html_put(out,
                    "This page holds %z of the table's %z rows: of each 1/%z of the duration those with the least and "
                    "the greatest values, so that no peak is lost. %s.csv of the run has all.",
                    share->kept, share->rows, share->pixels, name);
    fputs("</figcaption></figure>\n", out);
}

double sb_report_force_unit(double greatest, bool per_m, const char **name)
{
    const bool mega = greatest >= 1e7, kilo = greatest >= 1e3;
    *name = mega ? per_m ? "MN/m" : "MN" : kilo ? per_m ? "kN/m" : "kN" : per_m ? "N/m" : "N";
    return mega ? 1e-6 : kilo ? 1e-3 : 1;
}
