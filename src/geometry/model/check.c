/* Warns of faults of meshes, of plates and water that are too thin for the spacing, and of time steps that are too
   long. */
#include "geometry/model/parts.h"

#include <math.h>
#include <stdio.h>

enum { DEPTH_MIN = 4 };

/* In h/sqrt(g D). With steps of twice LONGEST_STEP a collapsing column has fallen an eighth less after 0.9 sqrt(D/g)
   than with short steps, and 2 % less with steps of LONGEST_STEP. With three times LONGEST_STEP it has fallen a
   quarter less, and some of it has passed a wall (tools/stress time-step). */
static const double LONGEST_STEP = 0.3, REFUSED_STEP = 0.6;

/* `cfl` of explicit steps. Still water by `preset: wen` gains no energy up to 0.8; with 0.9 it has eight times as much
   after 0.5 s, with 1 it compresses by 14 %. */
static const double LONGEST_EXPLICIT = 0.6;

/* In spacings: rounding errors of a mesh file's coordinates from this size on are reported. */
static const double ROUNDED = 0.01;

static sb_status check_mesh(const sb_model_body *body, sb_model *model, sb_error *error)
{
    const sb_mesh *mesh = &body->mesh;
    sb_status status = SB_OK;
    if (mesh->rounded > ROUNDED * model->spacing)
        status = sb_model_warn(
            model, error,
            "body \"%s\": its file's coordinates are so far from 0 that single precision rounds them by %.2g m "
            "(%.2g spacings): expected coordinates near 0 in the file, and the body moved by translate",
            body->name, mesh->rounded, mesh->rounded / model->spacing);
    if (mesh->dropped > 0 && status == SB_OK)
        status =
            sb_model_warn(model, error, "body \"%s\": %zu faces without area are left out", body->name, mesh->dropped);
    if (mesh->turned > 0 && status == SB_OK)
        status = sb_model_warn(model, error, "body \"%s\": %zu faces pointed away from the water and were reversed",
                               body->name, mesh->turned);
    if (mesh->closed > 0 && status == SB_OK)
        status =
            sb_model_warn(model, error, "body \"%s\": %zu holes of one triangle are closed", body->name, mesh->closed);
    if (body->role != SB_ROLE_SOLID || mesh->open_surface || status != SB_OK) return status;
    sb_mesh_report report;
    status = sb_mesh_diagnose(mesh, &report, error);
    if (report.open_edges > 0 && status == SB_OK)
        status = sb_model_warn(model, error,
                               "body \"%s\" is not watertight: %zu open edges, the first at (%g, "
                               "%g, %g); its inside is determined by the winding number",
                               body->name, report.open_edges, report.first_open_edge.x, report.first_open_edge.y,
                               report.first_open_edge.z);
    if (report.flipped_faces > 0 && status == SB_OK)
        status = sb_model_warn(model, error,
                               "body \"%s\": %zu faces are oriented opposite to their neighbours, "
                               "the first at (%g, %g, %g)",
                               body->name, report.flipped_faces, report.first_flipped_face.x,
                               report.first_flipped_face.y, report.first_flipped_face.z);
    if (report.doubled_faces > 0 && status == SB_OK)
        status = sb_model_warn(model, error, "body \"%s\": %zu faces duplicate other faces", body->name,
                               report.doubled_faces);
    return status;
}

/* DEPTH_SLACK (spacings) and DEPTH_SHARE (of the depth): difference between a law's still-water depth and the actual
   one that is accepted, because floors are uneven. NEAR (spacings): distance from a crest or a paddle's face within
   which the depth is measured. */
static const double DEPTH_SLACK = 1.5, DEPTH_SHARE = 0.05, NEAR = 3;

/* Water between two positions along a direction. */
typedef struct stretch {
    sb_vec3 along;
    double from, to;
    bool found;
    sb_vec3 lowest; /* place of the lowest water, if any is found */
} stretch;

static void find_lowest(void *context, const sb_water_piece *piece)
{
    stretch *s = context;
    for (size_t i = 0; i < piece->count; i++) {
        const sb_vec3 at = piece->position[i];
        const double where = sb_dot(at, s->along);
        if (!(where >= s->from && where <= s->to) || (s->found && at.z >= s->lowest.z)) continue;
        s->found = true;
        s->lowest = at;
    }
}

/* Level of the still water that has water at this place: of the sea, or of the box of water around it. */
static double level_around(const sb_scene *scene, sb_vec3 at)
{
    double level = scene->sea.present ? scene->sea.level : at.z;
    for (size_t i = 0; i < scene->box_count; i++) {
        const sb_fluid_box *box = &scene->boxes[i];
        const bool across = scene->dimensions == 2 || (at.y > box->min.y && at.y < box->max.y);
        if (at.x > box->min.x && at.x < box->max.x && across && at.z > box->min.z) level = fmax(level, box->level);
    }
    return level;
}

/* The scene, its solids and the model whose depths are checked. */
typedef struct checked {
    const sb_scene *scene;
    const sb_model_space *space;
    sb_model *model;
} checked;

static const char other_wave[] = "the wave will differ from the one requested";

/* Compares a depth with that of the still water within a stretch. effect: of a wrong depth. *level: of its surface, m,
   if there is water. May be NULL. */
static sb_status check_depth(const checked *c, const char *what, const char *name, const char *effect, double depth,
                             sb_vec3 along, double from, double to, double *level, sb_error *error)
{
    sb_model *model = c->model;
    stretch s = {.along = along, .from = from, .to = to};
    const sb_status status = sb_model_visit_water(c->space, model, find_lowest, &s, error);
    if (status != SB_OK) return status;
    const double surface = level_around(c->scene, s.lowest);
    const double there = s.found ? fmax(surface - s.lowest.z + 0.5 * model->spacing, 0) : 0;
    if (level && s.found) *level = surface;
    if (there == 0) return sb_model_warn(model, error, "%s%s: no water is there at t = 0", what, name);
    if (fabs(depth - there) <= fmax(DEPTH_SLACK * model->spacing, DEPTH_SHARE * there)) return SB_OK;
    return sb_model_warn(model, error, "%s%s: its depth is %g m, but the water there is about %.2g m deep: %s", what,
                         name, depth, there, effect);
}

/* Elevation of the crests of a wave maker, m: of a solitary wave its height. 0: it makes no waves, or they are not
   known. */
static double crest_of(const sb_wavemaker_parameters *law)
{
    sb_paddle paddle = {0};
    if (!law->kind->facts) return law->height;
    if (sb_paddle_create(law, &paddle, NULL) != SB_OK) return 0;
    const double crest = law->kind->facts(paddle.state)->crest;
    sb_paddle_destroy(&paddle);
    return crest;
}

/* Compares the crests of a wave maker with the tops of the domain and of its body. level: of the still water; top: of
   the boundary particles, which lie within the body. */
static sb_status check_crest(const checked *c, const sb_wavemaker_use *maker, double level, double top, sb_error *error)
{
    const double elevation = crest_of(&maker->law), crest = level + elevation;
    if (!(elevation > 0)) return SB_OK;
    if (crest > c->scene->domain.max.z)
        return sb_model_warn(
            c->model, error,
            "wave maker \"%s\": its crests at z = %.4g m are above the domain's top, %g m, where water "
            "leaves; expected a higher domain or lower waves",
            maker->name, crest, c->scene->domain.max.z);
    const double body_top = top + c->scene->numerics.wall_offset * c->model->spacing;
    if (crest <= body_top + 0.25 * c->model->spacing) return SB_OK;
    return sb_model_warn(
        c->model, error,
        "wave maker \"%s\": its crests at z = %.4g m are above the top of its body, about z = %.4g m, and "
        "pass over it; expected a higher body or lower waves",
        maker->name, crest, body_top);
}

/* Compares the still-water depth that waves and wave makers assume with the depth of the water there. */
static sb_status check_depths(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    const sb_initial_wave *wave = &scene->wave;
    const checked c = {scene, space, model};
    const sb_vec3 east = {1, 0, 0};
    const double near = NEAR * model->spacing;
    sb_status status = SB_OK;
    if (wave->kind == SB_INITIAL_SOLITARY && scene->sea.present)
        status = check_depth(&c, "water.wave", " at its crest", other_wave, wave->depth, east, wave->position - near,
                             wave->position + near, NULL, error);
    if ((wave->kind == SB_INITIAL_REGULAR || wave->kind == SB_INITIAL_COMPONENTS ||
         wave->kind == SB_INITIAL_STANDING) &&
        scene->sea.present)
        status =
            check_depth(&c, "water.wave", "", other_wave, wave->depth, east, model->min.x, model->max.x, NULL, error);
    if (status == SB_OK && wave->kind != SB_INITIAL_NONE && scene->sea.present &&
        scene->sea.level + sb_initial_crest(wave) > scene->domain.max.z)
        status = sb_model_warn(model, error,
                               "water.wave: its crest at z = %g m is above the domain's top, %g m: it is cut off",
                               scene->sea.level + sb_initial_crest(wave), scene->domain.max.z);
    for (size_t w = 0; w < scene->wavemaker_count && status == SB_OK; w++) {
        const sb_wavemaker_use *maker = &scene->wavemakers[w];
        double front = -(double)INFINITY, top = -(double)INFINITY;
        double level = scene->sea.present ? scene->sea.level : -(double)INFINITY;
        char name[SB_NAME_MAX + 4];
        for (size_t b = 0; b < model->body_count; b++)
            for (size_t i = model->bodies[b].begin; i < model->bodies[b].begin + model->bodies[b].count; i++)
                if (model->bodies[b].wavemaker == (int)w) {
                    top = fmax(top, model->wall_position[i].z);
                    if (sb_dot(model->wall_normal[i], maker->direction) > 0.9)
                        front = fmax(front, sb_dot(model->wall_position[i], maker->direction));
                }
        if (maker->law.depth > 0 && isfinite(front)) {
            snprintf(name, sizeof name, " \"%s\"", maker->name);
            const bool waves = maker->law.kind->needs & SB_WM_HEIGHT || maker->law.kind->needs & SB_WM_FILE;
            status = check_depth(&c, "wave maker", name, waves ? other_wave : "it absorbs less than predicted",
                                 maker->law.depth, maker->direction, front, front + near, &level, error);
        }
        if (status == SB_OK && isfinite(level)) status = check_crest(&c, maker, level, top, error);
    }
    return status;
}

static sb_status check_water(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    if (model->fluid_count == 0)
        return sb_model_warn(model, error,
                             "the scene has no water: expected a sea or a box of water at least half a "
                             "spacing (%g m) deep",
                             0.5 * model->spacing);
    sb_status status = SB_OK;
    if (model->still_depth < DEPTH_MIN * model->spacing)
        status = sb_model_warn(
            model, error, "the water is at most %g m deep, %.2g times the particle spacing: expected %d times or more",
            model->still_depth, model->still_depth / model->spacing, DEPTH_MIN);
    if (status == SB_OK) status = sb_model_warn_wave_sizes(scene, model, error);
    if (status == SB_OK) status = sb_model_warn_standing(scene, space, model, error);
    return status == SB_OK ? check_depths(scene, space, model, error) : status;
}

static sb_status check_steps(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const sb_numerics *n = &scene->numerics;
    if (n->solver == SB_SOLVER_WCSPH && n->cfl > LONGEST_EXPLICIT)
        return sb_model_warn(model, error,
                             "numerics.cfl %g: with solver wcsph, steps above 0.8 move and compress still water; "
                             "expected %g or less",
                             n->cfl, LONGEST_EXPLICIT);
    if (n->solver == SB_SOLVER_WCSPH || n->time_step_rule != SB_TIME_STEP_DEPTH) return SB_OK;
    if (n->time_step_factor <= LONGEST_STEP * (1 + 1e-6)) return SB_OK;
    if (n->time_step_factor > REFUSED_STEP * (1 + 1e-6))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.300s: numerics.time_step_factor %g: with steps this long water falls tens of per cent too "
                       "slowly and passes walls, expected %g or less under time_step_rule depth",
                       scene->path ? scene->path : "the scene", n->time_step_factor, REFUSED_STEP);
    return sb_model_warn(model, error,
                         "numerics.time_step_factor %g: with steps this long water falls several per cent too slowly, "
                         "expected %g or less",
                         n->time_step_factor, LONGEST_STEP);
}

/* The checks before those for which ranks with parts of the boundary particles need each other. */
static sb_status check_alone(const sb_scene *scene, const sb_model_space *space, sb_model *model, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t i = 0; i < model->body_count && status == SB_OK; ++i) {
        sb_model_body *body = model->bodies + i;
        if (body->mesh.triangle_count == 0) continue;
        status = check_mesh(body, model, error);
        if (status == SB_OK) status = sb_model_warn_ends(scene, body, model, error);
        if (status == SB_OK) status = sb_model_check_thickness(scene, space, model, body, error);
        if (status == SB_OK) status = sb_model_warn_place(scene, body, space->solid[i], model, error);
    }
    if (status == SB_OK) status = sb_model_warn_elsewhere(scene, model, error);
    if (status == SB_OK) status = sb_model_warn_thin(scene, model, error);
    if (status == SB_OK) status = sb_model_warn_shared(scene, model, error);
    if (status == SB_OK) status = sb_model_warn_ground(scene, space, model, error);
    if (status == SB_OK) status = sb_model_warn_open(scene, space, model, error);
    if (status == SB_OK) status = sb_model_warn_gauges(scene, space, model, error);
    if (status == SB_OK) status = sb_model_warn_probes(scene, space, model, error);
    if (status == SB_OK) status = sb_model_warn_reflections(scene, space, model, error);
    if (status == SB_OK) status = sb_model_warn_depths(scene, space, model, error);
    if (status == SB_OK) status = sb_model_warn_records(scene, space, model, error);
    return status;
}

sb_status sb_model_check(const sb_scene *scene, const sb_model_team *team, const sb_model_space *space,
                         sb_status before, sb_model *model, sb_error *error)
{
    sb_status status = before == SB_OK ? check_alone(scene, space, model, error) : before;
    status = sb_model_warn_clad(scene, team, status, model, error);
    status = sb_model_warn_gaps(scene, team, space, status, model, error);
    if (status == SB_OK) status = sb_model_warn_strokes(scene, space, model, error);
    if (status == SB_OK) status = check_steps(scene, model, error);
    if (status == SB_OK) status = sb_model_check_sound(scene, model, error);
    if (status == SB_OK) status = sb_model_check_paddles(scene, space, model, error);
    return status == SB_OK ? check_water(scene, space, model, error) : status;
}
