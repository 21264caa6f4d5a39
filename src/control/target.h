/* What a sender of commands must know of a run: its id, channels and token. */
#ifndef SB_CONTROL_TARGET_H
#define SB_CONTROL_TARGET_H

#include "control/token.h"

#include <stdint.h>

#define SB_TARGET_EVENT "control" /* the event of run.jsonl that has them */

enum { SB_TARGET_TEXT = 1024 };

typedef struct sb_target {
    int64_t run_id;
    char prefix[64], url[512]; /* of the stream */
    sb_token token;
} sb_target;

/* Writes the text of the event. SB_BAD_INPUT if prefix or URL are too long. */
sb_status sb_target_write(int64_t run_id, const char *prefix, const char *url, char text[SB_TARGET_TEXT],
                          sb_error *error);

/* Reads the run's directory: the last such event of run.jsonl, and control.token. SB_BAD_INPUT if the run allows no
   commands, or has ended. */
sb_status sb_target_read(const char *directory, sb_target *target, sb_error *error);

/* A counter for the next command: microseconds since 1970, above that of commands that were sent before. */
int64_t sb_target_counter(void);

#endif
