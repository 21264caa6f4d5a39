/* Shared libraries that are loaded only when something needs them: what a run does not use costs it no memory. */
#ifndef SB_BASE_LIBRARY_H
#define SB_BASE_LIBRARY_H

#include "base/status.h"

#include <stddef.h>

typedef struct sb_library_function {
    const char *name;
    void *pointer; /* to the function pointer that is set */
} sb_library_function;

/* The library of that file name, by the loader's search path; it stays for the life of the process. SB_FAILED has the
   loader's reason, or the first function that the library lacks. */
sb_status sb_library_load(const char *file, const sb_library_function *functions, size_t count, sb_error *error);

#endif
