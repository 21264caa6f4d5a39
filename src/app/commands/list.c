#include "app/commands/commands.h"
#include "app/options.h"
#include "base/nearest.h"
#include "physics/kernels/kernel.h"
#include "physics/wavemakers/wavemaker.h"
#include "sim/pressure/pressure.h"

#include <stdio.h>
#include <string.h>

static const char help[] = "usage: shorebreak list kernels|wavemakers|solvers|presets\n"
                           "Prints the available choices, each with its source.\n";

static void row(const char *name, const char *summary, const char *reference)
{
    printf("%-18s %s [%s]\n", name, summary, reference);
}

static void list_kernels(void)
{
    for (size_t i = 0; sb_kernels[i]; i++) row(sb_kernels[i]->name, sb_kernels[i]->summary, sb_kernels[i]->reference);
}

static void list_wavemakers(void)
{
    for (size_t i = 0; sb_wavemakers[i]; i++)
        row(sb_wavemakers[i]->name, sb_wavemakers[i]->summary, sb_wavemakers[i]->reference);
}

static void list_solvers(void)
{
    for (size_t i = 0; sb_pressure_solvers[i]; i++)
        row(sb_pressure_solvers[i]->name, sb_pressure_solvers[i]->summary, sb_pressure_solvers[i]->reference);
}

static void list_presets(void)
{
    row("default", "the most accurate values found over several cases", "docs/method.md");
    row("paper", "as published, with errata corrected", "Sampath et al. 2016");
    row("wen", "explicit steps of weakly compressible water, for comparison", "Wen, Ren, Dong, Wang");
}

static const struct {
    const char *name;
    void (*list)(void);
} tables[] = {
    {"kernels", list_kernels}, {"wavemakers", list_wavemakers}, {"solvers", list_solvers}, {"presets", list_presets}};

static sb_status refuse(const char *name, sb_error *error)
{
    sb_nearest nearest = sb_nearest_to(name);
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) sb_nearest_try(&nearest, tables[t].name);
    return sb_fail(error, SB_BAD_INPUT, "list %.100s: expected kernels, wavemakers, solvers or presets%s%s%s", name,
                   nearest.found ? "; did you mean " : "", nearest.found ? nearest.found : "",
                   nearest.found ? "?" : "");
}

int sb_command_list(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_status status = sb_options_parse(count, arguments, 0, "table", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    bool found = false;
    for (size_t t = 0; status == SB_OK && t < sizeof tables / sizeof tables[0]; t++)
        if (strcmp(tables[t].name, options.positional) == 0) {
            tables[t].list();
            found = true;
        }
    if (status == SB_OK && !found) status = refuse(options.positional, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_options_free(&options);
    return (int)status;
}
