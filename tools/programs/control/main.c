/* shorebreak-control: sends a command to a run and prints its reply. */
#include "send.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: tools/control [--timeout S] RUN_DIR COMMAND\n"
    "Sends a command to the run in RUN_DIR, which was started with --control, and prints its reply. The exit status "
    "is\n"
    "0 if the run obeyed, else 1. The commands:\n\n"
    "  pause, resume        stop before the next step, and go on\n"
    "  step [N]             make N steps (1), then pause\n"
    "  stop                 end the run as Ctrl-C does, with a checkpoint\n"
    "  checkpoint           write a checkpoint now\n"
    "  rate R               stream at most R frames per second of wall time; 0: no limit\n"
    "  decimation N         stream one particle in N\n"
    "  region X0 Y0 Z0 X1 Y1 Z1 | region off\n"
    "                       stream only the particles in this box (m), or all\n"
    "  picture CAMERA | picture EX EY EZ TX TY TZ\n"
    "                       draw a picture now from this camera of the scene, or from eye E to target T (m)\n"
    "  trigger WAVEMAKER    start a wave maker whose start is `command`\n\n"
    "  --timeout S          wait S seconds for the reply (default: 60)\n";

int main(int count, char **arguments)
{
    sb_target target;
    sb_reply_message reply;
    sb_error error = {0};
    double seconds = 60;
    int at = 1;
    if (at < count && (strcmp(arguments[at], "--help") == 0 || strcmp(arguments[at], "-h") == 0)) {
        fputs(help, stdout);
        return 0;
    }
    if (at + 1 < count && strcmp(arguments[at], "--timeout") == 0) {
        char *end;
        seconds = strtod(arguments[at + 1], &end);
        if (*end || !(seconds > 0) || !isfinite(seconds)) {
            fprintf(stderr, "tools/control: --timeout %s: expected seconds > 0\n", arguments[at + 1]);
            return 1;
        }
        at += 2;
    }
    if (count - at < 2) {
        fputs(help, stderr);
        return 1;
    }
    sb_status status = sb_target_read(arguments[at], &target, &error);
    if (status == SB_OK) status = sb_control_send(&target, count - at - 1, arguments + at + 1, seconds, &reply, &error);
    if (status != SB_OK) {
        fprintf(stderr, "tools/control: %s\n", error.text);
        return 1;
    }
    fprintf(reply.refused ? stderr : stdout, "%sstep %lld, t = %.9g s: %s\n", reply.refused ? "refused: " : "",
            (long long)reply.step, reply.time, reply.text);
    return reply.refused;
}
