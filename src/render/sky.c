/* Draws the background. */
#include "render/sky.h"

static const char fragment[] = "in vec2 screen;\n"
                               "out vec4 color;\n"
                               "uniform vec3 right, up, back;\n"
                               "uniform vec2 lens;\n"
                               "void main() {\n"
                               "  vec3 d = normalize(right * screen.x * lens.x + up * screen.y * lens.y - back);\n"
                               /* Ordered dithering hides the bands of a smooth gradient in 8 bits. */
                               "  ivec2 p = ivec2(gl_FragCoord.xy) & 3;\n"
                               "  float noise = float((p.x * 5 + p.y * 11 + (p.x ^ p.y) * 3) & 15) / 16.0 - 0.47;\n"
                               "  color = encoded(sky(d)) + noise / 255.0;\n"
                               "}\n";

sb_status sb_sky_create(sb_sky *sky, sb_error *error)
{
    sb_status status = sb_program_create("sky", sb_fullscreen_vertex, sb_light_source, fragment, &sky->program, error);
    if (status == SB_OK) sb_gl.GenVertexArrays(1, &sky->empty);
    return status;
}

void sb_sky_destroy(sb_sky *sky)
{
    sb_gl.DeleteProgram(sky->program);
    sb_gl.DeleteVertexArrays(1, &sky->empty);
    *sky = (sb_sky){0};
}

static void set_axis(GLuint program, const char *name, sb_vec3 axis)
{
    const float value[3] = {(float)axis.x, (float)axis.y, (float)axis.z};
    sb_uniform_vec3(program, name, value);
}

void sb_sky_bind_rays(const sb_view *view, GLuint program)
{
    set_axis(program, "right", view->right);
    set_axis(program, "up", view->up);
    set_axis(program, "back", view->back);
    sb_uniform_vec2(program, "lens", view->tangent * view->aspect, view->tangent);
}

void sb_sky_draw(const sb_sky *sky, const sb_light *light, const sb_view *view)
{
    sb_gl.UseProgram(sky->program);
    sb_light_bind(light, view, sky->program);
    sb_sky_bind_rays(view, sky->program);
    sb_uniform_float(sky->program, "depth", 1);
    sb_gl.Enable(GL_DEPTH_TEST);
    sb_gl.DepthFunc(GL_LEQUAL);
    sb_gl.DepthMask(GL_FALSE);
    sb_fullscreen_draw(sky->empty);
    sb_gl.DepthMask(GL_TRUE);
}
