/* Writes JSON to a stream: escapes texts, separates values, and writes numbers that are not finite as null. */
#ifndef SB_OUTPUT_JSON_H
#define SB_OUTPUT_JSON_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { SB_JSON_DEPTH = 16 };

/* key: the value's key inside of an object; NULL inside of an array and at the top level. Write errors are left in the
   stream. */
typedef struct sb_json {
    FILE *stream;
    bool pretty; /* one value per line, indented; else all on one line */
    int depth;
    bool filled[SB_JSON_DEPTH];
    char bracket[SB_JSON_DEPTH];
} sb_json;

/* Length of the valid UTF-8 sequence at text; 0 if it is not valid. */
size_t sb_utf8_length(const char *text);

void sb_json_begin(sb_json *json, FILE *stream, bool pretty);
/* bracket: '{' or '['. */
void sb_json_open(sb_json *json, const char *key, char bracket);
void sb_json_close(sb_json *json);
/* NULL is written as null. Bytes that are not UTF-8 become U+FFFD. */
void sb_json_text(sb_json *json, const char *key, const char *text);
void sb_json_number(sb_json *json, const char *key, double value);
void sb_json_count(sb_json *json, const char *key, uint64_t value);
void sb_json_bool(sb_json *json, const char *key, bool value);
void sb_json_vector(sb_json *json, const char *key, sb_vec3 value);
/* A hash, as a string of 16 hexadecimal digits. */
void sb_json_hash(sb_json *json, const char *key, uint64_t value);

#endif
