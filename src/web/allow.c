#include "web/allow.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

/* The name of a "name", "name:port", "[address]" or "[address]:port"; 0: it is none of these. */
static size_t split(const char *host, const char **name)
{
    size_t length;
    const char *port;
    if (*host == '[') {
        *name = host + 1;
        length = strcspn(*name, "]");
        if ((*name)[length] != ']') return 0;
        port = *name + length + 1;
    } else {
        *name = host;
        length = strcspn(host, ":");
        port = host + length;
    }
    if (*port == ':') {
        const size_t digits = strspn(port + 1, "0123456789");
        if (digits < 1 || digits > 5) return 0;
        port += 1 + digits;
    }
    return *port ? 0 : length;
}

static bool is_name(const char *text, size_t length, const char *name)
{
    return name && strlen(name) == length && strncasecmp(text, name, length) == 0;
}

bool sb_web_allow_host(const char *host, const char *address, const char *name)
{
    const char *text = NULL;
    const size_t length = host ? split(host, &text) : 0;
    if (length == 0) return false;
    return is_name(text, length, address) || is_name(text, length, "localhost") || is_name(text, length, name);
}

bool sb_web_allow_origin(const char *origin, const char *site, const char *mode, const char *host, bool is_page)
{
    static const char scheme[] = "http://";
    if (origin && (!host || strncasecmp(origin, scheme, sizeof scheme - 1) != 0 ||
                   strcasecmp(origin + sizeof scheme - 1, host) != 0))
        return false;
    if (!site || strcmp(site, "same-origin") == 0 || strcmp(site, "none") == 0) return true;
    return is_page && !origin && mode && strcmp(mode, "navigate") == 0;
}

bool sb_web_allow_token(const char *given, const char *expected)
{
    if (!given || !expected || !*expected) return false;
    const size_t length = strlen(expected), given_length = strlen(given);
    volatile unsigned char difference = length != given_length;
    for (size_t i = 0; i < length; i++) {
        const unsigned char byte = i < given_length ? (unsigned char)given[i] : 0;
        difference = (unsigned char)(difference | (byte ^ (unsigned char)expected[i]));
    }
    return difference == 0;
}

bool sb_web_is_loopback(const char *address)
{
    return strncmp(address, "127.", 4) == 0 || strcmp(address, "::1") == 0;
}
