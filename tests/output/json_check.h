/* A small strict JSON reader: checks that a text is valid, and finds values by key. */
#ifndef SB_TESTS_JSON_CHECK_H
#define SB_TESTS_JSON_CHECK_H

#include <ctype.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static const char *json_value(const char *at);

static inline const char *json_space(const char *at)
{
    while (*at == ' ' || *at == '\n' || *at == '\t' || *at == '\r') at++;
    return at;
}

static inline const char *json_string(const char *at)
{
    if (*at++ != '"') return NULL;
    for (; *at != '"'; at++) {
        if ((unsigned char)*at < 0x20) return NULL;
        if (*at != '\\') continue;
        at++;
        if (*at == 'u') {
            for (int i = 1; i <= 4; i++)
                if (!isxdigit((unsigned char)at[i])) return NULL;
            at += 4;
        } else if (*at == '\0' || !strchr("\"\\/bfnrt", *at))
            return NULL;
    }
    return at + 1;
}

static inline const char *json_members(const char *at, char close, bool keys)
{
    at = json_space(at);
    if (*at == close) return at + 1;
    for (;;) {
        at = json_space(at);
        if (keys) {
            at = json_string(at);
            if (!at || *(at = json_space(at)) != ':') return NULL;
            at++;
        }
        at = json_value(at);
        if (!at) return NULL;
        at = json_space(at);
        if (*at == close) return at + 1;
        if (*at++ != ',') return NULL;
    }
}

static inline const char *json_number_text(const char *at)
{
    const char *c = at + (*at == '-');
    if (!isdigit((unsigned char)*c) || (*c == '0' && isdigit((unsigned char)c[1]))) return NULL;
    char *end;
    strtod(at, &end);
    return end;
}

/* The end of the value at `at`; NULL if it is not JSON. */
static const char *json_value(const char *at)
{
    at = json_space(at);
    if (*at == '{') return json_members(at + 1, '}', true);
    if (*at == '[') return json_members(at + 1, ']', false);
    if (*at == '"') return json_string(at);
    const char *const literals[] = {"true", "false", "null"};
    for (int i = 0; i < 3; i++)
        if (strncmp(at, literals[i], strlen(literals[i])) == 0) return at + strlen(literals[i]);
    return json_number_text(at);
}

/* Whether the text is one value, followed by blanks only. */
static inline bool json_valid(const char *text)
{
    const char *end = json_value(text);
    return end && *json_space(end) == '\0';
}

/* The text after the first "key": at any depth; NULL if there is none. */
static inline const char *json_find(const char *text, const char *key)
{
    size_t length = strlen(key);
    for (const char *at = text; (at = strchr(at, '"')); at++)
        if (strncmp(at + 1, key, length) == 0 && at[length + 1] == '"' && at[length + 2] == ':')
            return json_space(at + length + 3);
    return NULL;
}

#endif
