/* Water that stands at the domain's sides: its pictures against the exact ones of a block of calm water. */
#include "base/memory.h"
#include "render/slice/plane_field.h"
#include "render/water/sides.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120, COLUMNS = 24, LAYERS = 8 };
static const double side = 12, top = 4; /* m, of the block; its lowest corner is the domain's, at `corner` */
static const sb_vec3 corner = {100, -40, 7};
static const double pi = 3.14159265358979323846;

static float no_bodies[1] = {-1000};
static sb_ground ground_of(void)
{
    return (sb_ground){.side = 1,
                       .height = no_bodies,
                       .per_cell = 1e-3,
                       .x = -500,
                       .y = -500,
                       .floor_level = corner.z,
                       .sided = true,
                       .side_min = {corner.x, corner.y},
                       .side_max = {corner.x + side, corner.y + side}};
}

/* Calm water at a spacing of 0.5 m. */
static sb_frame *block(void)
{
    sb_frame *frame = sb_frame_create((size_t)(COLUMNS * COLUMNS * LAYERS), 0);
    assert_non_null(frame);
    frame->spacing = 0.5;
    frame->origin = sb_add(corner, sb_vec(3, -2, 1));
    float *p = frame->position;
    for (int k = 0; k < LAYERS; k++)
        for (int j = 0; j < COLUMNS; j++)
            for (int i = 0; i < COLUMNS; i++, p += 3) {
                p[0] = 0.25f + 0.5f * (float)i - 3;
                p[1] = 0.25f + 0.5f * (float)j + 2;
                p[2] = 0.25f + 0.5f * (float)k - 1;
            }
    memset(frame->velocity, 0, 3 * frame->count * sizeof(float));
    memset(frame->pressure, 0, frame->count * sizeof(float));
    return frame;
}

static sb_view view_from(double x, double y, double z)
{
    const sb_camera_key key = {0, sb_add(corner, sb_vec(x, y, z)), sb_add(corner, sb_vec(0.5 * side, 0.5 * side, 2)),
                               50, SB_EASE_SMOOTH};
    return sb_view_create(&key, (double)WIDTH / HEIGHT, sb_sub(corner, sb_vec(30, 30, 30)),
                          sb_add(corner, sb_vec(50, 50, 50)));
}

/* Draws the block, whose values are the height over the floor in units of 4 m. */
static void draw(const sb_frame *frame, const sb_view *view, int threads, sb_splat *splat)
{
    const sb_ground ground = ground_of();
    sb_error error = {0};
    sb_surfels surfels = {0};
    sb_sides sides = {0};
    float *values = sb_alloc(frame->count, sizeof *values);
    assert_non_null(values);
    for (size_t i = 0; i < frame->count; i++) values[i] = (frame->position[3 * i + 2] + 1) / 4;
    if (sb_splat_create(WIDTH, HEIGHT, splat, &error) != SB_OK ||
        sb_surfels_collect(&surfels, frame, values, &ground, view, threads, &error) != SB_OK ||
        sb_splat_draw(splat, &surfels, view, frame->spacing, threads, &error) != SB_OK ||
        sb_sides_draw(&sides, splat, &surfels.density, frame, values, &ground, view, threads, &error) != SB_OK)
        fail_msg("%s", error.text);
    sb_surfels_free(&surfels);
    sb_sides_free(&sides);
    sb_free(values);
}

/* The ray of a pixel, with 1 along the view. */
static sb_vec3 ray_of(const sb_view *view, int x, int y)
{
    const double step = 2 * view->tangent / HEIGHT;
    return sb_sub(sb_madd(sb_madd(sb_vec(0, 0, 0), (x + 0.5 - WIDTH / 2.0) * step, view->right),
                          (y + 0.5 - HEIGHT / 2.0) * step, view->up),
                  view->back);
}

/* Where a ray enters a box around the block, `wider` than it on all sides but the lowest: the axis of the face; -1: it
   misses the box. */
static int enter(sb_vec3 eye, sb_vec3 ray, double wider, double *depth)
{
    const double from[3] = {eye.x - corner.x, eye.y - corner.y, eye.z - corner.z}, along[3] = {ray.x, ray.y, ray.z};
    const double high[3] = {side + wider, side + wider, top + wider}, low[3] = {-wider, -wider, -wider};
    double in = -HUGE_VAL, out = HUGE_VAL;
    int axis = -1;
    for (int a = 0; a < 3; a++) {
        const double one = (low[a] - from[a]) / along[a], two = (high[a] - from[a]) / along[a];
        if (fmin(one, two) > in) {
            in = fmin(one, two);
            axis = a;
        }
        out = fmin(out, fmax(one, two));
    }
    *depth = in;
    return in < out ? axis : -1;
}

/* The distance of a place on a face from the nearest edge of that face, m. */
static double from_edge(sb_vec3 place, int axis)
{
    const double at[3] = {place.x - corner.x, place.y - corner.y, place.z - corner.z}, size[3] = {side, side, top};
    double least = HUGE_VAL;
    for (int a = 0; a < 3; a++)
        if (a != axis) least = fmin(least, fmin(at[a], size[a] - at[a]));
    return least;
}

/* Each pixel a tenth of a metre from the edges of the block shows the exact plane: depth, normal, and on the cut the
   value. Nothing is seen where the ray misses the block by 0.2 m. */
static void block_has_flat_sides(void **state)
{
    (void)state;
    static const double eyes[][3] = {{-9, -13, 11}, {24, 20, 9}, {6, -16, 9}};
    sb_frame *frame = block();
    for (size_t e = 0; e < sizeof eyes / sizeof *eyes; e++) {
        const sb_view view = view_from(eyes[e][0], eyes[e][1], eyes[e][2]);
        sb_splat splat;
        int faces[3] = {0}, missed = 0;
        draw(frame, &view, 2, &splat);
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                const float *surface = splat.surface + 4 * (y * WIDTH + x), *cover = splat.cover + 4 * (y * WIDTH + x);
                const sb_vec3 ray = ray_of(&view, x, y);
                double depth;
                if (enter(view.eye, ray, 0.2, &depth) < 0) {
                    assert_true(cover[0] == 0);
                    missed++;
                    continue;
                }
                const int axis = enter(view.eye, ray, 0, &depth);
                const sb_vec3 place = sb_madd(view.eye, depth, ray);
                if (axis < 0 || from_edge(place, axis) < 0.1) continue;
                const double sign = axis == 2 ? 1 : (axis ? ray.y : ray.x) > 0 ? -1 : 1;
                const sb_vec3 normal = sb_vec(axis == 0 ? sign : 0, axis == 1 ? sign : 0, axis == 2 ? sign : 0);
                assert_true(cover[0] == 1);
                /* The surface within a fifth of a spacing and 3.4 degrees; the cut is exact. */
                const double facing = fabs(sb_dot(normal, ray)), room = axis == 2 ? 0.06 : 1e-4;
                assert_true(fabs((double)surface[0] - depth) * facing < (axis == 2 ? 0.1 : 1e-4));
                assert_true(fabs((double)surface[2] - sb_dot(normal, view.right)) < room);
                assert_true(fabs((double)surface[3] - sb_dot(normal, view.up)) < room);
                if (axis < 2 && from_edge(place, axis) > 1)
                    assert_true(fabs((double)surface[1] - (place.z - corner.z) / 4) < 0.03);
                faces[axis]++;
            }
        assert_true(faces[0] + faces[1] > 800 && faces[2] > 800 && missed > 800);
        sb_splat_free(&splat);
    }
    sb_frame_release(frame);
}

static void threads_do_not_change_a_bit(void **state)
{
    (void)state;
    sb_frame *frame = block();
    const sb_view view = view_from(-9, -13, 11);
    sb_splat splat[2];
    for (int t = 0; t < 2; t++) draw(frame, &view, 1 + 2 * t, &splat[t]);
    assert_memory_equal(splat[0].surface, splat[1].surface, 4 * sizeof(float) * WIDTH * HEIGHT);
    assert_memory_equal(splat[0].cover, splat[1].cover, 4 * sizeof(float) * WIDTH * HEIGHT);
    for (int t = 0; t < 2; t++) sb_splat_free(&splat[t]);
    sb_frame_release(frame);
}

/* The eye is in the domain: no side faces it. What a slice cuts off has no cut at a side. */
static void sides_behind_the_eye_are_not_drawn(void **state)
{
    (void)state;
    sb_frame *frame = block();
    sb_view view = view_from(6, 1, 8);
    sb_splat splat;
    draw(frame, &view, 1, &splat);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) assert_true(splat.surface[4 * i] == 0 || splat.surface[4 * i] > 3);
    sb_splat_free(&splat);
    view = view_from(6, -16, 2);
    view.cuts = true;
    view.cut_normal = sb_vec(0, -1, 0);
    view.cut_at = -(corner.y + 6);
    draw(frame, &view, 1, &splat);
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) assert_true(splat.surface[4 * i] == 0 || splat.surface[4 * i] > 21);
    sb_splat_free(&splat);
    sb_frame_release(frame);
}

/* At the foot of a body that ends at the side, the cut of the water ends within a spacing; below a bridge it does not.
 */
static void bodies_end_the_cut(void **state)
{
    (void)state;
    enum { N = 240 };
    static float height[N * N];
    for (int bridge = 0; bridge < 2; bridge++) {
        sb_frame *frame = block();
        sb_ground ground = ground_of();
        sb_surfels surfels = {0};
        sb_sides sides = {0};
        sb_splat splat;
        sb_error error = {0};
        /* 0.1 m cells over 24 m x 24 m about the block: a body over x of 6 m and more, up to 5 m. */
        for (int i = 0; i < N * N; i++) height[i] = i % N >= 120 ? 5 : -1000;
        ground.side = N;
        ground.height = height;
        ground.per_cell = 10;
        ground.origin = corner;
        ground.x = ground.y = -6;
        size_t kept = 0;
        for (size_t i = 0; i < frame->count; i++)
            if (bridge || frame->position[3 * i] + 3 < 6) {
                memmove(frame->position + 3 * kept, frame->position + 3 * i, 3 * sizeof(float));
                kept++;
            }
        frame->count = kept;
        const sb_view view = view_from(6, -16, 2);
        float *values = sb_alloc(frame->count, sizeof *values);
        assert_non_null(values);
        if (sb_splat_create(WIDTH, HEIGHT, &splat, &error) != SB_OK ||
            sb_density_build(&surfels.density, frame, &ground, 1, &error) != SB_OK ||
            sb_sides_draw(&sides, &splat, &surfels.density, frame, values, &ground, &view, 1, &error) != SB_OK)
            fail_msg("%s", error.text);
        int water = 0, bodies = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) {
                const sb_vec3 ray = ray_of(&view, x, y);
                double depth;
                if (enter(view.eye, ray, 0, &depth) != 1) continue;
                const sb_vec3 place = sb_madd(view.eye, depth, ray);
                const double at = place.x - corner.x;
                const bool drawn = splat.surface[4 * (y * WIDTH + x)] > 0;
                if (from_edge(place, 1) < 0.2) continue;
                if (bridge || at < 5.7) {
                    assert_true(drawn);
                    water++;
                } else if (at > 6.5) {
                    assert_false(drawn);
                    bodies++;
                }
            }
        assert_true(water > 500 && (bridge || bodies > 200));
        sb_free(values);
        sb_splat_free(&splat);
        sb_sides_free(&sides);
        sb_surfels_free(&surfels);
        sb_frame_release(frame);
    }
}

/* The water of a slice ends at the sides and at the floor. */
static void slices_end_at_the_sides(void **state)
{
    (void)state;
    sb_frame *frame = block();
    const sb_ground ground = ground_of();
    const double angle = 20 * pi / 180, low[2] = {-9, -5}, high[2] = {9, 5};
    const sb_slice slice = {.point = sb_add(corner, sb_vec(6, 6, 2)), .normal = sb_vec(sin(angle), -cos(angle), 0)};
    const sb_plane plane = sb_plane_of(&slice, sb_add(slice.point, slice.normal));
    sb_density density = {0};
    sb_plane_field field = {0};
    sb_error error = {0};
    float *values = sb_alloc(frame->count, sizeof *values);
    assert_non_null(values);
    if (sb_density_build(&density, frame, &ground, 1, &error) != SB_OK ||
        sb_plane_field_lay(&field, low, high, frame->spacing, &error) != SB_OK ||
        sb_plane_field_fill(&field, &plane, frame, values, &density, 1, &error) != SB_OK)
        fail_msg("%s", error.text);
    int wet = 0;
    for (int j = 0; j < 100; j++)
        for (int i = 0; i < 180; i++) {
            const double a = -9 + 0.1 * i, b = -5 + 0.1 * j;
            const sb_vec3 at = sb_sub(sb_plane_at(&plane, a, b), corner);
            const double inside = fmin(fmin(at.x, side - at.x), fmin(fmin(at.y, side - at.y), fmin(at.z, top - at.z)));
            const bool water = sb_plane_field_at(&field, a, b).density >= 0.5f;
            if (fabs(inside) > 0.13) assert_int_equal(water, inside > 0);
            wet += water;
        }
    assert_true(wet > 3000);
    sb_free(values);
    sb_plane_field_free(&field);
    sb_density_free(&density);
    sb_frame_release(frame);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(block_has_flat_sides),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(sides_behind_the_eye_are_not_drawn),
        cmocka_unit_test(bodies_end_the_cut),
        cmocka_unit_test(slices_end_at_the_sides),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
