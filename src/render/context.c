/* The only file that knows OSMesa. */
#include "render/context.h"

#include "base/memory.h"

#include <GL/osmesa.h>
#include <stdlib.h>

#ifdef __SANITIZE_ADDRESS__
/* Mesa 22.3 never frees the small record of a destroyed context's buffer: not ours to report. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa.so\n";
}
#endif

/* OSMesa wants a buffer of its own to be current; nothing is drawn into it. */
enum { SIDE = 8 };

struct sb_context {
    OSMesaContext mesa;
    unsigned char buffer[SIDE * SIDE * 4];
};

sb_status sb_context_create(sb_context **context, sb_error *error)
{
    /* The simulation wants the processors too: two rasteriser threads unless the user says else. */
    setenv("LP_NUM_THREADS", "2", 0);
    sb_context *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "the drawing context");
    static const int attributes[] = {OSMESA_FORMAT,
                                     OSMESA_RGBA,
                                     OSMESA_DEPTH_BITS,
                                     0,
                                     OSMESA_PROFILE,
                                     OSMESA_CORE_PROFILE,
                                     OSMESA_CONTEXT_MAJOR_VERSION,
                                     3,
                                     OSMESA_CONTEXT_MINOR_VERSION,
                                     3,
                                     0};
    made->mesa = OSMesaCreateContextAttribs(attributes, NULL);
    if (!made->mesa) {
        sb_free(made);
        return sb_fail(error, SB_FAILED,
                       "OSMesa gives no OpenGL 3.3 core context: pictures cannot be drawn");
    }
    *context = made;
    return SB_OK;
}

sb_status sb_context_enter(sb_context *context, sb_error *error)
{
    if (!OSMesaMakeCurrent(context->mesa, context->buffer, GL_UNSIGNED_BYTE, SIDE, SIDE))
        return sb_fail(error, SB_FAILED, "OSMesa cannot make its context current");
    return SB_OK;
}

void sb_context_leave(sb_context *context)
{
    (void)context;
    OSMesaMakeCurrent(NULL, NULL, 0, 0, 0);
}

void sb_context_destroy(sb_context *context)
{
    if (!context) return;
    OSMesaDestroyContext(context->mesa);
    sb_free(context);
}
