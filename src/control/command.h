/* Commands to a run, as plain records and as JSON (docs/live.md#commands). */
#ifndef SB_CONTROL_COMMAND_H
#define SB_CONTROL_COMMAND_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef enum sb_command_kind {
    SB_COMMAND_PAUSE,
    SB_COMMAND_RESUME,
    SB_COMMAND_STEP,       /* count: steps, those of settling included, after which the run is paused */
    SB_COMMAND_STOP,       /* as SIGINT does */
    SB_COMMAND_CHECKPOINT, /* now */
    SB_COMMAND_RATE,       /* number[0]: frames per second of wall time in the stream, at most; 0: no limit */
    SB_COMMAND_DECIMATION, /* count: one particle in `count` is streamed */
    SB_COMMAND_REGION,     /* off: all particles; else those between number[0..2] and number[3..5], m */
    SB_COMMAND_PICTURE,    /* name: the camera; if it is empty, eye number[0..2] and target number[3..5], m */
    SB_COMMAND_TRIGGER,    /* name: the wave maker */
    SB_COMMAND_LOSS,       /* number[0]: share of the stream that a subscriber lost lately, 0 to 1; there is no reply */
    SB_COMMANDS,           /* the number of kinds that are sent to a run; the helper process makes those that follow: */
    SB_COMMAND_BAD = SB_COMMANDS, /* a signed command with a fault; name: the reason, for the reply */
    SB_COMMAND_COUNTS,            /* number[0..4]: the counts of sb_received, for the log */
    SB_COMMAND_KINDS
} sb_command_kind;

enum {
    SB_COMMAND_NUMBERS = 6,
    SB_COMMAND_NAME = 128,     /* bytes of the name, with its terminating zero */
    SB_COMMAND_JSON_MAX = 1024 /* bytes of a command as JSON */
};

/* The largest id and counter: numbers up to it are exact in every language. */
#define SB_COMMAND_ID_MAX (((int64_t)1 << 53) - 1)

/* A record of fixed size. The helper process writes it to a pipe in one piece, which is atomic. */
typedef struct sb_command {
    int32_t kind; /* sb_command_kind */
    int32_t off;  /* 0 or 1 */
    int64_t id;   /* of the sender's choice; the reply repeats it */
    int64_t counter;
    int64_t count;
    double number[SB_COMMAND_NUMBERS];
    char name[SB_COMMAND_NAME];
} sb_command;

_Static_assert(sizeof(sb_command) <= 256, "a record must be small");

/* The kind's name, as "do" has it. */
const char *sb_command_name(int32_t kind);

/* Reads {"do": "pause"}, {"do": "step", "steps": 10} and so on from untrusted text. The member "id" is optional.
   SB_BAD_INPUT, with *command unchanged, for text that is not one JSON object, and for members that are missing,
   unknown, of a wrong type or out of range. */
sb_status sb_command_from_json(const char *text, size_t size, sb_command *command, sb_error *error);

/* Writes the words of a command line, such as "step 10" or "region 0 0 0 10 10 10", as JSON into text, with the id.
   SB_BAD_INPUT for a wrong number of words, or for a command that sb_command_from_json refuses. */
sb_status sb_command_from_words(int count, char *const words[], int64_t id, char text[SB_COMMAND_JSON_MAX],
                                sb_error *error);

/* Whether a record from the pipe is valid: the process that wrote it receives from a network. */
bool sb_command_is_valid(const sb_command *command);

#endif
