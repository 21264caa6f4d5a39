/* Computes ambient occlusion from the picture's depths at half resolution. */
#include "render/bodies/occlusion.h"

/* Samples on a spiral around each pixel, turned by a pattern of 4 x 4 pixels; the blur takes the mean of that pattern.
   A surface that is hit by a sample at the distance d hides the part max(0, cos) (1 - d^2 / radius^2). */
static const char fragment[] = "in vec2 screen;\n"
                               "out vec2 result;\n"
                               "uniform sampler2D normals, depths, water, water_cover;\n"
                               "uniform vec3 right, up, back;\n"
                               "uniform vec2 lens, clip;\n"
                               "uniform float radius, pixels, solid;\n"
                               "vec3 place(ivec2 p, out vec2 slope) {\n"
                               "  ivec2 size = textureSize(depths, 0);\n"
                               "  p = clamp(p, ivec2(0), size - 1);\n"
                               "  vec4 w = texelFetch(water, p, 0);\n"
                               "  float z = clip.y / (2.0 * texelFetch(depths, p, 0).x - 1.0 - clip.x);\n"
                               "  float cover = solid > 0.5 ? 1.0 : texelFetch(water_cover, p, 0).x;\n"
                               "  slope = vec2(2.0);\n"
                               "  if (w.x > 0.0 && w.x < z && cover > 0.5) { z = w.x; slope = w.zw; }\n"
                               "  vec2 at = (vec2(p) + 0.5) / vec2(size) * 2.0 - 1.0;\n"
                               "  return vec3(at * lens, -1.0) * z;\n"
                               "}\n"
                               "void main() {\n"
                               "  ivec2 p = 2 * ivec2(gl_FragCoord.xy);\n"
                               "  vec2 slope, unused;\n"
                               "  vec3 here = place(p, slope);\n"
                               "  float reach = radius * pixels / -here.z;\n"
                               "  result = vec2(1.0, -here.z);\n"
                               "  vec3 n;\n"
                               "  if (slope.x < 1.5) {\n"
                               "    n = vec3(slope, sqrt(max(1.0 - dot(slope, slope), 0.0)));\n"
                               "  } else {\n"
                               "    vec3 m = texelFetch(normals, p, 0).xyz;\n"
                               "    if (dot(m, m) < 0.5) return;\n"
                               "    n = vec3(dot(m, right), dot(m, up), dot(m, back));\n"
                               "  }\n"
                               "  if (reach < 2.0) return;\n"
                               "  reach = min(reach, 90.0);\n"
                               "  float turn = float((p.x / 2 & 3) * 4 + (p.y / 2 & 3)) * 0.3927, hidden = 0.0;\n"
                               "  for (int i = 0; i < 10; i++) {\n"
                               "    float angle = turn + float(i) * 2.4, far = reach * sqrt((float(i) + 0.5) / 10.0);\n"
                               "    vec3 v = place(p + ivec2(far * cos(angle), far * sin(angle)), unused) - here;\n"
                               "    float d = dot(v, v), near = max(1.0 - d / (radius * radius), 0.0);\n"
                               "    hidden += max(dot(v, n) * inversesqrt(d + 1e-12) - 0.12, 0.0) * near;\n"
                               "  }\n"
                               "  result.x = clamp(1.0 - 2.6 * hidden / 10.0, 0.15, 1.0);\n"
                               "}\n";

static const char blur_fragment[] = "out vec2 result;\n"
                                    "uniform sampler2D source;\n"
                                    "void main() {\n"
                                    "  ivec2 p = ivec2(gl_FragCoord.xy), last = textureSize(source, 0) - 1;\n"
                                    "  vec2 here = texelFetch(source, p, 0).xy;\n"
                                    "  float sum = 0.0, total = 0.0;\n"
                                    "  for (int j = -2; j < 2; j++)\n"
                                    "    for (int i = -2; i < 2; i++) {\n"
                                    "      ivec2 q = clamp(p + ivec2(i, j), ivec2(0), last);\n"
                                    "      vec2 s = texelFetch(source, q, 0).xy;\n"
                                    "      float w = max(1.0 - 20.0 * abs(s.y - here.y) / here.y, 0.001);\n"
                                    "      sum += w * s.x;\n"
                                    "      total += w;\n"
                                    "    }\n"
                                    "  result = vec2(sum / total, here.y);\n"
                                    "}\n";

sb_status sb_occlusion_create(int width, int height, sb_occlusion *occlusion, sb_error *error)
{
    sb_occlusion made = {.width = (width + 1) / 2, .height = (height + 1) / 2};
    sb_status status = sb_program_create("occlusion", sb_fullscreen_vertex, NULL, fragment, &made.program, error);
    if (status == SB_OK)
        status = sb_program_create("blur", sb_fullscreen_vertex, NULL, blur_fragment, &made.blur_program, error);
    sb_gl.GenVertexArrays(1, &made.empty);
    sb_gl.GenFramebuffers(2, made.framebuffer);
    for (int i = 0; i < 2 && status == SB_OK; i++) {
        made.texture[i] = sb_texture_create(GL_RG32F, made.width, made.height, GL_RG, GL_FLOAT, NULL, GL_LINEAR);
        sb_gl.BindFramebuffer(GL_FRAMEBUFFER, made.framebuffer[i]);
        sb_gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, made.texture[i], 0);
        status = sb_framebuffer_check("occlusion", error);
    }
    if (status == SB_OK)
        *occlusion = made;
    else
        sb_occlusion_destroy(&made);
    return status;
}

void sb_occlusion_destroy(sb_occlusion *occlusion)
{
    sb_gl.DeleteVertexArrays(1, &occlusion->empty);
    sb_gl.DeleteTextures(2, occlusion->texture);
    sb_gl.DeleteFramebuffers(2, occlusion->framebuffer);
    *occlusion = (sb_occlusion){0};
}

void sb_occlusion_draw(const sb_occlusion *occlusion, const sb_scenery *scenery, const sb_water *water,
                       const sb_view *view, double radius)
{
    GLuint program = occlusion->program;
    sb_gl.Viewport(0, 0, occlusion->width, occlusion->height);
    sb_gl.Disable(GL_DEPTH_TEST);
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, occlusion->framebuffer[1]);
    sb_gl.UseProgram(program);
    sb_light_bind_rays(view, program);
    sb_uniform_float(program, "depth", 0);
    sb_uniform_float(program, "radius", radius);
    sb_uniform_float(program, "pixels", scenery->height / (2 * view->tangent));
    sb_uniform_float(program, "solid", water->solid);
    sb_uniform_vec2(program, "clip", (double)-view->projection[10], (double)view->projection[14]);
    sb_uniform_texture(program, "normals", 0, scenery->normal);
    sb_uniform_texture(program, "depths", 1, scenery->depth);
    sb_uniform_texture(program, "water", 2, water->surface);
    sb_uniform_texture(program, "water_cover", 3, water->cover);
    sb_fullscreen_draw(occlusion->empty);
    program = occlusion->blur_program;
    sb_gl.BindFramebuffer(GL_FRAMEBUFFER, occlusion->framebuffer[0]);
    sb_gl.UseProgram(program);
    sb_uniform_float(program, "depth", 0);
    sb_uniform_texture(program, "source", 0, occlusion->texture[1]);
    sb_fullscreen_draw(occlusion->empty);
}
