#include "app/commands.h"
#include "app/options.h"
#include "app/run.h"
#include "base/file.h"
#include "base/stop.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char help[] =
    "usage: shorebreak run SCENE [OPTIONS]\n"
    "Simulates the scene and writes forces.csv, gauges.csv, probes.csv, pictures, particle files, plots,\n"
    "run.jsonl and summary.json.\n\n"
    "  --out DIR            results go here (default: runs/<name of the scene file>)\n"
    "  --until T            stop at T seconds instead of the scene's duration\n"
    "  --threads N          of the simulation (default: one on each core that it may use)\n"
    "  --preset NAME        numerics: default or paper (default: the scene's)\n"
    "  --set KEY=VALUE      change a key of the scene, e.g. --set resolution=5; may be repeated\n"
    "  --overwrite          replace the run that DIR holds; without it, or --resume, such a DIR is refused, and so is\n"
    "                       one that holds other files and no run\n"
    "  --resume             go on from the newest checkpoint in DIR, bit for bit; without one, from the beginning\n"
    "  --other-build        with --resume: also from a checkpoint of another build, then no longer bit for bit\n"
    "  --quiet              no progress\n"
    "  --profile            at the end, where the time went, stage by stage\n";

/* runs/<scene file without folder and .yaml> */
static void default_out(char out[SB_PATH_MAX], const char *scene)
{
    const char *slash = strrchr(scene, '/');
    const char *name = slash ? slash + 1 : scene;
    const char *ending = strrchr(name, '.');
    const bool is_scene = ending && ending > name && (strcmp(ending, ".yaml") == 0 || strcmp(ending, ".yml") == 0);
    snprintf(out, SB_PATH_MAX, "runs/%.*s", (int)(is_scene ? (size_t)(ending - name) : strlen(name)), name);
}

static int exit_status(sb_status status)
{
    if (status == SB_INTERRUPTED) return 128 + sb_stop_signal();
    return (int)status;
}

int sb_command_run(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_scene scene = {0};
    bool left = false;
    unsigned accepted = SB_OPT_OUT | SB_OPT_UNTIL | SB_OPT_THREADS | SB_OPT_PRESET | SB_OPT_SET | SB_OPT_QUIET |
                        SB_OPT_PROFILE | SB_OPT_RESUME | SB_OPT_OVERWRITE | SB_OPT_OTHER_BUILD;
    sb_status status = sb_options_parse(count, arguments, accepted, "scene", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    char out[SB_PATH_MAX];
    if (status == SB_OK && options.other_build && !options.resume)
        status = sb_fail(&error, SB_BAD_INPUT, "--other-build: only together with --resume");
    if (status == SB_OK && options.overwrite && options.resume)
        status = sb_fail(&error, SB_BAD_INPUT, "--overwrite: not together with --resume, which keeps the run");
    if (status == SB_OK) status = sb_options_scene(&options, options.positional, &scene, &error);
    if (status == SB_OK) {
        if (options.out)
            snprintf(out, sizeof out, "%s", options.out);
        else
            default_out(out, options.positional);
        const sb_run_manner manner = {.resume = options.resume,
                                      .overwrite = options.overwrite,
                                      .other_build = options.other_build,
                                      .quiet = options.quiet,
                                      .profile = options.profile,
                                      .left = &left};
        status = sb_run(&scene, out, &manner, &error);
    }
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    if (left) { /* a library's clean-up at exit could wait for the thread, or be used by it */
        fflush(NULL);
        _exit(exit_status(status));
    }
    sb_scene_free(&scene);
    sb_options_free(&options);
    return exit_status(status);
}
