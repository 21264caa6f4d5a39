/* The run's pictures: one at the time of the greatest load, and a strip of others, scaled down; or its film. */
#include "report/sections.h"

#include "report/html.h"
#include "report/pictures.h"

#include <unistd.h>

enum { LEAD_BYTES = 450000, STRIP_BYTES = 600000, STRIP = 6 };

static void put_lead(FILE *out, const sb_report_page *page, const sb_stored_pictures *list)
{
    const bool loaded = page->loads->reached > 0;
    const double time = loaded ? page->loads->loads[0].horizontal_time : sb_report_reached(page->run);
    fputs("<div class=\"lead\">", out);
    sb_stored_pictures_put(out, list, sb_stored_pictures_nearest(list, time), 1000, LEAD_BYTES, NULL);
    if (loaded)
        sb_html_put(out,
                    "<p class=\"note\">The picture nearest to %g s, when the horizontal force on %s is greatest.</p>",
                    time, page->loads->loads[0].name);
    fputs("</div>\n", out);
}

static void put_strip(FILE *out, const sb_stored_pictures *list, size_t shown, size_t most)
{
    if (shown > list->count) shown = list->count;
    for (size_t k = 0; k < shown; k++)
        sb_stored_pictures_put(out, list, shown > 1 ? k * (list->count - 1) / (shown - 1) : 0, 480, most, NULL);
}

/* Writes the film of the first camera that has one; false: there is none. */
static bool put_film(FILE *out, const sb_report_page *page)
{
    static const char *const endings[] = {"mp4", "webm"};
    const sb_scene *scene = &page->run->scene;
    char path[SB_PATH_MAX], name[SB_NAME_MAX + 8], caption[SB_NAME_MAX + 32];
    for (size_t c = 0; c < scene->render.camera_count; c++)
        for (size_t e = 0; e < sizeof endings / sizeof *endings; e++) {
            snprintf(name, sizeof name, "%s.%s", scene->render.cameras[c].name, endings[e]);
            if (sb_path_join(path, page->run->directory, name, NULL) != SB_OK || access(path, R_OK) != 0) continue;
            snprintf(caption, sizeof caption, "Film of camera %s", scene->render.cameras[c].name);
            sb_film_put(out, path, page->film_bytes, caption);
            return true;
        }
    return false;
}

static void put_cameras(FILE *out, const sb_report_page *page, const sb_stored_pictures lists[2], size_t cameras)
{
    const size_t all = page->run->scene.render.camera_count;
    put_lead(out, page, &lists[0]);
    fputs("<div class=\"strip\">", out);
    for (size_t c = 0; c < cameras && !page->film; c++) put_strip(out, &lists[c], STRIP / cameras, STRIP_BYTES / STRIP);
    fputs("</div>\n", out);
    if (all > cameras) sb_html_put(out, "<p class=\"note\">Cameras shown: %z of %z.</p>", cameras, all);
}

void sb_section_pictures(FILE *out, const sb_report_page *page)
{
    const sb_report_run *run = page->run;
    sb_stored_pictures lists[2] = {{0}};
    size_t cameras = 0;
    for (size_t c = 0; run->has_scene && c < run->scene.render.camera_count && cameras < 2; c++) {
        sb_stored_pictures_list(run, run->scene.render.cameras[c].name, &lists[cameras]);
        if (lists[cameras].count > 0)
            cameras++;
        else
            sb_stored_pictures_free(&lists[cameras]);
    }
    fputs("<section id=\"pictures\"><h2>The event</h2>\n", out);
    if (cameras == 0) fputs("<p class=\"note\">The run has no pictures.</p>", out);
    if (cameras > 0) put_cameras(out, page, lists, cameras);
    if (page->film && !(run->has_scene && put_film(out, page)))
        fputs("<p class=\"missing\">The run has no film: render.video and ffmpeg make one.</p>", out);
    fputs("</section>\n", out);
    for (size_t c = 0; c < cameras; c++) sb_stored_pictures_free(&lists[c]);
}
