/* The tables of the page: for each item one row per scene, with the difference from the first scene. */
#include "compare/page.h"

#include "compare/table.h"
#include "report/html.h"

#include <math.h>

static void put_head(FILE *out, const sb_comparison *c, const sb_item_row *row, const char *force)
{
    sb_html_put(out, "<div class=\"wide\"><table class=\"compare\"><thead><tr><th>%s</th><th class=\"run\">Run</th>",
                row->name);
    for (size_t q = 0; row->quantities[q].key; q++) {
        const sb_quantity *quantity = &row->quantities[q];
        const bool per_m = c->flat && (quantity->of == SB_OF_FORCE || quantity->of == SB_OF_VOLUME);
        char prefix[2] = {quantity->of == SB_OF_FORCE && *force != 'N' ? *force : '\0'};
        sb_html_put(out, "<th>%s, %s%s%s</th>", quantity->head, prefix, quantity->unit, per_m ? "/m" : "");
    }
    fputs(row == &sb_item_rows[SB_ITEM_BODY] ? "<th>Force</th></tr></thead><tbody>\n" : "</tr></thead><tbody>\n", out);
}

static void put_cell(FILE *out, const sb_comparison *c, const sb_item *item, size_t q, size_t group, double unit)
{
    const sb_quantity *quantity = &sb_item_rows[item->kind].quantities[q];
    const sb_spread *spread = sb_item_spread(c, item, q, group);
    const double scale = quantity->of == SB_OF_FORCE ? unit : 1;
    char change[SB_CHANGE_MAX];
    if (q == SB_BODY_FIRST_WET && item->kind == SB_ITEM_BODY && spread->count == 0)
        fputs("<td>dry", out);
    else
        sb_html_put(out, "<td>%g", scale * spread->mean);
    if (c->group[group].count > 1 && spread->count > 0)
        sb_html_put(out, "<small>%g to %g%s</small>", scale * spread->least, scale * spread->most,
                    spread->count < c->group[group].count ? ", not in all runs" : "");
    sb_change_text(change, quantity, sb_item_spread(c, item, q, 0), spread);
    if (*change) sb_html_put(out, "<small class=\"change\">%s</small>", change);
    fputs("</td>", out);
}

static void put_verdict(FILE *out, const sb_comparison *c, const sb_item *item, size_t group)
{
    if (!(sb_item_spread(c, item, 0, group)->most > 0))
        fputs("<td class=\"none\">no load</td>", out);
    else if (sb_item_doubtful(c, item, group))
        fputs("<td class=\"bad\">not reliable</td>", out);
    else
        fputs("<td class=\"good\">usable</td>", out);
}

static void put_group(FILE *out, const sb_comparison *c, const sb_item *item, size_t group, double unit)
{
    const sb_item_row *row = &sb_item_rows[item->kind];
    size_t columns = 0;
    sb_html_put(out, "<td class=\"run\"><i class=\"run-%d\"></i>%s</td>", (int)(group % 8), c->group[group].label);
    if (!sb_item_present(c, item, group)) {
        while (row->quantities[columns].key) columns++;
        fprintf(out, "<td colspan=\"%zu\" class=\"open\">not in this run</td></tr>\n",
                columns + (item->kind == SB_ITEM_BODY));
        return;
    }
    for (size_t q = 0; row->quantities[q].key; q++) put_cell(out, c, item, q, group, unit);
    if (item->kind == SB_ITEM_BODY) put_verdict(out, c, item, group);
    fputs("</tr>\n", out);
}

static void put_kind(FILE *out, const sb_compare_page *page, sb_item_kind kind)
{
    const sb_comparison *c = page->comparison;
    const char *force = "N";
    double unit = 1;
    bool begun = false;
    for (size_t i = 0; i < page->items->count; i++) {
        const sb_item *item = &page->items->items[i];
        if (item->kind != kind || (kind == SB_ITEM_BODY && !(item->greatest > 0))) continue;
        if (!begun) {
            if (kind == SB_ITEM_BODY) unit = sb_force_unit(item->greatest, false, &force);
            put_head(out, c, &sb_item_rows[kind], force);
        }
        begun = true;
        for (size_t g = 0; g < c->groups; g++) {
            fputs("<tr>", out);
            if (g == 0) sb_html_put(out, "<th scope=\"rowgroup\" rowspan=\"%z\">%s</th>", c->groups, item->name);
            put_group(out, c, item, g, unit);
        }
    }
    if (begun) fputs("</tbody></table></div>\n", out);
}

static void put_without_force(FILE *out, const sb_compare_page *page)
{
    const char *comma = "<p class=\"note\">No force acted in any run on: ";
    for (size_t i = 0; i < page->items->count; i++) {
        const sb_item *item = &page->items->items[i];
        if (item->kind != SB_ITEM_BODY || item->greatest > 0) continue;
        fputs(comma, out);
        sb_html_text(out, item->name);
        comma = ", ";
    }
    if (*comma == ',') fputs(".</p>\n", out);
}

static bool has_kind(const sb_compare_page *page, sb_item_kind kind)
{
    for (size_t i = 0; i < page->items->count; i++)
        if (page->items->items[i].kind == kind) return true;
    return false;
}

void sb_compare_tables(FILE *out, const sb_compare_page *page)
{
    fputs("<section id=\"loads\"><h2>Loads on bodies</h2>\n", out);
    if (has_kind(page, SB_ITEM_BODY)) {
        sb_plot_put(out, &page->plots[0], "Force on the chosen body in all runs.");
        put_kind(out, page, SB_ITEM_BODY);
        put_without_force(out, page);
    } else
        fputs("<p class=\"note\">The runs measured no forces.</p>", out);
    fputs("</section>\n<section id=\"water\"><h2>Water</h2>\n", out);
    static const char *const captions[] = {"", "Elevation of the water surface at the chosen gauge. A gap: it is dry.",
                                           "Highest point of the connected water along the chosen line, z in m.",
                                           "Net volume through the chosen plane since the start."};
    for (int kind = SB_ITEM_GAUGE; kind <= SB_ITEM_PLANE; kind++) {
        if (!has_kind(page, (sb_item_kind)kind)) continue;
        sb_html_put(out, "<h3>%s</h3>", sb_item_rows[kind].title);
        sb_plot_put(out, &page->plots[kind], captions[kind]);
        put_kind(out, page, (sb_item_kind)kind);
    }
    if (has_kind(page, SB_ITEM_MAP)) {
        sb_html_put(out, "<h3>%s</h3>", sb_item_rows[SB_ITEM_MAP].title);
        put_kind(out, page, SB_ITEM_MAP);
    }
    fputs("</section>\n", out);
}
