#include "form.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>

uint32_t sb_form_vertex(sb_form *form, sb_vec3 at)
{
    sb_mesh *mesh = &form->mesh;
    if (form->failed || sb_grow((void **)&mesh->vertices, &form->vertex_capacity, mesh->vertex_count + 1,
                                sizeof *mesh->vertices) != 0) {
        form->failed = 1;
        return 0;
    }
    mesh->vertices[mesh->vertex_count] = at;
    return (uint32_t)mesh->vertex_count++;
}

void sb_form_triangle(sb_form *form, uint32_t a, uint32_t b, uint32_t c)
{
    sb_mesh *mesh = &form->mesh;
    if (form->failed || sb_grow((void **)&mesh->triangles, &form->triangle_capacity, mesh->triangle_count + 1,
                                sizeof *mesh->triangles) != 0) {
        form->failed = 1;
        return;
    }
    uint32_t *triangle = mesh->triangles[mesh->triangle_count++];
    triangle[0] = a;
    triangle[1] = b;
    triangle[2] = c;
}

void sb_form_quad(sb_form *form, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    sb_form_triangle(form, a, b, c);
    sb_form_triangle(form, a, c, d);
}

sb_status sb_form_finish(sb_form *form, const char *name, sb_mesh *mesh, sb_error *error)
{
    if (form->failed) {
        sb_free(form->mesh.vertices);
        sb_free(form->mesh.triangles);
        *form = (sb_form){0};
        return sb_fail_memory(error, name);
    }
    snprintf(form->mesh.name, sizeof form->mesh.name, "%s", name);
    *mesh = form->mesh;
    *form = (sb_form){0};
    return SB_OK;
}

sb_ring sb_ring_rectangle(double x_min, double x_max, double y_min, double y_max, double z)
{
    return (sb_ring){.count = 4, .x = {x_min, x_max, x_max, x_min}, .y = {y_min, y_min, y_max, y_max}, .z = z};
}

sb_ring sb_ring_circle(double x, double y, double radius, double z)
{
    enum { CORNERS = 24 };
    sb_ring ring = {.count = CORNERS, .z = z};
    for (size_t i = 0; i < CORNERS; i++) {
        double angle = 2 * M_PI * (double)i / CORNERS;
        ring.x[i] = x + radius * cos(angle);
        ring.y[i] = y + radius * sin(angle);
    }
    return ring;
}

/* Twice the signed area of the triangle of corners a, b, c. */
static double turn(const sb_ring *ring, size_t a, size_t b, size_t c)
{
    return (ring->x[b] - ring->x[a]) * (ring->y[c] - ring->y[a]) -
           (ring->x[c] - ring->x[a]) * (ring->y[b] - ring->y[a]);
}

/* Whether no other remaining corner lies in the triangle a b c or on its edges. */
static bool is_ear(const sb_ring *ring, const size_t *left, size_t count, size_t at)
{
    size_t a = left[(at + count - 1) % count], b = left[at], c = left[(at + 1) % count];
    if (turn(ring, a, b, c) <= 0) return false;
    for (size_t i = 0; i < count; i++) {
        size_t p = left[i];
        if (p != a && p != b && p != c && turn(ring, a, b, p) >= 0 && turn(ring, b, c, p) >= 0 &&
            turn(ring, c, a, p) >= 0)
            return false;
    }
    return true;
}

/* Closes a ring by ear clipping. up: the face is visible from above, else from below. */
static void cap(sb_form *form, const sb_ring *ring, uint32_t first, bool up)
{
    size_t left[SB_FORM_CORNERS], count = ring->count;
    for (size_t i = 0; i < count; i++) left[i] = i;
    while (count >= 3) {
        size_t at = 0;
        while (at < count && !is_ear(ring, left, count, at)) at++;
        if (at == count) {
            form->failed = 1;
            return;
        }
        uint32_t a = first + (uint32_t)left[(at + count - 1) % count];
        uint32_t b = first + (uint32_t)left[at], c = first + (uint32_t)left[(at + 1) % count];
        if (up)
            sb_form_triangle(form, a, b, c);
        else
            sb_form_triangle(form, a, c, b);
        count--;
        for (size_t i = at; i < count; i++) left[i] = left[i + 1];
    }
}

void sb_form_loft(sb_form *form, const sb_ring *rings, size_t count)
{
    uint32_t first = (uint32_t)form->mesh.vertex_count;
    uint32_t corners = (uint32_t)rings[0].count;
    for (size_t r = 0; r < count; r++)
        for (uint32_t i = 0; i < corners; i++) sb_form_vertex(form, sb_vec(rings[r].x[i], rings[r].y[i], rings[r].z));
    for (uint32_t r = 0; r + 1 < count; r++) {
        uint32_t low = first + r * corners, high = low + corners;
        for (uint32_t i = 0; i < corners; i++) {
            uint32_t next = (i + 1) % corners;
            sb_form_quad(form, low + i, low + next, high + next, high + i);
        }
    }
    cap(form, &rings[0], first, false);
    cap(form, &rings[count - 1], first + (uint32_t)(count - 1) * corners, true);
}

/* Unit direction of segment i of the line. */
static void direction_of(const sb_dike *dike, size_t i, double out[2])
{
    double dx = dike->line[i + 1][0] - dike->line[i][0];
    double dy = dike->line[i + 1][1] - dike->line[i][1];
    double length = hypot(dx, dy);
    out[0] = dx / length;
    out[1] = dy / length;
}

void sb_form_dike(sb_form *form, const sb_dike *dike)
{
    uint32_t first = (uint32_t)form->mesh.vertex_count;
    for (size_t i = 0; i < dike->count; i++) {
        double before[2], after[2];
        direction_of(dike, i > 0 ? i - 1 : 0, before);
        direction_of(dike, i + 1 < dike->count ? i : dike->count - 2, after);
        /* The mitre keeps the width of both segments: m = (n1 + n2) / (1 + n1.n2), n to the left of the line. */
        double scale = 1 / (1 + before[0] * after[0] + before[1] * after[1]);
        double mx = -(before[1] + after[1]) * scale, my = (before[0] + after[0]) * scale;
        double run = dike->slope * (dike->crest - dike->foot[i]);
        double out = i == 0 ? -run : i + 1 == dike->count ? run : 0; /* slope of the head */
        double x = dike->line[i][0], y = dike->line[i][1], half = dike->width / 2;
        double fx = x + out * after[0], fy = y + out * after[1], wide = half + run;
        sb_form_vertex(form, sb_vec(fx + wide * mx, fy + wide * my, dike->foot[i]));
        sb_form_vertex(form, sb_vec(x + half * mx, y + half * my, dike->crest));
        sb_form_vertex(form, sb_vec(x - half * mx, y - half * my, dike->crest));
        sb_form_vertex(form, sb_vec(fx - wide * mx, fy - wide * my, dike->foot[i]));
    }
    for (uint32_t i = 0; i + 1 < dike->count; i++) {
        uint32_t here = first + 4 * i, there = here + 4;
        for (uint32_t k = 0; k < 4; k++) {
            uint32_t next = (k + 1) % 4;
            sb_form_quad(form, here + k, here + next, there + next, there + k);
        }
    }
    uint32_t last = first + 4 * (uint32_t)(dike->count - 1);
    sb_form_quad(form, first, first + 3, first + 2, first + 1);
    sb_form_quad(form, last, last + 1, last + 2, last + 3);
}
