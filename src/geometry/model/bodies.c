/* Imports the bodies of a scene: meshes with unique names, colours, wave makers, moment points. */
#include "geometry/model/parts.h"

#include "base/memory.h"
#include "scene/name.h"

#include <stdio.h>
#include <string.h>

static const float solid_color[3] = {0.74F, 0.72F, 0.68F};
static const float terrain_color[3] = {0.60F, 0.54F, 0.42F};
static const float moving_color[3] = {0.80F, 0.52F, 0.25F};

/* Returns the index of the wave maker that moves the part by its own name, or else of the one that moves the whole
   body of the scene; -1: none. A wave maker moves a paddle, not its plates. */
static int find_wavemaker(const sb_scene *scene, const sb_body *body, const char *part)
{
    int whole = -1;
    for (size_t i = 0; i < scene->wavemaker_count; ++i) {
        if (body->split && !strcmp(scene->wavemakers[i].body, part)) return (int)i;
        if (whole < 0 && !strcmp(scene->wavemakers[i].body, body->name)) whole = (int)i;
    }
    return whole;
}

/* Returns the middle of the mesh's extent in x and y, at its lowest z. In 2D y is 0. */
static sb_vec3 footprint_center(const sb_mesh *mesh, int dimensions)
{
    sb_vec3 min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL), max = sb_scale(min, -1);
    for (size_t i = 0; i < mesh->vertex_count; ++i) {
        min = sb_min(min, mesh->vertices[i]);
        max = sb_max(max, mesh->vertices[i]);
    }
    return sb_vec(0.5 * (min.x + max.x), dimensions == 2 ? 0 : 0.5 * (min.y + max.y), min.z);
}

static bool name_taken(const sb_model *model, const char *name)
{
    for (size_t i = 0; i < model->body_count; ++i)
        if (!strcmp(model->bodies[i].name, name)) return true;
    return false;
}

/* Chooses the wanted name, or if it is used the first free one with "-2", "-3", ... appended. */
static void choose_name(const sb_model *model, const char *wanted, char name[SB_NAME_MAX])
{
    snprintf(name, SB_NAME_MAX, "%s", wanted);
    for (int n = 2; name_taken(model, name); ++n) snprintf(name, SB_NAME_MAX, "%.*s-%d", SB_NAME_MAX - 16, wanted, n);
}

static int add_body(sb_model *model, size_t *capacity, const char *wanted)
{
    if (sb_grow((void **)&model->bodies, capacity, model->body_count + 1, sizeof *model->bodies)) return -1;
    sb_model_body *body = model->bodies + model->body_count;
    *body = (sb_model_body){.wavemaker = -1, .source = SIZE_MAX};
    choose_name(model, wanted, body->name);
    ++model->body_count;
    return 0;
}

static void describe(const sb_scene *scene, const sb_body *from, sb_model_body *body)
{
    body->source = (size_t)(from - scene->bodies);
    body->role = from->role;
    body->report = from->report;
    body->wavemaker = find_wavemaker(scene, from, body->name);
    body->moment_point = from->has_moment_point ? from->moment_point : footprint_center(&body->mesh, scene->dimensions);
    const float *color = from->role == SB_ROLE_TERRAIN ? terrain_color
                         : body->wavemaker >= 0        ? moving_color
                                                       : solid_color;
    memcpy(body->color, from->color[0] < 0 ? color : from->color, sizeof body->color);
}

/* In spacings: largest distance of a body from the domain. Beyond it rounding distorts nearby parts of the mesh as
   well. */
static const double FARTHEST = 1e8;

static sb_status check_extent(const sb_scene *scene, const sb_model_body *body, sb_error *error)
{
    const double most = FARTHEST * scene->resolution;
    for (size_t i = 0; i < body->mesh.vertex_count; ++i) {
        const sb_vec3 at = body->mesh.vertices[i];
        const sb_vec3 out = sb_max(sb_sub(scene->domain.min, at), sb_sub(at, scene->domain.max));
        const double far = fmax(out.x, fmax(scene->dimensions == 2 ? 0 : out.y, out.z));
        if (!sb_isfinite(at) || !(far <= most))
            return sb_fail(
                error, SB_BAD_INPUT,
                "body \"%s\" extends to (%g, %g, %g) m: expected at most %g m, 1e8 spacings, from the "
                "domain%s",
                body->name, at.x, at.y, at.z, most,
                body->mesh.node_count > 0 ? "; does the file state the value of its missing heights (nodata)?" : "");
    }
    return SB_OK;
}

/* Refuses a terrain grid that is smaller than a spacing, such as one in degrees that is read as metres. */
static sb_status check_grid(const sb_scene *scene, const sb_model_body *body, sb_error *error)
{
    sb_vec3 min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL), max = sb_vec(-HUGE_VAL, -HUGE_VAL, -HUGE_VAL);
    for (size_t i = 0; i < body->mesh.vertex_count; ++i) {
        min = sb_min(min, body->mesh.vertices[i]);
        max = sb_max(max, body->mesh.vertices[i]);
    }
    const sb_vec3 size = sb_sub(max, min);
    if (body->mesh.node_count == 0 || !(fmax(size.x, size.y) < scene->resolution)) return SB_OK;
    return sb_fail(
        error, SB_BAD_INPUT,
        "body \"%s\": its grid is %.3g m x %.3g m large, at (%.9g, %.9g), less than a spacing of %g m, expected "
        "metres; if the file has degrees, give crs: EPSG:4326, and as origin the place that becomes (0, 0)",
        body->name, size.x, size.y, min.x, min.y, scene->resolution);
}

/* A part with the name of another body of the scene would take over that body's rows and wave maker. */
static sb_status check_name(const sb_scene *scene, const sb_body *from, const char *part, sb_error *error)
{
    for (size_t i = 0; i < scene->body_count && from->split; ++i)
        if (scene->bodies + i != from && !strcmp(scene->bodies[i].name, part))
            return sb_fail(
                error, SB_BAD_INPUT,
                "body \"%s\": %.200s has a part named \"%s\", which is also the name of another body of the scene: "
                "expected different names",
                from->name, from->file ? from->file : "it", part);
    return SB_OK;
}

/* Plates are named "paddle", "paddle-2", ..., by choose_name. */
static sb_status check_plate_name(const sb_scene *scene, const sb_body *from, size_t plate, sb_error *error)
{
    char name[SB_NAME_MAX + 24];
    snprintf(name, sizeof name, "%s-%zu", from->name, plate + 1);
    for (size_t i = 0; i < scene->body_count && plate > 0; ++i)
        if (!strcmp(scene->bodies[i].name, name))
            return sb_fail(error, SB_BAD_INPUT,
                           "%.300s: body \"%s\": part %zu of the paddle \"%s\" has this name, expected another name",
                           scene->path ? scene->path : "the scene", name, plate + 1, from->name);
    return SB_OK;
}

/* Warns once per file how many part names contain characters that a body's name may not have, with examples of their
   replacements. */
static sb_status warn_names(const sb_body *from, const sb_mesh *meshes, size_t count, sb_model *model, sb_error *error)
{
    enum { SHOWN = 4 };
    char list[600] = "", original[100];
    size_t replaced = 0, used = 0;
    for (size_t i = 0; i < count && from->split; ++i) {
        if (!meshes[i].original[0]) continue;
        sb_name_escape(meshes[i].original, original, sizeof original);
        if (replaced++ < SHOWN)
            used += (size_t)snprintf(list + used, sizeof list - used, "%s \"%s\" becomes \"%s\"", used ? "," : "",
                                     original, meshes[i].name);
    }
    if (replaced == 0) return SB_OK;
    return sb_model_warn(
        model, error,
        "body \"%s\": %zu part names contain characters other than letters, digits, _ . and -, which are "
        "replaced by _:%s%s",
        from->name, replaced, list, replaced > SHOWN ? ", ..." : "");
}

/* Adds the meshes of one body of the scene, each as a body of the model. shape: the body, or a push-plate of it. */
static sb_status add_meshes(const sb_scene *scene, const sb_body *from, const sb_body *shape, sb_model *model,
                            size_t *capacity, sb_error *error)
{
    sb_mesh *meshes = NULL;
    size_t count = 0;
    /* Solids are searched for, and terrain may have to continue, as far as the support radius beyond the domain. */
    const double margin = 4 * scene->numerics.support * scene->resolution;
    sb_status status = sb_mesh_from_body_within(shape, scene->resolution, scene->domain.min, scene->domain.max, margin,
                                                &meshes, &count, error);
    if (status != SB_OK) return status;
    status = warn_names(from, meshes, count, model, error);
    for (size_t i = 0; i < count && status == SB_OK; ++i) {
        status = check_name(scene, from, meshes[i].name, error);
        if (status != SB_OK) break;
        if (add_body(model, capacity, meshes[i].name[0] ? meshes[i].name : from->name)) {
            status = sb_fail_memory(error, "bodies");
            break;
        }
        sb_model_body *body = model->bodies + model->body_count - 1;
        body->mesh = meshes[i];
        meshes[i] = (sb_mesh){.open_surface = false};
        describe(scene, from, body);
        status = check_extent(scene, body, error);
        if (status == SB_OK) status = check_grid(scene, body, error);
    }
    for (size_t i = 0; i < count; ++i) sb_mesh_free(meshes + i);
    sb_free(meshes);
    return status;
}

/* Adds a body of the scene; of a paddle that is divided, its plates. */
static sb_status add_parts(const sb_scene *scene, const sb_body *from, sb_model *model, size_t *capacity,
                           sb_error *error)
{
    const int maker = find_wavemaker(scene, from, from->name);
    sb_plate_row row = {0};
    if (maker < 0 || sb_scene_plates(scene, &scene->wavemakers[maker], &row) == 0)
        return add_meshes(scene, from, from, model, capacity, error);
    const size_t first = model->body_count;
    sb_status status = SB_OK;
    for (size_t k = 0; k < row.count && status == SB_OK; ++k) {
        const sb_body part = sb_model_plate(from, &row, k);
        status = check_plate_name(scene, from, k, error);
        if (status == SB_OK) status = add_meshes(scene, from, &part, model, capacity, error);
    }
    sb_vec3 middle = sb_add(sb_scale(sb_add(from->min, from->max), 0.5), from->translate);
    middle.z = from->min.z + from->translate.z;
    if (from->has_moment_point) middle = from->moment_point;
    for (size_t k = 0; k < row.count && status == SB_OK; ++k) {
        sb_model_body *body = &model->bodies[first + k];
        body->plate = k;
        body->plates = row.count;
        body->report = from->report && k == 0;
        body->moment_point = middle;
        if (row.axis == 2) { /* the motion grows from the hinge to the still level, and beyond */
            const double above = ((double)k + 0.5) * (row.to - row.from) / (double)row.count;
            body->held = 1 - above / (scene->sea.level - row.from);
        }
    }
    return status;
}

static bool has_walls(const sb_scene *scene)
{
    for (int side = 0; side < SB_SIDES; ++side)
        if (scene->domain.side[side] == SB_SIDE_WALL &&
            (scene->dimensions == 3 || (side != SB_Y_MIN && side != SB_Y_MAX)))
            return true;
    return false;
}

static sb_status check_wavemakers(const sb_scene *scene, const sb_model *model, sb_error *error)
{
    for (size_t i = 0; i < scene->wavemaker_count; ++i) {
        bool used = false;
        for (size_t b = 0; b < model->body_count; ++b) used = used || model->bodies[b].wavemaker == (int)i;
        if (!used)
            return sb_fail(error, SB_BAD_INPUT,
                           "wave maker \"%s\": body \"%s\" is not among the bodies: expected the "
                           "name of one",
                           scene->wavemakers[i].name, scene->wavemakers[i].body);
    }
    return SB_OK;
}

sb_status sb_model_import_bodies(const sb_scene *scene, sb_model *model, sb_error *error)
{
    sb_model made = {.min = scene->domain.min,
                     .max = scene->domain.max,
                     .dimensions = scene->dimensions,
                     .spacing = scene->resolution};
    size_t capacity = 0;
    sb_status status = SB_OK;
    for (size_t i = 0; i < scene->body_count && status == SB_OK; ++i)
        status = add_parts(scene, scene->bodies + i, &made, &capacity, error);
    if (status == SB_OK) status = check_wavemakers(scene, &made, error);
    if (status == SB_OK) status = sb_model_end_terrain(scene, &made, error);
    if (status == SB_OK && has_walls(scene)) {
        if (add_body(&made, &capacity, "domain")) {
            status = sb_fail_memory(error, "bodies");
        } else {
            sb_model_body *body = made.bodies + made.body_count - 1;
            sb_vec3 middle = sb_scale(sb_add(made.min, made.max), 0.5);
            body->moment_point = sb_vec(middle.x, middle.y, made.min.z);
            memcpy(body->color, solid_color, sizeof body->color);
        }
    }
    if (status != SB_OK) {
        sb_model_free(&made);
        return status;
    }
    *model = made;
    return SB_OK;
}
