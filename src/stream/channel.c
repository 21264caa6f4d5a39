#include "stream/channel.h"

#include <stdio.h>
#include <string.h>

static const char *const endings[SB_CHANNELS] = {"_status", "_forces", "_gauges", "_frame", "_parity", "_scene"};

sb_status sb_channels_name(const char *prefix, sb_channel channels[SB_CHANNELS], sb_error *error)
{
    if (!prefix || !*prefix) prefix = "shorebreak";
    for (int i = 0; i < SB_CHANNELS; i++) {
        const int length = snprintf(channels[i], sizeof channels[i], "%s%s", prefix, endings[i]);
        if (length < 0 || (size_t)length >= sizeof channels[i])
            return sb_fail(error, SB_BAD_INPUT,
                           "stream prefix \"%s\": the channel name %s%s is longer than LCM's limit of %zu bytes",
                           prefix, prefix, endings[i], sizeof channels[i] - 1);
    }
    return SB_OK;
}

sb_channel_kind sb_channel_find(const char *name, const sb_channel channels[SB_CHANNELS])
{
    int kind = 0;
    while (kind < SB_CHANNELS && strcmp(name, channels[kind]) != 0) kind++;
    return (sb_channel_kind)kind;
}

sb_channel_kind sb_channel_guess(const char *name)
{
    const char *ending = strrchr(name, '_');
    int kind = 0;
    while (kind < SB_CHANNELS && !(ending && strcmp(ending, endings[kind]) == 0)) kind++;
    return (sb_channel_kind)kind;
}
