/* An off-screen OpenGL 3.3 core context that draws on the processor. All drawing goes to framebuffer objects, so that
   another way to create a context can replace this file. */
#ifndef SB_RENDER_CONTEXT_H
#define SB_RENDER_CONTEXT_H

#include "base/status.h"

typedef struct sb_context sb_context;

/* Creates the context without making it current. */
sb_status sb_context_create(sb_context **context, sb_error *error);

/* Number of threads with which pictures are drawn: LP_NUM_THREADS, two unless set; at least 1. Valid after the first
   sb_context_create. */
int sb_context_threads(void);

/* Makes it current on the calling thread (one at a time). */
sb_status sb_context_enter(sb_context *context, sb_error *error);

/* Releases it, so that another thread can enter. */
void sb_context_leave(sb_context *context);

/* Destroys the context, which must not be current on another thread. NULL has no effect. */
void sb_context_destroy(sb_context *context);

#endif
