/* An off-screen OpenGL 3.3 core context that draws on the processor. All drawing goes to framebuffer objects, so that
   another way to create a context can replace this file. */
#ifndef SB_RENDER_CONTEXT_H
#define SB_RENDER_CONTEXT_H

#include "base/status.h"

#include "render/gl/gl.h"

#include <stddef.h>
#include <stdint.h>

typedef struct sb_context sb_context;

enum { SB_PROGRAMS_MAX = 64 };

/* The shader programs that a context has compiled, by the hash of their sources. They last as long as the context. */
typedef struct sb_programs {
    size_t count;
    uint64_t source[SB_PROGRAMS_MAX];
    GLuint program[SB_PROGRAMS_MAX];
} sb_programs;

/* Returns those of the context that is current on this thread. */
sb_programs *sb_context_programs(void);

/* Creates a context without making it current, or returns one that was destroyed, with its programs: programs are
   compiled once per process unless pictures are drawn at the same time. */
sb_status sb_context_create(sb_context **context, sb_error *error);

/* Number of threads with which pictures are drawn: LP_NUM_THREADS, two unless set; at least 1. Valid after the first
   sb_context_create. */
int sb_context_threads(void);

/* Makes it current on the calling thread (one at a time). */
sb_status sb_context_enter(sb_context *context, sb_error *error);

/* Releases it, so that another thread can enter. */
void sb_context_leave(sb_context *context);

/* Destroys the context, or keeps it for sb_context_create. It must not be current on another thread. All objects but
   its programs must be deleted. NULL has no effect. */
void sb_context_destroy(sb_context *context);

#endif
