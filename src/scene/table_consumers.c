#include "scene/reader.h"

#include <string.h>
#include <strings.h>

/* clang-format off */
static const sb_key stream_keys[] = {
    {.name = "enabled", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_stream_settings, enabled),
     .fallback = "false", .doc = "Whether the run publishes its state while it runs."},
    {.name = "url", .type = SB_KEY_TEXT, SB_KEY_AT(sb_stream_settings, url), .fallback = "\"\"",
     .doc = "LCM provider, for example udpm://239.255.76.67:7667?ttl=0; empty: LCM's default."},
    {.name = "prefix", .type = SB_KEY_NAME, SB_KEY_AT(sb_stream_settings, prefix),
     .fallback = "shorebreak", .doc = "First part of channel names."},
    {.name = "interval", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_stream_settings, interval),
     .unit = "s", SB_KEY_POSITIVE, .fallback = "0.1",
     .doc = "Simulated time between particle messages."},
    {.name = "decimation", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_stream_settings, decimation),
     .min = 1, .max = 1000000, .fallback = "1", .doc = "Every n-th particle is sent."},
};
/* clang-format on */

enum { PREFIX_MAX = 63 - 10 }; /* the longest channel: <prefix>_particles */

static sb_status finish_stream(sb_reader *reader, const sb_yaml *map, void *item)
{
    const sb_stream_settings *stream = item;
    /* A scene may come from an untrusted source, and LCM would overwrite the file that it names, in any folder. */
    if (strncasecmp(stream->url + strspn(stream->url, " "), "file:", 5) == 0)
        return sb_reader_fail(reader, map, "url",
                              "%.80s would write outside of the output folder, expected a network provider; "
                              "record a log with lcm-logger, or name a file in LCM_DEFAULT_URL",
                              stream->url);
    if (strlen(stream->prefix) > PREFIX_MAX)
        return sb_reader_fail(reader, map, "prefix",
                              "has %zu characters, expected at most %d: a channel name of LCM has at most 63",
                              strlen(stream->prefix), PREFIX_MAX);
    return sb_reader_interval(reader, map, "interval", stream->interval);
}

const sb_table sb_stream_table = {SB_KEY_ROWS(stream_keys), .size = sizeof(sb_stream_settings),
                                  .finish = finish_stream};

/* clang-format off */
static const sb_key control_keys[] = {
    {.name = "enabled", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_control_settings, enabled),
     .fallback = "false",
     .doc = "Whether the run obeys commands that are signed with its token; this also enables the "
            "stream."},
    {.name = "paused", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_control_settings, paused),
     .fallback = "false",
     .doc = "Whether a run that obeys commands begins paused, until the command `resume`."},
};
/* clang-format on */

const sb_table sb_control_table = {SB_KEY_ROWS(control_keys)};

/* clang-format off */
static const sb_key checkpoint_keys[] = {
    {.name = "minutes", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_checkpoint_settings, minutes),
     .unit = "min", .min = 0, .max = 525600, .fallback = "10",
     .doc = "Run time between two checkpoints; 0: by steps only."},
    {.name = "steps", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_checkpoint_settings, steps),
     .unit = "steps", .min = 0, .max = 1000000000, .fallback = "0",
     .doc = "Steps between two checkpoints; 0: by minutes only. With both 0, no checkpoints are "
            "written."},
    {.name = "keep", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_checkpoint_settings, keep),
     .min = 1, .max = 1000000, .fallback = "2",
     .doc = "Number of checkpoints that are kept, the newest ones. If one is damaged, the "
            "previous one is used."},
};
/* clang-format on */

static const sb_table checkpoint_table = {SB_KEY_ROWS(checkpoint_keys)};

/* clang-format off */
static const sb_key output_keys[] = {
    {.name = "particle_interval", .type = SB_KEY_NUMBER,
     SB_KEY_AT(sb_output_settings, particle_interval), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .fallback = "0",
     .doc = "Simulated time between particle files for ParaView; 0: no particle files."},
    {.name = "particle_pieces", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_output_settings, particle_pieces),
     .fallback = "false",
     .doc = "Whether each rank of a run on [several ranks](mpi.md#particle-files-in-pieces) writes its particles as a "
            "file of its own, instead of one file that rank 0 gathers and writes."},
    {.name = "plots", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_output_settings, plots),
     .fallback = "true", .flags = SB_KEY_FREE,
     .doc = "Whether to plot forces and gauges at the end, if gnuplot is installed."},
    {.name = "checkpoint", .type = SB_KEY_BLOCK, SB_KEY_AT(sb_output_settings, checkpoint),
     .table = &checkpoint_table, .flags = SB_KEY_FREE,
     .doc = "Times at which checkpoints are saved, for `--resume`; also at the end and on a "
            "signal."},
};
/* clang-format on */

static sb_status finish_output(sb_reader *reader, const sb_yaml *map, void *item)
{
    return sb_reader_interval(reader, map, "particle_interval", ((const sb_output_settings *)item)->particle_interval);
}

const sb_table sb_output_table = {SB_KEY_ROWS(output_keys), .size = sizeof(sb_output_settings),
                                  .finish = finish_output};
