/* Loads shared libraries only when a run needs them, so that an unused library costs no memory. */
#ifndef SB_BASE_LIBRARY_H
#define SB_BASE_LIBRARY_H

#include "base/status.h"

#include <stddef.h>

typedef struct sb_library_function {
    const char *name;
    void *pointer; /* address of the function pointer that is set */
} sb_library_function;

/* Loads the library of that file name from the loader's search path and sets the function pointers. The library stays
   loaded until the process ends. SB_FAILED names the loader's reason, or the first function that is missing. */
sb_status sb_library_load(const char *file, const sb_library_function *functions, size_t count, sb_error *error);

#endif
