/* The film, and pictures of the runs side by side at the time of the greatest load. */
#include "compare/film.h"
#include "compare/page.h"

#include "report/html.h"
#include "report/pictures.h"

#include <math.h>

enum { PICTURE_WIDTH = 640, PICTURE_BYTES = 220000 };

/* The time of the greatest force, in the first scene, on the body whose greatest force differs most; without one, on
   the first body. NaN: there is no force. */
static double time_of_load(const sb_compare_page *page, const char **body)
{
    const sb_comparison *c = page->comparison;
    const sb_item *item = sb_items_most_changed(c, page->items, SB_ITEM_BODY, 0, c->groups > 1);
    *body = item ? item->name : "";
    return item ? sb_item_spread(c, item, 1, 0)->mean : (double)NAN;
}

static void put_row(FILE *out, const sb_compare_page *page, const char *camera, size_t groups, double time)
{
    const sb_comparison *c = page->comparison;
    fputs("<div class=\"beside\">", out);
    for (size_t g = 0; g < groups; g++) {
        sb_stored_pictures list;
        sb_stored_pictures_list(&c->runs[c->group[g].first].run, camera, &list);
        if (list.count > 0)
            sb_stored_pictures_put(out, &list, sb_stored_pictures_nearest(&list, time), PICTURE_WIDTH, PICTURE_BYTES,
                                   c->group[g].label);
        sb_stored_pictures_free(&list);
    }
    fputs("</div>\n", out);
}

static void put_film(FILE *out, const sb_compare_page *page, const char *camera, size_t groups, size_t most)
{
    const sb_comparison *c = page->comparison;
    char path[SB_PATH_MAX], caption[SB_FILM_MAX * (SB_LABEL_MAX + 40) + 200];
    if (page->no_film) {
        sb_html_put(out, "<p class=\"note\">%s</p>\n", page->no_film);
        return;
    }
    int n = snprintf(caption, sizeof caption, "Camera %.64s, at equal times; from left to right: ", camera);
    for (size_t g = 0; g < groups; g++)
        n += snprintf(caption + n, sizeof caption - (size_t)n, "%s%.160s", g > 0 ? ", " : "", c->group[g].label);
    if (sb_path_join(path, page->folder, "compare.mp4", NULL) == SB_OK) sb_film_put(out, path, most, caption);
}

void sb_compare_pictures(FILE *out, const sb_compare_page *page, size_t most)
{
    size_t groups = 0;
    const char *camera = sb_film_camera(page->comparison, &groups);
    const size_t pictures = groups * PICTURE_BYTES / 3 * 4;
    const char *body;
    const double time = time_of_load(page, &body);
    fputs("<section id=\"pictures\"><h2>The event</h2>\n", out);
    if (camera) {
        put_row(out, page, camera, groups, isnan(time) ? 0 : time);
        if (!isnan(time))
            sb_html_put(
                out,
                "<p class=\"note\">Pictures nearest to %g s, when the horizontal force on %s, which changed most, "
                "is greatest in %s.</p>",
                time, body, page->comparison->group[0].label);
    }
    put_film(out, page, camera ? camera : "", groups, most > pictures ? most - pictures : 0);
    fputs("</section>\n", out);
}
