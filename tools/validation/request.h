/* A run that is wanted: a case at one resolution, preset and seed. */
#ifndef SB_VALIDATION_REQUEST_H
#define SB_VALIDATION_REQUEST_H

#include "case.h"

#include <stdint.h>

enum { SB_SETTINGS_MAX = 32 };

typedef struct sb_request {
    const sb_case *of;
    const sb_plan *plan;
    bool paper, quick;
    int seed;
    char change[64]; /* one more KEY=VALUE, by which a sensitivity run differs; "": none */
} sb_request;

/* What a request sets, in order; the list points into the struct and the plan. */
typedef struct sb_settings {
    char resolution[48], seed[40];
    const char *list[SB_SETTINGS_MAX];
    size_t count;
} sb_settings;
void sb_request_settings(const sb_request *request, sb_settings *settings);
/* "still-water-box, 0.05 m, paper, seed 1" for messages, or without the case for plots. */
void sb_request_label(const sb_request *request, bool with_case, char label[96]);

/* What is asked, as a number: the scene's own text, the files it names, and all that is set.
   SB_BAD_INPUT when the scene cannot be read with these settings. */
sb_status sb_request_hash(const sb_request *request, const char *scene_path, uint64_t *hash, sb_error *error);

/* What a scene says with every default filled in, as a number: not what is in its bodies and wave makers, whose files
   may lie elsewhere by now. A request's, and a finished run's, by which runs of other defaults are told from it. */
sb_status sb_scene_meaning(const sb_scene *scene, uint64_t *hash, sb_error *error);
sb_status sb_request_meant(const sb_request *request, const char *scene_path, uint64_t *hash, sb_error *error);

#endif
