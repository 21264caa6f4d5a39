/* Loads shared libraries when they are needed. */
#include "base/library.h"

#include <dlfcn.h>
#include <string.h>

sb_status sb_library_load(const char *file, const sb_library_function *functions, size_t count, sb_error *error)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char *reason = dlerror();
        return sb_fail(error, SB_FAILED, "%s: cannot be loaded: %s", file, reason ? reason : "no reason given");
    }
    for (size_t f = 0; f < count; f++) {
        void *found = dlsym(library, functions[f].name);
        if (!found)
            return sb_fail(error, SB_FAILED, "%s: function %s is missing, expected another version of the library",
                           file, functions[f].name);
        /* ISO C does not define a cast from a data pointer to a function pointer. */
        memcpy(functions[f].pointer, &found, sizeof found);
    }
    return SB_OK;
}
