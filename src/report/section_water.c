/* Water levels at gauges, run-up, volumes through planes and pressures at probes: greatest values, and plots. */
#include "report/sections.h"

#include "report/html.h"

#include <math.h>
#include <stdint.h>

/* The greatest value of a column and its row; SIZE_MAX: there is none. */
static size_t greatest_row(const sb_series_table *table, const sb_series *series, size_t column)
{
    size_t best = SIZE_MAX;
    for (size_t row = 0; row < series->rows; row++) {
        const double value = sb_series_table_value(table, series, row, column);
        if (isnan(value)) continue;
        if (best == SIZE_MAX || value > sb_series_table_value(table, series, best, column)) best = row;
    }
    return best;
}

static void put_value(FILE *out, const sb_series_table *table, const sb_series *series, size_t row, size_t column,
                      double scale)
{
    const double value = row == SIZE_MAX ? (double)NAN : sb_series_table_value(table, series, row, column);
    sb_html_put(out, "<td>%g</td>", scale * value);
}

static void put_csv(FILE *out, const char *table, const sb_series *series)
{
    sb_html_put(
        out,
        "<td class=\"csv\"><a class=\"csv\" data-table=\"%s\" data-name=\"%s\" href=\"#water\">CSV</a></td></tr>\n",
        table, series->name);
}

/* Of the table of probes. Its head in the page has no unit, which follows from the values. */
enum { PRESSURE = 4 };

/* The columns of a table that the page shows, by its greatest values. */
typedef struct shown {
    sb_report_table table;
    const char *title, *item, *caption;
    struct {
        const char *head;
        size_t column; /* 0: the time */
        size_t of;     /* at the row with the greatest value of this column */
    } cells[4];
} shown;

static const shown all[] = {
    {SB_REPORT_GAUGES,
     "Water level at gauges",
     "Gauge",
     "Elevation of the water surface above the still-water level, or absolute where the scene has no level. A gap: the "
     "place is dry.",
     {{"Highest above still water, m", 1, 1}, {"Highest, z in m", 2, 2}, {"at, s", 0, 2}}},
    {SB_REPORT_RUNUP,
     "Run-up",
     "Line",
     "Highest point that connected water wets along the line, z in m.",
     {{"Highest run-up, z in m", 3, 3},
      {"at, s", 0, 3},
      {"at x, m", 1, 3},
      {"Farthest front along the line, m", 4, 4}}},
    {SB_REPORT_OVERTOPPING,
     "Overtopping",
     "Plane",
     "Net volume through the plane since the start.",
     {{"Greatest net volume, m³", 1, 1}, {"Greatest flux, m³/s", 2, 2}, {"at, s", 0, 2}}},
    {SB_REPORT_PROBES,
     "Pressure at probes",
     "Probe",
     "Pressure. A gap: the place is dry.",
     {{"Greatest pressure", PRESSURE, PRESSURE}, {"at, s", 0, 4}}},
};

/* The unit that the plot above the table has (prefix in page/report.js). Returns the factor from Pa. */
static double pressure_unit(const sb_plot *plot, const char **name)
{
    double most = 0;
    for (size_t i = 0; i < plot->count; i++)
        for (size_t row = 0; row < plot->lines[i].series->rows; row++)
            most = fmax(most, fabs(sb_series_table_value(plot->lines[i].table, plot->lines[i].series, row, PRESSURE)));
    const bool mega = most >= 1e7, kilo = most >= 1e3;
    *name = mega ? "MPa" : kilo ? "kPa" : "Pa";
    return mega ? 1e-6 : kilo ? 1e-3 : 1;
}

static void put_shown(FILE *out, const sb_report_page *page, const shown *s)
{
    const sb_series_table *table = &page->run->tables[s->table];
    const char *name = sb_report_table_names[s->table];
    if (table->count == 0) return;
    const bool flat = s->table == SB_REPORT_OVERTOPPING && page->run->flat;
    sb_html_put(out, "<h3>%s%s</h3>", s->title, flat ? ", per metre of width" : "");
    sb_plot_put(out, &page->plots[s->table], s->caption);
    sb_html_put(out, "<div class=\"wide\"><table><thead><tr><th>%s</th>", s->item);
    double scales[4] = {1, 1, 1, 1};
    for (size_t c = 0; c < 4 && s->cells[c].head; c++) {
        const char *unit = NULL;
        if (s->table == SB_REPORT_PROBES && s->cells[c].column == PRESSURE)
            scales[c] = pressure_unit(&page->plots[s->table], &unit);
        sb_html_put(out, "<th>%s%s%s</th>", s->cells[c].head, unit ? ", " : "", unit ? unit : "");
    }
    fputs("<th class=\"csv\">Series</th></tr></thead><tbody>\n", out);
    for (size_t i = 0; i < page->plots[s->table].count; i++) {
        const sb_series *series = &table->series[i];
        sb_html_put(out, "<tr><th scope=\"row\">%s</th>", series->name);
        for (size_t c = 0; c < 4 && s->cells[c].head; c++)
            put_value(out, table, series, greatest_row(table, series, s->cells[c].of), s->cells[c].column, scales[c]);
        put_csv(out, name, series);
    }
    fputs("</tbody></table></div>\n", out);
}

void sb_section_water(FILE *out, const sb_report_page *page)
{
    fputs("<section id=\"water\"><h2>Water</h2>\n", out);
    size_t shown_tables = 0;
    for (size_t s = 0; s < sizeof all / sizeof *all; s++) {
        shown_tables += page->run->tables[all[s].table].count > 0;
        put_shown(out, page, &all[s]);
    }
    sb_section_waves(out, page);
    if (shown_tables == 0) fputs("<p class=\"note\">The run has no gauges, lines, planes or probes.</p>", out);
    fputs("</section>\n", out);
}
