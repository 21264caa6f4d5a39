/* The functions of OpenGL 3.3 core that the renderer calls. They are loaded from the library when the first context is
   created: a run without pictures loads neither OSMesa nor its compiler. */
#ifndef SB_RENDER_GL_H
#define SB_RENDER_GL_H

#define GL_GLEXT_PROTOTYPES /* for the types of the members below; the prototypes are not linked */
#include <GL/glcorearb.h>

/* clang-format off */
#define SB_GL_FUNCTIONS(F) F(ActiveTexture) F(AttachShader) F(BindBuffer) F(BindFramebuffer) F(BindRenderbuffer) \
    F(BindTexture) F(BindVertexArray) F(BlendFunc) F(BufferData) F(CheckFramebufferStatus) F(Clear) F(ClearColor) \
    F(ClearDepth) F(ColorMask) F(CompileShader) F(CreateProgram) F(CreateShader) F(CullFace) F(DeleteBuffers) \
    F(DeleteFramebuffers) F(DeleteProgram) F(DeleteRenderbuffers) F(DeleteShader) F(DeleteTextures) \
    F(DeleteVertexArrays) F(DepthFunc) F(DepthMask) F(Disable) F(DrawArrays) F(DrawBuffer) F(DrawBuffers) F(Enable) \
    F(EnableVertexAttribArray) F(FramebufferRenderbuffer) F(FramebufferTexture2D) F(GenBuffers) F(GenFramebuffers) \
    F(GenRenderbuffers) F(GenTextures) F(GenVertexArrays) F(GetError) F(GetProgramInfoLog) F(GetProgramiv) \
    F(GetShaderInfoLog) F(GetShaderiv) F(GetTexImage) F(GetUniformLocation) F(LineWidth) F(LinkProgram) \
    F(PolygonOffset) F(ReadBuffer) F(ReadPixels) F(RenderbufferStorage) F(ShaderSource) \
    F(TexImage2D) F(TexParameteri) F(Uniform1f) F(Uniform1i) F(Uniform2f) F(Uniform2i) F(Uniform3fv) F(Uniform4f) \
    F(UniformMatrix4fv) F(UseProgram) F(VertexAttribPointer) F(Viewport)
/* clang-format on */

typedef struct sb_gl_functions {
#define SB_GL_MEMBER(name) __typeof__(gl##name) *name;
    SB_GL_FUNCTIONS(SB_GL_MEMBER)
#undef SB_GL_MEMBER
} sb_gl_functions;

/* Set by the first successful sb_context_create; the same for all contexts. */
extern sb_gl_functions sb_gl;

#endif
