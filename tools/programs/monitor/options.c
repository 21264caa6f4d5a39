#include "options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char sb_monitor_help[] =
    "usage: shorebreak-monitor [--url URL] [--prefix NAME] [--run DIR | --token-file FILE]\n"
    "                          [--once] [--duration S] [--plain]\n"
    "\n"
    "Shows a run while it computes: progress, stage times, convergence, forces on bodies, gauges, and the health of "
    "its\n"
    "stream. Keys: q quit, p pause the run, r resume it, s do one step, Tab next panel, arrows and PgUp/PgDn scroll,\n"
    "? help.\n"
    "\n"
    "  --url URL       LCM provider, as stream.url of the scene (default: LCM_DEFAULT_URL, else\n"
    "                  udpm://239.255.76.67:7667); file://LOG replays a log of lcm-logger\n"
    "  --prefix NAME   prefix of the channels, as stream.prefix of the scene (default: shorebreak)\n"
    "  --run DIR       folder of a run that was started with --control: its URL and prefix are used, and the keys\n"
    "                  p, r and s send commands that are signed with its control.token\n"
    "  --token-file F  the same keys with a copy of the token, for example on another machine\n"
    "  --once          show the first status with its forces and particle counts, then exit\n"
    "  --duration S    exit after S seconds\n"
    "  --plain         print a line per second instead of a live screen (the default when not on a terminal)\n"
    "  --help          print this text\n"
    "  --version       print the version\n"
    "\n"
    "NO_COLOR in the environment switches colours off. Exit status 0: done; 1: bad option, no provider, or no status "
    "with --once.\n";

static bool read_duration(const char *text, double *seconds)
{
    char *end;
    *seconds = strtod(text, &end);
    return end != text && !*end && isfinite(*seconds) && *seconds > 0;
}

bool sb_monitor_options_read(int count, char **arguments, sb_monitor_options *options, char problem[256])
{
    *options = (sb_monitor_options){0};
    const char *duration = NULL;
    const struct {
        const char *name, **value;
        bool *flag;
    } known[] = {{"--url", &options->url, NULL},        {"--prefix", &options->prefix, NULL},
                 {"--run", &options->run, NULL},        {"--token-file", &options->token_file, NULL},
                 {"--duration", &duration, NULL},       {"--once", NULL, &options->once},
                 {"--plain", NULL, &options->plain},    {"--help", NULL, &options->help},
                 {"--version", NULL, &options->version}};
    const size_t known_count = sizeof known / sizeof *known;
    for (int i = 1; i < count; i++) {
        size_t k = 0;
        while (k < known_count && strcmp(arguments[i], known[k].name) != 0) k++;
        if (k == known_count) {
            snprintf(problem, 256, "%.100s: unknown option; see --help", arguments[i]);
            return false;
        }
        if (known[k].flag) {
            *known[k].flag = true;
        } else if (i + 1 < count) {
            *known[k].value = arguments[++i];
        } else {
            snprintf(problem, 256, "%s: a value is missing", known[k].name);
            return false;
        }
    }
    if (options->run && options->token_file) {
        snprintf(problem, 256, "--run and --token-file: only one of them can be given");
        return false;
    }
    if (duration && !read_duration(duration, &options->duration)) {
        snprintf(problem, 256, "--duration: \"%.100s\" is not a number of seconds above 0", duration);
        return false;
    }
    return true;
}
