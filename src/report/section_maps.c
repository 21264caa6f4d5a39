/* The inundation maps as pictures in metres, with bodies and gauges. */
#include "report/sections.h"

#include "base/memory.h"
#include "output/maps/maps.h"
#include "report/html.h"
#include "report/map_figure.h"

#include <errno.h>
#include <math.h>

typedef struct marks {
    size_t count;
    sb_map_mark *marks;
} marks;

static void list_marks(const sb_report_page *page, marks *all)
{
    const sb_measure_settings *measure = page->run->has_scene ? &page->run->scene.measure : NULL;
    all->marks = sb_alloc(page->loads->count + (measure ? measure->gauge_count : 0), sizeof *all->marks);
    if (!all->marks) return; /* the maps are of use without them */
    for (size_t i = 0; i < page->loads->count; i++) {
        const sb_load *load = &page->loads->loads[i];
        if (load->has_point)
            all->marks[all->count++] = (sb_map_mark){load->name, load->point[0], load->point[1], false};
    }
    for (size_t i = 0; measure && i < measure->gauge_count; i++)
        all->marks[all->count++] =
            (sb_map_mark){measure->gauges[i].name, measure->gauges[i].x, measure->gauges[i].y, true};
}

/* Returns whether there is such a map. */
static bool put_row(FILE *out, const sb_report_page *page, const sb_map_row *row, const char *file, const marks *all)
{
    char path[SB_PATH_MAX], name[64];
    sb_grid grid = {0};
    sb_error error = {0};
    if (!row->drawn) return false;
    snprintf(name, sizeof name, "maps/%s.asc", file);
    errno = 0;
    sb_status status = sb_path_join(path, page->run->directory, name, &error);
    if (status == SB_OK) status = sb_grid_read(path, &grid, &error);
    if (status != SB_OK && errno == ENOENT) return false;
    if (status == SB_OK) status = sb_grid_coarsen(&grid, SB_MAP_SIDE_MAX, &error);
    if (status == SB_OK && grid.wet == 0)
        sb_html_put(out, "<p class=\"note\">%s: no cell was wet.</p>", row->label);
    else if (status == SB_OK) {
        const sb_map_look look = {row->label, row->palette, row->from_zero ? fmin(0, grid.low) : grid.low, grid.high};
        status = sb_map_figure(out, &grid, &look, all->marks, all->count, &error);
    }
    if (status != SB_OK) sb_html_put(out, "<p class=\"missing\">%s</p>", error.text);
    sb_grid_free(&grid);
    return true;
}

/* The maps of the depth-averaged water beside the particles. Returns their number. */
static size_t put_grid_rows(FILE *out, const sb_report_page *page, const marks *all)
{
    size_t count = 0;
    const sb_scene *scene = page->run->has_scene ? &page->run->scene : NULL;
    if (!scene || !sb_scene_nested(scene) || !scene->offshore.maps) return 0;
    fputs("<h3>Depth-averaged water beside the particles</h3>\n<div class=\"maps\">", out);
    for (const sb_map_row *row = sb_map_rows; row->name; row++) count += put_row(out, page, row, row->grid_name, all);
    fputs("</div>\n", out);
    return count;
}

void sb_section_maps(FILE *out, const sb_report_page *page)
{
    size_t count = 0;
    marks all = {0};
    list_marks(page, &all);
    fputs("<section id=\"maps\"><h2>Inundation</h2>\n<div class=\"maps\">", out);
    for (const sb_map_row *row = sb_map_rows; row->name; row++) count += put_row(out, page, row, row->name, &all);
    fputs("</div>\n", out);
    count += put_grid_rows(out, page, &all);
    if (count > 0)
        fputs("<p class=\"note\">x and y in m. Grey cells never were wet. Squares are bodies, circles are gauges.</p>",
              out);
    else
        fputs("<p class=\"note\">The run has no maps.</p>", out);
    fputs("</section>\n", out);
    sb_free(all.marks);
}
