/* What slices show: the interpolated field against linear fields, streamlines against circles, and the sections of
   bodies against exact areas. */
#include "base/memory.h"
#include "base/random.h"
#include "render/slice/section.h"
#include "render/slice/streamlines.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

/* side^3 particles of 0.5 m around `middle` in a frame with an origin of its own, each moved by up to 0.1 m. */
static sb_frame *block(int side, sb_vec3 middle)
{
    sb_frame *frame = sb_frame_create((size_t)(side * side * side), 0);
    assert_non_null(frame);
    frame->spacing = 0.5;
    frame->origin = sb_vec(100, -50, 20);
    size_t n = 0;
    for (int k = 0; k < side; k++)
        for (int j = 0; j < side; j++)
            for (int i = 0; i < side; i++, n++) {
                const int at[3] = {i, j, k};
                const double corner[3] = {middle.x - 100, middle.y + 50, middle.z - 20};
                for (size_t a = 0; a < 3; a++)
                    frame->position[3 * n + a] =
                        (float)(corner[a] + 0.5 * at[a] - 0.25 * (side - 1) + 0.2 * (sb_random(3, 3 * n + a) - 0.5));
            }
    memset(frame->pressure, 0, frame->count * sizeof(float));
    return frame;
}

static sb_vec3 place_of(const sb_frame *frame, size_t i)
{
    const float *p = frame->position + 3 * i;
    return sb_add(frame->origin, sb_vec((double)p[0], (double)p[1], (double)p[2]));
}

static void set_velocity(sb_frame *frame, size_t i, sb_vec3 v)
{
    frame->velocity[3 * i] = (float)v.x;
    frame->velocity[3 * i + 1] = (float)v.y;
    frame->velocity[3 * i + 2] = (float)v.z;
}

/* Fills a field over 9 m x 9 m around the plane's point. */
static void fill(const sb_frame *frame, const sb_plane *plane, int threads, sb_plane_field *field, float *values)
{
    const double low[2] = {-4.5, -4.5}, high[2] = {4.5, 4.5};
    sb_density density = {0};
    sb_error error = {0};
    memset(field, 0, sizeof *field);
    if (sb_density_build(&density, frame, NULL, 1, &error) != SB_OK ||
        sb_plane_field_lay(field, low, high, frame->spacing, &error) != SB_OK ||
        sb_plane_field_fill(field, plane, frame, values, &density, threads, &error) != SB_OK)
        fail_msg("%s", error.text);
    sb_density_free(&density);
}

static sb_vec3 linear(sb_vec3 x)
{
    return sb_vec(0.5 + 0.7 * x.x - 0.2 * x.y + 0.3 * x.z, -1 + 0.1 * x.x + 0.4 * x.y - 0.6 * x.z,
                  0.8 - 0.5 * x.x + 0.9 * x.y + 0.2 * x.z);
}

/* On an oblique plane through disordered particles, up to the water's edge. The velocity is up to 8 m/s. */
static void a_linear_velocity_is_exact(void **state)
{
    (void)state;
    const sb_vec3 middle = sb_vec(103, -47, 21);
    sb_frame *frame = block(16, middle);
    float *values = sb_alloc(frame->count, sizeof *values);
    for (size_t i = 0; i < frame->count; i++) {
        const sb_vec3 x = sb_sub(place_of(frame, i), middle);
        set_velocity(frame, i, linear(x));
        values[i] = (float)(0.5 + 0.05 * x.x - 0.04 * x.y + 0.01 * x.z);
    }
    const sb_slice slice = {.point = middle, .normal = {0.3, -1, 0.5}};
    const sb_plane plane = sb_plane_of(&slice, sb_vec(103, -90, 40));
    sb_plane_field field;
    fill(frame, &plane, 2, &field, values);
    size_t wet = 0;
    double worst = 0, worst_value = 0;
    for (int i = 0; i < 3000; i++) {
        const double a = 9 * (sb_random(5, 2 * (uint64_t)i) - 0.5), b = 9 * (sb_random(5, 2 * (uint64_t)i + 1) - 0.5);
        const sb_plane_sample sample = sb_plane_field_at(&field, a, b);
        const sb_vec3 x = sb_sub(sb_plane_at(&plane, a, b), middle), v = linear(x);
        const bool inside = fabs(x.x) < 3.9 && fabs(x.y) < 3.9 && fabs(x.z) < 3.9;
        const bool outside = fabs(x.x) > 4.6 || fabs(x.y) > 4.6 || fabs(x.z) > 4.6;
        if (outside) assert_false(sb_plane_wet(&sample));
        if (!inside) continue;
        if (fabs(x.x) < 3.4 && fabs(x.y) < 3.4 && fabs(x.z) < 3.4) assert_true(sb_plane_wet(&sample));
        if (!sb_plane_wet(&sample)) continue; /* edges of the block are rounded */
        wet++;
        /* The grid's bilinear interpolation is exact for linear fields, too. */
        worst = fmax(worst, fabs((double)sample.velocity[0] - sb_dot(v, plane.across)));
        worst = fmax(worst, fabs((double)sample.velocity[1] - sb_dot(v, plane.over)));
        worst_value = fmax(worst_value, fabs((double)sample.value - (0.5 + 0.05 * x.x - 0.04 * x.y + 0.01 * x.z)));
    }
    assert_true(wet > 1000);
    print_message("velocity: %.2g m/s, value: %.2g\n", worst, worst_value);
    assert_true(worst < 1e-3);
    assert_true(worst_value < 1e-3);
    sb_plane_field_free(&field);
    sb_free(values);
    sb_frame_release(frame);
}

/* Any number of threads gives the same bits. */
static void threads_do_not_change_the_field(void **state)
{
    (void)state;
    sb_frame *frame = block(12, sb_vec(103, -47, 21));
    float *values = sb_alloc(frame->count, sizeof *values);
    for (size_t i = 0; i < frame->count; i++) {
        set_velocity(frame, i, sb_vec(sb_random(7, i), sb_random(8, i), sb_random(9, i)));
        values[i] = (float)sb_random(10, i);
    }
    const sb_slice slice = {.point = {103, -47, 21}, .normal = {0, 0, 1}};
    const sb_plane plane = sb_plane_of(&slice, sb_vec(103, -47, 60));
    sb_plane_field one, many;
    fill(frame, &plane, 1, &one, values);
    for (int threads = 2; threads <= 8; threads *= 2) {
        fill(frame, &plane, threads, &many, values);
        assert_memory_equal(one.node, many.node, one.n[0] * one.n[1] * sizeof *one.node);
        sb_plane_field_free(&many);
    }
    sb_plane_field_free(&one);
    sb_free(values);
    sb_frame_release(frame);
}

/* The mean distance of a line's points from the middle, and the largest difference from it. */
static double radius_of(const sb_streamlines *lines, const sb_streamline *line, double *off)
{
    double sum = 0;
    for (size_t k = line->first; k < line->first + line->count; k++)
        sum += hypot((double)lines->points[k].a, (double)lines->points[k].b);
    const double mean = sum / (double)line->count;
    *off = 0;
    for (size_t k = line->first; k < line->first + line->count; k++)
        *off = fmax(*off, fabs(hypot((double)lines->points[k].a, (double)lines->points[k].b) - mean));
    return mean;
}

/* Lines of a rigid rotation are circles about its middle, closed unless they leave the water, and evenly spaced. */
static void lines_of_a_rotation_are_circles(void **state)
{
    (void)state;
    const sb_vec3 middle = sb_vec(103, -47, 21);
    sb_frame *frame = block(16, middle);
    float *values = sb_alloc(frame->count, sizeof *values);
    for (size_t i = 0; i < frame->count; i++) {
        const sb_vec3 x = sb_sub(place_of(frame, i), middle);
        set_velocity(frame, i, sb_vec(-0.8 * x.y, 0.8 * x.x, 0.1));
    }
    const sb_slice slice = {.point = middle, .normal = {0, 0, -1}};
    const sb_plane plane = sb_plane_of(&slice, sb_vec(103, -47, 60));
    sb_plane_field field;
    sb_streamlines lines = {0};
    sb_error error = {0};
    fill(frame, &plane, 2, &field, values);
    assert_int_equal(sb_streamlines_trace(&lines, &field, 0.6, &error), SB_OK);
    size_t closed = 0;
    double radii[64];
    assert_in_range(lines.line_count, 6, 64);
    for (size_t i = 0; i < lines.line_count; i++) {
        double off;
        const double radius = radius_of(&lines, &lines.lines[i], &off);
        assert_true(off < 1e-3 * radius + 1e-5);
        if (radius < 3.8) assert_true(lines.lines[i].closed);
        for (size_t k = 0; k < closed; k++) assert_true(fabs(radius - radii[k]) > 0.29); /* half of the distance */
        if (lines.lines[i].closed) radii[closed++] = radius;
    }
    assert_in_range(closed, 5, 12); /* of 4 m / 0.6 m */
    sb_streamlines_free(&lines);
    sb_plane_field_free(&field);
    sb_free(values);
    sb_frame_release(frame);
}

static sb_mesh room_for(size_t vertices, size_t triangles)
{
    sb_mesh mesh = {.vertex_count = vertices, .triangle_count = triangles};
    mesh.vertices = sb_alloc(vertices, sizeof *mesh.vertices);
    mesh.triangles = sb_alloc(triangles, sizeof *mesh.triangles);
    assert_non_null(mesh.vertices);
    assert_non_null(mesh.triangles);
    return mesh;
}

static void clear(sb_mesh *mesh)
{
    sb_free(mesh->vertices);
    sb_free(mesh->triangles);
    *mesh = (sb_mesh){0};
}

/* A box whose faces point outward. */
static sb_mesh box(sb_vec3 min, sb_vec3 max)
{
    static const uint32_t faces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                          {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    sb_mesh mesh = room_for(8, 12);
    for (int i = 0; i < 8; i++)
        mesh.vertices[i] = sb_vec(i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z);
    memcpy(mesh.triangles, faces, sizeof faces);
    return mesh;
}

/* Ground over 40 m x 20 m whose height rises by `slope`. */
static sb_mesh ramp(double slope)
{
    sb_mesh mesh = room_for(4, 2);
    for (int i = 0; i < 4; i++) {
        const double x = i & 1 ? 20 : -20, y = i & 2 ? 10 : -10;
        mesh.vertices[i] = sb_vec(x, y, slope * x);
    }
    const uint32_t faces[2][3] = {{0, 1, 2}, {1, 3, 2}};
    memcpy(mesh.triangles, faces, sizeof faces);
    mesh.open_surface = true;
    return mesh;
}

enum { CELLS = 200 };

/* The solid area in the plane, m^2, as a camera at `eye` sees it: each cell's share times its size in the plane. */
static double area_of(sb_model *model, sb_vec3 normal, sb_vec3 eye, double terrain_and_bodies[2])
{
    const sb_slice slice = {.point = {0, 0, 0}, .normal = normal};
    const sb_camera_key key = {0, eye, {0, 0, 0}, 50, SB_EASE_SMOOTH};
    const sb_view view = sb_view_create(&key, 1, model->min, model->max);
    const sb_plane plane = sb_plane_of(&slice, eye);
    const sb_plane_area area = sb_plane_visible(&plane, &view, model->min, model->max);
    const sb_plane_map to_pixels = sb_plane_to_pixels(&plane, &view, CELLS, CELLS);
    const sb_plane_map to_plane = sb_plane_inverse(&to_pixels);
    static float terrain[CELLS * CELLS], bodies[CELLS * CELLS];
    sb_solids solids;
    sb_section section = {0};
    sb_error error = {0};
    sb_frame *frame = sb_frame_create(0, 0);
    if (sb_solids_create(model, &solids, &error) != SB_OK ||
        sb_section_cut(&section, &solids, &plane, frame, &error) != SB_OK ||
        sb_section_fill(&section, &solids, &plane, &area, &to_pixels, CELLS, CELLS, terrain, bodies, &error) != SB_OK)
        fail_msg("%s", error.text);
    terrain_and_bodies[0] = terrain_and_bodies[1] = 0;
    for (int y = 0; y < CELLS; y++)
        for (int x = 0; x < CELLS; x++) {
            double a[2], b[2], c[2];
            if (!sb_plane_apply(&to_plane, x, y, a) || !sb_plane_apply(&to_plane, x + 1, y, b) ||
                !sb_plane_apply(&to_plane, x, y + 1, c))
                continue;
            const double size = fabs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            terrain_and_bodies[0] += size * (double)terrain[y * CELLS + x];
            terrain_and_bodies[1] += size * (double)bodies[y * CELLS + x];
        }
    sb_section_free(&section);
    sb_solids_free(&solids);
    sb_frame_release(frame);
    return terrain_and_bodies[0] + terrain_and_bodies[1];
}

/* The areas are those of the bodies, from both sides of the plane. A cell is about 0.1 m. */
static void sections_have_the_area_of_the_bodies(void **state)
{
    (void)state;
    sb_model_body list[3] = {{.name = "one"}, {.name = "other"}, {.name = "ground", .role = SB_ROLE_TERRAIN}};
    list[0].mesh = box(sb_vec(-3, -2, -1), sb_vec(1, 2, 4));
    list[1].mesh = box(sb_vec(3, -4, -5), sb_vec(5, 4, -2));
    list[2].mesh = ramp(0.1);
    sb_model model = {.bodies = list, .body_count = 2, .min = {-10, -8, -6}, .max = {10, 8, 6}};
    static const sb_vec3 normals[] = {{0, 1, 0}, {0, 0, 1}, {0, 1, 1}};
    /* 4 x 5 and 2 x 3; 4 x 4; 4 m wide and from z = -1 to 2 along the diagonal, and 2 m wide from z = -4 to -2. */
    const double exact[] = {26, 16, 4 * 3 * sqrt(2) + 2 * 2 * sqrt(2)};
    for (size_t i = 0; i < 3; i++)
        for (int side = -1; side <= 1; side += 2) {
            double parts[2];
            const sb_vec3 eye = sb_add(sb_scale(normals[i], 22 * side), sb_vec(4, 0.5, 0.5));
            const double area = area_of(&model, normals[i], eye, parts);
            assert_true(fabs(area - exact[i]) < 0.01 * exact[i]);
        }
    model.body_count = 3;
    /* The ground from the domain's lower side to z = 0.1 x, over 20 m. */
    for (int side = -1; side <= 1; side += 2) {
        double parts[2];
        area_of(&model, sb_vec(0, 1, 0), sb_vec(1, 30 * side, 2), parts);
        assert_true(fabs(parts[0] - 120) < 1.2);
        assert_true(fabs(parts[1] - 26) < 0.26);
    }
    clear(&list[2].mesh);
    /* Level ground: no row of the picture passes its outline, when the eye is at the height of the plane's point. */
    list[2].mesh = ramp(0);
    double parts[2];
    area_of(&model, sb_vec(0, 1, 0), sb_vec(0, -30, 0), parts);
    assert_true(fabs(parts[0] - 120) < 2.5);
    for (int b = 0; b < 3; b++) clear(&list[b].mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_linear_velocity_is_exact),
        cmocka_unit_test(threads_do_not_change_the_field),
        cmocka_unit_test(lines_of_a_rotation_are_circles),
        cmocka_unit_test(sections_have_the_area_of_the_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
