/* A requested run: a case at one spacing, preset and seed. */
#ifndef SB_FRAMEWORK_REQUEST_H
#define SB_FRAMEWORK_REQUEST_H

#include "base/file.h"
#include "case.h"

#include <stdint.h>

enum { SB_SETTINGS_MAX = 32 };

typedef struct sb_request {
    const sb_case *of;
    const sb_plan *plan;
    const char *preset; /* "paper" or "wen", beside the judged runs; NULL: the default preset */
    bool quick;
    int seed;
    char change[64];     /* one more KEY=VALUE, the change of a sensitivity run; "": none */
    const char *replays; /* folder of a run whose record.csv is the given sea; NULL: none */
} sb_request;

/* The settings of a request, in order; a record that is replayed is the last. The list points into the struct and the
   plan. */
typedef struct sb_settings {
    char resolution[48], seed[40], record[SB_PATH_MAX + 32];
    const char *list[SB_SETTINGS_MAX];
    size_t count;
} sb_settings;
/* "default", "paper" or "wen". */
const char *sb_request_preset(const sb_request *request);
void sb_request_settings(const sb_request *request, sb_settings *settings);
/* Reads a scene with at most SB_SETTINGS_MAX settings. preset: NULL: that of the scene. */
sb_status sb_settings_scene(const char *path, const char *preset, const char *const *settings, size_t count,
                            sb_scene *scene, sb_error *error);
/* "still-water-box, 0.05 m, paper, seed 1" for messages, or without the case for plots. */
void sb_request_label(const sb_request *request, bool with_case, char label[96]);

/* Continues a hash by the request: the scene's text, the files that it names, and all settings; of a record that is
   replayed its contents, not its place. assets: folder that the scene's path is relative to. SB_BAD_INPUT: the scene
   cannot be read with these settings. */
sb_status sb_request_hash(const sb_request *request, const char *assets, uint64_t *hash, sb_error *error);

/* Hash of a scene with every default filled in, without its bodies and wave makers, whose files may have moved. The
   hash of a request and that of a finished run differ if the defaults have changed since the run. */
sb_status sb_scene_defaults_hash(const sb_scene *scene, uint64_t *hash, sb_error *error);
sb_status sb_request_defaults_hash(const sb_request *request, const char *assets, uint64_t *hash, sb_error *error);

#endif
