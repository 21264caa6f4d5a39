#include "compare/compare.h"
#include "app/commands/commands.h"
#include "app/options.h"

#include <stdio.h>

static const char help[] =
    "usage: shorebreak compare RUN_DIR RUN_DIR... [--out DIR] [--title TEXT] [--quiet]\n"
    "Compares finished runs with the first one, body by body: greatest force and its time, impulse, overturning "
    "moment,\n"
    "greatest depth in front, first wet; gauges, run-up, overtopped volume, flooded ground. Runs of one scene with\n"
    "different start seeds (numerics.seed) become one entry with error bars: give all of them.\n\n"
    "  --out DIR     write into DIR (default: compare): compare.html, a page that opens without a network; "
    "compare.csv;\n"
    "                depth-difference-2.asc, ... maps of the difference; compare.mp4, the films side by side\n"
    "  --title TEXT  title of the page (default: the names of the runs)\n"
    "  --quiet       print nothing\n";

int sb_command_compare(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_status status = sb_options_parse(count, arguments, SB_OPT_SEVERAL | SB_OPT_OUT | SB_OPT_TITLE | SB_OPT_QUIET,
                                        "run directory", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    const sb_compare_options page = {.title = options.title, .film = true, .text = options.quiet ? NULL : stdout};
    if (status == SB_OK)
        status = sb_compare_write(options.positionals, options.positional_count, options.out ? options.out : "compare",
                                  &page, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_options_free(&options);
    return (int)status;
}
