/* Title, warnings, the greatest differences, what differs between the scenes; and how the values are made. */
#include "compare/page.h"

#include "compare/table.h"
#include "report/html.h"

#include <string.h>

/* ---- results at a glance ---- */

/* One tile: the change of a quantity of an item, and both values. */
static void put_tile(FILE *out, const sb_compare_page *page, const sb_item *item, size_t q, const char *what)
{
    const sb_comparison *c = page->comparison;
    const sb_quantity *quantity = &sb_item_rows[item->kind].quantities[q];
    const sb_spread *first = sb_item_spread(c, item, q, 0), *other = sb_item_spread(c, item, q, 1);
    char change[SB_CHANGE_MAX];
    const char *unit = quantity->unit;
    const double scale = quantity->of == SB_OF_FORCE ? sb_force_unit(item->greatest, c->flat, &unit) : 1;
    sb_change_text(change, quantity, first, other);
    if (!*change) return;
    sb_html_put(out, "<div class=\"tile\"><b>%s</b><p>%s: %g %s in %s, %g %s in %s</p></div>\n", change, what,
                scale * first->mean, unit, c->group[0].label, scale * other->mean, unit, c->group[1].label);
}

/* The number of bodies on which a force acted, in each scene. */
static void put_loaded_tile(FILE *out, const sb_compare_page *page)
{
    const sb_comparison *c = page->comparison;
    size_t loaded[2] = {0, 0};
    char value[64];
    for (size_t i = 0; i < page->items->count; i++)
        for (size_t g = 0; g < 2; g++)
            loaded[g] += page->items->items[i].kind == SB_ITEM_BODY && page->items->items[i].everywhere &&
                         sb_item_spread(c, &page->items->items[i], 0, g)->most > 0;
    if (loaded[0] + loaded[1] == 0) return;
    snprintf(value, sizeof value, "%zu → %zu", loaded[0], loaded[1]);
    sb_html_put(out, "<div class=\"tile\"><b>%s</b><p>bodies with a load, of those that both scenes have</p></div>\n",
                value);
}

static void put_tiles(FILE *out, const sb_compare_page *page)
{
    static const char *const what[SB_ITEM_KINDS] = {"horizontal force on", "highest water at gauge",
                                                    "highest run-up on line", "greatest net volume through",
                                                    "flooded ground"};
    char text[SB_LABEL_MAX + 64];
    if (page->comparison->groups != 2) return;
    fputs("<section class=\"tiles\">\n", out);
    put_loaded_tile(out, page);
    for (int kind = 0; kind < SB_ITEM_KINDS; kind++) {
        const sb_item *item = sb_items_most_changed(page->comparison, page->items, (sb_item_kind)kind, 0, 1);
        if (!item) continue;
        snprintf(text, sizeof text, "%s%s%.100s", what[kind], kind == SB_ITEM_MAP ? "" : " ",
                 kind == SB_ITEM_MAP ? "" : item->name);
        put_tile(out, page, item, 0, text);
    }
    fputs("</section>\n<p class=\"note\">Each tile has the body, gauge, line or plane that changed most.</p>\n", out);
}

/* ---- how far to trust ---- */

static void put_note(FILE *out, const char *kind, const char *mark, const char *title)
{
    sb_html_put(out, "<li class=\"%s\"><b class=\"mark\">%s</b><div><b>%s</b> ", kind, mark, title);
}

static void put_reliable(FILE *out, const sb_compare_page *page)
{
    size_t loaded = 0, bad = 0;
    for (size_t i = 0; i < page->items->count; i++) {
        const sb_item *item = &page->items->items[i];
        bool doubtful = false;
        if (item->kind != SB_ITEM_BODY || !(item->greatest > 0)) continue;
        for (size_t g = 0; g < page->comparison->groups; g++) doubtful |= sb_item_doubtful(page->comparison, item, g);
        loaded++;
        bad += doubtful;
    }
    if (loaded == 0) return;
    put_note(out, bad > 0 ? "bad" : "good", bad > 0 ? "caution" : "good", "Forces.");
    if (bad == 0)
        fputs("The flow at every loaded body was resolved in all runs.", out);
    else
        sb_html_put(
            out,
            "On %z of %z loaded bodies the force is marked as not reliable in at least one run, because the flow "
            "is too shallow for the particles or a gap is too narrow. Differences of these are no better: flow over a "
            "crest that is thinner than about four spacings is not resolved and can be missing, so that a coarse "
            "run can show a building dry that a finer run floods. Repeat both scenes at a finer resolution before a "
            "difference is used. The report of each run says why, and which spacing it needs.",
            bad, loaded);
    fputs("</div></li>\n", out);
}

static void put_bars(FILE *out, const sb_comparison *c)
{
    size_t single = 0;
    for (size_t g = 0; g < c->groups; g++) single += c->group[g].count == 1;
    put_note(out, single > 0 ? "open" : "good", single > 0 ? "note" : "good", "Error bars.");
    if (single == c->groups)
        fputs(
            "Each scene has one run, so there are no error bars: it is not known which differences are due to chance. "
            "Repeat each scene with <code>--set numerics.seed=2</code>, 3, ... and give all runs to "
            "<code>shorebreak compare</code>.",
            out);
    else
        fputs("Values of several runs are means, with the least and the greatest value. A difference with ~ lies "
              "within them: it may be due to chance.",
              out);
    if (single > 0 && single < c->groups)
        sb_html_put(out, " Of %z scenes %z %s one run only, without error bars.", c->groups, single,
                    single == 1 ? "has" : "have");
    fputs("</div></li>\n", out);
}

static void put_trust(FILE *out, const sb_compare_page *page)
{
    const sb_texts *warnings = &page->comparison->warnings;
    fputs("<section id=\"trust\"><h2>How far to trust the differences</h2>\n<ul class=\"quality\">\n", out);
    for (size_t w = 0; w < warnings->count; w++) {
        put_note(out, "bad", "caution", "Scenes.");
        sb_html_put(out, "%s</div></li>\n", warnings->texts[w]);
    }
    put_reliable(out, page);
    put_bars(out, page->comparison);
    fputs("</ul></section>\n", out);
}

/* ---- what differs ---- */

static const char *value_of(const sb_comparison *c, size_t group, const char *key)
{
    const char *value = sb_scene_values_find(&c->runs[c->group[group].first].values, key);
    return value ? value : "–";
}

static size_t put_difference(FILE *out, const sb_comparison *c, const char *key, size_t shown)
{
    enum { SHOWN_MAX = 60 };
    bool equal = true;
    const char *last = strrchr(key, '.');
    const bool seed = strcmp(key, "numerics.seed") == 0, named = last && strcmp(last, ".name") == 0;
    for (size_t g = 1; g < c->groups; g++) equal &= strcmp(value_of(c, g, key), value_of(c, 0, key)) == 0;
    if (equal || seed || named || !sb_scene_values_matter(key)) return 0;
    if (shown >= SHOWN_MAX) return 1;
    if (shown == 0) {
        fputs("<div class=\"wide\"><table><thead><tr><th>Key of the scene</th>", out);
        for (size_t g = 0; g < c->groups; g++) sb_html_put(out, "<th>%s</th>", c->group[g].label);
        fputs("</tr></thead><tbody>\n", out);
    }
    sb_html_put(out, "<tr><th scope=\"row\">%s</th>", key);
    for (size_t g = 0; g < c->groups; g++) sb_html_put(out, "<td>%s</td>", value_of(c, g, key));
    fputs("</tr>\n", out);
    return 1;
}

static void put_differences(FILE *out, const sb_comparison *c)
{
    size_t count = 0;
    fputs("<section id=\"scenes\"><h2>What differs between the scenes</h2>\n", out);
    for (size_t g = 0; g < c->groups; g++) {
        const sb_scene_values *values = &c->runs[c->group[g].first].values;
        for (size_t i = 0; i < values->count; i++) {
            bool earlier = false; /* a scene before has the key, and it is listed there */
            for (size_t e = 0; e < g; e++)
                earlier |= sb_scene_values_find(&c->runs[c->group[e].first].values, values->values[i].key) != NULL;
            if (!earlier) count += put_difference(out, c, values->values[i].key, count);
        }
    }
    if (count == 0)
        fputs("<p class=\"note\">The scenes have equal values; only start seeds, names or pictures differ.</p>", out);
    else
        fputs("</tbody></table></div>\n", out);
    if (count > 60) sb_html_put(out, "<p class=\"note\">The first 60 of %z keys.</p>", count);
    fputs("</section>\n", out);
}

void sb_compare_head(FILE *out, const sb_compare_page *page)
{
    const sb_comparison *c = page->comparison;
    fputs("<header><p class=\"brand\">shorebreak · comparison of runs</p>", out);
    sb_html_put(out, "<h1>%s</h1><p class=\"state good\">%z runs of %z scenes</p></header>\n<main>\n", page->title,
                c->count, c->groups);
    put_tiles(out, page);
    put_differences(out, c);
    put_trust(out, page);
}

void sb_compare_record(FILE *out, const sb_compare_page *page)
{
    const sb_comparison *c = page->comparison;
    fputs(
        "<section id=\"record\"><h2>Values and runs</h2>\n<p class=\"note\">Peaks are of means over "
        "<code>measure.interval</code>; the horizontal impulse is the sum of force times time over the whole run; the "
        "overturning moment is the horizontal moment about the body’s reference point. The greatest depth in front is "
        "the mean of the map of depths before a side of the body, at most two particle spacings away, at the side "
        "where it "
        "is greatest. A "
        "body is first wet at the end of the first interval with a force. Differences are from the first scene; "
        "percentages are of its value.</p>\n<dl>",
        out);
    for (size_t r = 0; r < c->count; r++) {
        const sb_report_run *run = &c->runs[r].run;
        const char *version = sb_report_text(run, "version"), *hash = sb_report_text(run, "state_hash");
        const char *seed = sb_scene_values_find(&c->runs[r].values, "numerics.seed");
        sb_html_put(
            out,
            "<div><dt>%s</dt><dd>%s; shorebreak %s; spacing %g m, %g particles, %g s, seed %s; state %s</dd></div>\n",
            c->runs[r].label, run->directory, version ? version : "–", sb_report_number(run, "resolution_m"),
            sb_report_number(run, "fluid_particles"), sb_report_reached(run), seed ? seed : "–", hash ? hash : "–");
    }
    sb_html_put(out, "<div><dt>Version of this page</dt><dd>shorebreak %s</dd></div></dl></section>\n</main>\n",
                SB_VERSION);
}
