/* Runs that are shown to browsers by --live, and their HTTP interface. */
#ifndef SB_TESTS_APP_SHOWN_H
#define SB_TESTS_APP_SHOWN_H

#include "program.h"

/* Options that make the tank last and stream many frames. */
#define SHOWN_LONGER                                                                                                   \
    "--set", "numerics.settle_steps=0", "--set", "stream.interval=0.02", "--set", "render.interval=4", "--set",        \
        "output.particle_interval=4"

/* Starts a run of the tank in 3D with --live and --control, and this setting of its spacing, e.g. "resolution=0.1". It
   is paused. Waits for the address of its page. Skips the test without a multicast route. */
pid_t shown_start(const char *directory, const char *spacing, const char *duration);
extern int shown_port;
const char *shown_token(void);

/* A connection to the server, whose reads wait five seconds at most. */
int shown_connect(void);
/* The answer to a request; valid until the next one. headers: each ends with CR LF. */
const char *shown_ask(const char *line, const char *headers, const char *body);
/* The answer to a command that has the token. */
const char *shown_command(const char *body);
/* Waits until the status has this part; fails the test otherwise. */
void shown_await(const char *part);

#endif
