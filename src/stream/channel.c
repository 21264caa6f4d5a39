#include "stream/channel.h"

#include <stdio.h>
#include <string.h>

static const char *const endings[SB_CHANNELS] = {"_status", "_forces", "_gauges", "_frame",
                                                 "_parity", "_scene",  "_reply"};

static sb_status name_one(const char *prefix, const char *ending, sb_channel channel, sb_error *error)
{
    if (!prefix || !*prefix) prefix = "shorebreak";
    const int length = snprintf(channel, sizeof(sb_channel), "%s%s", prefix, ending);
    if (length >= 0 && (size_t)length < sizeof(sb_channel)) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "stream prefix \"%s\": the channel name %s%s is longer than LCM's limit of %zu bytes", prefix,
                   prefix, ending, sizeof(sb_channel) - 1);
}

sb_status sb_channels_name(const char *prefix, sb_channel channels[SB_CHANNELS], sb_error *error)
{
    sb_status status = SB_OK;
    for (int i = 0; status == SB_OK && i < SB_CHANNELS; i++) status = name_one(prefix, endings[i], channels[i], error);
    return status;
}

sb_status sb_channel_name_command(const char *prefix, sb_channel channel, sb_error *error)
{
    return name_one(prefix, "_command", channel, error);
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
