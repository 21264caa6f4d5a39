/* Discs of the water's surface, against weights of all pixels in double precision; and the kinds of pixels. */
#include "base/memory.h"
#include "base/random.h"
#include "render/kinds.h"
#include "render/splat.h"

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
                                       cmocka_unit_test(each_pixel_has_its_kind)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
