/* Draws the water's surface: spheres, smoothing of their depths, shading. */
#include "render/water.h"

#include "render/colormap.h"
#include "render/sky.h"

#include <stddef.h>

enum { COLORS = 256 };

/* The spheres overlap, so that a calm surface has no holes. Smoothing removes their curvature. */
static const double radius_spacings = 0.8;
/* Depths that differ by more than this belong to different surfaces. */
static const double jump_spacings = 5;
static const double smooth_spacings = 1.1; /* standard deviation */

static const char sphere_vertex[] = "layout(location = 0) in vec3 position;\n"
                                    "layout(location = 1) in vec2 trait;\n" /* fraction of speed_max, crowd */
                                    "layout(location = 2) in vec3 normal;\n"
                                    "uniform mat4 view, projection;\n"
                                    "uniform float radius, pixels;\n" /* pixels: of one metre at one metre */
                                    "flat out vec4 drop;\n"           /* depth, radius, speed, crowd */
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

/* One direction of a Gaussian filter that does not smooth across jumps in depth. Its width is proportional to the size
   of a particle in the picture. The allowed change in depth is larger where the surface is seen at a small angle. */
static const char smooth_fragment[] = "out vec4 surface;\n"
                                      "uniform sampler2D source;\n"
                                      "uniform ivec2 step_by;\n"
                                      "uniform float spread, limit, longest;\n" /* px m; m; px */
                                      "void main() {\n"
                                      "  ivec2 p = ivec2(gl_FragCoord.xy);\n"
                                      "  vec4 c = texelFetch(source, p, 0);\n"
                                      "  float sigma = min(spread / c.x, longest);\n"
                                      "  float stride = max(1.0, sigma * 0.6);\n"
                                      "  float fall = -0.5 * stride * stride / (sigma * sigma);\n"
                                      "  float tilt = sqrt(max(1.0 - dot(c.zw, c.zw), 0.02)) / limit;\n"
                                      "  vec4 sum = c;\n"
                                      "  float total = 1.0;\n"
                                      "  for (int i = 1; i <= 3; i++) {\n"
                                      "    ivec2 by = step_by * int(float(i) * stride + 0.5);\n"
                                      "    float w = exp(fall * float(i * i));\n"
                                      "    vec4 a = texelFetch(source, p + by, 0), b = texelFetch(source, p - by, 0);\n"
                                      "    vec2 jump = (vec2(a.x, b.x) - c.x) * tilt;\n"
                                      "    vec2 keep = w * max(1.0 - jump * jump, 0.0);\n"
                                      "    sum += a * keep.x + b * keep.y;\n"
                                      "    total += keep.x + keep.y;\n"
                                      "  }\n"
                                      "  surface = sum / total;\n"
                                      "}\n";

static const char shade_fragment[] =
    "in vec2 screen;\n"
    "out vec4 color;\n"
    "uniform sampler2D source, colors;\n"
    "uniform vec3 right, up, back;\n"
    "uniform vec2 lens;\n"
    "void main() {\n"
    "  vec4 w = texelFetch(source, ivec2(gl_FragCoord.xy), 0);\n"
    "  vec3 here = vec3(screen * lens, -1.0) * w.x;\n"
    "  vec3 n = normalize(vec3(w.zw, sqrt(max(1.0 - dot(w.zw, w.zw), 0.0))));\n"
    "  n = right * n.x + up * n.y + back * n.z;\n"
    "  vec3 away = right * here.x + up * here.y + back * here.z;\n"

    "  vec3 place = eye + away;\n"
    "  vec3 to_eye = -normalize(away);\n"
    "  vec3 albedo = texture(colors, vec2(w.y, 0.5)).rgb;\n"
    "  albedo *= albedo;\n"
    "  float facing = clamp(dot(n, to_eye), 0.0, 1.0);\n"
    "  float f = 1.0 - facing; f *= f; f *= f * (1.0 - facing);\n"
    "  float gloss = 0.02 + 0.30 * f;\n"
    "  vec3 mirrored = reflect(-to_eye, n);\n"
    "  float spark = pow(max(dot(mirrored, sun), 0.0), 60.0);\n"
    "  mirrored.z = abs(mirrored.z);\n"
    "  vec3 c = mix(0.8 * lit(albedo, place, n), sky(mirrored), gloss) + spark * vec3(0.30, 0.28, "
    "0.24);\n"
    "  color = encoded(hazed(c, place));\n"
    "}\n";

static void make_colors(sb_water *water)
{
    unsigned char texels[COLORS][3];
    for (int i = 0; i < COLORS; i++) {
        float rgb[3];
        sb_colormap(i / (COLORS - 1.0), rgb);
        for (int c = 0; c < 3; c++) texels[i][c] = (unsigned char)(255 * rgb[c] + 0.5f);
    }
    water->colors = sb_texture_create(GL_RGB8, COLORS, 1, GL_RGB, GL_UNSIGNED_BYTE, texels, GL_LINEAR);
}

static sb_status make_surfaces(sb_water *water, GLuint depth_stencil, sb_error *error)
{
    sb_status status = SB_OK;
    sb_gl.GenFramebuffers(2, water->framebuffer);
    for (int i = 0; i < 2 && status == SB_OK; i++) {
        water->surface[i] =
            sb_texture_create(GL_RGBA32F, water->width, water->height, GL_RGBA, GL_FLOAT, NULL, GL_NEAREST);
        sb_gl.BindFramebuffer(GL_FRAMEBUFFER, water->framebuffer[i]);
        sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, water->surface[i], 0);
        sb_gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, GL_RENDERBUFFER, depth_stencil);
        status = sb_framebuffer_check("water", error);
    }
    return status;
}

static void make_arrays(sb_water *water)
{
    sb_gl.GenVertexArrays(1, &water->empty);
    sb_gl.GenVertexArrays(1, &water->points);
    sb_gl.GenBuffers(1, &water->buffer);
    sb_gl.BindVertexArray(water->points);
    sb_gl.BindBuffer(GL_ARRAY_BUFFER, water->buffer);
    const GLsizei stride = sizeof(sb_visible_point);
    sb_attribute(0, 3, GL_FLOAT, GL_FALSE, stride, 0);
    sb_attribute(1, 2, GL_UNSIGNED_SHORT, GL_TRUE, stride, offsetof(sb_visible_point, speed));
    sb_attribute(2, 3, GL_BYTE, GL_TRUE, stride, offsetof(sb_visible_point, normal));
    for (GLuint i = 0; i < 3; i++) sb_gl.EnableVertexAttribArray(i);
    sb_gl.BindVertexArray(0);
}

sb_status sb_water_create(int width, int height, GLuint depth_stencil, sb_water *water, sb_error *error)
{
    sb_water made = {.width = width, .height = height};
    sb_status status = sb_program_create("spheres", sphere_vertex, NULL, sphere_fragment, &made.sphere_program, error);
    if (status == SB_OK)
        status =
            sb_program_create("smoothing", sb_fullscreen_vertex, NULL, smooth_fragment, &made.smooth_program, error);
    if (status == SB_OK)
        status = sb_program_create("water", sb_fullscreen_vertex, sb_light_source, shade_fragment, &made.shade_program,
                                   error);
    if (status == SB_OK) status = make_surfaces(&made, depth_stencil, error);
    if (status != SB_OK) {
        sb_water_destroy(&made);
        return status;
    }
    make_colors(&made);
    make_arrays(&made);
    *water = made;
    return SB_OK;
}

void sb_water_destroy(sb_water *water)
{
    sb_gl.DeleteProgram(water->sphere_program);
    sb_gl.DeleteProgram(water->smooth_program);
    sb_gl.DeleteProgram(water->shade_program);
    sb_gl.DeleteVertexArrays(1, &water->points);
    sb_gl.DeleteVertexArrays(1, &water->empty);
    sb_gl.DeleteBuffers(1, &water->buffer);
    sb_gl.DeleteTextures(1, &water->colors);
    sb_gl.DeleteTextures(2, water->surface);
    sb_gl.DeleteFramebuffers(2, water->framebuffer);
    sb_visible_free(&water->visible);
    *water = (sb_water){0};
}

static void draw_spheres(sb_water *water, const sb_frame *frame, const sb_view *view)
{
    GLuint program = water->sphere_program;
    float matrix[16];
    sb_view_matrix(view, frame->origin, matrix);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, water->framebuffer[0]);
    sb_gl.ClearColor(0, 0, 0, 0);
    sb_gl.Clear(GL_COLOR_BUFFER_BIT);
    sb_gl.UseProgram(program);
    sb_uniform_mat4(program, "view", matrix);
    sb_uniform_mat4(program, "projection", view->projection);
    sb_uniform_float(program, "radius", radius_spacings * frame->spacing);
    sb_uniform_float(program, "pixels", water->height / (2 * view->tangent));
    sb_uniform_vec2(program, "clip", (double)-view->projection[10], (double)view->projection[14]);
    sb_gl.Enable(GL_PROGRAM_POINT_SIZE);
    sb_gl.Enable(GL_STENCIL_TEST);
    sb_gl.StencilFunc(GL_ALWAYS, 1, 1);
    sb_gl.StencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    sb_gl.Enable(GL_DEPTH_TEST);
    sb_gl.DepthFunc(GL_LESS);
    sb_gl.DepthMask(GL_TRUE);
    sb_gl.BindVertexArray(water->points);
    sb_gl.BindBuffer(GL_ARRAY_BUFFER, water->buffer);
    sb_gl.BufferData(GL_ARRAY_BUFFER, (GLsizeiptr)(water->visible.count * sizeof *water->visible.points),
                     water->visible.points, GL_STREAM_DRAW);
    sb_gl.DrawArrays(GL_POINTS, 0, (GLsizei)water->visible.count);
    sb_gl.Disable(GL_STENCIL_TEST);
}

static void smooth_surface(const sb_water *water, const sb_frame *frame, const sb_view *view)
{
    GLuint program = water->smooth_program;
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, water->framebuffer[1]);
    sb_gl.Clear(GL_COLOR_BUFFER_BIT);
    sb_gl.UseProgram(program);
    sb_uniform_float(program, "depth", 0);
    sb_uniform_float(program, "limit", jump_spacings * frame->spacing);
    sb_uniform_float(program, "longest", water->height / 24.0);
    double spread = smooth_spacings * frame->spacing * water->height / (2 * view->tangent);
    for (int pass = 0; pass < 2; pass++) {
        sb_gl.BindFramebuffer(GL_FRAMEBUFFER, water->framebuffer[1 - pass % 2]);
        sb_uniform_texture(program, "source", 0, water->surface[pass % 2]);
        sb_gl.Uniform2i(sb_gl.GetUniformLocation(program, "step_by"), pass % 2 == 0, pass % 2 == 1);
        sb_uniform_float(program, "spread", spread);
        sb_fullscreen_draw(water->empty);
    }
}

static void shade(const sb_water *water, const sb_light *light, const sb_view *view)
{
    GLuint program = water->shade_program;
    sb_gl.UseProgram(program);
    sb_light_bind(light, view, program);
    sb_sky_bind_rays(view, program);
    sb_uniform_float(program, "depth", 0);
    sb_uniform_texture(program, "source", 0, water->surface[0]);
    sb_uniform_texture(program, "colors", 1, water->colors);
    sb_fullscreen_draw(water->empty);
}

sb_status sb_water_draw_depth(sb_water *water, const sb_frame *frame, const sb_view *view, double speed_max,
                              sb_error *error)
{
    sb_status status = sb_visible_collect(&water->visible, frame, view, speed_max, error);
    if (status == SB_OK && water->visible.count > 0) draw_spheres(water, frame, view);
    return status;
}

void sb_water_shade(const sb_water *water, const sb_frame *frame, const sb_light *light, const sb_view *view,
                    GLuint target)
{
    if (water->visible.count > 0) {
        sb_gl.Enable(GL_STENCIL_TEST);
        sb_gl.StencilFunc(GL_EQUAL, 1, 1);
        sb_gl.StencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
        sb_gl.Disable(GL_DEPTH_TEST);
        sb_gl.DepthMask(GL_FALSE);
        smooth_surface(water, frame, view);
        sb_gl.BindFramebuffer(GL_FRAMEBUFFER, target);
        shade(water, light, view);
        sb_gl.Disable(GL_STENCIL_TEST);
        sb_gl.DepthMask(GL_TRUE);
    }
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, target);
}
