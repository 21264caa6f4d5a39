#include "stream/replay.h"
#include "app/commands/commands.h"
#include "app/options.h"
#include "base/stop.h"

#include <stdio.h>

static const char help[] =
    "usage: shorebreak replay LOG [--speed X] [--url URL] [--prefix NAME] [--quiet]\n"
    "Publishes a run that lcm-logger recorded, for every subscriber: monitor, browser, another recording.\n\n"
    "  --speed X        factor on the recorded speed; 0: as fast as subscribers can receive (default: 1)\n"
    "  --url URL        LCM provider (default: LCM_DEFAULT_URL, else udpm://239.255.76.67:7667)\n"
    "  --prefix NAME    prefix of the run's channels (default: that of the first run in the log)\n"
    "  --quiet          print no progress\n";

static void print_progress(const sb_replay *replay)
{
    const sb_live *live = sb_replay_view(replay);
    const sb_status_message *status = sb_live_get_status(live);
    if (!status) return;
    printf("%s: t = %.4g of %.4g s, %llu frames\n", status->run, status->time, status->duration,
           (unsigned long long)sb_live_count(live).frames_complete);
    fflush(stdout);
}

/* Reports what is missing in the log, and whether anything was published. */
static sb_status finish(const sb_replay *replay, const char *path, sb_error *error)
{
    const sb_live_counts counts = sb_live_count(sb_replay_view(replay));
    const uint64_t left_out = sb_replay_left_out(replay), errors = sb_replay_errors(replay);
    if (left_out > 0)
        fprintf(stderr, "shorebreak: warning: %.500s: %llu bytes are not whole messages and are left out\n", path,
                (unsigned long long)left_out);
    if (counts.refused > 0)
        fprintf(stderr, "shorebreak: warning: %.500s: %llu messages are invalid and are left out\n", path,
                (unsigned long long)counts.refused);
    if (counts.lost > 0)
        fprintf(stderr,
                "shorebreak: warning: %.500s: %llu messages of the run are missing; they were lost before they "
                "were recorded\n",
                path, (unsigned long long)counts.lost);
    if (errors == 0) return SB_OK;
    return sb_fail(error, SB_FAILED, "LCM refused %llu messages", (unsigned long long)errors);
}

static sb_status replay_log(const sb_options *options, sb_error *error)
{
    static const double PROGRESS_SECONDS = 1;
    sb_replay *replay = NULL;
    const sb_replay_options how = {.url = options->url, .prefix = options->prefix, .speed = options->speed};
    sb_status status = sb_replay_create(options->positional, &how, &replay, error);
    if (status != SB_OK) return status;
    sb_stop_watch();
    while (!sb_stop_signal() && sb_replay_run(replay, PROGRESS_SECONDS) == SB_OK)
        if (!options->quiet) print_progress(replay);
    if (!options->quiet) print_progress(replay);
    status =
        sb_stop_signal() ? sb_stop_fail(error, "while a log was replayed") : finish(replay, options->positional, error);
    sb_replay_destroy(replay);
    return status;
}

int sb_command_replay(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_status status = sb_options_parse(count, arguments, SB_OPT_SPEED | SB_OPT_URL | SB_OPT_PREFIX | SB_OPT_QUIET,
                                        "log", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = replay_log(&options, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_options_free(&options);
    return status == SB_INTERRUPTED ? 128 + sb_stop_signal() : (int)status;
}
