/* Waves at gauges, their reflection, and overtopping beside EurOtop: tables of the summary's lists. */
#include "report/sections.h"

#include "report/html.h"

#include <math.h>
#include <string.h>

enum { CELLS = 8 };

/* A list of the summary, and what the page shows of each item. */
typedef struct shown {
    const char *list, *title, *item, *head, *note;
    struct {
        const char *key, *head;
    } cells[CELLS];
} shown;

static const shown all[] = {
    {"waves",
     "Waves at gauges",
     "gauge",
     "Gauge",
     "By upward crossings of the mean level since measure.waves.start. Hm0 is four standard deviations.",
     {{"waves", "Waves"},
      {"spectral_height_m", "Hm0, m"},
      {"significant_height_m", "Highest third, m"},
      {"highest_m", "Highest, m"},
      {"mean_height_m", "Mean height, m"},
      {"mean_period_s", "Mean period, s"},
      {"crest_z_m", "Highest crest, z in m"},
      {"crest_s", "at, s"}}},
    {"overtopping",
     "Overtopping beside EurOtop",
     "plane",
     "Plane",
     "Mean rates per metre of width. EurOtop's formula is that of docs/waves.md.",
     {{"rate_m2_s", "Run, m³/s per m"},
      {"eurotop_m2_s", "EurOtop, m³/s per m"},
      {"freeboard_m", "Freeboard, m"},
      {"height_m", "Hm0, m"},
      {"from_s", "From, s"}}},
};

static const char *name_of(const json_t *item, const char *key)
{
    return json_string_value(json_object_get(item, key));
}

static void begin(FILE *out, const char *title, const char *note, const char *head)
{
    sb_html_put(out, "<h3>%s</h3><p class=\"note\">%s</p><div class=\"wide\"><table><thead><tr><th>%s</th>", title,
                note, head);
}

static void finish(FILE *out)
{
    fputs("</tbody></table></div>\n", out);
}

static void put_shown(FILE *out, const json_t *list, const shown *s)
{
    begin(out, s->title, s->note, s->head);
    for (size_t c = 0; c < CELLS && s->cells[c].key; c++) sb_html_put(out, "<th>%s</th>", s->cells[c].head);
    fputs("</tr></thead><tbody>\n", out);
    for (size_t i = 0; i < json_array_size(list); i++) {
        const json_t *item = json_array_get(list, i);
        sb_html_put(out, "<tr><th scope=\"row\">%s</th>", name_of(item, s->item));
        for (size_t c = 0; c < CELLS && s->cells[c].key; c++)
            sb_html_put(out, "<td>%g</td>", sb_report_item_number(item, s->cells[c].key));
        fputs("</tr>\n", out);
    }
    finish(out);
}

/* Over the incident amplitude: the largest misfit of waves that count as split. */
static const double SPLIT = 0.5;

static void put_amplitudes(FILE *out, const char *name, const char *period, double incident, double reflected,
                           double misfit)
{
    const bool split = !(misfit > SPLIT * incident);
    sb_html_put(out, "<tr><th scope=\"row\">%s</th><td>%s</td><td>%g</td><td>%g</td><td>%g</td><td>%g</td></tr>\n",
                name, period, incident, reflected, split ? reflected / incident : (double)NAN, misfit);
}

/* Whether the gauges can tell the two waves of a period apart, and these are what the gauges have. */
static bool is_split(const json_t *item)
{
    return !json_is_false(json_object_get(item, "distinct")) &&
           !(sb_report_item_number(item, "misfit_m") > SPLIT * sb_report_item_number(item, "incident_m"));
}

/* A set's periods, of few, and all of them together. Returns the index behind the set. */
static size_t put_set(FILE *out, const json_t *list, size_t from)
{
    enum { FEW = 10 };
    const char *name = name_of(json_array_get(list, from), "name");
    double incident = 0, reflected = 0;
    size_t end = from;
    for (; end < json_array_size(list); end++) {
        const json_t *item = json_array_get(list, end);
        const char *its = name_of(item, "name");
        if (!name || !its || strcmp(name, its) != 0) break;
        if (!is_split(item)) continue;
        incident += pow(sb_report_item_number(item, "incident_m"), 2);
        reflected += pow(sb_report_item_number(item, "reflected_m"), 2);
    }
    if (end == from) return from + 1; /* it has no name */
    for (size_t i = from; end - from <= FEW && i < end; i++) {
        const json_t *item = json_array_get(list, i);
        char period[SB_FIGURE_MAX];
        put_amplitudes(out, name, sb_figure(period, sb_report_item_number(item, "period_s")),
                       sb_report_item_number(item, "incident_m"), sb_report_item_number(item, "reflected_m"),
                       sb_report_item_number(item, "misfit_m"));
    }
    if (end - from > 1) put_amplitudes(out, name, "all", sqrt(incident), sqrt(reflected), (double)NAN);
    return end;
}

static void put_reflections(FILE *out, const json_t *list)
{
    begin(out, "Reflection",
          "Amplitudes of the waves that come and of those that go back. All: roots of the sums of squares, of the "
          "periods at which the gauges can tell both apart and the misfit is at most half of the incident amplitude. "
          "Misfit: what the gauges have beside both waves. Where it is larger, as of a harmonic that is bound to a "
          "longer wave, the period is not split. Single periods are shown of sets with up to ten.",
          "Gauges");
    fputs("<th>Period, s</th><th>Incident, m</th><th>Reflected, m</th><th>Reflected over incident</th>"
          "<th>Misfit, m</th></tr></thead>"
          "<tbody>\n",
          out);
    for (size_t i = 0; i < json_array_size(list);) i = put_set(out, list, i);
    finish(out);
}

void sb_section_waves(FILE *out, const sb_report_page *page)
{
    const json_t *summary = page->run->summary, *reflections = json_object_get(summary, "reflections");
    if (json_array_size(reflections) > 0) put_reflections(out, reflections);
    for (size_t s = 0; s < sizeof all / sizeof *all; s++) {
        const json_t *list = json_object_get(summary, all[s].list);
        if (json_array_size(list) > 0) put_shown(out, list, &all[s]);
    }
}
