/* A library to preload into a program: it refuses the second thread of the graphics library, for which the library then
   waits forever in its first picture. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <string.h>

typedef int create(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

int pthread_create(pthread_t *restrict thread, const pthread_attr_t *restrict attributes, void *(*begin)(void *),
                   void *restrict argument)
{
    static atomic_int calls;
    Dl_info from;
    create *real;
    void *found = dlsym(RTLD_NEXT, "pthread_create"), *place;
    memcpy(&real, &found, sizeof real); /* ISO C has no cast between them */
    memcpy(&place, &begin, sizeof place);
    if (dladdr(place, &from) && strstr(from.dli_fname, "libOSMesa") && atomic_fetch_add(&calls, 1) == 1) return EAGAIN;
    return real(thread, attributes, begin, argument);
}
