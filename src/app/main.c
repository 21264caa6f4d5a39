/* shorebreak: tsunami waves striking coastal plants, by implicit incompressible SPH. */
#include "app/commands.h"
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
    bool answers; /* what it prints is what it is for; the others' is progress, which may go unheard */
} commands[] = {
    {"run", "simulate a scene, measure forces, draw pictures, stream", sb_command_run, false},
    {"check", "say what a scene would build and cost, without running it", sb_command_check, true},
    {"sample", "write a scene's boundary and fluid particles for ParaView", sb_command_sample, false},
    {"render", "draw pictures from a finished run's particle files", sb_command_render, false},
    {"list", "kernels, wave makers, solvers and presets there are", sb_command_list, true},
};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static void usage(FILE *stream)
{
    fprintf(stream, "usage: shorebreak COMMAND [ARGUMENTS]\n\n");
    for (int c = 0; c < COMMANDS; c++) fprintf(stream, "  %-8s %s\n", commands[c].name, commands[c].summary);
    fprintf(stream, "\nshorebreak COMMAND --help tells more; --version the version.\n"
                    "Exit status: 0 all done, 1 bad input, 2 the run failed, 129, 130 or 143 stopped by a signal.\n");
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

/* Exit status, when all else is well. */
static int finish_answer(void)
{
    errno = 0;
    if (fflush(stdout) == 0 && !ferror(stdout)) return 0;
    fprintf(stderr, "shorebreak: standard output: cannot write: %s\n", strerror(errno ? errno : EIO));
    return 2;
}

static bool returned;

/* A library that ends the process, as OpenMP's does when the system refuses it a thread, does so with status 1, which
   is for bad input. */
static void judge_exit(int status, void *unused)
{
    (void)unused;
    if (returned || status == 0) return;
    fprintf(stderr, "shorebreak: a library ended the program for the reason above; if the system refused a thread, use "
                    "fewer by --threads\n");
    _exit(2);
}

/* OpenMP threads that spin while they wait take the cores that pictures and stream need, and libgomp
   reads how long they may spin only when the process starts: start once more with a short spin. */
static void limit_spinning(char **arguments)
{
    if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT")) return;
    if (setenv("GOMP_SPINCOUNT", "20000", 1) == 0) execv("/proc/self/exe", arguments);
}

/* Where a standard stream is closed, the first file opened would take its place, and get what is said there. */
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
        on_exit(judge_exit, NULL);
        const int status = commands[c].run(count - 2, arguments + 2);
        returned = true;
        return commands[c].answers && status == 0 ? finish_answer() : status;
    }
    if (*name)
        no_such(name);
    else
        usage(stderr);
    return 1;
}
