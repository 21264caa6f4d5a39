/* shorebreak: tsunami waves striking coastal plants, by implicit incompressible SPH. */
#include "app/commands/commands.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const struct {
    const char *name, *summary;
    int (*run)(int count, char **arguments);
    bool result_on_stdout; /* its output is its result; other commands print progress, which may be lost without an
                              error */
} commands[] = {
    {"run", "simulate a scene, measure forces, draw pictures, stream", sb_command_run, false},
    {"check", "print the particles, estimated cost and warnings of a scene, without running it", sb_command_check,
     true},
    {"preview", "draw the set-up of a scene with the names of its parts, without running it", sb_command_preview,
     false},
    {"sample", "write a scene's boundary and fluid particles for ParaView", sb_command_sample, false},
    {"render", "draw pictures from a finished run's particle files, or from a recorded stream", sb_command_render,
     false},
    {"report", "write one HTML page about a run: pictures, loads, water, inundation, trust", sb_command_report, false},
    {"compare", "write the differences of runs: loads on buildings, water, inundation, side-by-side film",
     sb_command_compare, true},
    {"surface", "write the surface of the water of a run's particle files as meshes", sb_command_surface, false},
    {"replay", "publish a recorded stream again", sb_command_replay, false},
    {"list", "list the available kernels, wave makers, solvers and presets", sb_command_list, true},
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static void usage(FILE *stream)
{
    fprintf(stream, "usage: shorebreak COMMAND [ARGUMENTS]\n\n");
    for (int c = 0; c < COMMANDS; c++) fprintf(stream, "  %-8s %s\n", commands[c].name, commands[c].summary);
    fprintf(stream, "\nshorebreak COMMAND --help describes a command; shorebreak --version prints the version.\n"
                    "Exit status: 0 success, 1 bad input, 2 failure; 129, 130 or 143: stopped by a signal.\n");
}

static void no_such(const char *name)
{
    sb_error error;
    sb_nearest nearest = sb_nearest_to(name);
    for (int c = 0; c < COMMANDS; c++) sb_nearest_try(&nearest, commands[c].name);
    if (nearest.found)
        sb_fail(&error, SB_BAD_INPUT, "%.200s: no such command, did you mean %s? --help lists all", name,
                nearest.found);
    else
        sb_fail(&error, SB_BAD_INPUT, "%.200s: no such command; --help lists them", name);
    fprintf(stderr, "shorebreak: %s\n", error.text);
}

/* Exit status of a command that succeeded: 2 when its result could not be written. */
static int flush_stdout(void)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) return 0;
    fprintf(stderr, "shorebreak: standard output: cannot write: %s\n", strerror(errno ? errno : EIO));
    return 2;
}

static bool returned;

/* A library may end the process: OpenMP does so when the system refuses a thread. Its exit status is 1, which means bad
   input here, so it is replaced by 2. */
static void correct_exit_status(int status, void *unused)
{
    (void)unused;
    if (returned || status == 0) return;
    fprintf(stderr, "shorebreak: a library ended the program for the reason above; if the system refused a thread, use "
                    "fewer with --threads\n");
    _exit(2);
}

/* OpenMP threads that spin while they wait use the cores that pictures and stream need. libgomp reads the length of the
   spin only when the process starts, so the program executes itself again with a short spin. */
static void limit_spinning(char **arguments)
{
    if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT")) return;
    if (setenv("GOMP_SPINCOUNT", "1000", 1) == 0) execv("/proc/self/exe", arguments);
}

/* When a standard stream is closed, the next file that is opened gets its descriptor and would receive its output. */
static void keep_standard_streams(void)
{
    int file;
    do file = open("/dev/null", O_RDWR);
    while (file >= 0 && file <= STDERR_FILENO);
    if (file >= 0) close(file);
}

int main(int count, char **arguments)
{
    keep_standard_streams();
    const char *name = count > 1 ? arguments[1] : "";
    if (strcmp(name, "--version") == 0) {
        printf("shorebreak %s\n", SB_VERSION);
        return 0;
    }
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        usage(stdout);
        return 0;
    }
    for (int c = 0; c < COMMANDS; c++) {
        if (strcmp(name, commands[c].name) != 0) continue;
        for (int i = 2; i < count; i++)
            if (strcmp(arguments[i], "--version") == 0) {
                printf("shorebreak %s\n", SB_VERSION);
                return 0;
            }
        limit_spinning(arguments);
        sb_memory_return_blocks();
        on_exit(correct_exit_status, NULL);
        const int status = commands[c].run(count - 2, arguments + 2);
        returned = true;
        return commands[c].result_on_stdout && status == 0 ? flush_stdout() : status;
    }
    if (*name)
        no_such(name);
    else
        usage(stderr);
    return 1;
}
