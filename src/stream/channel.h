/* The channels of a run. */
#ifndef SB_STREAM_CHANNEL_H
#define SB_STREAM_CHANNEL_H

#include "base/status.h"

/* <prefix>_status, _forces, _gauges, _frame, _parity, _scene and _reply, on which the run sends; and <prefix>_command,
   on which it is sent commands. */
typedef enum sb_channel_kind {
    SB_CHANNEL_STATUS,
    SB_CHANNEL_FORCES,
    SB_CHANNEL_GAUGES,
    SB_CHANNEL_FRAME,
    SB_CHANNEL_PARITY,
    SB_CHANNEL_SCENE,
    SB_CHANNEL_REPLY,
    SB_CHANNELS, /* the number of channels on which the run sends */
    SB_CHANNEL_COMMAND
} sb_channel_kind;

/* A channel name of at most 63 characters, which is LCM's limit, and the terminating zero. */
typedef char sb_channel[64];

/* Writes the names of the channels; prefix NULL or empty: "shorebreak". SB_BAD_INPUT if a name is longer than LCM
   allows. */
sb_status sb_channels_name(const char *prefix, sb_channel channels[SB_CHANNELS], sb_error *error);

/* Writes the name of the channel of commands. */
sb_status sb_channel_name_command(const char *prefix, sb_channel channel, sb_error *error);

/* The kind of the channel with this name; SB_CHANNELS: none on which the run sends. */
sb_channel_kind sb_channel_find(const char *name, const sb_channel channels[SB_CHANNELS]);

/* The kind of a channel of any run, by the end of its name; SB_CHANNELS: none on which a run sends. */
sb_channel_kind sb_channel_guess(const char *name);

#endif
