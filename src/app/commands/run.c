#include "app/run/run.h"
#include "app/cluster/cluster.h"
#include "app/cluster/join.h"
#include "app/commands/commands.h"
#include "app/grid/water.h"
#include "app/options.h"
#include "base/file.h"
#include "base/stop.h"
#include "mpi/starter.h"
#include "mpi/world.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char help[] =
    "usage: shorebreak run SCENE [OPTIONS]\n"
    "Simulates the scene and writes forces.csv, gauges.csv, probes.csv, pictures, particle files, plots,\n"
    "run.jsonl and summary.json. A scene with offshore runs without particles, unless its sea.source is offshore, and\n"
    "writes gauges.csv, maps and grids.\n\n"
    "  --out DIR            write the results to DIR (default: runs/<name of the scene file>)\n"
    "  --until T            stop at T seconds instead of the scene's duration\n"
    "  --threads N          number of simulation threads (default: one per available core)\n"
    "  --preset NAME        numerical parameters: default, paper or wen (default: the scene's preset)\n"
    "  --set KEY=VALUE      change a key of the scene, e.g. --set resolution=5; null removes it; may be repeated\n"
    "  --overwrite          replace the run in DIR; without --overwrite or --resume, DIR must not hold a run;\n"
    "                       a DIR that holds other files and no run is always refused\n"
    "  --resume             continue from the newest checkpoint in DIR, with the same bits as an uninterrupted run;\n"
    "                       without a checkpoint, start from the beginning\n"
    "  --other-build        with --resume: also accept a checkpoint of another build; the bits may then differ\n"
    "  --control            obey commands that are signed with DIR/control.token (tools/control sends them);\n"
    "                       this also streams the run over LCM\n"
    "  --live[=[ADDRESS:]PORT]  show the run in a web browser, and print the address of its page (default: port 8080 "
    "of\n"
    "                       this machine, or the next free one; beyond this machine only with --control);\n"
    "                       this also streams the run over LCM\n"
    "  --rank-deadline S    on several ranks (mpirun, docs/mpi.md): end the run when a rank is not heard of for S "
    "seconds\n"
    "                       (default: 300)\n"
    "  --mixed              on several ranks: accept unequal builds or processors; the bits may then differ\n"
    "  --quiet              print no progress\n"
    "  --profile            at the end, print the time that each stage took\n";

/* The default directory: runs/<scene file without folder and .yaml>. */
static void default_out(char out[SB_PATH_MAX], const char *scene)
{
    const char *slash = strrchr(scene, '/');
    const char *name = slash ? slash + 1 : scene;
    const char *ending = strrchr(name, '.');
    const bool is_scene = ending && ending > name && (strcmp(ending, ".yaml") == 0 || strcmp(ending, ".yml") == 0);
    snprintf(out, SB_PATH_MAX, "runs/%.*s", (int)(is_scene ? (size_t)(ending - name) : strlen(name)), name);
}

static bool is_loopback(const char *address)
{
    return strncmp(address, "127.", 4) == 0 || strcmp(address, "::1") == 0;
}

static int exit_status(sb_status status)
{
    if (status == SB_INTERRUPTED) return 128 + (sb_stop_signal() ? sb_stop_signal() : SIGINT); /* 0: of another rank */
    return (int)status;
}

static sb_status check_options(const sb_options *options, sb_error *error)
{
    if (options->other_build && !options->resume)
        return sb_fail(error, SB_BAD_INPUT, "--other-build: expected only together with --resume");
    if (options->overwrite && options->resume)
        return sb_fail(error, SB_BAD_INPUT, "--overwrite: cannot be used together with --resume, which keeps the run");
    return SB_OK;
}

static sb_status check_scene(const sb_options *options, const sb_scene *scene, const sb_ranks *ranks, sb_error *error)
{
    if (*options->live_address && !scene->control.enabled && !is_loopback(options->live_address))
        return sb_fail(error, SB_BAD_INPUT,
                       "--live: %s is beyond this machine, expected together with --control, whose token every reader "
                       "then needs",
                       options->live_address);
    if (sb_ranks_several(ranks) && sb_scene_grid_alone(scene))
        return sb_fail(error, SB_BAD_INPUT,
                       "%d ranks: a scene of open water without particles runs on one rank, expected no mpirun",
                       ranks->count);
    return SB_OK;
}

/* Reads the scene and runs it, as the leader or as a follower of several ranks. */
static sb_status run_scene(const sb_options *options, sb_ranks *ranks, sb_scene *scene, sb_run_options *how,
                           sb_error *error)
{
    char out[SB_PATH_MAX];
    sb_status status = sb_options_scene(options, options->positional, scene, error);
    status = sb_cluster_compare(ranks, options, status, error);
    if (status == SB_OK) status = check_scene(options, scene, ranks, error);
    if (status != SB_OK) return status;
    if (options->out)
        snprintf(out, sizeof out, "%s", options->out);
    else
        default_out(out, options->positional);
    how->resume = options->resume;
    how->overwrite = options->overwrite;
    how->other_build = options->other_build;
    how->quiet = options->quiet;
    how->profile = options->profile;
    how->live_port = options->live_port;
    how->live_address = options->live_address;
    how->ranks = ranks;
    if (sb_ranks_own(ranks) != 0) {
        sb_cluster_follow(scene, out, how);
        return SB_OK;
    }
    return (sb_scene_grid_alone(scene) ? sb_grid_run : sb_run)(scene, out, how, error);
}

int sb_command_run(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_scene scene = {0};
    sb_ranks *ranks = NULL;
    bool thread_remains = false;
    unsigned accepted = SB_OPT_OUT | SB_OPT_UNTIL | SB_OPT_THREADS | SB_OPT_PRESET | SB_OPT_SET | SB_OPT_QUIET |
                        SB_OPT_PROFILE | SB_OPT_RESUME | SB_OPT_OVERWRITE | SB_OPT_OTHER_BUILD | SB_OPT_CONTROL |
                        SB_OPT_LIVE | SB_OPT_RANK_DEADLINE | SB_OPT_MIXED;
    sb_run_options how = {.argument_count = count + 1, .arguments = arguments - 1 /* with the name of the command */};
    how.thread_remains = &thread_remains;
    sb_status status = sb_options_parse(count, arguments, accepted, "scene", &options, &error);
    if (status == SB_OK && options.help) {
        if (sb_world_started_as() == 0) fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = check_options(&options, &error);
    status = sb_cluster_join(&options, status, &ranks, &error);
    if (status == SB_OK) status = run_scene(&options, ranks, &scene, &how, &error);
    if (status != SB_OK && sb_ranks_own(ranks) == 0) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_world_leave(ranks);
    if (thread_remains) { /* a library's exit handler could wait for that thread, or free memory that it uses */
        fflush(NULL);
        _exit(exit_status(status));
    }
    sb_scene_free(&scene);
    sb_options_free(&options);
    return exit_status(status);
}
