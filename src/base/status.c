#include "base/status.h"

#include <stdarg.h>
#include <stdio.h>

sb_status(sb_fail)(sb_error *error, sb_status status, const char *format, ...)
{
    if (error) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(error->text, sizeof error->text, format, arguments);
        va_end(arguments);
        /* Words of a hostile file may be quoted here: one line, and no orders to a terminal. */
        for (char *c = error->text; *c; c++)
            if ((unsigned char)*c < ' ' || *c == 0x7f) *c = '?';
        error->status = status;
    }
    return status;
}

sb_status(sb_fail_memory)(sb_error *error, const char *purpose)
{
    return sb_fail(error, SB_FAILED, "out of memory for %s", purpose);
}
