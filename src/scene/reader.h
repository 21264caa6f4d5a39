/* Reading a YAML tree into structs by the key tables, with errors that name place and key. */
#ifndef SB_SCENE_READER_H
#define SB_SCENE_READER_H

#include "base/file.h"
#include "scene/key.h"

struct sb_reader {
    const char *file;         /* the scene file, as given */
    char folder[SB_PATH_MAX]; /* absolute folder of it */
    sb_scene *scene;          /* being built */
    char path[512];           /* of the block or the value being read: "bodies[2].file" */
    sb_error *error;
};

/* Fails with "file:line:column: path.key: ..." ("--set: ..." for an override). The place is that
   of key's value in map, else of map itself; key NULL: the place is map's, the path as it is. */
sb_status sb_reader_fail(sb_reader *reader, const sb_yaml *map, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Reads one value into its field; reader->path is at the value. */
sb_status sb_reader_value(sb_reader *reader, const sb_yaml *node, const sb_key *key, void *field);

/* Reads a map (a node of another kind is an error) into item, zeroed before; reader->path is at
   the block. What is allocated before a failure hangs in item: sb_table_free it. */
sb_status sb_reader_block(sb_reader *reader, const sb_yaml *map, const sb_table *table, void *item);

/* Whether the run's duration holds a sane number of intervals; 0 (off) passes. */
sb_status sb_reader_interval(sb_reader *reader, const sb_yaml *map, const char *key, double interval);

/* Applies --set KEY=VALUE to the tree. */
sb_status sb_override_apply(sb_yaml *root, const sb_override *override, sb_error *error);

#endif
