#include "render/program.h"

static const char version[] = "#version 330 core\n";

const char sb_fullscreen_vertex[] =
    "out vec2 screen;\n"
    "uniform float depth;\n"
    "void main() {\n"
    "  screen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);\n"
    "  gl_Position = vec4(screen, depth, 1.0);\n"
    "}\n";

static sb_status compile(const char *name, GLenum stage, const char *common, const char *source,
                         GLuint *shader, sb_error *error)
{
    const char *parts[] = {version, common ? common : "", source};
    *shader = glCreateShader(stage);
    glShaderSource(*shader, 3, parts, NULL);
    glCompileShader(*shader);
    GLint good = 0;
    glGetShaderiv(*shader, GL_COMPILE_STATUS, &good);
    if (good) return SB_OK;
    char text[400] = "";
    glGetShaderInfoLog(*shader, sizeof text, NULL, text);
    return sb_fail(error, SB_FAILED, "shader %s: %s", name, text);
}

sb_status sb_program_create(const char *name, const char *vertex, const char *common,
                            const char *fragment, GLuint *program, sb_error *error)
{
    GLuint shaders[2] = {0};
    GLuint made = 0;
    sb_status status = compile(name, GL_VERTEX_SHADER, NULL, vertex, &shaders[0], error);
    if (status == SB_OK)
        status = compile(name, GL_FRAGMENT_SHADER, common, fragment, &shaders[1], error);
    if (status != SB_OK) goto done;
    made = glCreateProgram();
    glAttachShader(made, shaders[0]);
    glAttachShader(made, shaders[1]);
    glLinkProgram(made);
    GLint good = 0;
    glGetProgramiv(made, GL_LINK_STATUS, &good);
    if (!good) {
        char text[400] = "";
        glGetProgramInfoLog(made, sizeof text, NULL, text);
        status = sb_fail(error, SB_FAILED, "shader %s: %s", name, text);
        goto done;
    }
    *program = made;
    made = 0;
done:
    glDeleteShader(shaders[0]);
    glDeleteShader(shaders[1]);
    glDeleteProgram(made);
    return status;
}

void sb_uniform_float(GLuint program, const char *name, double value)
{
    glUniform1f(glGetUniformLocation(program, name), (float)value);
}

void sb_uniform_int(GLuint program, const char *name, int value)
{
    glUniform1i(glGetUniformLocation(program, name), value);
}

void sb_uniform_vec2(GLuint program, const char *name, double x, double y)
{
    glUniform2f(glGetUniformLocation(program, name), (float)x, (float)y);
}

void sb_uniform_vec3(GLuint program, const char *name, const float *value)
{
    glUniform3fv(glGetUniformLocation(program, name), 1, value);
}

void sb_uniform_mat4(GLuint program, const char *name, const float *value)
{
    glUniformMatrix4fv(glGetUniformLocation(program, name), 1, GL_FALSE, value);
}

void sb_uniform_texture(GLuint program, const char *name, int unit, GLuint texture)
{
    glActiveTexture((GLenum)(GL_TEXTURE0 + unit));
    glBindTexture(GL_TEXTURE_2D, texture);
    glUniform1i(glGetUniformLocation(program, name), unit);
}

void sb_fullscreen_draw(GLuint empty)
{
    glBindVertexArray(empty);
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

GLuint sb_texture_create(GLenum internal, int width, int height, GLenum format, GLenum type,
                         const void *pixels, GLenum filter)
{
    GLuint texture = 0;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, (GLint)internal, width, height, 0, format, type, pixels);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, (GLint)filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, (GLint)filter);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

sb_status sb_framebuffer_check(const char *name, sb_error *error)
{
    GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status == GL_FRAMEBUFFER_COMPLETE) return SB_OK;
    return sb_fail(error, SB_FAILED, "framebuffer %s: OpenGL status 0x%04x, expected complete",
                   name, status);
}

void sb_attribute(GLuint slot, GLint size, GLenum type, GLboolean normalized, GLsizei stride,
                  size_t offset)
{
    /* OpenGL passes an offset in a pointer's place. NOLINTNEXTLINE(performance-no-int-to-ptr) */
    glVertexAttribPointer(slot, size, type, normalized, stride, (const void *)offset);
    glEnableVertexAttribArray(slot);
}
