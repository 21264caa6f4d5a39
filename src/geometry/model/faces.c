#include "geometry/model/faces.h"

#include "base/memory.h"
#include "geometry/solid/tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A cell near a triangle. Cells are two spacings wide. */
typedef struct entry {
    int32_t cell[3];
    uint32_t triangle;
} entry;

struct sb_face_grid {
    double spacing, reach; /* m */
    sb_vec3 low, high;     /* m, scene: the box around all cells */
    size_t count, capacity;
    entry *entries;      /* sorted; in the end the first one of each cell */
    uint32_t *triangles; /* of all entries */
    size_t cells, *from; /* cell c, that of entries[c], has triangles[from[c]] to before triangles[from[c + 1]] */
};

/* ---- faces ---- */

/* A triangle by its plane, rounded so that the triangles of one face agree. */
typedef struct plane_key {
    int64_t body, normal[3], off;
    size_t triangle; /* of all bodies */
} plane_key;

static int by_plane(const void *left, const void *right)
{
    const plane_key *a = left, *b = right;
    if (a->body != b->body) return a->body < b->body ? -1 : 1;
    for (int k = 0; k < 3; k++)
        if (a->normal[k] != b->normal[k]) return a->normal[k] < b->normal[k] ? -1 : 1;
    if (a->off != b->off) return a->off < b->off ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static bool same_plane(const plane_key *a, const plane_key *b)
{
    return a->body == b->body && memcmp(a->normal, b->normal, sizeof a->normal) == 0 && a->off == b->off;
}

static bool has_faces(const sb_model_body *body)
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

/* Writes the key of each triangle of a face, and returns their number. */
static size_t find_keys(const sb_model *model, double spacing, plane_key *keys)
{
    size_t count = 0, triangle = 0;
    for (size_t b = 0; b < model->body_count; b++) {
        const sb_model_body *body = &model->bodies[b];
        for (size_t t = 0; t < body->mesh.triangle_count; t++, triangle++) {
            sb_vec3 corner[3];
            corners_of(&body->mesh, t, corner);
            const sb_vec3 area = area_of(corner), n = sb_normalize(area);
            if (!has_faces(body) || !(sb_norm(area) > 0)) continue;
            const double off = sb_dot(n, sb_sub(corner[0], body->mesh.vertices[0]));
            keys[count++] = (plane_key){.body = (int64_t)b,
                                        .normal = {llround(500 * n.x), llround(500 * n.y), llround(500 * n.z)},
                                        .off = llround(20 * off / spacing),
                                        .triangle = triangle};
        }
    }
    return count;
}

static void fill_faces(sb_faces *faces, const sb_model *model, const plane_key *keys, size_t count)
{
    size_t before = 0, body = 0; /* triangles of the bodies before this one */
    for (size_t i = 0; i < count; i++) {
        const size_t b = (size_t)keys[i].body;
        for (; body < b; body++) {
            before += model->bodies[body].mesh.triangle_count;
            faces->first[body + 1] = i;
        }
        sb_face_triangle *t = &faces->triangles[i];
        corners_of(&model->bodies[b].mesh, keys[i].triangle - before, t->corner);
        const sb_vec3 area = area_of(t->corner);
        t->normal = sb_normalize(area);
        if (i == 0 || !same_plane(&keys[i - 1], &keys[i]))
            faces->list[faces->count++] = (sb_face){.normal = t->normal, .body = b};
        t->face = (uint32_t)(faces->count - 1);
        faces->of[keys[i].triangle] = t->face;
        faces->list[t->face].area += 0.5 * sb_norm(area);
    }
    for (; body < model->body_count; body++) faces->first[body + 1] = count;
    faces->triangle_count = count;
}

/* ---- cells ---- */

static int by_cell(const void *left, const void *right)
{
    const entry *a = left, *b = right;
    for (int k = 0; k < 3; k++)
        if (a->cell[k] != b->cell[k]) return a->cell[k] < b->cell[k] ? -1 : 1;
    return (a->triangle > b->triangle) - (a->triangle < b->triangle);
}

static int32_t cell_of(double x, double spacing)
{
    return (int32_t)fmin(fmax(floor(x / (2 * spacing)), -1e9), 1e9);
}

/* Adds the cells in the domain, or `reach` beyond it, of which a point may be at most `reach` away from a triangle. */
static sb_status add_cells(struct sb_face_grid *grid, const sb_model *model, const sb_face_triangle *t, uint32_t number,
                           sb_error *error)
{
    const double s = grid->spacing, most = grid->reach + s * sqrt(3);
    const sb_vec3 around = sb_vec(grid->reach, grid->reach, grid->reach);
    const sb_vec3 first = sb_min(sb_min(t->corner[0], t->corner[1]), t->corner[2]);
    const sb_vec3 last = sb_max(sb_max(t->corner[0], t->corner[1]), t->corner[2]);
    const sb_vec3 low = sb_sub(sb_max(first, model->min), around), high = sb_add(sb_min(last, model->max), around);
    grid->low = sb_min(grid->low, low);
    grid->high = sb_max(grid->high, high);
    for (int32_t z = cell_of(low.z, s); z <= cell_of(high.z, s); z++)
        for (int32_t y = cell_of(low.y, s); y <= cell_of(high.y, s); y++)
            for (int32_t x = cell_of(low.x, s); x <= cell_of(high.x, s); x++) {
                const sb_vec3 middle = sb_scale(sb_vec(x + 0.5, y + 0.5, z + 0.5), 2 * s);
                if (fabs(sb_dot(t->normal, sb_sub(middle, t->corner[0]))) > most) continue;
                if (sb_grow((void **)&grid->entries, &grid->capacity, grid->count + 1, sizeof *grid->entries) != 0)
                    return sb_fail_memory(error, "the faces of bodies");
                grid->entries[grid->count++] = (entry){{x, y, z}, number};
            }
    return SB_OK;
}

/* Sorts the entries, and keeps the first one of each cell. */
static sb_status sort_cells(struct sb_face_grid *grid, sb_error *error)
{
    const size_t count = grid->count;
    if (count > 0) qsort(grid->entries, count, sizeof *grid->entries, by_cell);
    grid->triangles = sb_alloc_untouched(count, sizeof *grid->triangles);
    grid->from = sb_alloc(count + 1, sizeof *grid->from);
    if (!grid->triangles || !grid->from) return sb_fail_memory(error, "the faces of bodies");
    for (size_t i = 0; i < count; i++) {
        grid->triangles[i] = grid->entries[i].triangle;
        const entry *last = grid->cells > 0 ? &grid->entries[grid->cells - 1] : NULL;
        if (last && memcmp(last->cell, grid->entries[i].cell, sizeof last->cell) == 0) continue;
        grid->from[grid->cells] = i;
        grid->entries[grid->cells++] = grid->entries[i];
    }
    grid->from[grid->cells] = count;
    return SB_OK;
}

static sb_status make_grid(sb_faces *faces, const sb_model *model, double spacing, double reach, sb_error *error)
{
    struct sb_face_grid *grid = faces->grid;
    grid->spacing = spacing;
    grid->reach = reach;
    grid->low = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    grid->high = sb_scale(grid->low, -1);
    sb_status status = SB_OK;
    for (size_t t = 0; status == SB_OK && t < faces->triangle_count; t++)
        status = add_cells(grid, model, &faces->triangles[t], (uint32_t)t, error);
    return status == SB_OK ? sort_cells(grid, error) : status;
}

sb_status sb_faces_make(const sb_model *model, double spacing, double reach, sb_faces *faces, sb_error *error)
{
    sb_faces made = {.body_count = model->body_count};
    for (size_t b = 0; b < model->body_count; b++) {
        const size_t triangles = model->bodies[b].mesh.triangle_count;
        made.all_count += triangles;
        made.capacity += has_faces(&model->bodies[b]) ? triangles : 0;
    }
    plane_key *keys = sb_alloc(made.capacity, sizeof *keys);
    made.list = sb_alloc(made.capacity, sizeof *made.list);
    made.of = sb_alloc_untouched(made.all_count, sizeof *made.of);
    made.triangles = sb_alloc(made.capacity, sizeof *made.triangles);
    made.first = sb_alloc(model->body_count + 1, sizeof *made.first);
    made.grid = sb_alloc(1, sizeof *made.grid);
    sb_status status = SB_OK;
    if (!keys || !made.list || !made.of || !made.triangles || !made.first || !made.grid) {
        status = sb_fail_memory(error, "the faces of bodies");
        goto done;
    }
    memset(made.of, 0xff, made.all_count * sizeof *made.of);
    const size_t count = find_keys(model, spacing, keys);
    if (count > 0) qsort(keys, count, sizeof *keys, by_plane);
    fill_faces(&made, model, keys, count);
    status = make_grid(&made, model, spacing, reach, error);
done:
    sb_free(keys);
    if (status == SB_OK)
        *faces = made;
    else
        sb_faces_free(&made);
    return status;
}

void sb_faces_free(sb_faces *faces)
{
    if (faces->grid) {
        sb_free(faces->grid->entries);
        sb_free(faces->grid->triangles);
        sb_free(faces->grid->from);
    }
    sb_free(faces->grid);
    sb_free(faces->list);
    sb_free(faces->of);
    sb_free(faces->triangles);
    sb_free(faces->first);
    *faces = (sb_faces){0};
}

size_t sb_faces_bytes(const sb_faces *faces)
{
    const struct sb_face_grid *g = faces->grid;
    const size_t grid =
        g ? sizeof *g + g->capacity * sizeof *g->entries + g->count * (sizeof *g->triangles + sizeof *g->from) : 0;
    return grid + faces->capacity * (sizeof *faces->list + sizeof *faces->triangles) +
           faces->all_count * sizeof *faces->of + (faces->body_count + 1) * sizeof *faces->first;
}

/* ---- places ---- */

size_t sb_faces_near(const sb_faces *faces, sb_vec3 at, const uint32_t **triangles)
{
    const struct sb_face_grid *grid = faces->grid;
    if (!(at.x > grid->low.x && at.x < grid->high.x && at.y > grid->low.y && at.y < grid->high.y) ||
        !(at.z > grid->low.z && at.z < grid->high.z))
        return 0;
    const entry wanted = {{cell_of(at.x, grid->spacing), cell_of(at.y, grid->spacing), cell_of(at.z, grid->spacing)},
                          0};
    size_t low = 0, high = grid->cells;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (by_cell(&grid->entries[middle], &wanted) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    /* The first entry of the cell has a triangle of at least 0. */
    if (low == grid->cells || memcmp(grid->entries[low].cell, wanted.cell, sizeof wanted.cell) != 0) return 0;
    *triangles = grid->triangles + grid->from[low];
    return grid->from[low + 1] - grid->from[low];
}

/* What sb_faces_nearest minimises. */
static double cost_of(const sb_faces *faces, const sb_face_triangle *t, sb_vec3 at, sb_vec3 along)
{
    const sb_solid_triangle plain = {.a = t->corner[0], .b = t->corner[1], .c = t->corner[2]};
    const double distance = sb_norm(sb_sub(at, sb_solid_nearest_on(&plain, at)));
    return distance + faces->grid->spacing * (1 - sb_dot(t->normal, along));
}

uint32_t sb_faces_nearest(const sb_faces *faces, size_t body, sb_vec3 at, sb_vec3 along)
{
    const uint32_t *near = NULL;
    const size_t count = sb_faces_near(faces, at, &near);
    double least = HUGE_VAL;
    uint32_t face = UINT32_MAX;
    for (size_t k = 0; k < count; k++) {
        const sb_face_triangle *t = &faces->triangles[near[k]];
        if (faces->list[t->face].body != body) continue;
        const double cost = cost_of(faces, t, at, along);
        if (cost < least) face = t->face;
        least = fmin(cost, least);
    }
    if (least <= faces->grid->reach) return face; /* all others are farther away */
    for (size_t k = faces->first[body]; k < faces->first[body + 1]; k++) {
        const double cost = cost_of(faces, &faces->triangles[k], at, along);
        if (cost < least) face = faces->triangles[k].face;
        least = fmin(cost, least);
    }
    return face;
}
