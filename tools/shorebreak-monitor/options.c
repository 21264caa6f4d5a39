#include "options.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char sb_monitor_help[] =
    "Usage: shorebreak-monitor [--url URL] [--prefix NAME] [--once] [--duration S] [--plain]\n"
    "\n"
    "Shows a run live: progress, forces on bodies, and what of its particle stream arrives.\n"
    "\n"
    "  --url URL       LCM provider, as stream.url of the scene (default: LCM_DEFAULT_URL, else\n"
    "                  udpm://239.255.76.67:7667); file://LOG replays what lcm-logger wrote\n"
    "  --prefix NAME   of the channels, as stream.prefix of the scene (default: shorebreak)\n"
    "  --once          show the first status and what belongs to it, then exit\n"
    "  --duration S    exit after S seconds\n"
    "  --plain         lines instead of a live table (the default when not on a terminal)\n"
    "  --help          this text\n"
    "  --version       the version\n"
    "\n"
    "Ctrl-C ends it. Exit code 0: done; 1: bad option, no provider, or --once saw no status.\n";

static bool read_duration(const char *text, double *seconds)
{
    char *end;
    *seconds = strtod(text, &end);
    return end != text && !*end && isfinite(*seconds) && *seconds > 0;
}

bool sb_monitor_options_read(int count, char **words, sb_monitor_options *options,
                             char trouble[256])
{
    *options = (sb_monitor_options){0};
    for (int i = 1; i < count; i++) {
        const char *word = words[i], *value = i + 1 < count ? words[i + 1] : NULL;
        bool takes_value = !strcmp(word, "--url") || !strcmp(word, "--prefix") ||
                           !strcmp(word, "--duration");
        if (takes_value && !value) {
            snprintf(trouble, 256, "%.100s: a value is missing", word);
            return false;
        }
        i += takes_value;
        if (!strcmp(word, "--url")) {
            options->url = value;
        } else if (!strcmp(word, "--prefix")) {
            options->prefix = value;
        } else if (!strcmp(word, "--duration")) {
            if (!read_duration(value, &options->duration)) {
                snprintf(trouble, 256, "--duration: \"%.100s\" is not a number of seconds above 0",
                         value);
                return false;
            }
        } else if (!strcmp(word, "--once")) {
            options->once = true;
        } else if (!strcmp(word, "--plain")) {
            options->plain = true;
        } else if (!strcmp(word, "--help") || !strcmp(word, "-h")) {
            options->help = true;
        } else if (!strcmp(word, "--version")) {
            options->version = true;
        } else {
            snprintf(trouble, 256, "%.100s: no such option; see --help", word);
            return false;
        }
    }
    return true;
}
