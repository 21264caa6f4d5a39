#include "options.h"

#include <math.h>

static const char help[] =
    "usage: tools/soak [OPTIONS]\n"
    "Runs the plant with pictures, particle files and a live subscriber. Stops the run with SIGTERM and\n"
    "resumes it repeatedly; starts a new run when it has finished. Checks that the memory and the file\n"
    "descriptors of its processes do not grow. Writes soak.md.\n\n"
    "  --minutes N       run time in minutes (default: 60)\n"
    "  --life N          seconds after its first frame at which a process is stopped (default: a tenth\n"
    "                    of the run time, at least 3)\n"
    "  --spacing M       particle spacing in metres (default: 6)\n"
    "  --duration S      simulated seconds after which a new run is started (default: 300)\n"
    "  --out DIR         folder of the run and of samples.csv (default: runs/soak)\n"
    "  --report DIR      folder of soak.md (default: docs/results); if the soak is stopped, soak.md\n"
    "                    is written beside samples.csv\n"
    "  --help            this text\n\n"
    "Exit status: 0 nothing grew and nothing failed, 1 bad input, 2 the soak itself failed, 4 something\n"
    "grew or failed, 77 no network route for the subscriber.\n";

sb_status sb_soak_options_parse(int count, char **arguments, sb_soak_options *o, sb_error *error)
{
    *o = (sb_soak_options){.minutes = 60, .spacing = 6, .duration = 300};
    const sb_argument table[] = {{.name = "--minutes", .number = &o->minutes, .most = 1e6},
                                 {.name = "--life", .number = &o->life, .most = 1e6},
                                 {.name = "--spacing", .number = &o->spacing, .most = 1e3},
                                 {.name = "--duration", .number = &o->duration, .most = 1e6}};
    const sb_command_line line = {.tool = "soak",
                                  .help = help,
                                  .has = SB_HAS_OUT | SB_HAS_REPORT,
                                  .options = table,
                                  .option_count = sizeof table / sizeof *table};
    sb_status status = sb_command_line_read(&line, count, arguments, &o->common, error);
    if (!(o->life > 0)) o->life = fmax(6 * o->minutes, 3);
    return status;
}
