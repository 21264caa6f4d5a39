/* Foam over a picture of calm water: where discs lie, what hides them, and how much they cover. */
#include "base/memory.h"
#include "check.h"
#include "render/foam/foam.h"

#include <stdio.h>
#include <string.h>

enum { WIDTH = 120, HEIGHT = 80, PIXELS = WIDTH * HEIGHT };

static const double SPACING = 1.5, FINE = 0.3; /* m: discs of a few pixels, and of less than one */

/* A picture of the plane z = 0 from above, at an angle. */
typedef struct stage {
    sb_view view;
    sb_foam_ground ground;
    float surface[4 * PIXELS], bodies[PIXELS];
    sb_frame *frame;
    sb_foam_layer layer;
} stage;

static double slope_at(const stage *s, int pixel, int size)
{
    return 2 * s->view.tangent / HEIGHT * (pixel + 0.5 - 0.5 * size);
}

/* The ray of a pixel: one metre along the view. */
static sb_vec3 ray_of(const stage *s, int x, int y)
{
    return sb_add(sb_scale(s->view.back, -1),
                  sb_add(sb_scale(s->view.right, slope_at(s, x, WIDTH)), sb_scale(s->view.up, slope_at(s, y, HEIGHT))));
}

/* The value of the depth buffer at a distance along the view. */
static float buffer_of(const stage *s, double depth)
{
    return (float)(0.5 + 0.5 * (-(double)s->view.projection[10] + (double)s->view.projection[14] / depth));
}

static void set_stage(stage *s)
{
    const sb_camera_key key = {0, sb_vec(0, -10, 8), sb_vec(0, 0, 0), 40, SB_EASE_SMOOTH};
    memset(s, 0, sizeof *s);
    s->view = sb_view_create(&key, (double)WIDTH / HEIGHT, sb_vec(-20, -20, -20), sb_vec(20, 20, 20));
    s->ground = (sb_foam_ground){WIDTH, HEIGHT, s->surface, s->bodies};
    s->frame = sb_frame_create(0, 0);
    assert_non_null(s->frame);
    s->frame->spacing = SPACING;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            float *at = s->surface + 4 * (y * WIDTH + x);
            at[0] = (float)(-s->view.eye.z / ray_of(s, x, y).z);
            at[2] = (float)s->view.right.z;
            at[3] = (float)s->view.up.z;
            s->bodies[y * WIDTH + x] = 1;
        }
}

static void clear_stage(stage *s)
{
    sb_frame_release(s->frame);
    sb_foam_layer_free(&s->layer);
}

/* Draws one particle with most of its life left. */
static void draw_one(stage *s, double spacing, sb_vec3 at, sb_foam_kind kind)
{
    sb_error error = {0};
    sb_frame_release(s->frame);
    s->frame = sb_frame_create(0, 0);
    assert_true(s->frame && sb_frame_add_foam(s->frame, 1) == 0);
    s->frame->spacing = spacing;
    const float place[3] = {(float)at.x, (float)at.y, (float)at.z};
    memcpy(s->frame->foam.position, place, sizeof place);
    memset(s->frame->foam.velocity, 0, 3 * sizeof(float));
    s->frame->foam.life[0] = 0.9f;
    s->frame->foam.id[0] = 7;
    s->frame->foam.kind[0] = (uint8_t)kind;
    assert_int_equal(sb_foam_draw(&s->layer, s->frame, &s->view, &s->ground, 1, &error), SB_OK);
}

/* Sum of one of the four values over the picture, and its mean place. */
typedef struct covered {
    double sum, x, y;
} covered;

static covered cover_of(const stage *s, int layer)
{
    covered c = {0};
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const double value = (double)s->layer.pixels[4 * (y * WIDTH + x) + layer];
            assert_true(value >= 0 && (value <= 1 || layer == 2));
            c.sum += value;
            c.x += value * (x + 0.5);
            c.y += value * (y + 0.5);
        }
    c.x /= c.sum;
    c.y /= c.sum;
    return c;
}

enum { FOAM, SPRAY, DEPTH, BUBBLES };

/* Foam lies in the surface where its ray meets it, and is as large there as it is in the world. */
static void foam_lies_in_the_surface(void **state)
{
    (void)state;
    static stage s;
    set_stage(&s);
    draw_one(&s, SPACING, sb_vec(1, 0.5, 0), SB_FOAM_FLOATS);
    const covered c = cover_of(&s, FOAM);
    const sb_vec3 from = sb_sub(sb_vec(1, 0.5, 0), s.view.eye);
    const double depth = -sb_dot(from, s.view.back), pixel = 2 * s.view.tangent / HEIGHT * depth;
    assert_near(c.x, sb_dot(from, s.view.right) / pixel + 0.5 * WIDTH, 0.2);
    assert_near(c.y, sb_dot(from, s.view.up) / pixel + 0.5 * HEIGHT, 0.2);
    /* 0.45 (1 - q^2)^2 over a disc: a third of 0.45 pi R^2, less by the exponential; R is 0.5 to 1.5 of 0.4 spacings,
       and the surface is seen at asin(8/12.8). */
    const double facing = 8 / sb_norm(s.view.eye), area = c.sum * pixel * pixel / facing;
    const double r = 0.4 * SPACING;
    assert_true(area > 0.8 * 0.15 * M_PI * 0.25 * r * r && area < 0.15 * M_PI * 2.25 * r * r);
    assert_true(cover_of(&s, SPRAY).sum == 0 && cover_of(&s, BUBBLES).sum == 0);
    clear_stage(&s);
}

static void what_hides_it(void **state)
{
    (void)state;
    static stage s;
    set_stage(&s);
    draw_one(&s, SPACING, sb_vec(0, 0, -0.5), SB_FOAM_BUBBLES);
    const double shallow = cover_of(&s, BUBBLES).sum;
    draw_one(&s, SPACING, sb_vec(0, 0, -2.5), SB_FOAM_BUBBLES);
    const double deep = cover_of(&s, BUBBLES).sum;
    printf("bubbles: %.3g, deeper %.3g\n", shallow, deep);
    assert_true(shallow > 0.5 && deep > 0 && deep < 0.7 * shallow);
    draw_one(&s, SPACING, sb_vec(0, 0, -5), SB_FOAM_FLOATS); /* behind the surface that is seen */
    assert_true(cover_of(&s, FOAM).sum == 0 && cover_of(&s, SPRAY).sum == 0);
    draw_one(&s, SPACING, sb_vec(0, 0, -1), SB_FOAM_SPRAY);
    assert_true(cover_of(&s, SPRAY).sum == 0);
    draw_one(&s, SPACING, sb_vec(0, 0, 3), SB_FOAM_SPRAY);
    assert_true(cover_of(&s, SPRAY).sum > 0.2 && cover_of(&s, FOAM).sum == 0);
    const double depth = -sb_dot(sb_sub(sb_vec(0, 0, 3), s.view.eye), s.view.back);
    for (int i = 0; i < PIXELS; i++)
        if (s.layer.pixels[4 * i + SPRAY] > 0) assert_near((double)s.layer.pixels[4 * i + DEPTH], depth, 1e-5);
    /* A body in front of all. */
    for (int i = 0; i < PIXELS; i++) s.bodies[i] = buffer_of(&s, 4);
    draw_one(&s, SPACING, sb_vec(0, 0, 3), SB_FOAM_SPRAY);
    assert_true(cover_of(&s, SPRAY).sum == 0);
    draw_one(&s, SPACING, sb_vec(0, 0, 0), SB_FOAM_FLOATS);
    assert_true(cover_of(&s, FOAM).sum == 0);
    clear_stage(&s);
}

/* A disc that is smaller than a pixel covers as much as its area, wherever it is between pixels. */
static void small_discs_keep_their_cover(void **state)
{
    (void)state;
    static stage s;
    double least = INFINITY, most = 0;
    set_stage(&s);
    for (int k = 0; k < 20; k++) {
        draw_one(&s, FINE, sb_vec(0.11 * k, 0, 2), SB_FOAM_SPRAY);
        const double sum = cover_of(&s, SPRAY).sum;
        least = fmin(least, sum);
        most = fmax(most, sum);
    }
    assert_true(least > 0.1 && most < 2.5 * least);
    clear_stage(&s);
}

static void threads_and_order_do_not_matter(void **state)
{
    (void)state;
    enum { COUNT = 3000 };
    static stage s[3];
    sb_error error = {0};
    for (int t = 0; t < 3; t++) {
        set_stage(&s[t]);
        assert_int_equal(sb_frame_add_foam(s[t].frame, COUNT), 0);
        for (uint32_t i = 0; i < COUNT; i++) {
            sb_frame_foam *foam = &s[t].frame->foam;
            for (uint32_t a = 0; a < 3; a++) foam->position[3 * i + a] = 4 * sinf(12.9898f * (float)(3 * i + a));
            foam->position[3 * i + 2] *= 0.3f;
            foam->life[i] = 0.5f + 0.5f * sinf((float)i);
            foam->id[i] = i;
            foam->kind[i] = (uint8_t)(i % SB_FOAM_KINDS);
        }
        assert_int_equal(sb_foam_draw(&s[t].layer, s[t].frame, &s[t].view, &s[t].ground, t + 1, &error), SB_OK);
        assert_memory_equal(s[0].layer.pixels, s[t].layer.pixels, 4 * PIXELS * sizeof(float));
    }
    for (int layer = FOAM; layer <= BUBBLES; layer++)
        if (layer != DEPTH) assert_true(cover_of(&s[0], layer).sum > 100);
    for (int t = 0; t < 3; t++) clear_stage(&s[t]);
}

static void running_out_of_memory_is_an_error(void **state)
{
    (void)state;
    static stage s;
    int failures = 0;
    set_stage(&s);
    assert_int_equal(sb_frame_add_foam(s.frame, 1), 0);
    memset(s.frame->foam.position, 0, 3 * sizeof(float));
    s.frame->foam.life[0] = 1;
    s.frame->foam.id[0] = s.frame->foam.kind[0] = 0;
    for (long n = 1; n < 8; n++) {
        sb_foam_layer layer = {0};
        sb_error error = {0};
        sb_memory_fail_at(n);
        failures += sb_foam_draw(&layer, s.frame, &s.view, &s.ground, 1, &error) == SB_FAILED;
        sb_memory_fail_at(0);
        sb_foam_layer_free(&layer);
    }
    assert_int_equal(failures, 4);
    clear_stage(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(foam_lies_in_the_surface),          cmocka_unit_test(what_hides_it),
        cmocka_unit_test(small_discs_keep_their_cover),      cmocka_unit_test(threads_and_order_do_not_matter),
        cmocka_unit_test(running_out_of_memory_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
