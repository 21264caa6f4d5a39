/* Creates the solids of all bodies of a model. The domain's walls are an open surface that faces inwards. */
#include "geometry/model/parts.h"

#include "base/memory.h"
#include "geometry/sampling/sample.h"
#include "geometry/solid/simplify.h"

#include <string.h>

/* Corners of each side, counter-clockwise seen from inside, in the order of sb_side. Bits 1, 2, 4 of a corner's
   number select max in x, y, z. */
static const uint32_t side_corners[SB_SIDES][4] = {{0, 2, 6, 4}, {1, 5, 7, 3}, {0, 4, 5, 1},
                                                   {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 6, 7, 5}};

static sb_status domain_mesh(const sb_scene *scene, sb_mesh *mesh, sb_error *error)
{
    sb_mesh made;
    sb_status status = sb_mesh_alloc(&made, 8, 12, error);
    if (status != SB_OK) return status;
    bool flat = scene->dimensions == 2;
    sb_vec3 min = scene->domain.min, max = scene->domain.max;
    for (uint32_t i = 0; i < 8; ++i)
        made.vertices[i] =
            sb_vec(i & 1 ? max.x : min.x, flat ? (i & 2 ? 1 : -1) : (i & 2 ? max.y : min.y), i & 4 ? max.z : min.z);
    made.triangle_count = 0;
    made.open_surface = true;
    for (int side = 0; side < SB_SIDES; ++side) {
        if (scene->domain.side[side] != SB_SIDE_WALL || (flat && (side == SB_Y_MIN || side == SB_Y_MAX))) continue;
        const uint32_t *c = side_corners[side];
        const uint32_t two[2][3] = {{c[0], c[1], c[2]}, {c[0], c[2], c[3]}};
        memcpy(made.triangles + made.triangle_count, two, sizeof two);
        made.triangle_count += 2;
    }
    *mesh = made;
    return SB_OK;
}

double sb_model_strip_width(const sb_model *model)
{
    return 1e3 * (model->max.x - model->min.x + model->max.z - model->min.z);
}

/* In spacings: how far the surface that water meets may be from a body's mesh. */
static const double SIMPLER = 0.1;

/* The mesh of a body that water meets, in space->simple if it is not the body's own. */
static sb_status choose_mesh(const sb_model *model, size_t index, sb_model_space *space, sb_error *error)
{
    const sb_model_body *body = model->bodies + index;
    sb_mesh *simple = space->simple + index;
    const sb_status status = sb_mesh_simplify(&body->mesh, body->role, SIMPLER * model->spacing, simple, error);
    space->mesh[index] = simple->triangle_count > 0 ? simple : &body->mesh;
    return status;
}

/* Sets the mesh for queries (the body's own, a simpler one, or its section) and creates its solid. */
static sb_status add_solid(const sb_model *model, const sb_scene *scene, size_t index, sb_model_space *space,
                           sb_error *error)
{
    const sb_model_body *body = model->bodies + index;
    sb_mesh walls = {.open_surface = true};
    bool is_domain = body->mesh.triangle_count == 0;
    if (is_domain && !scene) return SB_OK;
    sb_status status = is_domain ? domain_mesh(scene, &walls, error) : choose_mesh(model, index, space, error);
    if (status != SB_OK) return status;
    const sb_mesh *mesh = is_domain ? &walls : space->mesh[index];
    if (model->dimensions == 2) {
        status = sb_section_mesh(mesh, sb_model_strip_width(model), space->section + index, error);
        sb_mesh_free(&walls);
        space->mesh[index] = space->section + index;
    } else if (is_domain) {
        space->section[index] = walls;
        space->mesh[index] = space->section + index;
    }
    if (status == SB_OK && space->mesh[index]->triangle_count > 0)
        status = sb_solid_create(space->mesh[index], body->role, space->solid + index, error);
    return status;
}

sb_status sb_model_space_create(const sb_model *model, const sb_scene *domain_of, sb_model_space *space,
                                sb_error *error)
{
    sb_model_space made = {.count = model->body_count};
    made.section = sb_alloc(made.count, sizeof *made.section);
    made.simple = sb_alloc(made.count, sizeof *made.simple);
    made.mesh = sb_alloc(made.count, sizeof(void *));
    made.solid = sb_alloc(made.count, sizeof(void *));
    if (!made.section || !made.simple || !made.mesh || !made.solid) {
        sb_model_space_free(&made);
        return sb_fail_memory(error, "search trees");
    }
    sb_status status = SB_OK;
    for (size_t i = 0; i < made.count && status == SB_OK; ++i) status = add_solid(model, domain_of, i, &made, error);
    if (status != SB_OK) {
        sb_model_space_free(&made);
        return status;
    }
    *space = made;
    return SB_OK;
}

void sb_model_space_free(sb_model_space *space)
{
    for (size_t i = 0; i < space->count; ++i) {
        if (space->solid) sb_solid_destroy(space->solid[i]);
        if (space->section) sb_mesh_free(space->section + i);
        if (space->simple) sb_mesh_free(space->simple + i);
    }
    sb_fill_source_destroy(space->water);
    sb_free(space->section);
    sb_free(space->simple);
    sb_free(space->mesh);
    sb_free(space->solid);
    *space = (sb_model_space){0};
}
