/* Shader programs, textures and framebuffers: functions around OpenGL that all drawing passes share. */
#ifndef SB_RENDER_PROGRAM_H
#define SB_RENDER_PROGRAM_H

#include "base/status.h"
#include "render/gl/gl.h"

#include <stddef.h>

/* Compiles and links a program, or returns the one that the current context has of these sources. It belongs to the
   context: it must not be deleted. `common` (may be NULL) is inserted before the fragment source. SB_FAILED contains
   the beginning of the compiler's message. 0 is never a valid program. */
sb_status sb_program_create(const char *name, const char *vertex, const char *common, const char *fragment,
                            GLuint *program, sb_error *error);

/* Set uniforms of the program in use by name. Names that the compiler has optimised away are ignored. */
void sb_uniform_float(GLuint program, const char *name, double value);
void sb_uniform_vec2(GLuint program, const char *name, double x, double y);
void sb_uniform_vec3(GLuint program, const char *name, const float *value);
void sb_uniform_vec4(GLuint program, const char *name, double x, double y, double z, double w);
void sb_uniform_mat4(GLuint program, const char *name, const float *value);
/* Binds a 2D texture to `unit` and assigns the unit to the sampler. */
void sb_uniform_texture(GLuint program, const char *name, int unit, GLuint texture);

/* The vertex shader of passes over the whole picture. It draws one triangle without vertex arrays, at the clip depth of
   the uniform `depth`, and gives the fragment shader `vec2 screen` in -1..1. */
extern const char sb_fullscreen_vertex[];
/* Draws that triangle with the program in use. `empty` is a vertex array object without arrays. */
void sb_fullscreen_draw(GLuint empty);

/* Makes attribute `slot` read from the bound array buffer, at `offset` bytes within each record. */
void sb_attribute(GLuint slot, GLint size, GLenum type, GLboolean normalized, GLsizei stride, size_t offset);

/* Creates a texture without mipmaps that is clamped at its edges. pixels may be NULL. */
GLuint sb_texture_create(GLenum internal, int width, int height, GLenum format, GLenum type, const void *pixels,
                         GLenum filter);

/* SB_FAILED if the bound framebuffer cannot be drawn to. */
sb_status sb_framebuffer_check(const char *name, sb_error *error);

#endif
