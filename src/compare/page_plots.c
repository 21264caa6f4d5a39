/* The series of the plots: for each item one line per run, in the colour of its group. */
#include "compare/page.h"

#include "base/memory.h"

static const struct {
    sb_item_kind kind;
    sb_report_table table;
    size_t budget; /* bytes in the page */
} rows[SB_COMPARE_PLOTS] = {
    {SB_ITEM_BODY, SB_REPORT_FORCES, 1800000},
    {SB_ITEM_GAUGE, SB_REPORT_GAUGES, 200000},
    {SB_ITEM_RUNUP, SB_REPORT_RUNUP, 150000},
    {SB_ITEM_PLANE, SB_REPORT_OVERTOPPING, 100000},
};
enum { LINES_MAX = 400 };

static void take_lines(const sb_comparison *c, const sb_items *items, size_t p, sb_plot *plot)
{
    for (size_t i = 0; i < items->count; i++) {
        const sb_item *item = &items->items[i];
        if (item->kind != rows[p].kind || (item->kind == SB_ITEM_BODY && !(item->greatest > 0))) continue;
        for (size_t r = 0; r < c->count; r++) {
            const sb_series_table *table = &c->runs[r].run.tables[rows[p].table];
            const sb_series *series = sb_series_table_find(table, item->name);
            if (!series || plot->all++ >= LINES_MAX) continue;
            plot->lines[plot->count++] = (sb_plot_line){.table = table,
                                                        .series = series,
                                                        .name = c->runs[r].label,
                                                        .item = item->name,
                                                        .colour = (int)c->runs[r].group};
        }
    }
}

sb_status sb_compare_plots(sb_compare_page *page, sb_error *error)
{
    for (size_t p = 0; p < SB_COMPARE_PLOTS; p++) {
        sb_plot *plot = &page->plots[p];
        *plot = (sb_plot){.table = sb_report_table_names[rows[p].table],
                          .budget = rows[p].budget,
                          .lines = sb_alloc(LINES_MAX, sizeof *plot->lines)};
        if (!plot->lines) return sb_fail_memory(error, "the plots of a comparison");
        take_lines(page->comparison, page->items, p, plot);
    }
    return sb_plots_fit(page->plots, SB_COMPARE_PLOTS, error);
}

void sb_compare_plots_free(sb_compare_page *page)
{
    for (size_t p = 0; p < SB_COMPARE_PLOTS; p++) sb_free(page->plots[p].lines);
}
