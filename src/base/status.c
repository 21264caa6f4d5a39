/* Fills errors. */
#include "base/status.h"

#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>

/* Returns the number of bytes of a character that controls a terminal or changes the direction of text; 0 for any other
   character. */
static int control_length(const unsigned char *c)
{
    if (*c < ' ' || *c == 0x7f) return 1;
    if (c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0) return 2; /* U+0080 to U+009F */
    if (c[0] == 0xd8 && c[1] == 0x9c) return 2;                /* U+061C */
    if (c[0] != 0xe2) return 0;
    if (c[1] == 0x80 && (c[2] == 0x8e || c[2] == 0x8f || (c[2] >= 0xa8 && c[2] <= 0xae)))
        return 3;                                                /* U+200E to U+202E */
    return c[1] == 0x81 && c[2] >= 0xa6 && c[2] <= 0xa9 ? 3 : 0; /* U+2066 to U+2069 */
}

void sb_one_line(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++)
        for (int length = control_length(c); length > 0; length--) {
            *c = '?';
            if (length > 1) c++;
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
