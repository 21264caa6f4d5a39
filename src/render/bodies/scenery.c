/* Keeps the picture of the solid bodies. */
#include "render/bodies/scenery.h"

#include "base/memory.h"

#include <string.h>

sb_status sb_scenery_create(int width, int height, sb_scenery *scenery, sb_error *error)
{
    static const GLenum targets[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    sb_scenery made = {.width = width, .height = height};
    made.color = sb_texture_create(GL_RGBA8, width, height, GL_RGBA, GL_UNSIGNED_BYTE, NULL, GL_NEAREST);
    made.normal = sb_texture_create(GL_RGBA16F, width, height, GL_RGBA, GL_FLOAT, NULL, GL_NEAREST);
    made.depth =
        sb_texture_create(GL_DEPTH_COMPONENT24, width, height, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT, NULL, GL_NEAREST);
    sb_gl.GenFramebuffers(1, &made.framebuffer);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, made.framebuffer);
    sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, made.color, 0);
    sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, GL_TEXTURE_2D, made.normal, 0);
    sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, made.depth, 0);
    sb_gl.DrawBuffers(2, targets);
    sb_status status = sb_framebuffer_check("bodies", error);
    if (status == SB_OK)
        *scenery = made;
    else
        sb_scenery_destroy(&made);
    return status;
}

void sb_scenery_destroy(sb_scenery *scenery)
{
    sb_gl.DeleteTextures(1, &scenery->color);
    sb_gl.DeleteTextures(1, &scenery->normal);
    sb_gl.DeleteTextures(1, &scenery->depth);
    sb_gl.DeleteFramebuffers(1, &scenery->framebuffer);
    sb_free(scenery->displacements);
    sb_free(scenery->values);
    *scenery = (sb_scenery){0};
}

static bool same_view(const sb_view *a, const sb_view *b)
{
    return memcmp(&a->eye, &b->eye, sizeof a->eye) == 0 && memcmp(&a->right, &b->right, sizeof a->right) == 0 &&
           memcmp(&a->up, &b->up, sizeof a->up) == 0 && memcmp(&a->back, &b->back, sizeof a->back) == 0 &&
           memcmp(a->projection, b->projection, sizeof a->projection) == 0 && a->cuts == b->cuts &&
           memcmp(&a->cut_normal, &b->cut_normal, sizeof a->cut_normal) == 0 && !(a->cut_at != b->cut_at);
}

static bool is_current(const sb_scenery *scenery, const sb_view *view, const sb_frame *frame)
{
    if (!scenery->drawn || scenery->body_count != frame->body_count || !same_view(&scenery->view, view)) return false;
    for (size_t i = 0; i < frame->body_count; i++)
        if (memcmp(&scenery->displacements[i], &frame->bodies[i].displacement, sizeof(sb_vec3)) != 0) return false;
    return true;
}

sb_status sb_scenery_draw(sb_scenery *scenery, const sb_meshes *meshes, const sb_light *light, const sb_view *view,
                          const sb_frame *frame, sb_error *error)
{
    if (is_current(scenery, view, frame)) return SB_OK;
    if (sb_grow((void **)&scenery->displacements, &scenery->body_capacity, frame->body_count, sizeof(sb_vec3)) != 0)
        return sb_fail_memory(error, "the bodies of a picture");
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, scenery->framebuffer);
    sb_gl.Viewport(0, 0, scenery->width, scenery->height);
    sb_gl.DepthMask(GL_TRUE);
    sb_gl.ClearDepth(1);
    sb_gl.ClearColor(0, 0, 0, 0);
    sb_gl.Clear(GL_DEPTH_BUFFER_BIT | GL_COLOR_BUFFER_BIT);
    sb_meshes_draw_faces(meshes, light, view, frame);
    for (size_t i = 0; i < frame->body_count; i++) scenery->displacements[i] = frame->bodies[i].displacement;
    scenery->body_count = frame->body_count;
    scenery->view = *view;
    scenery->drawn = true;
    scenery->read = false;
    return SB_OK;
}

const float *sb_scenery_depths(sb_scenery *scenery)
{
    const size_t pixels = (size_t)scenery->width * (size_t)scenery->height;
    if (!scenery->values) scenery->values = sb_alloc_untouched(pixels, sizeof *scenery->values);
    if (!scenery->values || scenery->read) return scenery->values;
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, scenery->framebuffer);
    sb_gl.ReadPixels(0, 0, scenery->width, scenery->height, GL_DEPTH_COMPONENT, GL_FLOAT, scenery->values);
    scenery->read = true;
    return scenery->values;
}
