/* The run's pictures: one at the time of the greatest load, and a strip of others, scaled down. */
#include "report/sections.h"

#include "base/memory.h"
#include "render/image.h"
#include "report/html.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAD_BYTES = 450000, STRIP_BYTES = 600000, STRIP = 6 };

typedef struct pictures {
    const char *camera;
    char folder[SB_PATH_MAX];
    size_t count, capacity;
    unsigned long *numbers; /* of the files, in increasing order; picture n is of the time (n - 1) interval */
} pictures;

static int by_number(const void *a, const void *b)
{
    const unsigned long one = *(const unsigned long *)a, other = *(const unsigned long *)b;
    return (one > other) - (one < other);
}

static void list_pictures(const sb_report_run *run, const char *camera, pictures *list)
{
    char name[SB_NAME_MAX + 16];
    *list = (pictures){.camera = camera};
    snprintf(name, sizeof name, "frames/%s", camera);
    if (sb_path_join(list->folder, run->directory, name, NULL) != SB_OK) return;
    DIR *entries = opendir(list->folder);
    for (const struct dirent *entry; entries && (entry = readdir(entries));) {
        const char *ending = strstr(entry->d_name, ".png");
        if (!sb_is_numbered(entry->d_name, ".png", 0) || !ending || ending[4]) continue;
        if (sb_grow((void **)&list->numbers, &list->capacity, list->count + 1, sizeof *list->numbers) != 0) break;
        list->numbers[list->count++] = strtoul(entry->d_name, NULL, 10);
    }
    if (entries) closedir(entries);
    if (list->count > 1) qsort(list->numbers, list->count, sizeof *list->numbers, by_number);
}

static double time_of(const sb_report_run *run, unsigned long number)
{
    return (double)(number - 1) * run->scene.render.interval;
}

static sb_status read_picture(const pictures *list, size_t i, sb_image *image, sb_error *error)
{
    char name[32], path[SB_PATH_MAX];
    snprintf(name, sizeof name, "%06lu.png", list->numbers[i]);
    const sb_status status = sb_path_join(path, list->folder, name, error);
    return status == SB_OK ? sb_png_read(path, image, error) : status;
}

/* A picture in PNG of at most `most` bytes, as wide as this allows. */
static sb_status encode_within(const sb_image *image, int width, size_t most, sb_image *small, unsigned char **bytes,
                               size_t *size, sb_error *error)
{
    for (;; width = 5 * width / 6) {
        sb_status status = sb_image_shrink(image, width, small, error);
        if (status == SB_OK) status = sb_png_encode(small, bytes, size, error);
        if (status != SB_OK || *size <= most) return status;
        sb_free(*bytes);
        *bytes = NULL;
        if (width < 40) return sb_fail(error, SB_FAILED, "a picture is too large for the page");
    }
}

static void put_picture(FILE *out, const sb_report_page *page, const pictures *list, size_t i, int width, size_t most)
{
    sb_image image = {0}, small = {0};
    sb_error error = {0};
    unsigned char *bytes = NULL;
    size_t size = 0;
    const double time = time_of(page->run, list->numbers[i]);
    sb_status status = read_picture(list, i, &image, &error);
    if (status == SB_OK) status = encode_within(&image, width, most, &small, &bytes, &size, &error);
    fputs("<figure>", out);
    if (status == SB_OK) {
        sb_html_put(out,
                    "<img width=\"%d\" height=\"%d\" alt=\"Picture of camera %s at %g s\" src=\"data:image/png;base64,",
                    small.width, small.height, list->camera, time);
        sb_html_base64(out, bytes, size);
        sb_html_put(out, "\"><figcaption>t ≈ %g s, camera %s</figcaption>", time, list->camera);
    } else
        sb_html_put(out, "<p class=\"missing\">%s</p>", error.text);
    fputs("</figure>\n", out);
    sb_free(bytes);
    sb_image_free(&small);
    sb_image_free(&image);
}

static size_t nearest_to(const sb_report_page *page, const pictures *list, double time)
{
    size_t best = 0;
    for (size_t i = 1; i < list->count; i++)
        if (fabs(time_of(page->run, list->numbers[i]) - time) < fabs(time_of(page->run, list->numbers[best]) - time))
            best = i;
    return best;
}

static void put_lead(FILE *out, const sb_report_page *page, const pictures *list)
{
    const bool loaded = page->loads->reached > 0;
    const double time = loaded ? page->loads->loads[0].horizontal_time : sb_report_reached(page->run);
    fputs("<div class=\"lead\">", out);
    put_picture(out, page, list, nearest_to(page, list, time), 1000, LEAD_BYTES);
    if (loaded)
        sb_html_put(out,
                    "<p class=\"note\">The picture nearest to %g s, when the horizontal force on %s is greatest.</p>",
                    time, page->loads->loads[0].name);
    fputs("</div>\n", out);
}

static void put_strip(FILE *out, const sb_report_page *page, const pictures *list, size_t shown, size_t most)
{
    if (shown > list->count) shown = list->count;
    for (size_t k = 0; k < shown; k++)
        put_picture(out, page, list, shown > 1 ? k * (list->count - 1) / (shown - 1) : 0, 480, most);
}

void sb_section_pictures(FILE *out, const sb_report_page *page)
{
    const sb_report_run *run = page->run;
    pictures lists[2] = {{0}};
    size_t cameras = 0;
    for (size_t c = 0; run->has_scene && c < run->scene.render.camera_count && cameras < 2; c++) {
        list_pictures(run, run->scene.render.cameras[c].name, &lists[cameras]);
        if (lists[cameras].count > 0)
            cameras++;
        else
            sb_free(lists[cameras].numbers);
    }
    fputs("<section id=\"pictures\"><h2>The event</h2>\n", out);
    if (cameras == 0) fputs("<p class=\"note\">The run has no pictures.</p>", out);
    if (cameras > 0) {
        put_lead(out, page, &lists[0]);
        fputs("<div class=\"strip\">", out);
        for (size_t c = 0; c < cameras; c++) put_strip(out, page, &lists[c], STRIP / cameras, STRIP_BYTES / STRIP);
        fputs("</div>\n", out);
        if (run->scene.render.camera_count > cameras)
            sb_html_put(out, "<p class=\"note\">Cameras shown: %z of %z.</p>", cameras, run->scene.render.camera_count);
    }
    fputs("</section>\n", out);
    for (size_t c = 0; c < cameras; c++) sb_free(lists[c].numbers);
}
