/* Parses a YAML text into a tree of nodes with their line and column. Only yaml.c uses libyaml. */
#ifndef SB_SCENE_YAML_H
#define SB_SCENE_YAML_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef enum sb_yaml_kind { SB_YAML_SCALAR, SB_YAML_LIST, SB_YAML_MAP } sb_yaml_kind;

/* A zero-initialised node is an empty scalar. A node owns its texts and its items. */
typedef struct sb_yaml sb_yaml;
struct sb_yaml {
    sb_yaml_kind kind;
    int line, column;         /* from 1; 0: not from a file (--set, a default) */
    char *key;                /* in a map: its key; otherwise NULL */
    int key_line, key_column; /* of that key */
    char *text;               /* scalar: UTF-8 without zero bytes */
    bool quoted;              /* scalar: written in quotes or as a block, and therefore text */
    size_t count, capacity;
    sb_yaml *items; /* of a list or a map, in the order written */
};

/* The origin of a text, for messages: "name:line:column: ", or "name: " if not placed. */
typedef struct sb_yaml_source {
    const char *name;
    bool placed;
} sb_yaml_source;

/* Parses one document into *root (unchanged on error). Refused are syntax errors, invalid UTF-8, no
   document or several, duplicate keys, tags, more than 100000 nodes, more than 32 levels. Aliases
   are copied. SB_BAD_INPUT, or SB_FAILED without memory. */
sb_status sb_yaml_parse(sb_yaml_source source, const char *text, size_t length, sb_yaml *root, sb_error *error);

/* Frees what the node owns and zeroes it. Allowed on a zeroed node. */
void sb_yaml_free(sb_yaml *node);

/* The map's value of that key; NULL if there is none, and for lists and scalars. */
sb_yaml *sb_yaml_child(const sb_yaml *map, const char *key);

/* Whether the node is a scalar without a value: empty, ~ or null. */
bool sb_yaml_is_null(const sb_yaml *node);

/* Moves *value into *place. The key of *place stays; its old value is freed and *value is zeroed. */
void sb_yaml_replace(sb_yaml *place, sb_yaml *value);

/* Frees an item of a list or a map, and closes the gap. */
void sb_yaml_remove(sb_yaml *parent, sb_yaml *item);

/* Adds an empty scalar under a new key of a map (key of key_length bytes). NULL without memory. */
sb_yaml *sb_yaml_append(sb_yaml *map, const char *key, size_t key_length);

#endif
