#include "options.h"

#include "arguments.h"

#include <math.h>

const char sb_soak_help[] = "usage: tools/soak [OPTIONS]\n"
                            "Runs the plant with pictures, particle files and a live subscriber, stops it with SIGTERM "
                            "and resumes it again and\n"
                            "again, begins anew when it is finished, and watches the memory and the descriptors of its "
                            "processes. Writes soak.md.\n"
                            "Exit status: 0 nothing grew and nothing failed, 4 something did, 1 bad input, 2 the soak "
                            "itself failed, 77 no route\n"
                            "for the subscriber.\n\n"
                            "  --minutes N       of wall time (default: 60)\n"
                            "  --life N          seconds after its first frame when a run is stopped (default: a tenth "
                            "of the time, at least 3)\n"
                            "  --spacing M       between particles, in metres (default: 6)\n"
                            "  --duration S      simulated seconds after which it is begun anew (default: 300)\n"
                            "  --out DIR         the run goes here, and samples.csv (default: runs/soak)\n"
                            "  --report DIR      soak.md goes here (default: docs/results); of a soak that is stopped\n"
                            "                    it lies beside samples.csv\n"
                            "  --help            this text\n";

sb_status sb_soak_options_parse(int count, char **arguments, sb_soak_options *options, sb_error *error)
{
    *options = (sb_soak_options){
        .minutes = 60, .spacing = 6, .duration = 300, .out = "runs/soak", .report = SB_SOURCE_DIR "/docs/results"};
    const sb_argument table[] = {{.name = "--minutes", .number = &options->minutes, .most = 1e6},
                                 {.name = "--life", .number = &options->life, .most = 1e6},
                                 {.name = "--spacing", .number = &options->spacing, .most = 1e3},
                                 {.name = "--duration", .number = &options->duration, .most = 1e6},
                                 {.name = "--out", .text = &options->out},
                                 {.name = "--report", .text = &options->report}};
    const sb_command_line line = {
        .options = table, .option_count = sizeof table / sizeof *table, .help = &options->help};
    sb_status status = sb_command_line_read(&line, count, arguments, error);
    if (!(options->life > 0)) options->life = fmax(6 * options->minutes, 3);
    return status;
}
