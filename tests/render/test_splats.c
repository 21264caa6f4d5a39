/* Discs of the water's surface, against weights of all pixels in double precision; and the kinds of pixels. */
#include "base/memory.h"
#include "base/random.h"
#include "render/kinds.h"
#include "render/water/splat.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { WIDTH = 157, HEIGHT = 90, DISCS = 1500 };

static const double TANGENT = 0.4, SPACING = 2;

static double uniform(uint64_t disc, uint64_t k, double low, double high)
{
    return low + (high - low) * sb_random(21, 16 * disc + k);
}

/* A disc of any size from less than a pixel to the whole picture, as a surface has them: its normal is at most turned
   away from the eye so far that its cosine is 0.1. */
static sb_surfel disc_of(uint64_t d)
{
    const double z = exp(uniform(d, 0, log(3), log(900)));
    sb_surfel s = {.radius = (float)(1.6 * SPACING), .share = 1, .value = 0.5f, .thickness = 1};
    s.place[0] = (float)(uniform(d, 1, -1.1, 1.1) * TANGENT * WIDTH / HEIGHT * z);
    s.place[1] = (float)(uniform(d, 2, -1.1, 1.1) * TANGENT * z);
    s.place[2] = (float)z;
    const sb_vec3 to_eye = sb_normalize(sb_vec(-(double)s.place[0], -(double)s.place[1], -z));
    const sb_vec3 any = sb_vec(uniform(d, 3, -1, 1), uniform(d, 4, -1, 1), uniform(d, 5, -1, 1));
    const sb_vec3 across = sb_normalize(sb_sub(any, sb_scale(to_eye, sb_dot(any, to_eye))));
    const double facing = d % 2 ? uniform(d, 6, 0.1, 0.2) : uniform(d, 6, 0.1, 1);
    const sb_vec3 n = sb_add(sb_scale(to_eye, facing), sb_scale(across, sqrt(1 - facing * facing)));
    s.normal[0] = (float)n.x;
    s.normal[1] = (float)n.y;
    s.normal[2] = (float)n.z;
    return s;
}

/* The weight of a disc in a pixel: (1 - r^2 / R^2)^2 where the ray meets its plane, or that of a disc of one pixel. */
static double weight_of(const sb_surfel *s, int x, int y)
{
    const double step = 2 * TANGENT / HEIGHT;
    const sb_vec3 c = sb_vec((double)s->place[0], (double)s->place[1], (double)s->place[2]);
    const sb_vec3 n = sb_vec((double)s->normal[0], (double)s->normal[1], (double)s->normal[2]);
    const sb_vec3 ray = sb_vec((x + 0.5 - 0.5 * WIDTH) * step, (y + 0.5 - 0.5 * HEIGHT) * step, 1);
    const double facing = sb_dot(n, ray), r = (double)s->radius;
    const sb_vec3 off = sb_sub(sb_scale(ray, sb_dot(n, c) / facing), c);
    const double in = facing < 0 ? 1 - sb_dot(off, off) / (r * r) : 0, w = in > 0 ? in * in : 0;
    const double dx = (ray.x - c.x / c.z) / step, dy = (ray.y - c.y / c.z) / step;
    const double near = 1 - (dx * dx + dy * dy) / 1.6, v = near > 0 ? 0.5 * near * near : 0;
    return fmax(w, v);
}

static double cover_of(double weight)
{
    const double t = fmin(fmax((weight - 0.22) / (0.62 - 0.22), 0), 1);
    return t * t * (3 - 2 * t);
}

/* No part of a disc is left out: rows and columns in which it has no weight are skipped. */
static void discs_cover_what_all_pixels_say(void **state)
{
    (void)state;
    const sb_view view = {.tangent = TANGENT, .near = 0.5};
    sb_splat splat;
    size_t covered = 0, drawn = 0;
    assert_int_equal(sb_splat_create(WIDTH, HEIGHT, &splat, NULL), SB_OK);
    for (uint64_t d = 0; d < DISCS; d++) {
        sb_surfel disc = disc_of(d);
        const sb_surfels one = {.count = 1, .list = &disc};
        size_t here = 0;
        assert_int_equal(sb_splat_draw(&splat, &one, &view, SPACING, 1, NULL), SB_OK);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                const double expected = cover_of(weight_of(&disc, x, y));
                const double cover = (double)splat.cover[4 * (y * WIDTH + x)];
                here += expected > 0.01;
                if (fabs(cover - expected) > 0.01)
                    fail_msg("disc %d at %g %g %g, normal %g %g %g: pixel %d %d has %g, expected %g", (int)d,
                             (double)disc.place[0], (double)disc.place[1], (double)disc.place[2],
                             (double)disc.normal[0], (double)disc.normal[1], (double)disc.normal[2], x, y, cover,
                             expected);
            }
        covered += here;
        drawn += here > 0;
    }
    assert_true(drawn > DISCS / 2 && covered > 100 * (size_t)DISCS);
    sb_splat_free(&splat);
}

/* What a disc is to a pixel. */
typedef struct part {
    double weight, depth, room; /* room: m along the ray within which others are parts of its surface */
} part;

static part part_of(const sb_surfel *s, int x, int y)
{
    const double step = 2 * TANGENT / HEIGHT;
    const sb_vec3 c = sb_vec((double)s->place[0], (double)s->place[1], (double)s->place[2]);
    const sb_vec3 n = sb_vec((double)s->normal[0], (double)s->normal[1], (double)s->normal[2]);
    const sb_vec3 ray = sb_vec((x + 0.5 - 0.5 * WIDTH) * step, (y + 0.5 - 0.5 * HEIGHT) * step, 1);
    const double facing = fmax(-sb_dot(n, c) / sb_norm(c), 0.1);
    return (part){
        .weight = weight_of(s, x, y), .depth = sb_dot(n, c) / sb_dot(n, ray), .room = SPACING * (0.7 + 0.6 / facing)};
}

/* Sums of a surface: weight, depth, value, normal, thickness. */
enum { SUMS = 7 };

/* Whether a value is so near a limit that single precision may be on the other side. */
static bool is_near(double value, double limit)
{
    return fabs(value - limit) < 1e-3;
}

/* Adds the discs of one surface, which begins at the nearest depth of weight above 0.16, or at the nearest one that is
   behind `front` by more than its room. Returns the depth; *sure: no disc is near a limit. */
static double add_surface(const sb_surfel *discs, int count, int x, int y, double front, double sum[SUMS], bool *sure)
{
    const bool second = isfinite(front);
    double nearest = HUGE_VAL;
    for (int d = 0; d < count; d++) {
        const part p = part_of(&discs[d], x, y);
        if (p.weight <= 0) continue;
        if (is_near(p.weight, 0.16) || (second && is_near((p.depth - front) / p.room, 1))) *sure = false;
        if ((double)discs[d].share < 0.3 || p.weight <= 0.16 || (second && p.depth - front <= p.room)) continue;
        nearest = fmin(nearest, p.depth);
    }
    for (int k = 0; k < SUMS; k++) sum[k] = 0;
    for (int d = 0; d < count; d++) {
        const sb_surfel *s = &discs[d];
        const part p = part_of(s, x, y);
        if (p.weight <= 0) continue;
        const double from_first = (p.depth - (second ? front : nearest)) / p.room;
        const double past = fmax((p.depth - nearest) / p.room, 0);
        if (is_near(from_first, 1)) *sure = false;
        if (past >= 1 || (from_first >= 1) != second) continue;
        const double w = (double)s->share * p.weight * (1 - past * past);
        const double parts[SUMS] = {1,
                                    p.depth,
                                    (double)s->value,
                                    (double)s->normal[0],
                                    (double)s->normal[1],
                                    (double)s->normal[2],
                                    (double)s->thickness};
        for (int k = 0; k < SUMS; k++) sum[k] += w * parts[k];
    }
    return nearest;
}

/* The depth, value and normal (x, y), and the cover and thickness of a pixel. */
static void blend(const sb_surfel *discs, int count, int x, int y, double surface[4], double cover[2], bool *sure)
{
    double one[SUMS], two[SUMS] = {0}, mixed[SUMS];
    const double front = add_surface(discs, count, x, y, HUGE_VAL, one, sure);
    if (isfinite(front)) add_surface(discs, count, x, y, front, two, sure);
    const double share = cover_of(one[0]), back = (1 - share) * cover_of(two[0]), all = share + back;
    if (all > 0 && fabs(share - back) < 0.01) *sure = false; /* whose depth it is */
    for (int k = 0; k < SUMS; k++)
        mixed[k] = (share > 0 ? share / one[0] * one[k] : 0) + (back > 0 ? back / two[0] * two[k] : 0);
    const double length = sqrt(mixed[3] * mixed[3] + mixed[4] * mixed[4] + mixed[5] * mixed[5]);
    surface[0] = all <= 0 ? 0 : share >= back ? one[1] / one[0] : two[1] / two[0];
    surface[1] = all > 0 ? mixed[2] / all : 0;
    surface[2] = length > 0 ? mixed[3] / length : 0;
    surface[3] = length > 0 ? mixed[4] / length : 0;
    cover[0] = all;
    cover[1] = all > 0 ? mixed[6] / all : 0;
}

/* A disc of two sheets, one 20 spacings behind the other, that waver by less than the room of a surface. The nearer
   one covers a part of the picture. */
static sb_surfel disc_of_sheets(uint64_t d)
{
    const bool behind = d % 3 == 0;
    const double z = 60 + (behind ? 20 * SPACING : 0) + uniform(d, 8, -1, 1) * SPACING;
    const double tilt = uniform(d, 9, -0.5, 0.5), turn = uniform(d, 10, 0, 6.28);
    return (sb_surfel){.place = {(float)(uniform(d, 11, behind ? -1 : 0, 1) * TANGENT * WIDTH / HEIGHT * z),
                                 (float)(uniform(d, 12, -1, 1) * TANGENT * z), (float)z},
                       .normal = {(float)(sin(tilt) * cos(turn)), (float)(sin(tilt) * sin(turn)), (float)-cos(tilt)},
                       .radius = (float)(1.6 * SPACING),
                       .share = d % 5 == 0 ? 0.6f : 1,
                       .value = (float)uniform(d, 13, 0, 1),
                       .thickness = (float)uniform(d, 14, 1, 9)};
}

/* Discs near the first one along a ray are blended by their weights, and a surface behind shows where the first one
   does not cover the pixel. */
static void discs_are_blended_by_their_weights(void **state)
{
    (void)state;
    enum { COUNT = 400 };
    const sb_view view = {.tangent = TANGENT, .near = 0.5};
    static sb_surfel discs[COUNT];
    const sb_surfels all = {.count = COUNT, .list = discs};
    sb_splat splat;
    int sure_ones = 0, first = 0, second = 0, both = 0;
    for (uint64_t d = 0; d < COUNT; d++) discs[d] = disc_of_sheets(d);
    assert_int_equal(sb_splat_create(WIDTH, HEIGHT, &splat, NULL), SB_OK);
    assert_int_equal(sb_splat_draw(&splat, &all, &view, SPACING, 2, NULL), SB_OK);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            double surface[4], cover[2];
            bool sure = true;
            blend(discs, COUNT, x, y, surface, cover, &sure);
            if (!sure) continue;
            const float *s = &splat.surface[4 * (y * WIDTH + x)], *c = &splat.cover[4 * (y * WIDTH + x)];
            sure_ones++;
            second += surface[0] > 60 + 10 * SPACING;
            first += surface[0] > 0 && surface[0] < 60 + 10 * SPACING;
            both += cover[0] > 0.05 && cover[0] < 0.95;
            /* Where nearly nothing covers a pixel, its colours are not seen. */
            double off = fabs((double)c[0] - cover[0]);
            if (cover[0] > 0.05)
                off = fmax(off, fmax(fabs((double)c[1] - cover[1]) / 9, fabs((double)s[0] - surface[0]) / SPACING));
            for (int k = 1; k < 4 && cover[0] > 0.05; k++) off = fmax(off, fabs((double)s[k] - surface[k]));
            if (off > 2e-3)
                fail_msg("pixel %d %d: depth %g, value %g, normal %g %g, cover %g, thickness %g; expected %g, %g, %g "
                         "%g, %g, %g",
                         x, y, (double)s[0], (double)s[1], (double)s[2], (double)s[3], (double)c[0], (double)c[1],
                         surface[0], surface[1], surface[2], surface[3], cover[0], cover[1]);
        }
    print_message("%d of %d pixels: %d of the first surface, %d of the second, %d partly covered\n", sure_ones,
                  WIDTH * HEIGHT, first, second, both);
    assert_true(sure_ones > 0.8 * WIDTH * HEIGHT && first > 2000 && second > 1000 && both > 300);
    sb_splat_free(&splat);
}

/* One row of pixels with all that a pixel may show. */
static void each_pixel_has_its_kind(void **state)
{
    (void)state;
    enum { PIXELS = 9 };
    const sb_view view = {.tangent = 0.001, .projection = {[10] = -1, [14] = -1}}; /* z = 1 / (1 - d) */
    float surface[4 * PIXELS] = {0}, cover[4 * PIXELS] = {0}, foam[4 * PIXELS] = {0}, bodies[PIXELS], kinds[PIXELS];
    const sb_splat splat = {.width = PIXELS, .height = 1, .surface = surface, .cover = cover};
    const sb_kind_parts parts = {
        .splat = &splat, .bodies = bodies, .foam = foam, .view = &view, .clarity = 1, .thickest = 100, .threads = 1};
    const float expected[PIXELS] = {SB_KIND_BEHIND,  SB_KIND_WATER,  SB_KIND_MIXTURE, SB_KIND_BEHIND, SB_KIND_MIXTURE,
                                    SB_KIND_MIXTURE, SB_KIND_BEHIND, SB_KIND_MIXTURE, SB_KIND_MIXTURE};
    for (int x = 0; x < PIXELS; x++) bodies[x] = 0.95f; /* 10 m away: clip[1] / (2 d - 1 - clip[0]) = -1 / (2 d - 2) */
    for (int x = 1; x < PIXELS - 2; x++) {
        surface[4 * x] = 5;
        cover[4 * x] = 1;
        cover[4 * x + 1] = 20;
    }
    cover[4 * 2 + 1] = 1;    /* shallow: the bed shows */
    surface[4 * 3] = 11;     /* behind the body */
    cover[4 * 4] = 0.5f;     /* the water covers half of the pixel */
    cover[4 * 5 + 2] = 0.5f; /* a drop before the water, */
    cover[4 * 5 + 3] = 3;
    cover[4 * 6] = 0; /* no water, and a drop behind the body */
    cover[4 * 6 + 2] = 0.5f;
    cover[4 * 6 + 3] = 12;
    foam[4 * 7 + 1] = 0.5f;  /* spray alone */
    cover[4 * 8 + 2] = 0.5f; /* a drop alone */
    cover[4 * 8 + 3] = 3;
    sb_kinds_find(&parts, kinds);
    for (int x = 0; x < PIXELS; x++)
        if (kinds[x] < expected[x] || kinds[x] > expected[x])
            fail_msg("pixel %d: %g, expected %g", x, (double)kinds[x], (double)expected[x]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(discs_cover_what_all_pixels_say),
                                       cmocka_unit_test(discs_are_blended_by_their_weights),
                                       cmocka_unit_test(each_pixel_has_its_kind)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
