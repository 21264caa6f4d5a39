#include "scene/name.h"

#include <stdio.h>
#include <string.h>

const char sb_name_letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_.-";

static const char blanks[] = " \t\r\n\v\f";

static void trim(char *name)
{
    const size_t begin = strspn(name, blanks);
    size_t length = strlen(name + begin);
    while (length > 0 && strchr(blanks, name[begin + length - 1])) --length;
    memmove(name, name + begin, length);
    name[length] = '\0';
}

/* Whether the byte continues a UTF-8 character. */
static bool is_continuation(char byte)
{
    return ((unsigned char)byte & 0xc0) == 0x80;
}

bool sb_name_fit(char *name)
{
    bool replaced = false;
    char *to = name;
    trim(name);
    for (const char *from = name; *from; ++from) {
        if (strchr(sb_name_letters, *from) && !(from == name && (*from == '.' || *from == '-'))) {
            *to++ = *from;
            continue;
        }
        /* One "_" per character, for any number of bytes. */
        for (int more = (unsigned char)*from >= 0x80 ? 3 : 0; more > 0 && is_continuation(from[1]); --more) ++from;
        *to++ = '_';
        replaced = true;
    }
    *to = '\0';
    return replaced;
}

void sb_name_escape(const char *name, char *to, size_t room)
{
    size_t used = 0;
    for (; *name && used + 8 < room; ++name) {
        const unsigned char c = (unsigned char)*name;
        if (c >= ' ' && c < 127 && c != '"' && c != '\\')
            to[used++] = *name;
        else
            used += (size_t)snprintf(to + used, room - used, "\\x%02x", c);
    }
    snprintf(to + used, room - used, "%s", *name ? "..." : "");
}
