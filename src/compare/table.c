#include "compare/table.h"

#include "output/tables/csv_tables.h"
#include "report/html.h"

#include <math.h>
#include <string.h>

const char *sb_change_text(char out[SB_CHANGE_MAX], const sb_quantity *quantity, const sb_spread *first,
                           const sb_spread *other)
{
    char figure[SB_FIGURE_MAX];
    const double change = other->mean - first->mean;
    const bool overlap = first->count > 1 && other->count > 1 && !sb_spread_apart(first, other);
    *out = '\0';
    if (first == other || isnan(change)) return out;
    if (quantity->of == SB_OF_TIME)
        snprintf(out, SB_CHANGE_MAX, "%s%s%s s", overlap ? "~" : "", change > 0 ? "+" : "", sb_figure(figure, change));
    else if (first->mean == 0)
        snprintf(out, SB_CHANGE_MAX, "%s", change == 0 ? "0 %" : "from 0");
    else {
        const double percent = round(100 * change / fabs(first->mean));
        snprintf(out, SB_CHANGE_MAX, "%s%s%.0f %%", overlap ? "~" : "", percent > 0 ? "+" : "",
                 percent == 0 ? 0 : percent);
    }
    return out;
}

/* ---- CSV ---- */

static void put_number(FILE *out, double value)
{
    if (isnan(value))
        fputc(',', out);
    else
        fprintf(out, ",%.9g", value);
}

static void put_csv_row(FILE *out, const sb_comparison *c, const sb_item *item, size_t q, size_t group)
{
    const sb_quantity *quantity = &sb_item_rows[item->kind].quantities[q];
    const sb_spread *first = sb_item_spread(c, item, q, 0), *spread = sb_item_spread(c, item, q, group);
    const double change = group > 0 ? spread->mean - first->mean : (double)NAN;
    const bool per_m = c->flat && (quantity->of == SB_OF_FORCE || quantity->of == SB_OF_VOLUME);
    fprintf(out, "%s,", sb_item_rows[item->kind].name);
    sb_csv_put_name(out, item->name);
    fprintf(out, ",%s,%s%s,", quantity->key, quantity->unit, per_m ? "/m" : "");
    sb_csv_put_name(out, c->runs[c->group[group].first].label);
    fprintf(out, ",%zu", spread->count);
    put_number(out, spread->mean);
    put_number(out, spread->least);
    put_number(out, spread->most);
    put_number(out, change);
    put_number(out, first->mean != 0 && quantity->of != SB_OF_TIME ? 100 * change / fabs(first->mean) : (double)NAN);
    fprintf(out, ",%s\n", item->kind != SB_ITEM_BODY ? "" : sb_item_doubtful(c, item, group) ? "no" : "yes");
}

void sb_table_csv(FILE *out, const sb_comparison *comparison, const sb_items *items)
{
    fputs(SB_TABLE_CSV_HEADER "\n", out);
    for (size_t i = 0; i < items->count; i++)
        for (size_t q = 0; sb_item_rows[items->items[i].kind].quantities[q].key; q++)
            for (size_t g = 0; g < comparison->groups; g++)
                if (sb_item_present(comparison, &items->items[i], g))
                    put_csv_row(out, comparison, &items->items[i], q, g);
}

/* ---- terminal ---- */

enum { NAME_WIDTH = 20, CELL_WIDTH = 18 };

/* Characters, not bytes: continuation bytes of UTF-8 do not count. */
static size_t width_of(const char *text)
{
    size_t width = 0;
    for (; *text; text++) width += ((unsigned char)*text & 0xc0) != 0x80;
    return width;
}

static void put_cell(FILE *out, const char *text, size_t width)
{
    const size_t used = width_of(text);
    fprintf(out, "%*s%s", used < width ? (int)(width - used) : 1, "", text);
}

static void put_line(FILE *out, const sb_comparison *c, const sb_item *item, size_t group, const char *name,
                     double unit)
{
    char figure[SB_FIGURE_MAX], change[SB_CHANGE_MAX], cell[SB_FIGURE_MAX + SB_CHANGE_MAX + 8];
    const sb_quantity *quantities = sb_item_rows[item->kind].quantities;
    fprintf(out, "%-*.*s %-*.*s", NAME_WIDTH, NAME_WIDTH, name, NAME_WIDTH, NAME_WIDTH, c->group[group].label);
    for (size_t q = 0; quantities[q].key; q++) {
        const sb_spread *spread = sb_item_spread(c, item, q, group);
        if (q == SB_BODY_FIRST_WET && item->kind == SB_ITEM_BODY && spread->count == 0)
            snprintf(figure, sizeof figure, "dry");
        else
            sb_figure(figure, (quantities[q].of == SB_OF_FORCE ? unit : 1) * spread->mean);
        sb_change_text(change, &quantities[q], sb_item_spread(c, item, q, 0), spread);
        snprintf(cell, sizeof cell, "%s%s%s%s", figure, *change ? " (" : "", change, *change ? ")" : "");
        put_cell(out, cell, CELL_WIDTH);
    }
    fputs(sb_item_doubtful(c, item, group) ? "  not reliable\n" : "\n", out);
}

static void put_heads(FILE *out, const sb_comparison *c, const sb_item *item, const char *force)
{
    const sb_item_row *row = &sb_item_rows[item->kind];
    char head[64];
    fprintf(out, "%s\n%-*s %-*s", row->title, NAME_WIDTH, row->name, NAME_WIDTH, "run");
    for (size_t q = 0; row->quantities[q].key; q++) {
        const sb_quantity *quantity = &row->quantities[q];
        if (quantity->of == SB_OF_FORCE)
            snprintf(head, sizeof head, "%s, %.*s%s", quantity->key, (int)strcspn(force, "N"), force, quantity->unit);
        else
            snprintf(head, sizeof head, "%s, %s", quantity->key, quantity->unit);
        if (c->flat && (quantity->of == SB_OF_FORCE || quantity->of == SB_OF_VOLUME))
            strncat(head, "/m", sizeof head - strlen(head) - 1);
        put_cell(out, head, CELL_WIDTH);
    }
    fputc('\n', out);
}

void sb_table_text(FILE *out, const sb_comparison *comparison, const sb_items *items)
{
    double unit = 1;
    for (size_t i = 0; i < items->count; i++) {
        const sb_item *item = &items->items[i];
        if (i == 0 || items->items[i - 1].kind != item->kind) {
            const char *force = "N";
            if (i > 0) fputc('\n', out);
            if (item->kind == SB_ITEM_BODY) unit = sb_force_unit(item->greatest, false, &force);
            put_heads(out, comparison, item, force);
        }
        if (item->kind == SB_ITEM_BODY && !(item->greatest > 0)) continue;
        const char *name = item->name;
        for (size_t g = 0; g < comparison->groups; g++) {
            if (!sb_item_present(comparison, item, g)) continue;
            put_line(out, comparison, item, g, name, unit);
            name = "";
        }
    }
}
