/* Draws a frame in passes: bodies, water, occlusion, picture, edges, overlay. */
#include "render/renderer.h"

#include "base/memory.h"
#include "render/compose.h"
#include "render/context.h"
#include "render/fields.h"
#include "render/marks.h"
#include "render/overlay.h"
#include "render/soften.h"

enum { SCENERIES = 4, TOPS_SIDE_MAX = 1024 };

struct sb_renderer {
    const sb_scene *scene;
    int width, height;
    sb_vec3 min, max; /* m, scene: domain and meshes */
    double depth;     /* m, from the still water to the lowest ground */
    sb_context *context;
    GLuint framebuffer, color, depth_buffer;
    sb_meshes *meshes;
    sb_light light;
    sb_scenery sceneries[SCENERIES]; /* of the cameras, each with its number modulo SCENERIES */
    sb_water water;
    sb_occlusion occlusion;
    sb_compose compose;
    sb_values values;
    sb_tops shade, reached;
    double reached_time;   /* s, of the frame that was added last */
    unsigned char *pixels; /* RGBA, rows from the bottom up as read from OpenGL */
};

static sb_status make_framebuffer(sb_renderer *r, sb_error *error)
{
    sb_gl.GenRenderbuffers(1, &r->depth_buffer);
    sb_gl.BindRenderbuffer(GL_RENDERBUFFER, r->depth_buffer);
    sb_gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, r->width, r->height);
    sb_gl.GenRenderbuffers(1, &r->color);
    sb_gl.BindRenderbuffer(GL_RENDERBUFFER, r->color);
    sb_gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, r->width, r->height);
    sb_gl.GenFramebuffers(1, &r->framebuffer);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, r->color);
    sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, r->depth_buffer);
    return sb_framebuffer_check("picture", error);
}

/* Widens the bounds by the water of a grid that frames contain beside that of the domain. */
static void add_grid(sb_renderer *r, const sb_scene *scene)
{
    const sb_offshore_settings *o = &scene->offshore;
    if (!sb_scene_nested(scene)) return;
    const double x_min = fmax(o->x_min, r->min.x - o->drawn), x_max = fmin(o->x_max, r->max.x + o->drawn);
    const double y_min = fmax(o->y_min, r->min.y - o->drawn), y_max = fmin(o->y_max, r->max.y + o->drawn);
    const bool flat = scene->dimensions == 2;
    r->min = sb_vec(fmin(r->min.x, x_min), flat ? r->min.y : fmin(r->min.y, y_min), r->min.z);
    r->max = sb_vec(fmax(r->max.x, x_max), flat ? r->max.y : fmax(r->max.y, y_max), r->max.z);
}

static void find_bounds(sb_renderer *r, const sb_model *model)
{
    r->min = model->min;
    r->max = model->max;
    add_grid(r, r->scene);
    for (size_t i = 0; i < model->body_count; i++)
        for (size_t v = 0; v < model->bodies[i].mesh.vertex_count; v++) {
            r->min = sb_min(r->min, model->bodies[i].mesh.vertices[v]);
            r->max = sb_max(r->max, model->bodies[i].mesh.vertices[v]);
        }
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

/* The context must be current. */
static sb_status make_passes(sb_renderer *r, const sb_model *model, sb_error *error)
{
    sb_status status = make_framebuffer(r, error);
    if (status == SB_OK) status = sb_meshes_create(model, model->min, &r->meshes, error);
    if (status == SB_OK)
        status = sb_light_create(r->meshes, model->min, r->min, r->max, sea_level(r->scene), &r->light, error);
    r->light.solid.floor_level = model->min.z;
    if (status == SB_OK) r->depth = depth_of(r);
    r->light.shadows = r->scene->render.shadows;
    if (status == SB_OK) status = sb_water_create(r->width, r->height, &r->water, error);
    if (status == SB_OK && r->scene->render.occlusion)
        status = sb_occlusion_create(r->width, r->height, &r->occlusion, error);
    if (status == SB_OK) status = sb_compose_create(&r->compose, error);
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
    r->reached_time = -HUGE_VAL;
    find_bounds(r, model);
    sb_status status = SB_OK;
    r->pixels = sb_alloc((size_t)width * (size_t)height, 4);
    if (!r->pixels) status = sb_fail_memory(error, "a picture");
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

/* Cells of about a spacing over the lit box, so that no water falls between them. */
static int tops_side(const sb_renderer *r, double spacing)
{
    const double side = r->light.size / (1.3 * spacing);
    return side < 8 ? 8 : side > TOPS_SIDE_MAX ? TOPS_SIDE_MAX : (int)side;
}

/* Adds a frame to the highest water so far. A frame that is earlier than the last one begins anew. */
static sb_status add_reached(sb_renderer *r, const sb_frame *frame, sb_error *error)
{
    if (frame->status.time == r->reached_time) return SB_OK;
    if (r->reached.side == 0) {
        const int side = tops_side(r, frame->spacing);
        sb_status status = sb_tops_create(side, &r->reached, error);
        if (status != SB_OK) return status;
    }
    if (frame->status.time < r->reached_time) sb_tops_clear(&r->reached);
    r->reached_time = frame->status.time;
    const sb_vec3 shift = sb_sub(frame->origin, r->light.origin);
    const float *corner = r->light.ground_frame, scale = corner[2];
    float map[3][4] = {{scale, 0, 0, ((float)shift.x - corner[0]) * scale},
                       {0, scale, 0, ((float)shift.y - corner[1]) * scale},
                       {0, 0, 1, (float)(shift.z + 0.5 * frame->spacing)}};
    sb_tops_add(&r->reached, frame, r->water.density, 0.14f, map);
    sb_tops_upload(&r->reached);
    return SB_OK;
}

/* Finds the water as seen from the sun; heights are towards the sun. */
static sb_status find_shade(sb_renderer *r, const sb_frame *frame, sb_error *error)
{
    if (r->shade.side == 0) {
        const int side = r->light.shadows ? tops_side(r, frame->spacing) : 1;
        sb_status status = sb_tops_create(side, &r->shade, error);
        if (status != SB_OK) return status;
    }
    if (!r->light.shadows) return SB_OK;
    const sb_vec3 shift = sb_sub(frame->origin, r->light.origin);
    const float *m = r->light.to_shadow, by[3] = {(float)shift.x, (float)shift.y, (float)shift.z};
    float map[3][4];
    for (int row = 0; row < 3; row++) {
        const float sign = row == 2 ? -1 : 1;
        for (int a = 0; a < 4; a++) map[row][a] = sign * m[4 * a + row];
        for (int a = 0; a < 3; a++) map[row][3] += map[row][a] * by[a];
    }
    sb_tops_clear(&r->shade);
    sb_tops_add(&r->shade, frame, r->water.density, 0.35f, map);
    sb_tops_upload(&r->shade);
    return SB_OK;
}

/* How much the height towards the sun changes per metre, in units of the shadow map. */
static double shadow_scale(const sb_light *light)
{
    const double x = (double)light->to_shadow[2], y = (double)light->to_shadow[6], z = (double)light->to_shadow[10];
    return sqrt(x * x + y * y + z * z);
}

static sb_status draw_maps(sb_renderer *r, const sb_frame *frame, sb_error *error)
{
    const sb_render_settings *settings = &r->scene->render;
    sb_status status = find_shade(r, frame, error);
    if (status == SB_OK && (settings->wet_ground || settings->greatest_depth)) status = add_reached(r, frame, error);
    return status;
}

static void draw_picture(sb_renderer *r, const sb_frame *frame, const sb_scenery *scenery, const sb_camera *camera,
                         const sb_view *view)
{
    const sb_render_settings *settings = &r->scene->render;
    /* A length for contact shadows and for colours of the ground that fits plants and flumes: 10 m at a plant. */
    const double unit = r->light.size / 175;
    if (settings->occlusion) sb_occlusion_draw(&r->occlusion, scenery, &r->water, view, 1.6 * unit);
    const sb_parts parts = {.scenery = scenery,
                            .water = &r->water,
                            .light = &r->light,
                            .occlusion = settings->occlusion ? &r->occlusion : NULL,
                            .shade = &r->shade,
                            .shade_bias = 1.5 * frame->spacing * shadow_scale(&r->light),
                            .reached = settings->wet_ground || settings->greatest_depth ? &r->reached : NULL,
                            .wet = settings->wet_ground,
                            .painted = settings->greatest_depth,
                            .depth_max = r->depth > 0 ? 0.5 * r->depth : 1,
                            .thickest = SB_SURFEL_THICKEST * frame->spacing,
                            .map = sb_fields[camera->color].map};
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    sb_gl.Viewport(0, 0, r->width, r->height);
    sb_compose_draw(&r->compose, &parts, view);
    sb_meshes_draw_edges(r->meshes, view, frame);
    sb_gl.ReadPixels(0, 0, r->width, r->height, GL_RGBA, GL_UNSIGNED_BYTE, r->pixels);
}

static sb_status draw_passes(sb_renderer *r, const sb_frame *frame, size_t number, const sb_view *view,
                             const double range[2], sb_error *error)
{
    const sb_camera *camera = &r->scene->render.cameras[number];
    sb_scenery *scenery = &r->sceneries[number % SCENERIES];
    sb_status status = SB_OK;
    if (scenery->width == 0) status = sb_scenery_create(r->width, r->height, scenery, error);
    if (status == SB_OK) status = sb_scenery_draw(scenery, r->meshes, &r->light, view, frame, error);
    if (status == SB_OK) status = sb_values_compute(&r->values, frame, camera->color, range[0], range[1], error);
    if (status == SB_OK)
        status = sb_water_draw(&r->water, frame, r->values.list, &r->light.solid, view, camera->style, error);
    if (status == SB_OK) status = draw_maps(r, frame, error);
    if (status != SB_OK) return status;
    draw_picture(r, frame, scenery, camera, view);
    GLenum code = sb_gl.GetError();
    if (code == GL_OUT_OF_MEMORY) return sb_fail_memory(error, "drawing");
    if (code != GL_NO_ERROR) return sb_fail(error, SB_FAILED, "OpenGL error 0x%04x while drawing", code);
    return SB_OK;
}

/* The values at the ends of the colour map. */
static void find_range(const sb_renderer *r, const sb_camera *camera, double range[2])
{
    range[0] = camera->color_min;
    range[1] = camera->color_max;
    if (range[0] != 0 || range[1] != 0) return;
    range[1] = sb_fields[camera->color].range(r->scene, r->depth, sqrt(r->scene->fluid.gravity * r->depth));
    if (!(range[1] > 0) || !isfinite(range[1])) range[1] = 1;
}

static sb_status draw_marks(const sb_renderer *r, const sb_frame *frame, size_t camera, const sb_view *view,
                            sb_vec3 target, const double range[2], sb_image *image, sb_error *error)
{
    const sb_render_settings *settings = &r->scene->render;
    const sb_field *field = &sb_fields[settings->cameras[camera].color];
    const sb_legend legend = {field->label, field->map, range[0], range[1]};
    sb_status status = sb_overlay_draw(image, r->scene->title, frame->status.time, &legend, error);
    if (status == SB_OK && settings->scale_bar) status = sb_marks_scale(image, view, target, error);
    if (status == SB_OK) status = sb_marks_north(image, view, target, settings->north, error);
    return status;
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
    sb_camera_key key = sb_camera_at(&settings->cameras[camera], frame->status.time);
    double margin = 2 * frame->spacing, range[2];
    sb_view view = sb_view_create(&key, (double)r->width / r->height, sb_sub(r->min, sb_vec(margin, margin, margin)),
                                  sb_add(r->max, sb_vec(margin, margin, margin)));
    find_range(r, &settings->cameras[camera], range);
    sb_status status = sb_image_resize(image, r->width, r->height, error);
    if (status == SB_OK) status = sb_context_enter(r->context, error);
    if (status != SB_OK) return status;
    status = draw_passes(r, frame, camera, &view, range, error);
    sb_context_leave(r->context);
    if (status != SB_OK) return status;
    sb_soften(r->pixels, image);
    return draw_marks(r, frame, camera, &view, key.target, range, image, error);
}

void sb_renderer_destroy(sb_renderer *renderer)
{
    sb_renderer *r = renderer;
    if (!r) return;
    if (r->context && sb_context_enter(r->context, NULL) == SB_OK) {
        sb_water_destroy(&r->water);
        sb_occlusion_destroy(&r->occlusion);
        sb_compose_destroy(&r->compose);
        sb_tops_destroy(&r->shade);
        sb_tops_destroy(&r->reached);
        for (int i = 0; i < SCENERIES; i++) sb_scenery_destroy(&r->sceneries[i]);
        sb_light_destroy(&r->light);
        sb_meshes_destroy(r->meshes);
        sb_gl.DeleteFramebuffers(1, &r->framebuffer);
        sb_gl.DeleteRenderbuffers(1, &r->color);
        sb_gl.DeleteRenderbuffers(1, &r->depth_buffer);
        sb_context_leave(r->context);
    }
    sb_context_destroy(r->context);
    sb_values_free(&r->values);
    sb_free(r->pixels);
    sb_free(r);
}
