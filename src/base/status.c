#include "base/status.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

void sb_one_line(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++) {
        const bool high = c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0;
        if (high) *c++ = '?';
        if (high || *c < ' ' || *c == 0x7f) *c = '?';
    }
}

sb_status(sb_fail)(sb_error *error, sb_status status, const char *format, ...)
{
    if (error) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(error->text, sizeof error->text, format, arguments);
        va_end(arguments);
        sb_one_line(error->text);
        error->status = status;
    }
    return status;
}

sb_status(sb_fail_memory)(sb_error *error, const char *purpose)
{
    return sb_fail(error, SB_FAILED, "out of memory for %s", purpose);
}
