/* Shader programs and framebuffers: the thin layer over OpenGL that all passes share. */
#ifndef SB_RENDER_PROGRAM_H
#define SB_RENDER_PROGRAM_H

#include "base/status.h"
#include "render/gl.h"

#include <stddef.h>

/* Compiles and links; `common` is put before the fragment source. SB_FAILED holds the compiler's
   first words. 0 is never a valid program. */
sb_status sb_program_create(const char *name, const char *vertex, const char *common, const char *fragment,
                            GLuint *program, sb_error *error);

/* Uniforms of a program in use, by name; names the compiler dropped are fine. */
void sb_uniform_float(GLuint program, const char *name, double value);
void sb_uniform_vec2(GLuint program, const char *name, double x, double y);
void sb_uniform_vec3(GLuint program, const char *name, const float *value);
void sb_uniform_mat4(GLuint program, const char *name, const float *value);
/* Binds a 2D texture to `unit` and points the sampler at it. */
void sb_uniform_texture(GLuint program, const char *name, int unit, GLuint texture);

/* The vertex shader of passes over the whole picture: three vertices without any array; gives the
   fragment `vec2 screen` in -1..1; `depth` is the uniform clip depth they lie at. */
extern const char sb_fullscreen_vertex[];
/* Draws those three vertices with the program in use; `empty` is a vertex array without arrays. */
void sb_fullscreen_draw(GLuint empty);

/* Reads attribute `slot` from the bound array buffer, `offset` bytes into each record. */
void sb_attribute(GLuint slot, GLint size, GLenum type, GLboolean normalized, GLsizei stride, size_t offset);

/* A texture without mipmaps, clamped at its edge; pixels may be NULL. */
GLuint sb_texture_create(GLenum internal, int width, int height, GLenum format, GLenum type, const void *pixels,
                         GLenum filter);

/* SB_FAILED when the framebuffer now bound cannot be drawn to. */
sb_status sb_framebuffer_check(const char *name, sb_error *error);

#endif
