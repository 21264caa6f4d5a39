/* Makes the meshes of a body of the scene: shape, units and axes, transform, names. */
#include "base/memory.h"
#include "base/turn.h"
#include "geometry/grid/terrain.h"
#include "geometry/mesh/mesh.h"

#include <stdio.h>
#include <string.h>

/* Chord error of round shapes in spacings: small compared with the distance rules of the sampling. */
static const double chord_error = 0.02;

/* Returns half a unit in the last place of the largest coordinate in single precision, in metres. Importers store
   coordinates in single precision. */
static double rounding(const sb_body *body, const sb_mesh *mesh)
{
    double largest = 0;
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        const sb_vec3 p = mesh->vertices[i];
        largest = fmax(largest, fmax(fabs(p.x), fmax(fabs(p.y), fabs(p.z))));
    }
    return 0x1p-24 * largest * body->scale;
}

/* In spacings: largest rounding error of a mesh file's coordinates that is accepted. */
static const double coarsest = 0.25;

static sb_status check_rounding(const sb_body *body, double spacing, sb_mesh *meshes, size_t count, sb_error *error)
{
    for (size_t i = 0; i < count && body->shape == SB_SHAPE_MESH; ++i) {
        meshes[i].rounded = rounding(body, &meshes[i]);
        if (meshes[i].rounded > coarsest * spacing)
            return sb_fail(
                error, SB_BAD_INPUT,
                "%.300s: its coordinates are so far from 0 that single precision rounds them by %.2g m (%.2g "
                "spacings): expected coordinates near 0 in the file, and the body moved by translate",
                body->file, meshes[i].rounded, meshes[i].rounded / spacing);
    }
    return SB_OK;
}

static void transform(const sb_body *body, sb_mesh *mesh)
{
    const bool from_file = body->shape == SB_SHAPE_MESH || body->shape == SB_SHAPE_GRID;
    const double scale = from_file ? body->scale : 1;
    const double raise = body->shape == SB_SHAPE_GRID ? body->datum : 0;
    const sb_turn turn = sb_turn_of(body->rotate);
    for (size_t i = 0; i < mesh->vertex_count + mesh->hole_count; ++i) {
        sb_vec3 *at = i < mesh->vertex_count ? mesh->vertices + i : mesh->holes + (i - mesh->vertex_count);
        sb_vec3 p = sb_scale(*at, scale);
        if (body->shape == SB_SHAPE_MESH && body->up == 'y') p = sb_vec(p.x, -p.z, p.y);
        if (body->shape == SB_SHAPE_GRID && body->positive == SB_POSITIVE_DOWN) p.z = -p.z;
        p.z += raise;
        *at = sb_add(sb_turned(&turn, p), body->translate);
    }
}

/* A box in scene coordinates. */
typedef struct box {
    sb_vec3 min, max;
    double margin; /* m */
} box;

/* Returns the extent in x and y of the box and its margin before the body's rotation, translation and scale. */
static sb_terrain_area area_of(const sb_body *body, const box *within)
{
    const sb_turn turn = sb_turn_of(body->rotate);
    const sb_vec3 axes[2] = {sb_vec(1, 0, 0), sb_vec(0, 1, 0)}, ends[2] = {within->min, within->max};
    sb_terrain_area area = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};
    for (int corner = 0; corner < 8; ++corner) {
        const sb_vec3 at = sb_vec(ends[corner & 1].x, ends[corner >> 1 & 1].y, ends[corner >> 2].z);
        for (int k = 0; k < 2; ++k) {
            /* The rotation's inverse is its transpose. */
            const sb_vec3 row = sb_turned(&turn, axes[k]);
            const double place = sb_dot(row, sb_sub(at, body->translate));
            area.min[k] = fmin(area.min[k], (place - within->margin) / body->scale);
            area.max[k] = fmax(area.max[k], (place + within->margin) / body->scale);
        }
    }
    return area;
}

static sb_status make_grid(const sb_body *body, const box *within, sb_mesh *mesh, sb_error *error)
{
    if (!sb_terrain_applies(body)) return sb_mesh_import_grid(body, mesh, error);
    const sb_terrain_area area = within ? area_of(body, within) : (sb_terrain_area){.min = {0}};
    return sb_terrain_make(body, within ? &area : NULL, mesh, error);
}

/* Makes the body's meshes in the coordinates of its shape or file. */
static sb_status make(const sb_body *body, double spacing, const box *within, sb_mesh **meshes, size_t *count,
                      sb_error *error)
{
    if (body->shape == SB_SHAPE_MESH) return sb_mesh_import(body->file, meshes, count, error);
    sb_mesh *one = sb_alloc(1, sizeof *one);
    if (!one) return sb_fail_memory(error, "a mesh");
    sb_status status = SB_BAD_INPUT;
    switch (body->shape) {
    case SB_SHAPE_MESH:
        break;
    case SB_SHAPE_GRID:
        status = make_grid(body, within, one, error);
        break;
    case SB_SHAPE_BOX:
        status = sb_mesh_box(body->min, body->max, one, error);
        break;
    case SB_SHAPE_CYLINDER:
        status = sb_mesh_cylinder(body->center, body->radius, body->height, chord_error * spacing, one, error);
        break;
    case SB_SHAPE_PLANE:
        status = sb_mesh_plane(body->center, body->normal, body->width, body->length, one, error);
        break;
    case SB_SHAPE_BASIN:
        status = sb_mesh_basin(body->min, body->max, one, error);
        break;
    }
    if (status != SB_OK) {
        sb_free(one);
        return status;
    }
    *meshes = one;
    *count = 1;
    return SB_OK;
}

/* Merges all meshes into the first. */
static sb_status merge(sb_mesh *meshes, size_t *count, sb_error *error)
{
    if (*count <= 1) return SB_OK;
    sb_mesh whole;
    size_t vertices = 0, triangles = 0, dropped = 0, turned = 0;
    double rounded = 0;
    for (size_t i = 0; i < *count; ++i) {
        vertices += meshes[i].vertex_count;
        triangles += meshes[i].triangle_count;
        dropped += meshes[i].dropped;
        turned += meshes[i].turned;
        rounded = fmax(rounded, meshes[i].rounded);
    }
    if (vertices >= UINT32_MAX) return sb_fail(error, SB_BAD_INPUT, "%zu vertices, expected fewer than 2^32", vertices);
    sb_status status = sb_mesh_alloc(&whole, vertices, triangles, error);
    if (status != SB_OK) return status;
    whole.dropped = dropped;
    whole.turned = turned;
    whole.rounded = rounded;
    vertices = triangles = 0;
    for (size_t i = 0; i < *count; ++i) {
        sb_mesh *part = &meshes[i];
        memcpy(whole.vertices + vertices, part->vertices, part->vertex_count * sizeof *part->vertices);
        for (size_t j = 0; j < part->triangle_count; ++j)
            for (int k = 0; k < 3; ++k) whole.triangles[triangles + j][k] = (uint32_t)vertices + part->triangles[j][k];
        vertices += part->vertex_count;
        triangles += part->triangle_count;
        sb_mesh_free(part);
    }
    meshes[0] = whole;
    *count = 1;
    return SB_OK;
}

/* Orients the meshes of mesh files. Shapes and grids are made with the right orientation. */
static sb_status orient(const sb_body *body, sb_mesh *meshes, size_t count, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; i < count && body->shape == SB_SHAPE_MESH && status == SB_OK; ++i)
        status = sb_mesh_orient(&meshes[i], body->role, error);
    return status;
}

static sb_status close_holes(const sb_body *body, sb_mesh *meshes, size_t count, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; i < count && body->shape == SB_SHAPE_MESH && status == SB_OK; ++i)
        status = sb_mesh_close(&meshes[i], error);
    return status;
}

/* Whether a mesh before `count` has the name. For a mesh whose own name was replaced: also whether any mesh of the
   file has it as its own name. */
static bool taken(const sb_mesh *meshes, size_t count, size_t all, bool replaced, const char *name)
{
    for (size_t i = 0; i < (replaced ? all : count); ++i)
        if ((i < count || !meshes[i].original[0]) && i != count && strcmp(meshes[i].name, name) == 0) return true;
    return false;
}

/* Names the meshes: those without a name get the body's, and repeated names get a number. Within a run of equal
   names, as tools write them, the numbers ascend. */
static void set_names(const sb_body *body, sb_mesh *meshes, size_t count)
{
    char last[SB_NAME_MAX] = "";
    size_t number = 2;
    for (size_t i = 0; i < count; ++i) {
        char wanted[SB_NAME_MAX];
        const bool replaced = body->split && meshes[i].original[0];
        memcpy(wanted, body->split && meshes[i].name[0] ? meshes[i].name : body->name, sizeof wanted);
        if (strcmp(wanted, last) != 0) number = 2;
        memcpy(last, wanted, sizeof last);
        memcpy(meshes[i].name, wanted, sizeof wanted);
        while (taken(meshes, i, count, replaced, meshes[i].name))
            snprintf(meshes[i].name, sizeof meshes[i].name, "%.*s-%zu", SB_NAME_MAX - 22, wanted, number++);
    }
}

/* Largest number of parts. Each part's name is compared with all others. */
enum { PARTS_MAX = 10000 };

static sb_status check_parts(const sb_body *body, size_t count, sb_error *error)
{
    if (!body->split || count <= PARTS_MAX) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s: %zu parts, expected at most %d in a body with split", body->file,
                   count, PARTS_MAX);
}

static sb_status from_body(const sb_body *body, double spacing, const box *within, sb_mesh **meshes, size_t *count,
                           sb_error *error)
{
    const bool from_file = body->shape == SB_SHAPE_MESH || body->shape == SB_SHAPE_GRID;
    sb_error reason = {0};
    sb_mesh *made = NULL;
    size_t made_count = 0;
    sb_status status = SB_OK;
    if (from_file && !body->file && body->file_count == 0)
        status = sb_fail(&reason, SB_BAD_INPUT, "it has no file, expected one");
    else if (from_file && !(isfinite(body->scale) && body->scale > 0))
        status = sb_fail(&reason, SB_BAD_INPUT, "scale %g, expected > 0", body->scale);
    if (status == SB_OK) status = make(body, spacing, within, &made, &made_count, &reason);
    if (status == SB_OK) status = check_parts(body, made_count, &reason);
    if (status == SB_OK) status = check_rounding(body, spacing, made, made_count, &reason);
    for (size_t i = 0; i < made_count; ++i) transform(body, &made[i]);
    /* Each solid part is oriented separately, since one part may be inside out. The parts of a terrain are oriented
       together, since the orientation of a single upright wall is unknown. */
    if (status == SB_OK && body->role == SB_ROLE_SOLID) status = orient(body, made, made_count, &reason);
    if (status == SB_OK && !body->split) status = merge(made, &made_count, &reason);
    if (status == SB_OK && body->role == SB_ROLE_SOLID) status = close_holes(body, made, made_count, &reason);
    if (status == SB_OK && body->role == SB_ROLE_TERRAIN) status = orient(body, made, made_count, &reason);
    if (status != SB_OK) {
        for (size_t i = 0; i < made_count; ++i) sb_mesh_free(&made[i]);
        sb_free(made);
        return sb_fail(error, status, "body \"%s\": %s", body->name, reason.text);
    }
    set_names(body, made, made_count);
    *meshes = made;
    *count = made_count;
    return SB_OK;
}

sb_status sb_mesh_from_body(const sb_body *body, double spacing, sb_mesh **meshes, size_t *count, sb_error *error)
{
    return from_body(body, spacing, NULL, meshes, count, error);
}

sb_status sb_mesh_from_body_within(const sb_body *body, double spacing, sb_vec3 min, sb_vec3 max, double margin,
                                   sb_mesh **meshes, size_t *count, sb_error *error)
{
    const box within = {min, max, margin};
    return from_body(body, spacing, &within, meshes, count, error);
}
