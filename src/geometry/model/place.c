/* Warns of bodies that no water can reach, most often because the unit of a file is not the metre. */
#include "geometry/model/parts.h"

#include <stdio.h>

/* Usual units of files, in metres. */
static const double usual[] = {1e-3, 1, 1e-2, 0.0254, 0.3048, 1e3};

/* MANY: multiple of the domain's size above which a body is reported. In spacings: a body smaller than TINY is not
   represented; a body larger than RESOLVED is. */
static const double MANY = 100, TINY = 1, RESOLVED = 2;

/* A body whose size is within this factor of the domain's has the right unit: the nearest of the usual ones, the foot,
   would change it by 3.3. */
static const double ALIKE = 3;

typedef struct extent {
    sb_vec3 min, max;
} extent;

static sb_vec3 size_of(extent of)
{
    return sb_sub(of.max, of.min);
}

/* Returns the largest of its three sizes (two in 2D). */
static double largest(const sb_model *model, sb_vec3 size)
{
    return fmax(fmax(size.x, model->dimensions == 2 ? 0 : size.y), size.z);
}

static bool is_apart(const sb_model *model, extent of)
{
    const bool flat = model->dimensions == 2;
    return of.min.x >= model->max.x || of.max.x <= model->min.x || of.min.z >= model->max.z ||
           of.max.z <= model->min.z || (!flat && (of.min.y >= model->max.y || of.max.y <= model->min.y));
}

/* Whether the body would lie within the domain's range if its file were scaled by a further factor. */
static bool would_fit(const sb_model *model, const sb_body *from, extent of, double factor)
{
    const sb_vec3 raise = sb_vec(0, 0, from->shape == SB_SHAPE_GRID ? from->datum : 0);
    const sb_vec3 origin = sb_add(from->translate, raise);
    const extent scaled = {sb_madd(origin, factor, sb_sub(of.min, origin)),
                           sb_madd(origin, factor, sb_sub(of.max, origin))};
    const sb_vec3 size = size_of(scaled), room = sb_sub(model->max, model->min);
    return !is_apart(model, scaled) && largest(model, size) > RESOLVED * model->spacing && size.x <= room.x &&
           size.z <= room.z && (model->dimensions == 2 || size.y <= room.y);
}

/* Writes the scale that would bring the body into the domain, as the end of a warning; empty if none of the usual
   units does. */
static void advise(const sb_scene *scene, const sb_model *model, const sb_model_body *body, extent of, char *text,
                   size_t size)
{
    const sb_body *from = body->source < scene->body_count ? &scene->bodies[body->source] : NULL;
    text[0] = 0;
    if (!from || (from->shape != SB_SHAPE_MESH && from->shape != SB_SHAPE_GRID)) return;
    const double ratio = largest(model, size_of(of)) / largest(model, sb_sub(model->max, model->min));
    if (ratio < ALIKE && ratio > 1 / ALIKE) return;
    for (size_t i = 0; i < sizeof usual / sizeof *usual; ++i) {
        const double factor = usual[i] / from->scale;
        if (usual[i] == from->scale || !would_fit(model, from, of, factor)) continue;
        const sb_vec3 now = sb_scale(size_of(of), factor);
        snprintf(text, size, "; expected scale %g? Then it would be %g x %g x %g m, within the domain's range",
                 usual[i], now.x, now.y, now.z);
        return;
    }
}

static extent extent_of(const sb_mesh *mesh)
{
    extent of = {mesh->vertices[0], mesh->vertices[0]};
    for (size_t i = 1; i < mesh->vertex_count; ++i) {
        of.min = sb_min(of.min, mesh->vertices[i]);
        of.max = sb_max(of.max, mesh->vertices[i]);
    }
    return of;
}

/* Whether a body lies outside of the domain, where forces on it were expected or no part of it is left, and no scale of
   its file would change that. */
static bool is_elsewhere(const sb_scene *scene, const sb_model *model, const sb_model_body *body, extent of)
{
    char advice[160] = "";
    const bool sampled = sb_model_body_walls(model, (size_t)(body - model->bodies)) > 0;
    if (!is_apart(model, of) || (sampled && !body->report)) return false;
    advise(scene, model, body, of, advice, sizeof advice);
    return !advice[0];
}

sb_status sb_model_warn_elsewhere(const sb_scene *scene, sb_model *model, sb_error *error)
{
    char first[SB_NAME_MAX + 300] = "", others[700] = "";
    size_t count = 0, named = 0, length = 0;
    for (size_t i = 0; i < model->body_count; ++i) {
        const sb_model_body *body = model->bodies + i;
        if (body->mesh.triangle_count == 0) continue;
        const extent of = extent_of(&body->mesh);
        if (!is_elsewhere(scene, model, body, of)) continue;
        const sb_vec3 size = size_of(of);
        if (count++ == 0) {
            snprintf(first, sizeof first,
                     "body \"%s\" has no surface that water could reach: it is outside of the domain; it is "
                     "%g x %g x %g m, from (%g, %g, %g) to (%g, %g, %g)",
                     body->name, size.x, size.y, size.z, of.min.x, of.min.y, of.min.z, of.max.x, of.max.y, of.max.z);
        } else if (length + sizeof body->name + 32 < sizeof others) {
            length += (size_t)snprintf(others + length, sizeof others - length, "%s \"%s\"",
                                       length == 0 ? "; likewise" : ",", body->name);
            named++;
        }
    }
    if (count == 0) return SB_OK;
    if (count > named + 1) snprintf(others + length, sizeof others - length, " and %zu more", count - named - 1);
    return sb_model_warn(model, error, "%s%s", first, others);
}

sb_status sb_model_warn_place(const sb_scene *scene, const sb_model_body *body, const sb_solid *solid, sb_model *model,
                              sb_error *error)
{
    const sb_mesh *mesh = &body->mesh;
    const extent of = extent_of(mesh);
    char advice[160] = "";
    if (is_elsewhere(scene, model, body, of)) return SB_OK;
    const sb_vec3 size = size_of(of);
    const bool apart = is_apart(model, of), closed = body->role == SB_ROLE_SOLID && !mesh->open_surface;
    const bool large = closed && largest(model, size) > MANY * largest(model, sb_sub(model->max, model->min));
    const bool small = closed && largest(model, size) < TINY * model->spacing;
    if (apart || large || small) advise(scene, model, body, of, advice, sizeof advice);
    if (sb_model_body_walls(model, (size_t)(body - model->bodies)) == 0 || (apart && body->report))
        return sb_model_warn(model, error,
                             "body \"%s\" has no surface that water could reach: it is %s; it is %g x %g x %g m, "
                             "from (%g, %g, %g) to (%g, %g, %g)%s",
                             body->name,
                             apart    ? "outside of the domain"
                             : small  ? "smaller than the spacing"
                             : !solid ? "not cut by the plane y = 0"
                                      : "within other bodies, or larger than the domain",
                             size.x, size.y, size.z, of.min.x, of.min.y, of.min.z, of.max.x, of.max.y, of.max.z,
                             advice);
    if ((!large && !small) || (large && !advice[0])) return SB_OK;
    return sb_model_warn(model, error, "body \"%s\" is %g x %g x %g m, %s%s", body->name, size.x, size.y, size.z,
                         large ? "more than a hundred times the domain"
                               : "smaller than the spacing: it hardly affects the water",
                         advice);
}
