/* Which series of the run's tables the page plots, and in which order. */
#include "report/sections.h"

#include "base/memory.h"

/* Bytes of a table's rows in the page; the parts of a page add up to less than SB_REPORT_BYTES_MAX. */
static const size_t budget[] = {
    [SB_REPORT_FORCES] = 1600000,     [SB_REPORT_GAUGES] = 160000, [SB_REPORT_RUNUP] = 100000,
    [SB_REPORT_OVERTOPPING] = 100000, [SB_REPORT_PROBES] = 160000,
};
enum { SERIES_MAX = 100 };

sb_status sb_section_data_plan(sb_report_page *page, sb_error *error)
{
    for (size_t t = 0; t < SB_REPORT_PLOTS; t++) {
        const sb_series_table *table = &page->run->tables[t];
        sb_plot *plot = &page->plots[t];
        *plot = (sb_plot){.table = sb_report_table_names[t],
                          .budget = budget[t],
                          .all = table->count,
                          .lines = sb_alloc(table->count, sizeof *plot->lines)};
        if (!plot->lines) return sb_fail_memory(error, "the plots of a report");
        plot->count = table->count < SERIES_MAX ? table->count : SERIES_MAX;
        for (size_t i = 0; i < plot->count; i++) {
            const sb_series *series = t == SB_REPORT_FORCES ? page->loads->loads[i].series : &table->series[i];
            plot->lines[i] = (sb_plot_line){.table = table, .series = series, .name = series->name};
        }
    }
    return sb_plots_fit(page->plots, SB_REPORT_PLOTS, error);
}

void sb_section_data_free(sb_report_page *page)
{
    for (size_t t = 0; t < SB_REPORT_PLOTS; t++) sb_free(page->plots[t].lines);
}
