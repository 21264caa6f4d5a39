/* The disc of each particle of foam: where it lies, and how much it covers. */
#include "base/hash.h"
#include "render/camera/lens.h"
#include "render/foam/foam.h"

/* Radii in spacings, of which each particle has 0.5 to 1.5, and optical thickness at the centre. */
static const float foam_radius = 0.4f, spray_radius = 0.18f;
static const float foam_thickness = 0.45f, spray_thickness = 0.45f, bubbles_thickness = 0.3f;
/* Distances from the drawn surface in spacings: foam farther off is not part of it; bubbles fade over the second. */
static const float in_surface = 2, fading = 1.5f;
/* A particle fades during this last part of the longest life. */
static const float last_part = 0.15f;

enum { FOAM, SPRAY, BUBBLES = 3 }; /* sb_foam_mark.layer */

/* How a place is to what the picture shows there. */
typedef struct spot {
    bool inside;  /* of the picture */
    float water;  /* m, depth of the surface; 0: none is seen */
    float body;   /* m, depth of the bodies */
    float below;  /* m, distance of the place below the surface, along its normal */
    float facing; /* cosine between normal and ray */
} spot;

static spot spot_of(const sb_foam_lens *lens, const sb_foam_ground *ground, const float place[3])
{
    const float x = (place[0] / place[2] - lens->left) / lens->step,
                y = (place[1] / place[2] - lens->bottom) / lens->step;
    spot s = {.inside = x >= 0 && y >= 0 && x < (float)ground->width && y < (float)ground->height};
    if (!s.inside) return s;
    const size_t pixel = (size_t)y * (size_t)ground->width + (size_t)x;
    s.body = sb_foam_body_depth(lens, ground, pixel);
    s.water = sb_foam_water_depth(lens, ground, pixel);
    if (!(s.water > 0)) return s;
    const float *n = ground->surface + 4 * pixel + 2, rest = 1 - n[0] * n[0] - n[1] * n[1];
    const float normal[3] = {n[0], n[1], rest > 0 ? -sqrtf(rest) : 0};
    s.below = sb_dot3(normal, place) * (s.water / place[2] - 1);
    s.facing = -sb_dot3(normal, place) / sqrtf(sb_dot3(place, place));
    return s;
}

/* Puts a disc into the surface along the ray. One that is seen at a small angle covers less. */
static void lay(const sb_foam_lens *lens, const spot *s, sb_foam_mark *mark)
{
    const float scale = s->water / mark->place[2], pixel = s->water * lens->step;
    for (int a = 0; a < 3; a++) mark->place[a] *= scale;
    const float across = 2 * mark->radius * (s->facing > 0.02f ? s->facing : 0.02f);
    if (across < pixel) mark->strength *= across / pixel;
}

static sb_foam_mark mark_of(const sb_foam_lens *lens, const sb_foam_ground *ground, const sb_frame *frame, size_t p,
                            const float place[3])
{
    const float spacing = (float)frame->spacing, life = frame->foam.life[p] / last_part;
    const float size = 0.5f + (float)(sb_hash_mix(frame->foam.id[p] + 1u) >> 40) * 0x1p-24f;
    const int kind = frame->foam.kind[p];
    const spot s = spot_of(lens, ground, place);
    sb_foam_mark mark = {.place = {place[0], place[1], place[2]}, .radius = foam_radius * size * spacing};
    const float away = s.below / spacing, off = away > 0 ? away : -away;
    if (s.water > 0 && kind != SB_FOAM_SPRAY && away > -in_surface) {
        const bool bubbles = kind == SB_FOAM_BUBBLES;
        mark.layer = bubbles ? BUBBLES : FOAM;
        mark.strength = bubbles            ? bubbles_thickness * expf(-(away > 0 ? away : 0) / fading)
                        : off < in_surface ? foam_thickness * (off < 1 ? 1 : in_surface - off)
                                           : 0;
        lay(lens, &s, &mark);
    } else if (!s.inside || (place[2] < s.body && !(s.water > 0 && place[2] > s.water + 0.3f * spacing))) {
        mark.layer = SPRAY;
        mark.radius = spray_radius * size * spacing;
        mark.strength = spray_thickness;
    }
    mark.strength *= life < 1 ? life : 1;
    /* A disc that is smaller than a pixel is widened to one. */
    const float least = 0.9f * mark.place[2] * lens->step;
    if (mark.radius < least) {
        mark.strength *= mark.radius * mark.radius / (least * least);
        mark.radius = least;
    }
    return mark;
}

void sb_foam_marks(const sb_frame *frame, const sb_view *view, const sb_foam_ground *ground, int threads,
                   sb_foam_mark *marks)
{
    const sb_foam_lens lens = sb_foam_lens_of(view, ground);
    const sb_lens axes = sb_lens_of(view, frame->origin, frame->spacing);
#pragma omp parallel for num_threads(threads) schedule(static)
    for (size_t p = 0; p < frame->foam.count; p++) {
        const float *at = frame->foam.position + 3 * p;
        const float to_eye[3] = {axes.eye[0] - at[0], axes.eye[1] - at[1], axes.eye[2] - at[2]};
        const float place[3] = {-sb_dot3(to_eye, axes.right), -sb_dot3(to_eye, axes.up), sb_dot3(to_eye, axes.back)};
        marks[p] = (sb_foam_mark){0};
        if (place[2] > lens.near && !sb_lens_outside(&axes, to_eye) && !sb_lens_cut(&axes, at))
            marks[p] = mark_of(&lens, ground, frame, p, place);
    }
}
