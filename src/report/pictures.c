#include "report/pictures.h"

#include "base/memory.h"
#include "render/image/image.h"
#include "report/html.h"

#include <dirent.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static int by_number(const void *a, const void *b)
{
    const unsigned long one = *(const unsigned long *)a, other = *(const unsigned long *)b;
    return (one > other) - (one < other);
}

void sb_stored_pictures_list(const sb_report_run *run, const char *camera, sb_stored_pictures *list)
{
    char name[SB_NAME_MAX + 16];
    *list = (sb_stored_pictures){.camera = camera};
    if (!run->has_scene) return;
    list->interval = run->scene.render.interval;
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

void sb_stored_pictures_free(sb_stored_pictures *list)
{
    sb_free(list->numbers);
    *list = (sb_stored_pictures){0};
}

double sb_stored_pictures_time(const sb_stored_pictures *list, size_t i)
{
    return (double)(list->numbers[i] - 1) * list->interval;
}

size_t sb_stored_pictures_nearest(const sb_stored_pictures *list, double time)
{
    size_t best = 0;
    for (size_t i = 1; i < list->count; i++)
        if (fabs(sb_stored_pictures_time(list, i) - time) < fabs(sb_stored_pictures_time(list, best) - time)) best = i;
    return best;
}

static sb_status read_picture(const sb_stored_pictures *list, size_t i, sb_image *image, sb_error *error)
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

void sb_stored_pictures_put(FILE *out, const sb_stored_pictures *list, size_t i, int width, size_t most,
                            const char *label)
{
    sb_image image = {0}, small = {0};
    sb_error error = {0};
    unsigned char *bytes = NULL;
    size_t size = 0;
    const double time = sb_stored_pictures_time(list, i);
    sb_status status = read_picture(list, i, &image, &error);
    if (status == SB_OK) status = encode_within(&image, width, most, &small, &bytes, &size, &error);
    fputs("<figure>", out);
    if (status == SB_OK) {
        sb_html_put(out,
                    "<img width=\"%d\" height=\"%d\" alt=\"Picture of camera %s at %g s\" src=\"data:image/png;base64,",
                    small.width, small.height, list->camera, time);
        sb_html_base64(out, bytes, size);
        sb_html_put(out, "\"><figcaption>%s%st ≈ %g s, camera %s</figcaption>", label ? label : "", label ? ", " : "",
                    time, list->camera);
    } else
        sb_html_put(out, "<p class=\"missing\">%s</p>", error.text);
    fputs("</figure>\n", out);
    sb_free(bytes);
    sb_image_free(&small);
    sb_image_free(&image);
}

void sb_film_put(FILE *out, const char *path, size_t most, const char *caption)
{
    char *bytes = NULL;
    size_t size = 0;
    sb_error error = {0};
    const char *ending = strrchr(path, '.');
    const sb_status status = sb_file_read(path, most / 4 * 3, &bytes, &size, &error);
    if (status == SB_OK) {
        sb_html_put(out,
                    "<figure class=\"film\"><video controls muted playsinline preload=\"auto\" "
                    "src=\"data:video/%s;base64,",
                    ending && strcmp(ending, ".webm") == 0 ? "webm" : "mp4");
        sb_html_base64(out, (const unsigned char *)bytes, size);
        sb_html_put(out, "\"></video><figcaption>%s</figcaption></figure>\n", caption);
    } else
        sb_html_put(out, "<p class=\"missing\">The film is not in this page: %s</p>\n", error.text);
    sb_free(bytes);
}
