/* Sums the pressure of the water next to bodies. */
#include "render/face_loads.h"

#include "base/memory.h"
#include "render/colormap.h"
#include "render/density.h"
#include "render/meshes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A triangle with a load. */
struct triangle {
    sb_vec3 corner[3], normal; /* m, scene; unit */
    uint32_t face;
};

/* A cell near a triangle. Cells are two spacings wide. */
struct entry {
    int32_t cell[3];
    uint32_t triangle;
};

struct sb_load_grid {
    double spacing;
    sb_vec3 low, high; /* m, scene: the box around all entries */
    size_t triangle_count, entry_count, entry_capacity;
    struct triangle *triangles;
    struct entry *entries; /* sorted */
};

/* ---- faces ---- */

/* A triangle by its plane, rounded so that the triangles of one face agree. */
struct plane_key {
    int64_t body, normal[3], off;
    size_t triangle;
};

static int by_plane(const void *left, const void *right)
{
    const struct plane_key *a = left, *b = right;
    if (a->body != b->body) return a->body < b->body ? -1 : 1;
    for (int k = 0; k < 3; k++)
        if (a->normal[k] != b->normal[k]) return a->normal[k] < b->normal[k] ? -1 : 1;
    if (a->off != b->off) return a->off < b->off ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static bool same_plane(const struct plane_key *a, const struct plane_key *b)
{
    return a->body == b->body && memcmp(a->normal, b->normal, sizeof a->normal) == 0 && a->off == b->off;
}

static bool has_load(const sb_model_body *body)
{
    return body->role != SB_ROLE_TERRAIN && body->wavemaker < 0;
}

/* Normal times twice the area. */
static sb_vec3 area_of(const sb_vec3 p[3])
{
    return sb_cross(sb_sub(p[1], p[0]), sb_sub(p[2], p[0]));
}

static void corners_of(const sb_mesh *mesh, size_t triangle, sb_vec3 corner[3])
{
    for (int k = 0; k < 3; k++) corner[k] = mesh->vertices[mesh->triangles[triangle][k]];
}

/* Writes the key of each triangle with a load, and returns their number. */
static size_t find_keys(const sb_model *model, double spacing, struct plane_key *keys)
{
    size_t count = 0, triangle = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t t = 0; t < body->mesh.triangle_count; t++, triangle++) {
            sb_vec3 corner[3];
            corners_of(&body->mesh, t, corner);
            const sb_vec3 area = area_of(corner), n = sb_normalize(area);
            if (!has_load(body) || !(sb_norm(area) > 0)) continue;
            const double off = sb_dot(n, sb_sub(corner[0], body->mesh.vertices[0]));
            keys[count++] = (struct plane_key){.body = (int64_t)b,
                                               .normal = {llround(500 * n.x), llround(500 * n.y), llround(500 * n.z)},
                                               .off = llround(20 * off / spacing),
                                               .triangle = triangle};
        }
    }
    return count;
}

/* ---- cells ---- */

static int by_cell(const void *left, const void *right)
{
    const struct entry *a = left, *b = right;
    for (int k = 0; k < 3; k++)
        if (a->cell[k] != b->cell[k]) return a->cell[k] < b->cell[k] ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static int32_t cell_of(double x, double spacing)
{
    return (int32_t)fmin(fmax(floor(x / (2 * spacing)), -1e9), 1e9);
}

/* Adds the cells that the layer before a triangle may touch. */
static sb_status add_cells(struct sb_load_grid *grid, uint32_t number, sb_error *error)
{
    const struct triangle *t = &grid->triangles[number];
    const double reach = grid->spacing, half = reach * sqrt(3);
    sb_vec3 low = t->corner[0], high = low;
    for (int k = 0; k < 3; k++) {
        low = sb_min(low, sb_min(t->corner[k], sb_madd(t->corner[k], reach, t->normal)));
        high = sb_max(high, sb_max(t->corner[k], sb_madd(t->corner[k], reach, t->normal)));
    }
    grid->low = sb_min(grid->low, low);
    grid->high = sb_max(grid->high, high);
    for (int32_t z = cell_of(low.z, reach); z <= cell_of(high.z, reach); z++)
        for (int32_t y = cell_of(low.y, reach); y <= cell_of(high.y, reach); y++)
            for (int32_t x = cell_of(low.x, reach); x <= cell_of(high.x, reach); x++) {
                const sb_vec3 middle = sb_scale(sb_vec(x + 0.5, y + 0.5, z + 0.5), 2 * reach);
                const double off = sb_dot(t->normal, sb_sub(middle, t->corner[0]));
                if (off < -half || off > reach + half) continue;
                if (sb_grow((void **)&grid->entries, &grid->entry_capacity, grid->entry_count + 1,
                            sizeof *grid->entries) != 0)
                    return sb_fail_memory(error, "the loads of a picture");
                grid->entries[grid->entry_count++] = (struct entry){{x, y, z}, number};
            }
    return SB_OK;
}

/* The first entry of a cell, or of the next one. */
static size_t find_cell(const struct sb_load_grid *grid, const int32_t cell[3])
{
    const struct entry wanted = {{cell[0], cell[1], cell[2]}, 0};
    size_t low = 0, high = grid->entry_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (by_cell(&grid->entries[middle], &wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* ---- creation ---- */

static sb_status make_faces(sb_face_loads *loads, const sb_model *model, const struct plane_key *keys, size_t count,
                            sb_error *error)
{
    struct sb_load_grid *grid = loads->grid;
    const sb_model_body *bodies = model->bodies;
    size_t first = 0; /* triangle of the key's body */
    int64_t last = -1;
    for (size_t i = 0; i < count; i++) {
        const size_t b = (size_t)keys[i].body;
        for (; last < keys[i].body; last++) first += last >= 0 ? bodies[last].mesh.triangle_count : 0;
        struct triangle *t = &grid->triangles[i];
        corners_of(&bodies[b].mesh, keys[i].triangle - first, t->corner);
        const sb_vec3 area = area_of(t->corner);
        t->normal = sb_normalize(area);
        if (i == 0 || !same_plane(&keys[i - 1], &keys[i]))
            loads->faces[loads->face_count++] = (sb_load_face){.normal = t->normal, .body = b};
        t->face = (uint32_t)(loads->face_count - 1);
        loads->face[keys[i].triangle] = t->face;
        loads->faces[t->face].area += 0.5 * sb_norm(area);
        grid->triangle_count = i + 1;
        sb_status status = add_cells(grid, (uint32_t)i, error);
        if (status != SB_OK) return status;
    }
    if (grid->entry_count > 0) qsort(grid->entries, grid->entry_count, sizeof *grid->entries, by_cell);
    return SB_OK;
}

static void find_paint(sb_face_loads *loads, const sb_model *model)
{
    size_t corner = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        unsigned char paint[4];
        sb_meshes_paint(&model->bodies[b], paint);
        for (size_t c = 0; c < 3 * model->bodies[b].mesh.triangle_count; c++) memcpy(loads->paint[corner++], paint, 4);
    }
}

sb_status sb_face_loads_create(const sb_model *model, double spacing, sb_face_loads *loads, sb_error *error)
{
    sb_face_loads made = {0};
    for (size_t b = 0; b < model->body_count; b++) made.triangle_count += model->bodies[b].mesh.triangle_count;
    const size_t n = made.triangle_count;
    struct plane_key *keys = sb_alloc(n, sizeof *keys);
    made.faces = sb_alloc(n, sizeof *made.faces);
    made.face = sb_alloc(n, sizeof *made.face);
    made.paint = sb_alloc(3 * n, sizeof *made.paint);
    made.colors = sb_alloc(3 * n, sizeof *made.colors);
    made.grid = sb_alloc(1, sizeof *made.grid);
    if (made.grid) made.grid->triangles = sb_alloc(n, sizeof *made.grid->triangles);
    sb_status status = SB_OK;
    if (!keys || !made.faces || !made.face || !made.paint || !made.colors || !made.grid || !made.grid->triangles) {
        status = sb_fail_memory(error, "the loads of a picture");
        goto done;
    }
    made.grid->spacing = spacing;
    made.grid->low = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    made.grid->high = sb_scale(made.grid->low, -1);
    memset(made.face, 0xff, n * sizeof *made.face);
    find_paint(&made, model);
    const size_t count = find_keys(model, spacing, keys);
    if (count > 0) qsort(keys, count, sizeof *keys, by_plane);
    status = make_faces(&made, model, keys, count, error);
done:
    sb_free(keys);
    if (status == SB_OK)
        *loads = made;
    else
        sb_face_loads_free(&made);
    return status;
}

void sb_face_loads_free(sb_face_loads *loads)
{
    if (loads->grid) {
        sb_free(loads->grid->triangles);
        sb_free(loads->grid->entries);
    }
    sb_free(loads->grid);
    sb_free(loads->faces);
    sb_free(loads->face);
    sb_free(loads->paint);
    sb_free(loads->colors);
    *loads = (sb_face_loads){0};
}

/* ---- pictures ---- */

/* Whether a place is in the layer of one spacing before a triangle. */
static bool is_before(const struct triangle *t, sb_vec3 at, double spacing)
{
    const double off = sb_dot(t->normal, sb_sub(at, t->corner[0]));
    if (!(off > 0 && off <= spacing)) return false;
    for (int k = 0; k < 3; k++) {
        const sb_vec3 side = sb_sub(t->corner[(k + 1) % 3], t->corner[k]);
        if (sb_dot(sb_cross(side, sb_sub(at, t->corner[k])), t->normal) < 0) return false;
    }
    return true;
}

/* Adds the pressure of a particle to each face that it is next to, but once. */
static void add_particle(sb_face_loads *loads, sb_vec3 at, double force)
{
    const struct sb_load_grid *grid = loads->grid;
    const int32_t cell[3] = {cell_of(at.x, grid->spacing), cell_of(at.y, grid->spacing), cell_of(at.z, grid->spacing)};
    uint32_t last = UINT32_MAX;
    for (size_t i = find_cell(grid, cell); i < grid->entry_count; i++) {
        if (memcmp(grid->entries[i].cell, cell, sizeof cell) != 0) return;
        const struct triangle *t = &grid->triangles[grid->entries[i].triangle];
        if (t->face == last || !is_before(t, at, grid->spacing)) continue;
        loads->faces[t->face].force += force;
        last = t->face; /* triangles of one face follow each other */
    }
}

static void find_colors(sb_face_loads *loads, double most)
{
    for (size_t t = 0; t < loads->triangle_count; t++) {
        const sb_load_face *face = loads->face[t] == UINT32_MAX ? NULL : &loads->faces[loads->face[t]];
        const double share = face ? face->force / (face->area * most) : 0;
        /* Faces without a load keep their colour. */
        const double tint = 0.9 * fmin(50 * fmax(share, 0), 1);
        float rgb[3];
        sb_colormap(SB_COLORMAP_FIRE, share, rgb);
        for (size_t c = 3 * t; c < 3 * t + 3; c++) {
            for (int k = 0; k < 3; k++)
                loads->colors[c][k] =
                    (unsigned char)((1 - tint) * loads->paint[c][k] + tint * 255 * (double)rgb[k] + 0.5);
            loads->colors[c][3] = loads->paint[c][3];
        }
    }
}

void sb_face_loads_compute(sb_face_loads *loads, const sb_frame *frame, double most)
{
    const struct sb_load_grid *grid = loads->grid;
    const double square = frame->spacing * frame->spacing;
    for (size_t f = 0; f < loads->face_count; f++) loads->faces[f].force = 0;
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        const sb_vec3 at = sb_add(frame->origin, sb_vec((double)p[0], (double)p[1], (double)p[2]));
        if (!sb_density_counts(p) || !(at.x > grid->low.x && at.x < grid->high.x)) continue;
        if (!(at.y > grid->low.y && at.y < grid->high.y && at.z > grid->low.z && at.z < grid->high.z)) continue;
        add_particle(loads, at, square * (double)frame->pressure[i]);
    }
    find_colors(loads, most);
}
