#include "render/foam/foam_texture.h"

#include "base/memory.h"
#include "render/gl/context.h"

/* The surface is in memory already, unless OpenGL has drawn it as spheres. */
static sb_status read_ground(sb_foam_texture *foam, sb_scenery *scenery, const sb_water *water, sb_foam_ground *ground,
                             sb_error *error)
{
    const int width = water->width, height = water->height;
    const size_t pixels = (size_t)width * (size_t)height;
    *ground = (sb_foam_ground){.width = width, .height = height, .surface = water->splat.surface};
    ground->bodies = sb_scenery_depths(scenery);
    if (!ground->bodies || (water->solid && sb_grow((void **)&foam->surface, &foam->surface_capacity, pixels,
                                                    4 * sizeof *foam->surface) != 0))
        return sb_fail_memory(error, "the foam of a picture");
    if (!water->solid) return SB_OK;
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, water->framebuffer);
    sb_gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_FLOAT, foam->surface);
    ground->surface = foam->surface;
    return SB_OK;
}

sb_status sb_foam_texture_draw(sb_foam_texture *foam, const sb_frame *frame, sb_scenery *scenery, const sb_water *water,
                               const sb_view *view, sb_error *error)
{
    sb_foam_ground ground;
    foam->drawn = frame->foam.count > 0;
    if (!foam->drawn) return SB_OK;
    sb_status status = read_ground(foam, scenery, water, &ground, error);
    if (status == SB_OK) status = sb_foam_draw(&foam->layer, frame, view, &ground, sb_context_threads(), error);
    if (status != SB_OK) return status;
    if (!foam->texture)
        foam->texture = sb_texture_create(GL_RGBA32F, water->width, water->height, GL_RGBA, GL_FLOAT, NULL, GL_NEAREST);
    sb_gl.BindTexture(GL_TEXTURE_2D, foam->texture);
    sb_gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, water->width, water->height, 0, GL_RGBA, GL_FLOAT,
                     foam->layer.pixels);
    return SB_OK;
}

void sb_foam_texture_destroy(sb_foam_texture *foam)
{
    if (foam->texture) sb_gl.DeleteTextures(1, &foam->texture);
    sb_free(foam->surface);
    sb_foam_layer_free(&foam->layer);
    *foam = (sb_foam_texture){0};
}
