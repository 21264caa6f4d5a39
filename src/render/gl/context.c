/* Creates OpenGL contexts by OSMesa. No other file calls OSMesa. */
#include "render/gl/context.h"

#include "base/library.h"
#include "base/memory.h"
#include "base/threads.h"
#include "render/gl/gl.h"

#include <GL/osmesa.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

#ifdef __SANITIZE_ADDRESS__
/* Mesa 22.3 never frees the small record of a destroyed context's buffer. This leak is not in this project. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libOSMesa.so\n";
}

/* Libraries that are loaded at run time have their thread-local storage on the heap. If it begins 16 bytes into a page,
   which happens one time in 256, the sanitizer interprets the bytes before it as a record of glibc 2.19 and searches
   for pointers at the address that it finds there, which crashes its leak check. This option excludes such storage from
   the search and nothing else. */
const char *__asan_default_options(void);
const char *__asan_default_options(void)
{
    return "intercept_tls_get_addr=0";
}
#endif

/* OSMesa requires a buffer to make a context current. Nothing is drawn into it. */
enum { SIDE = 8 };

struct sb_context {
    OSMesaContext mesa;
    unsigned char buffer[SIDE * SIDE * 4];
    sb_programs programs;
    bool used; /* before it was created again: errors of that time do not count */
};

static _Thread_local sb_context *current;

/* Contexts that were destroyed. A run has one renderer for its film and one at a time for stills. */
enum { KEPT_MAX = 2 };
static struct {
    pthread_mutex_t lock;
    size_t count;
    sb_context *list[KEPT_MAX];
} kept = {.lock = PTHREAD_MUTEX_INITIALIZER};

sb_programs *sb_context_programs(void)
{
    return &current->programs;
}

static sb_context *take_kept(void)
{
    pthread_mutex_lock(&kept.lock);
    sb_context *context = kept.count > 0 ? kept.list[--kept.count] : NULL;
    pthread_mutex_unlock(&kept.lock);
    return context;
}

static bool keep(sb_context *context)
{
    pthread_mutex_lock(&kept.lock);
    const bool room = kept.count < KEPT_MAX;
    if (room) kept.list[kept.count++] = context;
    pthread_mutex_unlock(&kept.lock);
    return room;
}

sb_gl_functions sb_gl;

/* The functions of OSMesa, and the error if they could not be loaded. */
static struct {
    __typeof__(OSMesaCreateContextAttribs) *create;
    __typeof__(OSMesaMakeCurrent) *make_current;
    __typeof__(OSMesaDestroyContext) *destroy;
    sb_error error;
} mesa;

static void load(void)
{
    const sb_library_function functions[] = {{"OSMesaCreateContextAttribs", &mesa.create},
                                             {"OSMesaMakeCurrent", &mesa.make_current},
                                             {"OSMesaDestroyContext", &mesa.destroy},
#define SB_GL_FIND(name) {"gl" #name, &sb_gl.name},
                                             SB_GL_FUNCTIONS(SB_GL_FIND)
#undef SB_GL_FIND
    };
    sb_library_load("libOSMesa.so.8", functions, sizeof functions / sizeof functions[0], &mesa.error);
}

static int drawing_threads = 1;

int sb_context_threads(void)
{
    return drawing_threads;
}

/* The simulation needs the processors, too: two rasteriser threads unless the user sets another number. Mesa starts as
   many again for compute shaders, and one for its cache of shaders. The water is drawn by as many threads, too. If only
   some of the rasteriser's threads can be started, Mesa 22.3 waits for the others without end in the first picture. It
   then gets no threads and draws in the thread that calls it. */
static void choose_threads(void)
{
    enum { CHOSEN = 2, MOST = 32 };
    setenv("LP_NUM_THREADS", "2", 0);
    const char *text = getenv("LP_NUM_THREADS");
    const long requested = text ? strtol(text, NULL, 10) : CHOSEN;
    const int threads = requested < 0 ? 0 : requested > MOST ? MOST : (int)requested, needed = 3 * threads + 1;
    const bool few = threads > 0 && sb_threads_allowed(needed) < needed;
    if (few) setenv("LP_NUM_THREADS", "0", 1);
    drawing_threads = few || threads < 1 ? 1 : threads;
}

/* The library first: it takes address space, and so do threads. */
static void prepare(void)
{
    load();
    if (mesa.error.status == SB_OK) choose_threads();
}

sb_status sb_context_create(sb_context **context, sb_error *error)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, prepare);
    if (mesa.error.status != SB_OK)
        return sb_fail(error, SB_FAILED, "pictures cannot be drawn without OSMesa: %.900s", mesa.error.text);
    *context = take_kept();
    if (*context) return SB_OK;
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
    made->mesa = mesa.create(attributes, NULL);
    if (!made->mesa) {
        sb_free(made);
        return sb_fail(error, SB_FAILED, "OSMesa cannot create an OpenGL 3.3 core context: pictures cannot be drawn");
    }
    /* OpenMP ends the process when it cannot start a thread: its threads start now, while there is room. */
    int running = 0;
#pragma omp parallel num_threads(drawing_threads)
#pragma omp atomic
    running++;
    *context = made;
    (void)running;
    return SB_OK;
}

sb_status sb_context_enter(sb_context *context, sb_error *error)
{
    if (!mesa.make_current(context->mesa, context->buffer, GL_UNSIGNED_BYTE, SIDE, SIDE))
        return sb_fail(error, SB_FAILED, "OSMesa cannot make its context current");
    current = context;
    for (int k = 0; context->used && k < 16 && sb_gl.GetError() != GL_NO_ERROR; k++) continue;
    context->used = false;
    return SB_OK;
}

void sb_context_leave(sb_context *context)
{
    (void)context;
    current = NULL;
    mesa.make_current(NULL, NULL, 0, 0, 0);
}

void sb_context_destroy(sb_context *context)
{
    if (!context) return;
    context->used = true;
    if (keep(context)) return;
    mesa.destroy(context->mesa);
    sb_free(context);
}
