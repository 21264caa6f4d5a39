/* Paints a slice: its face, outlines, arrows and lines. */
#include "render/overlay/colormap.h"
#include "render/overlay/font.h"
#include "render/overlay/overlay.h"
#include "render/overlay/paint.h"
#include "render/slice/slice.h"

#include <math.h>
#include <stdio.h>

static const float body_ink[3] = {0.33f, 0.34f, 0.36f}, terrain_ink[3] = {0.47f, 0.41f, 0.33f};
static const float outline_ink[3] = {0.08f, 0.08f, 0.09f}, paper[3] = {0.84f, 0.87f, 0.89f};
static const float dark[3] = {0.02f, 0.04f, 0.07f}, light[3] = {0.97f, 0.98f, 0.99f};

/* While a picture is painted. */
struct painting {
    const sb_slicer *slicer;
    const sb_slice_job *job;
    const sb_plane_area *area;
    sb_plane_map to_pixels, to_plane;
    sb_image *image;
    double unit; /* px in a picture that is 720 px high */
};

static double unit_of(const sb_image *image)
{
    return fmax(0.6, image->height / 720.0);
}

static void mix(unsigned char *pixel, const float rgb[3], double alpha)
{
    for (int c = 0; c < 3; c++) pixel[c] = (unsigned char)(pixel[c] + alpha * (255 * (double)rgb[c] - pixel[c]) + 0.5);
}

/* How much of a pixel the water covers: its edge, where the density is 0.5, is a pixel wide. */
static double cover_of(const struct painting *p, const sb_plane_sample *sample, int x, int y)
{
    static const int away[2][2] = {{1, 0}, {0, 1}};
    double square = 0, place[2];
    const double over = (double)sample->density - 0.5;
    if (fabs(over) > 0.45) return over > 0;
    for (int k = 0; k < 2; k++) {
        if (!sb_plane_apply(&p->to_plane, x + 0.5 + away[k][0], y + 0.5 + away[k][1], place)) return over > 0;
        const sb_plane_sample next = sb_plane_field_at(&p->slicer->field, place[0], place[1]);
        const double change = (double)(next.density - sample->density);
        square += change * change;
    }
    const double cover = 0.5 + over / fmax(sqrt(square), 1e-6);
    return cover < 0 ? 0 : cover > 1 ? 1 : cover;
}

/* One pixel: water in the colour of the field, without light, so that it is that of the legend; then what is solid. */
static void paint_pixel(const struct painting *p, int x, int y)
{
    const size_t at = (size_t)y * (size_t)p->image->width + (size_t)x;
    unsigned char *pixel = p->image->rgb + 3 * at;
    double place[2];
    if (!sb_plane_apply(&p->to_plane, x + 0.5, y + 0.5, place)) return;
    const sb_plane_sample sample = sb_plane_field_at(&p->slicer->field, place[0], place[1]);
    const double terrain = (double)p->slicer->terrain[at], bodies = (double)p->slicer->bodies[at];
    if (sample.density > 0.05f) {
        float rgb[3];
        sb_colormap(sb_fields[p->job->slice->field].map, (double)sample.value, rgb);
        mix(pixel, rgb, cover_of(p, &sample, x, y));
    }
    if (terrain > 0) mix(pixel, terrain_ink, terrain);
    if (bodies > 0) mix(pixel, body_ink, bodies);
}

static void paint_face(const struct painting *p)
{
#pragma omp parallel for num_threads(p->job->threads) schedule(static)
    for (int y = 0; y < p->image->height; y++)
        for (int x = 0; x < p->image->width; x++) paint_pixel(p, x, y);
}

static bool is_far(const struct painting *p, const double at[2])
{
    const double wide = p->image->width, tall = p->image->height;
    return at[0] < -wide || at[0] > 2 * wide || at[1] < -tall || at[1] > 2 * tall;
}

/* Whether a line lies beyond one side of the picture. */
static bool is_beyond(const struct painting *p, double end[2][2])
{
    const double size[2] = {p->image->width, p->image->height}, margin = 4 * p->unit;
    for (int k = 0; k < 2; k++)
        if ((end[0][k] < -margin && end[1][k] < -margin) ||
            (end[0][k] > size[k] + margin && end[1][k] > size[k] + margin))
            return true;
    return false;
}

static void paint_outlines(const struct painting *p)
{
    for (size_t i = 0; i < p->slicer->section.count; i++) {
        double end[2][2];
        if (!sb_section_project(&p->slicer->section.pieces[i], &p->to_pixels, end)) continue;
        if (is_beyond(p, end)) continue;
        sb_paint_line(p->image, end[0][0], end[0][1], end[1][0], end[1][1], 1.3 * p->unit, outline_ink, 0.9);
    }
}

/* A line with a head at its end, px. */
static void paint_arrow(sb_image *image, const double from[2], const double to[2], double width, const float rgb[3])
{
    const double dx = to[0] - from[0], dy = to[1] - from[1], length = hypot(dx, dy);
    if (!(length > 0)) return;
    const double head = fmin(0.45 * length, 4.5 * width) / length;
    sb_paint_line(image, from[0], from[1], to[0], to[1], width, rgb, 1);
    for (int side = -1; side <= 1; side += 2) {
        const double x = to[0] - head * (dx - 0.55 * side * dy), y = to[1] - head * (dy + 0.55 * side * dx);
        sb_paint_line(image, to[0], to[1], x, y, width, rgb, 1);
    }
}

/* Whether a place in the picture, px, is solid. The field's grid is coarser than the picture. */
static bool is_solid(const struct painting *p, const double at[2])
{
    if (!(at[0] >= 0 && at[1] >= 0 && at[0] < p->image->width && at[1] < p->image->height)) return false;
    const size_t pixel = (size_t)at[1] * (size_t)p->image->width + (size_t)at[0];
    return p->slicer->terrain[pixel] + p->slicer->bodies[pixel] > 0.5f;
}

static void paint_vector(const struct painting *p, double a, double b)
{
    const sb_plane_sample sample = sb_plane_field_at(&p->slicer->field, a, b);
    const double scale = p->job->slice->vectors / p->job->vector_speed;
    double from[2], to[2];
    if (!sb_plane_wet(&sample) || !sb_plane_apply(&p->to_pixels, a, b, from)) return;
    if (!sb_plane_apply(&p->to_pixels, a + scale * (double)sample.velocity[0], b + scale * (double)sample.velocity[1],
                        to))
        return;
    if (is_far(p, from) || is_far(p, to) || is_solid(p, from)) return;
    if (hypot(to[0] - from[0], to[1] - from[1]) < 2 * p->unit) {
        sb_paint_disc(p->image, from[0], from[1], 0.9 * p->unit, dark, 1);
        return;
    }
    paint_arrow(p->image, from, to, 1.4 * p->unit, dark);
}

static void paint_vectors(const struct painting *p)
{
    const double step = p->job->slice->vectors, *low = p->area->low, *high = p->area->high;
    for (double j = ceil(low[1] / step); j <= floor(high[1] / step); j++)
        for (double i = ceil(low[0] / step); i <= floor(high[0] / step); i++) paint_vector(p, i * step, j * step);
}

/* A line as pieces of at least four px, with an arrow's head each 140 px. */
static void paint_streamline(const struct painting *p, const sb_streamline *line)
{
    const sb_stream_point *points = p->slicer->streamlines.points + line->first;
    double last[2], here[2], since = 0;
    if (!sb_plane_apply(&p->to_pixels, (double)points[0].a, (double)points[0].b, last)) return;
    for (size_t k = 1; k < line->count; k++) {
        if (!sb_plane_apply(&p->to_pixels, (double)points[k].a, (double)points[k].b, here)) return;
        const double length = hypot(here[0] - last[0], here[1] - last[1]);
        if (length < 4 && k + 1 < line->count) continue;
        if (!is_solid(p, here)) sb_paint_line(p->image, last[0], last[1], here[0], here[1], 1.5 * p->unit, light, 1);
        since += length;
        if (since > 70 * p->unit && length > 0.5) {
            const double head = 7 * p->unit / length;
            const double from[2] = {here[0] - head * (here[0] - last[0]), here[1] - head * (here[1] - last[1])};
            paint_arrow(p->image, from, here, 1.5 * p->unit, light);
            since = -70 * p->unit;
        }
        last[0] = here[0];
        last[1] = here[1];
    }
}

void sb_slice_paint(const sb_slicer *slicer, const sb_slice_job *job, const sb_plane *plane, const sb_plane_area *area,
                    sb_image *image)
{
    struct painting p = {.slicer = slicer, .job = job, .area = area, .image = image, .unit = unit_of(image)};
    p.to_pixels = sb_plane_to_pixels(plane, job->view, image->width, image->height);
    p.to_plane = sb_plane_inverse(&p.to_pixels);
    if (!job->slice->behind) sb_paint_box(image, 0, 0, image->width, image->height, paper, 1);
    if (area->count == 0) return;
    paint_face(&p);
    paint_outlines(&p);
    for (size_t i = 0; i < slicer->streamlines.line_count; i++) paint_streamline(&p, &slicer->streamlines.lines[i]);
    if (job->slice->vectors > 0) paint_vectors(&p);
}

sb_status sb_slice_legend(sb_image *image, const sb_slice_job *job, sb_vec3 target, int slots, sb_error *error)
{
    const double depth = -sb_dot(sb_sub(target, job->view->eye), job->view->back), unit = unit_of(image);
    if (image->height < SB_OVERLAY_HEIGHT_MIN || !(job->slice->vectors > 0) || !(depth > 0)) return SB_OK;
    const double per_pixel = 2 * job->view->tangent * depth / image->height;
    const double per_speed = job->slice->vectors / job->vector_speed / per_pixel; /* px s/m */
    const double speed = sb_overlay_tick(100 * unit / per_speed, 2), length = speed * per_speed;
    if (!(length > 0) || !isfinite(length)) return SB_OK;
    const double y = image->height - (58 + SB_OVERLAY_SLOT * slots) * unit, right = image->width - 34 * unit;
    const double from[2] = {right - length, y}, to[2] = {right, y}, letters = 11 * unit;
    char label[48];
    snprintf(label, sizeof label, "%.6g m/s", speed);
    const double text = sb_font_width(label, letters);
    sb_overlay_plate(image, from[0] - 24 * unit - text, y - 14 * unit, right + 14 * unit, y + 14 * unit);
    paint_arrow(image, from, to, 3.4 * unit, dark);
    paint_arrow(image, from, to, 1.6 * unit, light);
    return sb_font_draw(image, from[0] - 10 * unit - text, y + 0.5 * letters, letters, light, label, error);
}
