#include "coast.h"

#include "base/memory.h"
#include "base/random.h"

#include <stdio.h>

enum { ROWS = 7, BUILDINGS = ROWS * ROWS, CORNERS = 8, FACES = 12 };

static const double shore = 230, front = 330; /* m, x: where the still water ends, and the bore */

static double ground_at(double x, double y)
{
    const double slope = 0.07 * (x - shore), beach = slope < -13 ? -13 : slope > 4 ? 4 : slope;
    return beach + 0.4 * sin(0.11 * x) * cos(0.07 * y);
}

/* The surface of the water, or the ground where there is none. */
static double surface_at(double x, double y)
{
    const double off = (x - 170) / 30, wave = 8 / (cosh(off) * cosh(off));
    const double bore = x > front ? 0 : x > shore - 30 ? 3 * (front - x) / (front - shore + 30) : 0;
    const double ripples = 0.25 * sin(0.5 * x + 0.2 * y) * cos(0.4 * y), bed = ground_at(x, y);
    const double level = x < shore ? wave + ripples : bed + bore;
    return fmax(level > bed ? level : bed, x < shore && bore > 0 ? bed + bore : bed);
}

/* ---- bodies ---- */

static sb_status make_mesh(size_t vertices, size_t triangles, sb_mesh *mesh, sb_error *error)
{
    mesh->vertices = sb_alloc(vertices, sizeof *mesh->vertices);
    mesh->triangles = sb_alloc(triangles, sizeof *mesh->triangles);
    mesh->vertex_count = vertices;
    mesh->triangle_count = triangles;
    return mesh->vertices && mesh->triangles ? SB_OK : sb_fail_memory(error, "a mesh");
}

static sb_status make_ground(const sb_model *model, size_t triangles, sb_mesh *mesh, sb_error *error)
{
    const size_t n = (size_t)ceil(sqrt(0.5 * (double)triangles));
    sb_status status = make_mesh((n + 1) * (n + 1), 2 * n * n, mesh, error);
    const double wide = (model->max.x - model->min.x) / (double)n, deep = (model->max.y - model->min.y) / (double)n;
    for (size_t v = 0; v < (n + 1) * (n + 1) && status == SB_OK; v++) {
        const double x = model->min.x + wide * (double)(v % (n + 1)), y = model->min.y + deep * (double)(v / (n + 1));
        mesh->vertices[v] = sb_vec(x, y, ground_at(x, y));
    }
    for (size_t c = 0; c < n * n && status == SB_OK; c++) {
        const uint32_t low = (uint32_t)(c / n * (n + 1) + c % n), high = low + (uint32_t)n + 1;
        const uint32_t corners[2][3] = {{low, low + 1, high + 1}, {low, high + 1, high}};
        for (int t = 0; t < 2; t++)
            for (int k = 0; k < 3; k++) mesh->triangles[2 * c + (size_t)t][k] = corners[t][k];
    }
    mesh->open_surface = true;
    return status;
}

static sb_status make_building(size_t number, sb_mesh *mesh, sb_error *error)
{
    static const uint32_t faces[FACES][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                                             {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    sb_status status = make_mesh(CORNERS, FACES, mesh, error);
    const double x = 262 + 19 * (double)(number % ROWS), y = 20 + 52 * (double)(number / ROWS);
    const double low = ground_at(x, y) - 2, high = low + 10 + 8 * sb_random(1, number);
    for (int c = 0; c < CORNERS && status == SB_OK; c++)
        mesh->vertices[c] = sb_vec(x + (c & 1 ? 12 : 0), y + (c & 2 ? 30 : 0), c & 4 ? high : low);
    for (int t = 0; t < FACES && status == SB_OK; t++)
        for (int k = 0; k < 3; k++) mesh->triangles[t][k] = faces[t][k];
    return status;
}

sb_status sb_bench_coast_model(const sb_scene *scene, size_t triangles, sb_model *model, sb_error *error)
{
    *model = (sb_model){.min = scene->domain.min, .max = scene->domain.max, .dimensions = 3};
    model->bodies = sb_alloc(1 + BUILDINGS, sizeof *model->bodies);
    if (!model->bodies) return sb_fail_memory(error, "the bodies");
    sb_status status = SB_OK;
    for (size_t b = 0; b < 1 + BUILDINGS && status == SB_OK; b++) {
        static const float brown[3] = {0.46f, 0.47f, 0.35f}, grey[3] = {0.8f, 0.78f, 0.72f};
        sb_model_body *body = &model->bodies[model->body_count++];
        *body = (sb_model_body){.wavemaker = -1, .source = b, .role = b ? SB_ROLE_SOLID : SB_ROLE_TERRAIN};
        snprintf(body->name, sizeof body->name, b ? "building-%zu" : "ground", b);
        for (int c = 0; c < 3; c++) body->color[c] = (b ? grey : brown)[c];
        status = b ? make_building(b - 1, &body->mesh, error) : make_ground(model, triangles, &body->mesh, error);
    }
    if (status != SB_OK) sb_model_free(model);
    return status;
}

/* ---- water ---- */

/* Writes the particles of a spacing into the frame, or only counts them if it is NULL. */
static size_t fill(const sb_scene *scene, double spacing, sb_frame *frame)
{
    const sb_vec3 min = scene->domain.min, max = scene->domain.max;
    size_t count = 0;
    for (double y = min.y + 0.5 * spacing; y < max.y; y += spacing)
        for (double x = min.x + 0.5 * spacing; x < front; x += spacing) {
            const double top = surface_at(x, y);
            for (double z = ground_at(x, y) + 0.5 * spacing; z < top; z += spacing, count++) {
                if (!frame || count >= frame->count) continue;
                const bool thrown = x > shore - 30 && top - z < 2 * spacing && sb_random(2, count) < 0.025;
                float *p = frame->position + 3 * count, *v = frame->velocity + 3 * count;
                const double at[3] = {x, y, z + (thrown ? 12 * sb_random(3, count) : 0)};
                for (size_t a = 0; a < 3; a++) p[a] = (float)(at[a] + 0.3 * spacing * (sb_random(4 + a, count) - 0.5));
                v[0] = (float)(x < shore ? 0.8 * fmax(top, 0) : 7 * (front - x) / (front - shore));
                v[1] = v[2] = 0;
                frame->pressure[count] = (float)(1000 * 9.81 * (top - z));
                frame->id[count] = (uint32_t)count;
            }
        }
    return count;
}

static void fill_foam(sb_frame *frame)
{
    const sb_frame_foam *foam = &frame->foam;
    for (size_t i = 0; i < foam->count; i++) {
        const double x = shore - 30 + (front - shore + 30) * sb_random(7, i), y = 400 * sb_random(8, i);
        const sb_foam_kind kind = (sb_foam_kind)(i % SB_FOAM_KINDS);
        const double above = kind == SB_FOAM_SPRAY ? 10 * sb_random(9, i) : kind == SB_FOAM_BUBBLES ? -0.5 : 0;
        const double at[3] = {x, y, surface_at(x, y) + above};
        for (size_t a = 0; a < 3; a++) {
            foam->position[3 * i + a] = (float)at[a];
            foam->velocity[3 * i + a] = 0;
        }
        foam->life[i] = (float)sb_random(10, i);
        foam->id[i] = (uint32_t)i;
        foam->kind[i] = (uint8_t)kind;
    }
}

sb_status sb_bench_coast_frame(const sb_scene *scene, size_t particles, sb_frame **frame, sb_error *error)
{
    double spacing = 2;
    for (int turn = 0; turn < 4; turn++) spacing *= cbrt((double)fill(scene, spacing, NULL) / (double)particles);
    const size_t count = fill(scene, spacing, NULL);
    sb_frame *made = sb_frame_create(count, 0);
    if (!made || sb_frame_add_foam(made, count / 20) != 0) {
        sb_frame_release(made);
        return sb_fail_memory(error, "a frame");
    }
    made->spacing = spacing;
    made->status.duration = scene->duration;
    fill(scene, spacing, made);
    fill_foam(made);
    *frame = made;
    return SB_OK;
}
