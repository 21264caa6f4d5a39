/* Draws the water's surface, or its particles as spheres. */
#include "render/water/water.h"

#include "render/gl/context.h"

#include <stddef.h>

/* The spheres overlap, so that a calm surface has no holes. */
static const double radius_spacings = 0.8;

static const char sphere_vertex[] = "layout(location = 0) in vec3 position;\n"
                                    "layout(location = 1) in vec2 trait;\n" /* value, crowd */
                                    "layout(location = 2) in vec3 normal;\n"
                                    "uniform mat4 view, projection;\n"
                                    "uniform float radius, pixels;\n" /* pixels: of one metre at one metre */
                                    "flat out vec4 drop;\n"           /* depth, radius, value, crowd */
                                    "flat out vec3 slope;\n"
                                    "void main() {\n"
                                    "  vec4 e = view * vec4(position, 1.0);\n"
                                    "  gl_Position = projection * e;\n"
                                    "  drop = vec4(-e.z, radius * (0.45 + 0.55 * trait.y), trait);\n"
                                    "  slope = mat3(view) * normal;\n"
                                    "  gl_PointSize = clamp(2.0 * drop.y * pixels / drop.x, 1.5, 255.0);\n"
                                    "}\n";

/* The normal of a particle that is surrounded by others is the surface's; that of a single drop is the sphere's. */
static const char sphere_fragment[] =
    "flat in vec4 drop;\n"
    "flat in vec3 slope;\n"
    "uniform vec2 clip;\n" /* of the projection: ndc = clip.x + clip.y / depth */
    "out vec4 surface;\n"
    "void main() {\n"
    "  vec2 d = vec2(gl_PointCoord.x, 1.0 - gl_PointCoord.y) * 2.0 - 1.0;\n"
    "  float q = 1.0 - dot(d, d);\n"
    "  if (q < 0.0) discard;\n"
    "  float bulge = sqrt(q), z = drop.x - drop.y * bulge;\n"
    "  vec3 n = normalize(mix(vec3(d, bulge), vec3(slope.xy, max(slope.z, 0.05)), drop.w));\n"
    "  surface = vec4(z, drop.z, n.xy);\n"
    "  gl_FragDepth = 0.5 + 0.5 * (clip.x + clip.y / z);\n"
    "}\n";

static sb_status make_targets(sb_water *water, sb_error *error)
{
    const int width = water->width, height = water->height;
    water->surface = sb_texture_create(GL_RGBA32F, width, height, GL_RGBA, GL_FLOAT, NULL, GL_NEAREST);
    water->cover = sb_texture_create(GL_RGBA32F, width, height, GL_RGBA, GL_FLOAT, NULL, GL_NEAREST);
    sb_gl.GenRenderbuffers(1, &water->depth);
    sb_gl.BindRenderbuffer(GL_RENDERBUFFER, water->depth);
    sb_gl.RenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    sb_gl.GenFramebuffers(1, &water->framebuffer);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, water->framebuffer);
    sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, water->surface, 0);
    sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, water->depth);
    return sb_framebuffer_check("water", error);
}

static void make_arrays(sb_water *water)
{
    sb_gl.GenVertexArrays(1, &water->points);
    sb_gl.GenBuffers(1, &water->buffer);
    sb_gl.BindVertexArray(water->points);
    sb_gl.BindBuffer(GL_ARRAY_BUFFER, water->buffer);
    const GLsizei stride = sizeof(sb_visible_point);
    sb_attribute(0, 3, GL_FLOAT, GL_FALSE, stride, 0);
    sb_attribute(1, 2, GL_UNSIGNED_SHORT, GL_TRUE, stride, offsetof(sb_visible_point, value));
    sb_attribute(2, 3, GL_BYTE, GL_TRUE, stride, offsetof(sb_visible_point, normal));
    for (GLuint i = 0; i < 3; i++) sb_gl.EnableVertexAttribArray(i);
    sb_gl.BindVertexArray(0);
}

sb_status sb_water_create(int width, int height, sb_water *water, sb_error *error)
{
    sb_water made = {.width = width, .height = height};
    sb_status status = sb_splat_create(width, height, &made.splat, error);
    if (status == SB_OK)
        status = sb_program_create("spheres", sphere_vertex, NULL, sphere_fragment, &made.sphere_program, error);
    if (status == SB_OK) status = make_targets(&made, error);
    if (status != SB_OK) {
        sb_water_destroy(&made);
        return status;
    }
    make_arrays(&made);
    *water = made;
    return SB_OK;
}

void sb_water_destroy(sb_water *water)
{
    sb_gl.DeleteVertexArrays(1, &water->points);
    sb_gl.DeleteBuffers(1, &water->buffer);
    sb_gl.DeleteTextures(1, &water->surface);
    sb_gl.DeleteTextures(1, &water->cover);
    sb_gl.DeleteRenderbuffers(1, &water->depth);
    sb_gl.DeleteFramebuffers(1, &water->framebuffer);
    sb_visible_free(&water->visible);
    sb_surfels_free(&water->surfels);
    sb_splat_free(&water->splat);
    sb_sides_free(&water->sides);
    *water = (sb_water){0};
}

static void draw_spheres(const sb_water *water, const sb_frame *frame, const sb_view *view)
{
    GLuint program = water->sphere_program;
    float matrix[16];
    sb_view_matrix(view, frame->origin, matrix);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, water->framebuffer);
    sb_gl.Viewport(0, 0, water->width, water->height);
    sb_gl.DepthMask(GL_TRUE);
    sb_gl.ClearDepth(1);
    sb_gl.ClearColor(0, 0, 0, 0);
    sb_gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    sb_gl.UseProgram(program);
    sb_uniform_mat4(program, "view", matrix);
    sb_uniform_mat4(program, "projection", view->projection);
    sb_uniform_float(program, "radius", radius_spacings * frame->spacing);
    sb_uniform_float(program, "pixels", water->height / (2 * view->tangent));
    sb_uniform_vec2(program, "clip", (double)-view->projection[10], (double)view->projection[14]);
    sb_gl.Enable(GL_PROGRAM_POINT_SIZE);
    sb_gl.Enable(GL_DEPTH_TEST);
    sb_gl.DepthFunc(GL_LESS);
    sb_gl.BindVertexArray(water->points);
    sb_gl.BindBuffer(GL_ARRAY_BUFFER, water->buffer);
    sb_gl.BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(water->visible.count * sizeof *water->visible.points),
                     water->visible.points, GL_STREAM_DRAW);
    sb_gl.DrawArrays(GL_POINTS, 0, (GLsizei)water->visible.count);
}

static void upload(GLuint texture, const sb_splat *splat, const float *pixels)
{
    sb_gl.BindTexture(GL_TEXTURE_2D, texture);
    sb_gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, splat->width, splat->height, 0, GL_RGBA, GL_FLOAT, pixels);
}

sb_status sb_water_draw(sb_water *water, const sb_frame *frame, const float *values, const sb_ground *ground,
                        const sb_view *view, sb_water_style style, sb_error *error)
{
    const int threads = sb_context_threads();
    water->solid = style == SB_WATER_PARTICLES;
    water->density = water->solid ? &water->visible.density : &water->surfels.density;
    if (water->solid) {
        /* Water that continues beyond the sides would hide the spheres at these. */
        sb_ground open = ground ? *ground : (sb_ground){0};
        open.sided = false;
        sb_status status = sb_visible_collect(&water->visible, frame, values, &open, view, threads, error);
        if (status == SB_OK) draw_spheres(water, frame, view);
        return status;
    }
    sb_status status = sb_surfels_collect(&water->surfels, frame, values, ground, view, threads, error);
    if (status == SB_OK) status = sb_splat_draw(&water->splat, &water->surfels, view, frame->spacing, threads, error);
    if (status == SB_OK)
        status =
            sb_sides_draw(&water->sides, &water->splat, water->density, frame, values, ground, view, threads, error);
    if (status != SB_OK) return status;
    upload(water->surface, &water->splat, water->splat.surface);
    upload(water->cover, &water->splat, water->splat.cover);
    return SB_OK;
}
