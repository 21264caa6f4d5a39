/* Draws a frame in passes: bodies, water, occlusion, picture, edges, overlay. */
#include "render/renderer.h"

#include "base/memory.h"
#include "render/bodies/face_loads.h"
#include "render/camera/bounds.h"
#include "render/compose.h"
#include "render/foam/foam_texture.h"
#include "render/gl/context.h"
#include "render/image/soften.h"
#include "render/kinds.h"
#include "render/overlay/captions.h"
#include "render/water/fields.h"
#include "render/water/overhead.h"

enum { SCENERIES = 4 };

struct sb_renderer {
    const sb_scene *scene;
    int width, height;
    sb_vec3 min, max; /* m, scene: domain and meshes */
    double depth;     /* m, from the still water to the lowest ground */
    sb_context *context;
    GLuint framebuffer, color, kind_depth; /* of the picture, with the depths of kinds.h */
    GLuint edges;                          /* a framebuffer of the same colours and the depths of a scenery */
    size_t kind_capacity;
    float *kinds; /* per pixel, as in kinds.h */
    sb_meshes *meshes;
    sb_light light;
    sb_scenery sceneries[SCENERIES]; /* of the cameras, each with its number modulo SCENERIES */
    sb_water water;
    sb_foam_texture foam;
    sb_occlusion occlusion;
    sb_compose compose;
    sb_values values;
    sb_overhead overhead;
    sb_reached reached;    /* unless it shares another one */
    sb_face_loads loads;   /* empty unless the scene shows them */
    sb_slicer slicer;      /* empty unless a camera has a slice */
    unsigned char *pixels; /* RGBA, rows from the bottom up as read from OpenGL */
};

static sb_status make_framebuffer(sb_renderer *r, sb_error *error)
{
    r->kind_depth =
        sb_texture_create(GL_DEPTH_COMPONENT32F, r->width, r->height, GL_DEPTH_COMPONENT, GL_FLOAT, NULL, GL_NEAREST);
    sb_gl.GenRenderbuffers(1, &r->color);
    sb_gl.BindRenderbuffer(GL_RENDERBUFFER, r->color);
    sb_gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, r->width, r->height);
    sb_gl.GenFramebuffers(1, &r->framebuffer);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, r->color);
    sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, r->kind_depth, 0);
    sb_gl.GenFramebuffers(1, &r->edges);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->edges);
    sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, r->color);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    return sb_framebuffer_check("picture", error);
}

static double sea_level(const sb_scene *scene)
{
    double level = scene->sea.present ? scene->sea.level : scene->domain.min.z;
    for (size_t i = 0; i < scene->box_count && !scene->sea.present; i++)
        level = scene->boxes[i].level > level ? scene->boxes[i].level : level;
    return level;
}

/* The depth from what is known with and without the water of the start: the model of stored frames has bodies only. */
static double depth_of(const sb_renderer *r)
{
    const sb_ground *ground = &r->light.solid;
    double lowest = HUGE_VAL;
    for (size_t i = 0; i < (size_t)ground->side * (size_t)ground->side; i++)
        lowest = fmin(lowest, (double)ground->height[i]);
    lowest = fmax(lowest + ground->origin.z, ground->floor_level);
    return fmax(r->light.sea_level - lowest, r->scene->resolution);
}

static bool is_sliced(const sb_camera *camera)
{
    return sb_norm(camera->slice.normal) > 0;
}

static sb_status make_slicer(sb_renderer *r, const sb_model *model, sb_error *error)
{
    for (size_t c = 0; c < r->scene->render.camera_count; c++)
        if (is_sliced(&r->scene->render.cameras[c])) return sb_slicer_create(model, &r->slicer, error);
    return SB_OK;
}

/* Frames with water of a grid have it beyond the domain's sides. */
static void set_sides(sb_ground *ground, const sb_scene *scene, const sb_model *model)
{
    ground->floor_level = model->min.z;
    static const double never = 1e9; /* m: a scene of two dimensions does not end along y */
    const bool flat = scene->dimensions == 2;
    ground->sided = !sb_scene_nested(scene);
    ground->side_min[0] = model->min.x;
    ground->side_min[1] = flat ? -never : model->min.y;
    ground->side_max[0] = model->max.x;
    ground->side_max[1] = flat ? never : model->max.y;
}

/* The context must be current. */
static sb_status make_passes(sb_renderer *r, const sb_model *model, sb_error *error)
{
    sb_status status = make_framebuffer(r, error);
    if (status == SB_OK) status = sb_meshes_create(model, model->min, &r->meshes, error);
    if (status == SB_OK)
        status = sb_light_create(r->meshes, model->min, r->min, r->max, sea_level(r->scene), &r->light, error);
    set_sides(&r->light.solid, r->scene, model);
    if (status == SB_OK) r->depth = depth_of(r);
    r->light.shadows = r->scene->render.shadows;
    r->overhead.flat = r->scene->dimensions == 2;
    if (status == SB_OK) status = sb_water_create(r->width, r->height, &r->water, error);
    if (status == SB_OK && r->scene->render.occlusion)
        status = sb_occlusion_create(r->width, r->height, &r->occlusion, error);
    const sb_render_settings *settings = &r->scene->render;
    const sb_effects effects = {.foam = r->scene->foam.enabled,
                                .shadows = settings->shadows,
                                .occlusion = settings->occlusion,
                                .reached = sb_reached_shown(r->scene)};
    if (status == SB_OK) status = sb_compose_create(&effects, &r->compose, error);
    return status;
}

sb_status sb_renderer_create(const sb_scene *scene, const sb_model *model, sb_renderer **renderer, sb_error *error)
{
    int width = scene->render.width, height = scene->render.height;
    if (width < 1 || height < 1 || width > SB_IMAGE_SIDE_MAX || height > SB_IMAGE_SIDE_MAX)
        return sb_fail(error, SB_BAD_INPUT, "render: a picture of %d x %d px, expected 1 to %d on each side", width,
                       height, SB_IMAGE_SIDE_MAX);
    sb_renderer *r = sb_alloc(1, sizeof *r);
    if (!r) return sb_fail_memory(error, "the renderer");
    r->scene = scene;
    r->width = width;
    r->height = height;
    sb_bounds_find(scene, model, &r->min, &r->max);
    r->overhead.reached = &r->reached;
    sb_status status = SB_OK;
    r->pixels = sb_alloc((size_t)width * (size_t)height, 4);
    if (!r->pixels) status = sb_fail_memory(error, "a picture");
    if (status == SB_OK) status = make_slicer(r, model, error);
    if (status == SB_OK && scene->render.loads)
        status = sb_face_loads_create(model, scene->resolution, &r->loads, error);
    if (status == SB_OK) status = sb_context_create(&r->context, error);
    if (status == SB_OK) status = sb_context_enter(r->context, error);
    if (status == SB_OK) {
        status = make_passes(r, model, error);
        sb_context_leave(r->context);
    }
    if (status == SB_OK)
        *renderer = r;
    else
        sb_renderer_destroy(r);
    return status;
}

void sb_renderer_share(sb_renderer *renderer, sb_reached *reached)
{
    renderer->overhead.reached = reached;
    renderer->overhead.uploaded = 0;
}

/* The kinds of pixels, if the water is in memory; NULL: it is drawn by OpenGL. */
static sb_status find_kinds(sb_renderer *r, const sb_frame *frame, sb_scenery *scenery, const sb_view *view,
                            const float **kinds, sb_error *error)
{
    *kinds = NULL;
    if (r->water.solid) return SB_OK;
    const sb_kind_parts parts = {.splat = &r->water.splat,
                                 .bodies = sb_scenery_depths(scenery),
                                 .foam = r->foam.drawn ? r->foam.layer.pixels : NULL,
                                 .view = view,
                                 .clarity = sb_compose_clarity(&r->light),
                                 .thickest = SB_SURFEL_THICKEST * frame->spacing,
                                 .threads = sb_context_threads()};
    if (!parts.bodies ||
        sb_grow((void **)&r->kinds, &r->kind_capacity, (size_t)r->width * (size_t)r->height, sizeof *r->kinds) != 0)
        return sb_fail_memory(error, "a picture");
    sb_kinds_find(&parts, r->kinds);
    *kinds = r->kinds;
    return SB_OK;
}

static void draw_edges(const sb_renderer *r, const sb_frame *frame, const sb_scenery *scenery, const sb_view *view)
{
    const sb_edge_water water = {r->water.surface, r->water.cover, r->water.solid};
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->edges);
    sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, scenery->depth, 0);
    sb_meshes_draw_edges(r->meshes, view, frame, &water);
}

/* m, greatest depth at the upper end of its colours. */
static double paint_max(const sb_renderer *r)
{
    return r->depth > 0 ? 0.5 * r->depth : 1;
}

static void draw_picture(sb_renderer *r, const sb_frame *frame, const sb_scenery *scenery, const float *kinds,
                         const sb_camera *camera, const sb_view *view)
{
    const sb_render_settings *settings = &r->scene->render;
    /* A length for contact shadows and for colours of the ground that fits plants and flumes: 10 m at a plant. */
    const double unit = r->light.size / 175;
    if (settings->occlusion) sb_occlusion_draw(&r->occlusion, scenery, &r->water, view, 1.6 * unit);
    const sb_parts parts = {.scenery = scenery,
                            .water = &r->water,
                            .light = &r->light,
                            .occlusion = settings->occlusion ? &r->occlusion : NULL,
                            .kinds = kinds,
                            .kind_depth = r->kind_depth,
                            .foam = r->foam.drawn ? r->foam.texture : 0,
                            .shade = r->overhead.shade_map,
                            .shade_bias = 1.5 * frame->spacing * sb_overhead_scale(&r->light),
                            .reached = r->overhead.reached_map,
                            .wet = settings->wet_ground,
                            .painted = settings->greatest_depth,
                            .loaded = settings->loads,
                            .depth_max = paint_max(r),
                            .thickest = SB_SURFEL_THICKEST * frame->spacing,
                            .map = sb_fields[camera->color].map};
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    sb_gl.Viewport(0, 0, r->width, r->height);
    sb_compose_draw(&r->compose, &parts, view);
    draw_edges(r, frame, scenery, view);
    sb_gl.ReadPixels(0, 0, r->width, r->height, GL_RGBA, GL_UNSIGNED_BYTE, r->pixels);
}

static double load_max(const sb_renderer *r)
{
    const double chosen = r->scene->render.load_max;
    const double most = 0.1 * r->scene->fluid.density * r->scene->fluid.gravity * r->depth;
    return chosen > 0 ? chosen : most > 0 ? most : 1;
}

/* Gives the bodies the colours of their loads; they are then drawn again. */
static void tint(sb_renderer *r, const sb_frame *frame, sb_scenery *scenery)
{
    sb_face_loads_compute(&r->loads, frame, load_max(r));
    sb_meshes_recolor(r->meshes, r->loads.colors[0], 3 * r->loads.faces.all_count);
    scenery->drawn = false;
}

static sb_status draw_passes(sb_renderer *r, const sb_frame *frame, size_t number, const sb_view *view,
                             const double range[2], sb_error *error)
{
    const sb_camera *camera = &r->scene->render.cameras[number];
    sb_scenery *scenery = &r->sceneries[number % SCENERIES];
    sb_status status = SB_OK;
    if (scenery->width == 0) status = sb_scenery_create(r->width, r->height, scenery, error);
    if (status == SB_OK && r->scene->render.loads) tint(r, frame, scenery);
    if (status == SB_OK) status = sb_scenery_draw(scenery, r->meshes, &r->light, view, frame, error);
    if (status == SB_OK) status = sb_values_compute(&r->values, frame, camera->color, range[0], range[1], error);
    if (status == SB_OK)
        status = sb_water_draw(&r->water, frame, r->values.list, &r->light.solid, view, camera->style, error);
    if (status == SB_OK && r->scene->foam.enabled)
        status = sb_foam_texture_draw(&r->foam, frame, scenery, &r->water, view, error);
    const bool reaches = sb_reached_shown(r->scene);
    if (status == SB_OK) status = sb_overhead_update(&r->overhead, &r->light, frame, r->water.density, reaches, error);
    const float *kinds = NULL;
    if (status == SB_OK) status = find_kinds(r, frame, scenery, view, &kinds, error);
    if (status != SB_OK) return status;
    draw_picture(r, frame, scenery, kinds, camera, view);
    GLenum code = sb_gl.GetError();
    if (code == GL_OUT_OF_MEMORY) return sb_fail_memory(error, "drawing");
    if (code != GL_NO_ERROR) return sb_fail(error, SB_FAILED, "OpenGL error 0x%04x while drawing", code);
    return SB_OK;
}

/* The values at the ends of a colour map; low and high: those of the scene, both 0 for a range that fits it. */
static void find_range(const sb_renderer *r, sb_water_color color, double low, double high, double range[2])
{
    range[0] = low;
    range[1] = high;
    if (low != 0 || high != 0) return;
    range[1] = sb_fields[color].range(r->scene, r->depth, sqrt(r->scene->fluid.gravity * r->depth));
    if (!(range[1] > 0) || !isfinite(range[1])) range[1] = 1;
}

static sb_shot shot_of(const sb_renderer *r, const sb_frame *frame, size_t number)
{
    const sb_camera *camera = &r->scene->render.cameras[number];
    const double margin = 2 * frame->spacing;
    sb_shot shot = {.frame = frame, .camera = camera};
    shot.key = sb_camera_at(camera, frame->status.time);
    shot.min = sb_sub(r->min, sb_vec(margin, margin, margin));
    shot.max = sb_add(r->max, sb_vec(margin, margin, margin));
    shot.view = sb_view_create(&shot.key, (double)r->width / r->height, shot.min, shot.max);
    shot.load_max = r->scene->render.loads ? load_max(r) : 0;
    shot.paint_max = r->scene->render.greatest_depth ? paint_max(r) : 0;
    if (is_sliced(camera)) sb_slice_cut(&camera->slice, &shot.view);
    find_range(r, camera->color, camera->color_min, camera->color_max, shot.range);
    return shot;
}

/* Draws the slice of a camera over its picture, and the marks. */
static sb_status finish_slice(sb_renderer *r, const sb_shot *shot, sb_image *image, sb_error *error)
{
    const sb_slice *slice = &shot->camera->slice;
    sb_slice_job job = {.slice = slice,
                        .frame = shot->frame,
                        .view = &shot->view,
                        .density = slice->behind ? r->water.density : NULL,
                        .ground = &r->light.solid,
                        .min = shot->min,
                        .max = shot->max,
                        .vector_speed = slice->vector_speed,
                        .threads = sb_context_threads()};
    if (!(job.vector_speed > 0)) job.vector_speed = 0.5 * sqrt(r->scene->fluid.gravity * r->depth);
    if (!(job.vector_speed > 0)) job.vector_speed = 1;
    find_range(r, slice->field, slice->field_min, slice->field_max, job.range);
    sb_status status = sb_slicer_draw(&r->slicer, &job, image, error);
    return status == SB_OK ? sb_captions_draw(r->scene, shot, &job, image, error) : status;
}

sb_status sb_renderer_draw(sb_renderer *renderer, const sb_frame *frame, size_t camera, sb_image *image,
                           sb_error *error)
{
    sb_renderer *r = renderer;
    const sb_render_settings *settings = &r->scene->render;
    if (camera >= settings->camera_count || settings->cameras[camera].key_count == 0)
        return sb_fail(error, SB_BAD_INPUT, "render: camera %zu of %zu, expected one with keys", camera,
                       settings->camera_count);
    if (!(frame->spacing > 0)) return sb_fail(error, SB_BAD_INPUT, "frame: spacing %g m, expected > 0", frame->spacing);
    const sb_shot shot = shot_of(r, frame, camera);
    const bool sliced = is_sliced(shot.camera);
    sb_status status = sb_image_resize(image, r->width, r->height, error);
    if (status == SB_OK && (!sliced || shot.camera->slice.behind)) {
        status = sb_context_enter(r->context, error);
        if (status != SB_OK) return status;
        status = draw_passes(r, frame, camera, &shot.view, shot.range, error);
        sb_context_leave(r->context);
        if (status == SB_OK) sb_soften(r->pixels, image);
    }
    if (status != SB_OK) return status;
    return sliced ? finish_slice(r, &shot, image, error) : sb_captions_draw(r->scene, &shot, NULL, image, error);
}

void sb_renderer_destroy(sb_renderer *renderer)
{
    sb_renderer *r = renderer;
    if (!r) return;
    if (r->context && sb_context_enter(r->context, NULL) == SB_OK) {
        sb_water_destroy(&r->water);
        sb_foam_texture_destroy(&r->foam);
        sb_occlusion_destroy(&r->occlusion);
        sb_compose_destroy(&r->compose);
        sb_overhead_destroy(&r->overhead);
        for (int i = 0; i < SCENERIES; i++) sb_scenery_destroy(&r->sceneries[i]);
        sb_light_destroy(&r->light);
        sb_meshes_destroy(r->meshes);
        sb_gl.DeleteFramebuffers(1, &r->framebuffer);
        sb_gl.DeleteRenderbuffers(1, &r->color);
        sb_gl.DeleteFramebuffers(1, &r->edges);
        sb_gl.DeleteTextures(1, &r->kind_depth);
        sb_context_leave(r->context);
    }
    sb_context_destroy(r->context);
    sb_values_free(&r->values);
    sb_slicer_free(&r->slicer);
    sb_face_loads_free(&r->loads);
    sb_reached_free(&r->reached);
    sb_free(r->kinds);
    sb_free(r->pixels);
    sb_free(r);
}
