/* Draws a frame in passes: water, faces, sky, edges, overlay. */
#include "render/renderer.h"

#include "base/memory.h"
#include "render/context.h"
#include "render/meshes.h"
#include "render/overlay.h"
#include "render/sky.h"
#include "render/soften.h"
#include "render/water.h"

struct sb_renderer {
    const sb_scene *scene;
    int width, height;
    sb_vec3 min, max; /* m, scene: domain and meshes */
    double speed_max; /* m/s, at the upper end of the colour map */
    sb_context *context;
    GLuint framebuffer, color, depth_stencil;
    sb_meshes *meshes;
    sb_light light;
    sb_sky sky;
    sb_water water;
    unsigned char *pixels; /* RGBA, rows from the bottom up as read from OpenGL */
};

static sb_status make_framebuffer(sb_renderer *r, sb_error *error)
{
    sb_gl.GenRenderbuffers(1, &r->depth_stencil);
    sb_gl.BindRenderbuffer(GL_RENDERBUFFER, r->depth_stencil);
    sb_gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH24_STENCIL8, r->width, r->height);
    sb_gl.GenRenderbuffers(1, &r->color);
    sb_gl.BindRenderbuffer(GL_RENDERBUFFER, r->color);
    sb_gl.RenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, r->width, r->height);
    sb_gl.GenFramebuffers(1, &r->framebuffer);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, r->color);
    sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, r->depth_stencil);
    return sb_framebuffer_check("picture", error);
}

static void find_bounds(sb_renderer *r, const sb_model *model)
{
    r->min = model->min;
    r->max = model->max;
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

/* The context must be current. */
static sb_status make_passes(sb_renderer *r, const sb_model *model, sb_error *error)
{
    sb_status status = make_framebuffer(r, error);
    if (status == SB_OK) status = sb_meshes_create(model, model->min, &r->meshes, error);
    if (status == SB_OK)
        status = sb_light_create(r->meshes, model->min, r->min, r->max, sea_level(r->scene), &r->light, error);
    if (status == SB_OK) status = sb_sky_create(&r->sky, error);
    if (status == SB_OK) status = sb_water_create(r->width, r->height, r->depth_stencil, &r->water, error);
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
    r->speed_max = scene->render.speed_max > 0 ? scene->render.speed_max : 2 * sb_model_wave_speed(scene, model);
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

static sb_status draw_passes(sb_renderer *r, const sb_frame *frame, const sb_view *view, sb_error *error)
{
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    sb_gl.Viewport(0, 0, r->width, r->height);
    sb_gl.Disable(GL_STENCIL_TEST);
    sb_gl.DepthMask(GL_TRUE);
    sb_gl.ClearDepth(1);
    sb_gl.ClearStencil(0);
    sb_gl.Clear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    /* The water is drawn first, so that the ground beneath it is not shaded. */
    sb_status status = sb_water_draw_depth(&r->water, frame, view, r->speed_max, error);
    if (status != SB_OK) return status;
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, r->framebuffer);
    sb_gl.Enable(GL_STENCIL_TEST);
    sb_gl.StencilFunc(GL_ALWAYS, 0, 1);
    sb_gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    sb_meshes_draw_faces(r->meshes, &r->light, view, frame);
    sb_gl.Disable(GL_STENCIL_TEST);
    sb_sky_draw(&r->sky, &r->light, view);
    sb_water_shade(&r->water, frame, &r->light, view, r->framebuffer);
    sb_meshes_draw_edges(r->meshes, view, frame);
    sb_gl.ReadPixels(0, 0, r->width, r->height, GL_RGBA, GL_UNSIGNED_BYTE, r->pixels);
    GLenum code = sb_gl.GetError();
    if (code == GL_OUT_OF_MEMORY) return sb_fail_memory(error, "drawing");
    if (code != GL_NO_ERROR) return sb_fail(error, SB_FAILED, "OpenGL error 0x%04x while drawing", code);
    return SB_OK;
}

sb_status sb_renderer_draw(sb_renderer *renderer, const sb_frame *frame, size_t camera, sb_image *image,
                           sb_error *error)
{
    sb_renderer *r = renderer;
    const sb_render_settings *settings = &r->scene->render;
    if (camera >= settings->camera_count || settings->cameras[camera].key_count == 0)
        return sb_fail(error, SB_BAD_INPUT, "render: camera %zu of %zu, expected one with keys", camera,
                       settings->camera_count);
    sb_camera_key key = sb_camera_at(&settings->cameras[camera], frame->status.time);
    double margin = 2 * frame->spacing;
    sb_view view = sb_view_create(&key, (double)r->width / r->height, sb_sub(r->min, sb_vec(margin, margin, margin)),
                                  sb_add(r->max, sb_vec(margin, margin, margin)));
    sb_status status = sb_image_resize(image, r->width, r->height, error);
    if (status == SB_OK) status = sb_context_enter(r->context, error);
    if (status != SB_OK) return status;
    status = draw_passes(r, frame, &view, error);
    sb_context_leave(r->context);
    if (status != SB_OK) return status;
    sb_soften(r->pixels, image);
    return sb_overlay_draw(image, r->scene->title, frame->status.time, r->speed_max, error);
}

void sb_renderer_destroy(sb_renderer *renderer)
{
    sb_renderer *r = renderer;
    if (!r) return;
    if (r->context && sb_context_enter(r->context, NULL) == SB_OK) {
        sb_water_destroy(&r->water);
        sb_sky_destroy(&r->sky);
        sb_light_destroy(&r->light);
        sb_meshes_destroy(r->meshes);
        sb_gl.DeleteFramebuffers(1, &r->framebuffer);
        sb_gl.DeleteRenderbuffers(1, &r->color);
        sb_gl.DeleteRenderbuffers(1, &r->depth_stencil);
        sb_context_leave(r->context);
    }
    sb_context_destroy(r->context);
    sb_free(r->pixels);
    sb_free(r);
}
