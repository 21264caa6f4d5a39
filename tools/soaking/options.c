#include "options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char sb_soak_help[] =
    "usage: tools/soak [OPTIONS]\n"
    "Runs the plant with pictures, particle files and a live subscriber, stops it with SIGTERM and resumes it again and\n"
    "again, begins anew when it is finished, and watches the memory and the descriptors of its processes. Writes soak.md.\n"
    "Exit status: 0 nothing grew and nothing failed, 4 something did, 1 bad input, 2 the soak itself failed, 77 no route\n"
    "for the subscriber.\n\n"
    "  --minutes N       of wall time (default: 60)\n"
    "  --life N          seconds after its first frame when a run is stopped (default: a tenth of the time, at least 3)\n"
    "  --spacing M       between particles, in metres (default: 6)\n"
    "  --duration S      simulated seconds after which it is begun anew (default: 300)\n"
    "  --out DIR         the run goes here, and samples.csv (default: runs/soak)\n"
    "  --report DIR      soak.md goes here (default: docs/results)\n"
    "  --help            this text\n";

static sb_status take_number(const char *flag, const char *value, double *number, sb_error *error)
{
    char *end = NULL;
    *number = value ? strtod(value, &end) : 0;
    if (!value || end == value || *end || !isfinite(*number) || *number <= 0 || *number > 1e6)
        return sb_fail(error, SB_BAD_INPUT, "%s: expected a number above 0, at most 1e6", flag);
    return SB_OK;
}

static sb_status take(sb_soak_options *o, const char *flag, const char *value, sb_error *error)
{
    const struct {
        const char *name;
        double *number;
        const char **text;
    } flags[] = {{"--minutes", &o->minutes, NULL}, {"--life", &o->life, NULL},   {"--spacing", &o->spacing, NULL},
                 {"--duration", &o->duration, NULL}, {"--out", NULL, &o->out}, {"--report", NULL, &o->report}};
    for (size_t f = 0; f < sizeof flags / sizeof *flags; f++) {
        if (strcmp(flag, flags[f].name) != 0)
            continue;
        if (flags[f].number)
            return take_number(flag, value, flags[f].number, error);
        *flags[f].text = value;
        return value ? SB_OK : sb_fail(error, SB_BAD_INPUT, "%s: a folder is missing behind it", flag);
    }
    return sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; --help lists them", flag);
}

sb_status sb_soak_options_parse(int count, char **arguments, sb_soak_options *options, sb_error *error)
{
    *options = (sb_soak_options){.minutes = 60, .spacing = 6, .duration = 300, .out = "runs/soak",
                                 .report = SB_SOURCE_DIR "/docs/results"};
    sb_status status = SB_OK;
    for (int i = 1; status == SB_OK && i < count; i += 2) {
        options->help = strcmp(arguments[i], "--help") == 0;
        if (options->help)
            return SB_OK;
        status = take(options, arguments[i], i + 1 < count ? arguments[i + 1] : NULL, error);
    }
    if (!(options->life > 0))
        options->life = fmax(6 * options->minutes, 3);
    return status;
}
