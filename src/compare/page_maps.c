/* The difference of inundation as a map in the page and as a file. */
#include "compare/difference.h"
#include "compare/page.h"

#include "base/memory.h"
#include "report/html.h"
#include "report/map_figure.h"

#include <math.h>

/* Less water than in the first scene: brown; more: blue. */
static const char palette[] = "0 '#8c510a', 0.25 '#dfc27d', 0.5 '#ffffff', 0.75 '#67a9cf', 1 '#053061'";

/* Bodies and gauges of the first run of a group. The caller frees *marks. */
static size_t list_marks(const sb_comparison *c, size_t group, sb_map_mark **marks)
{
    const sb_compared_run *run = &c->runs[c->group[group].first];
    const sb_measure_settings *measure = &run->run.scene.measure;
    size_t count = 0;
    *marks = sb_alloc(run->loads.count + measure->gauge_count, sizeof **marks);
    if (!*marks) return 0;
    for (size_t i = 0; i < run->loads.count; i++) {
        const sb_load *load = &run->loads.loads[i];
        if (load->has_point) (*marks)[count++] = (sb_map_mark){load->name, load->point[0], load->point[1], false};
    }
    for (size_t i = 0; i < measure->gauge_count; i++)
        (*marks)[count++] = (sb_map_mark){measure->gauges[i].name, measure->gauges[i].x, measure->gauges[i].y, true};
    return count;
}

/* Writes the file of the difference from all cells. */
static sb_status write_file(const sb_compare_page *page, const sb_grid *first, const sb_grid *other, size_t group,
                            double *spread, sb_error *error)
{
    char path[SB_PATH_MAX], name[64];
    sb_grid difference = {0};
    snprintf(name, sizeof name, "depth-difference-%zu.asc", group + 1);
    sb_status status = sb_path_join(path, page->folder, name, error);
    if (status == SB_OK) status = sb_grid_subtract(first, other, &difference, error);
    if (status == SB_OK) {
        *spread = sb_grid_spread(&difference);
        status = sb_grid_write(path, &difference, error);
    }
    sb_grid_free(&difference);
    return status;
}

/* Both grids are made coarser, by which each cell keeps its greatest depth, before they are subtracted. */
static sb_status put_figure(FILE *out, const sb_compare_page *page, sb_grid *first, sb_grid *other, size_t group,
                            double spread, sb_error *error)
{
    const sb_comparison *c = page->comparison;
    char label[2 * SB_LABEL_MAX + 160];
    sb_grid difference = {0};
    sb_map_mark *marks = NULL;
    sb_status status = sb_grid_coarsen(first, SB_MAP_SIDE_MAX, error);
    if (status == SB_OK) status = sb_grid_coarsen(other, SB_MAP_SIDE_MAX, error);
    if (status == SB_OK) status = sb_grid_subtract(first, other, &difference, error);
    if (status != SB_OK) return status;
    snprintf(label, sizeof label,
             "greatest depth in %.120s minus that in %.120s (m): brown is less water, blue is more",
             c->group[group].label, c->group[0].label);
    const double range = spread > 0 ? spread : 1;
    const sb_map_look look = {label, palette, -range, range};
    const size_t count = list_marks(c, group, &marks);
    status = sb_map_figure(out, &difference, &look, marks, count, error);
    sb_free(marks);
    sb_grid_free(&difference);
    return status;
}

static void put_group(FILE *out, const sb_compare_page *page, size_t group)
{
    const sb_comparison *c = page->comparison;
    sb_grid first = {0}, other = {0};
    sb_error error = {0};
    double spread = 0;
    sb_status status = sb_group_depth(c, 0, &first, &error);
    if (status == SB_OK) status = sb_group_depth(c, group, &other, &error);
    if (status == SB_OK && !sb_grid_same(&first, &other))
        status = sb_fail(&error, SB_BAD_INPUT, "%.120s and %.120s: their maps have different cells: no difference",
                         c->group[0].label, c->group[group].label);
    if (status == SB_OK) status = write_file(page, &first, &other, group, &spread, &error);
    if (status == SB_OK) status = put_figure(out, page, &first, &other, group, spread, &error);
    if (status != SB_OK) sb_html_put(out, "<p class=\"missing\">%s</p>\n", error.text);
    sb_grid_free(&first);
    sb_grid_free(&other);
}

void sb_compare_maps(FILE *out, const sb_compare_page *page)
{
    if (page->comparison->groups < 2) return;
    fputs("<section id=\"maps\"><h2>Difference of inundation</h2>\n<div class=\"maps\">", out);
    for (size_t g = 1; g < page->comparison->groups; g++) put_group(out, page, g);
    fputs(
        "</div>\n<p class=\"note\">x and y in m. A cell that stayed dry counts as depth 0; grey cells stayed dry in "
        "both. The colours end at the difference that one of a hundred cells exceeds. Squares are bodies, circles are "
        "gauges. depth-difference-<i>n</i>.asc beside this page has the values.</p></section>\n",
        out);
}
