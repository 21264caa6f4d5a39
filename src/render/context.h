/* An off-screen OpenGL 3.3 core context on the processor; everything else draws into its own
   framebuffers, so that another window system can take this file's place. */
#ifndef SB_RENDER_CONTEXT_H
#define SB_RENDER_CONTEXT_H

#include "base/status.h"

typedef struct sb_context sb_context;

/* Makes the context; it is not current afterwards. */
sb_status sb_context_create(sb_context **context, sb_error *error);

/* Makes it current on the calling thread (one at a time). */
sb_status sb_context_enter(sb_context *context, sb_error *error);

/* Lets go of it, so that another thread may enter. */
void sb_context_leave(sb_context *context);

/* Must not be current on another thread. NULL is fine. */
void sb_context_destroy(sb_context *context);

#endif
