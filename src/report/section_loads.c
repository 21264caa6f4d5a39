/* The loads on bodies: plot, table by load, and the forces that are not to be trusted. */
#include "report/sections.h"

#include "report/html.h"

#include <math.h>

static void put_head(FILE *out, const char *force, const char *moment, const char *impulse)
{
    sb_html_put(
        out,
        "<thead><tr><th>Body</th><th>Horizontal force, %s<small>greatest, and when</small></th>"
        "<th>Vertical force, %s<small>least to greatest, up is positive</small></th>"
        "<th>Impulse, %s<small>horizontal</small></th>"
        "<th>Overturning moment, %s<small>greatest, and when</small></th>"
        "<th>Flow depth,<small>particles</small></th><th>Force</th><th class=\"csv\">Series</th></tr></thead>\n",
        force, force, impulse, moment);
}

static void put_verdict(FILE *out, const sb_load *load)
{
    if (!load->judged)
        fputs("<td class=\"open\">not judged</td>", out);
    else if (load->coarse || load->narrow)
        fputs("<td class=\"bad\">not reliable</td>", out);
    else
        fputs("<td class=\"good\">usable</td>", out);
}

/* 0 for what rounds to 0 beside the horizontal force. */
static double beside(const sb_load *load, double value)
{
    return fabs(value) < 5e-4 * load->horizontal ? 0 : value;
}

static void put_row(FILE *out, const sb_load *load, double unit, bool has_series)
{
    sb_html_put(out, "<tr><th scope=\"row\">%s</th><td>%g<small>at %g s</small></td><td>%g to %g</td>", load->name,
                unit * load->horizontal, load->horizontal_time, unit * beside(load, load->down),
                unit * beside(load, load->up));
    sb_html_put(out, "<td>%g</td><td>%g<small>at %g s</small></td><td>%g</td>", unit * load->impulse_horizontal,
                unit * load->moment, load->moment_time, round(10 * load->layers) / 10);
    put_verdict(out, load);
    if (has_series)
        sb_html_put(
            out,
            "<td class=\"csv\"><a class=\"csv\" data-table=\"forces\" data-name=\"%s\" href=\"#loads\">CSV</a></td>",
            load->name);
    else
        fputs("<td class=\"csv\"></td>", out);
    fputs("</tr>\n", out);
}

static void put_table(FILE *out, const sb_report_page *page)
{
    const sb_loads *loads = page->loads;
    const bool flat = page->run->flat;
    const char *force;
    char moment[16], impulse[16];
    const double unit = sb_force_unit(loads->loads[0].horizontal, flat, &force);
    const char *prefix = unit < 1e-4 ? "M" : unit < 1 ? "k" : "";
    snprintf(moment, sizeof moment, "%sN\u202fm%s", prefix, flat ? "/m" : "");
    snprintf(impulse, sizeof impulse, "%sN\u202fs%s", prefix, flat ? "/m" : "");
    fputs("<div class=\"wide\"><table class=\"loads\">", out);
    put_head(out, force, moment, impulse);
    fputs("<tbody>", out);
    for (size_t i = 0; i < loads->reached; i++)
        put_row(out, &loads->loads[i], unit, i < page->plots[SB_REPORT_FORCES].count);
    fputs("</tbody></table></div>\n", out);
    if (loads->reached < loads->count) {
        fputs("<p class=\"note\">No force acted on: ", out);
        for (size_t i = loads->reached; i < loads->count; i++)
            sb_html_put(out, "%s%s", i > loads->reached ? ", " : "", loads->loads[i].name);
        fputs(".</p>\n", out);
    }
}

static void put_meaning(FILE *out, const sb_report_page *page)
{
    const double interval = page->run->has_scene ? page->run->scene.measure.interval : (double)NAN;
    fputs("<p class=\"note\">", out);
    if (!isnan(interval))
        sb_html_put(out, "Forces and moments are means over %g s; a shorter interval gives higher peaks of an impact. ",
                    interval);
    fputs(
        "Forces include the pressure of water at rest. The overturning moment is the horizontal moment about the "
        "body’s reference point (moment_point_m of summary.json; by default the middle of its footprint at its lowest "
        "level). The impulse is the sum of force times time over the whole run.",
        out);
    if (page->run->flat) fputs(" The scene is in two dimensions: all values are per metre of width.", out);
    fputs("</p>\n", out);
}

void sb_section_loads(FILE *out, const sb_report_page *page)
{
    fputs("<section id=\"loads\"><h2>Loads on bodies</h2>\n", out);
    if (page->loads->count == 0)
        fputs("<p class=\"note\">The run measured no forces.</p>", out);
    else if (page->loads->reached == 0)
        fputs("<p class=\"note\">No force acted on any body.</p>", out);
    else {
        sb_plot_put(out, &page->plots[SB_REPORT_FORCES], "Force on bodies, the six with the greatest loads first.");
        put_table(out, page);
        put_meaning(out, page);
    }
    fputs("</section>\n", out);
}
