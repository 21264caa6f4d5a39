/* Reads a YAML tree into structs by the key tables. Errors name the place and the key. */
#ifndef SB_SCENE_READER_H
#define SB_SCENE_READER_H

#include "base/file.h"
#include "scene/key.h"

struct sb_reader {
    const char *file;         /* the scene file, as given */
    char folder[SB_PATH_MAX]; /* absolute folder of it */
    sb_scene *scene;          /* that is being read */
    char path[512];           /* of the block or the value being read: "bodies[2].file" */
    sb_error *error;
};

/* Fails with "file:line:column: path.key: ..." ("--set: ..." for an override). The place is that of the key's value in
   map, or that of map if the key is missing or NULL. With key NULL the message has reader->path only. */
sb_status sb_reader_fail(sb_reader *reader, const sb_yaml *map, const char *key, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Reads one value into its field. reader->path must name the value. */
sb_status sb_reader_value(sb_reader *reader, const sb_yaml *node, const sb_key *key, void *field);

/* Reads a map (a node of another kind is an error) into item, which must be zeroed. reader->path must name the block.
   After a failure item owns what was allocated: call sb_table_free. */
sb_status sb_reader_block(sb_reader *reader, const sb_yaml *map, const sb_table *table, void *item);

/* Refuses an interval that fits too often into the run's duration. 0 (off) is allowed. */
sb_status sb_reader_interval(sb_reader *reader, const sb_yaml *map, const char *key, double interval);

/* Gives `period` and `depth` that map does not have the values of the scene's waves; fails if there are none, or
   several that differ. regular: only regular waves have such a period. */
sb_status sb_reader_period(sb_reader *reader, const sb_yaml *map, bool regular, double *period, double *depth);

/* Refuses the name of a body that the scene does not have, and names the most similar one. */
sb_status sb_reader_no_body(sb_reader *reader, const sb_yaml *map, const char *key, const char *name);

/* plates.c: refuses push-plates that cannot be made for a wave maker. */
sb_status sb_plates_check(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use);

/* plates.c: the body that a wave maker moves; NULL: it is part of a split mesh. */
const sb_body *sb_plates_body(const sb_scene *scene, const sb_wavemaker_use *use);

/* piston.c: refuses a paddle of a wave train whose face is oblique to its motion, or does not reach from the bed to
   above the water. */
sb_status sb_piston_check(sb_reader *reader, const sb_yaml *map, const sb_wavemaker_use *use);

/* initial_wave.c: prepares the wave, and refuses one that cannot be or does not fit a periodic domain. */
sb_status sb_initial_wave_finish(sb_reader *reader, const sb_yaml *map, sb_initial_wave *wave);
/* Refuses a wavelength that does not fit a whole number of times into a periodic extent of the place ("domain"), m. */
sb_status sb_initial_wave_fits(sb_reader *reader, const sb_yaml *map, const char *key, double length, const char *place,
                               double extent);

/* Applies --set KEY=VALUE to the tree. */
sb_status sb_override_apply(sb_yaml *root, const sb_override *override, sb_error *error);

#endif
