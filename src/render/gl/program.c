/* Compiles shaders and wraps OpenGL calls. */
#include "render/gl/program.h"

#include "base/hash.h"
#include "render/gl/context.h"

#include <string.h>

static const char version[] = "#version 330 core\n";

const char sb_fullscreen_vertex[] = "out vec2 screen;\n"
                                    "uniform float depth;\n"
                                    "void main() {\n"
                                    "  screen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
                                    "  gl_Position = vec4(screen, depth, 1.0);\n"
                                    "}\n";

static sb_status compile(const char *name, GLenum stage, const char *common, const char *source, GLuint *shader,
                         sb_error *error)
{
    const char *parts[] = {version, common ? common : "", source};
    *shader = sb_gl.CreateShader(stage);
    sb_gl.ShaderSource(*shader, 3, parts, NULL);
    sb_gl.CompileShader(*shader);
    GLint good = 0;
    sb_gl.GetShaderiv(*shader, GL_COMPILE_STATUS, &good);
    if (good) return SB_OK;
    char text[400] = "";
    sb_gl.GetShaderInfoLog(*shader, sizeof text, NULL, text);
    return sb_fail(error, SB_FAILED, "shader %s: %s", name, text);
}

static uint64_t hash_of(const char *vertex, const char *common, const char *fragment)
{
    uint64_t hash = sb_hash(1, vertex, strlen(vertex));
    if (common) hash = sb_hash(hash, common, strlen(common));
    return sb_hash(hash, fragment, strlen(fragment));
}

static sb_status compile_program(const char *name, const char *vertex, const char *common, const char *fragment,
                                 GLuint *program, sb_error *error)
{
    GLuint shaders[2] = {0};
    GLuint made = 0;
    sb_status status = compile(name, GL_VERTEX_SHADER, NULL, vertex, &shaders[0], error);
    if (status == SB_OK) status = compile(name, GL_FRAGMENT_SHADER, common, fragment, &shaders[1], error);
    if (status != SB_OK) goto done;
    made = sb_gl.CreateProgram();
    sb_gl.AttachShader(made, shaders[0]);
    sb_gl.AttachShader(made, shaders[1]);
    sb_gl.LinkProgram(made);
    GLint good = 0;
    sb_gl.GetProgramiv(made, GL_LINK_STATUS, &good);
    if (!good) {
        char text[400] = "";
        sb_gl.GetProgramInfoLog(made, sizeof text, NULL, text);
        status = sb_fail(error, SB_FAILED, "shader %s: %s", name, text);
        goto done;
    }
    *program = made;
    made = 0;
done:
    sb_gl.DeleteShader(shaders[0]);
    sb_gl.DeleteShader(shaders[1]);
    sb_gl.DeleteProgram(made);
    return status;
}

sb_status sb_program_create(const char *name, const char *vertex, const char *common, const char *fragment,
                            GLuint *program, sb_error *error)
{
    sb_programs *known = sb_context_programs();
    const uint64_t source = hash_of(vertex, common, fragment);
    for (size_t k = 0; k < known->count; k++)
        if (known->source[k] == source) {
            *program = known->program[k];
            return SB_OK;
        }
    if (known->count == SB_PROGRAMS_MAX)
        return sb_fail(error, SB_FAILED, "shader %s: expected at most %d programs", name, SB_PROGRAMS_MAX);
    const sb_status status = compile_program(name, vertex, common, fragment, program, error);
    if (status != SB_OK) return status;
    known->source[known->count] = source;
    known->program[known->count++] = *program;
    return SB_OK;
}

void sb_uniform_float(GLuint program, const char *name, double value)
{
    sb_gl.Uniform1f(sb_gl.GetUniformLocation(program, name), (float)value);
}

void sb_uniform_vec2(GLuint program, const char *name, double x, double y)
{
    sb_gl.Uniform2f(sb_gl.GetUniformLocation(program, name), (float)x, (float)y);
}

void sb_uniform_vec3(GLuint program, const char *name, const float *value)
{
    sb_gl.Uniform3fv(sb_gl.GetUniformLocation(program, name), 1, value);
}

void sb_uniform_vec4(GLuint program, const char *name, double x, double y, double z, double w)
{
    sb_gl.Uniform4f(sb_gl.GetUniformLocation(program, name), (float)x, (float)y, (float)z, (float)w);
}

void sb_uniform_mat4(GLuint program, const char *name, const float *value)
{
    sb_gl.UniformMatrix4fv(sb_gl.GetUniformLocation(program, name), 1, GL_FALSE, value);
}

void sb_uniform_texture(GLuint program, const char *name, int unit, GLuint texture)
{
    sb_gl.ActiveTexture((GLenum)(GL_TEXTURE0 + unit));
    sb_gl.BindTexture(GL_TEXTURE_2D, texture);
    sb_gl.Uniform1i(sb_gl.GetUniformLocation(program, name), unit);
}

void sb_fullscreen_draw(GLuint empty)
{
    sb_gl.BindVertexArray(empty);
    sb_gl.DrawArrays(GL_TRIANGLES, 0, 3);
}

GLuint sb_texture_create(GLenum internal, int width, int height, GLenum format, GLenum type, const void *pixels,
                         GLenum filter)
{
    GLuint texture = 0;
    sb_gl.GenTextures(1, &texture);
    sb_gl.BindTexture(GL_TEXTURE_2D, texture);
    sb_gl.TexImage2D(GL_TEXTURE_2D, 0, (GLint)internal, width, height, 0, format, type, pixels);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, (GLint)filter);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, (GLint)filter);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    sb_gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

sb_status sb_framebuffer_check(const char *name, sb_error *error)
{
    GLenum status = sb_gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return SB_OK;
    return sb_fail(error, SB_FAILED, "framebuffer %s: OpenGL status 0x%04x, expected complete", name, status);
}

void sb_attribute(GLuint slot, GLint size, GLenum type, GLboolean normalized, GLsizei stride, size_t offset)
{
    /* OpenGL expects the offset as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr) */
    sb_gl.VertexAttribPointer(slot, size, type, normalized, stride, (const void *)offset);
    sb_gl.EnableVertexAttribArray(slot);
}
