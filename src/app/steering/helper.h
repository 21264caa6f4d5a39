/* The helper process of a run, shorebreak-live: it receives from the network, so that the run does not, and passes
   commands through a pipe. The run never waits for it, and goes on when it ends. */
#ifndef SB_APP_HELPER_H
#define SB_APP_HELPER_H

#include "base/status.h"
#include "control/command.h"

#include <stdbool.h>
#include <sys/types.h>

/* How often a helper that ends is started again. */
enum { SB_HELPER_RESTARTS = 5 };

/* The texts must outlive the helper. */
typedef struct sb_helper_setup {
    const char *url, *prefix; /* of the stream */
    const char *token_file;   /* NULL: no commands are allowed */
    int64_t run_id;
    int port;            /* of the page for browsers; 0: none */
    const char *address; /* on which it is; NULL or empty: loopback */
} sb_helper_setup;

/* A zero-initialised struct has no helper. */
typedef struct sb_helper {
    sb_helper_setup setup;
    bool on;       /* a helper was started and not given up */
    pid_t process; /* 0: it has ended */
    int pipe;      /* the reading end, nonblocking */
    int restarts;
    double started;  /* sb_clock() at the last start */
    int64_t counter; /* the highest counter of its commands */
} sb_helper;

/* Starts the program shorebreak-live, which is beside this one. SB_FAILED with the reason. */
sb_status sb_helper_start(sb_helper *helper, const sb_helper_setup *setup, sb_error *error);

/* Reads the next valid record. False: there is none now. Never waits. */
bool sb_helper_next(sb_helper *helper, sb_command *command);

/* What has become of the helper since the last call. */
typedef enum sb_helper_news {
    SB_HELPER_SAME,
    SB_HELPER_RESTARTED, /* it had ended, and another one was started */
    SB_HELPER_LOST       /* it had ended, and is not started again */
} sb_helper_news;

/* Looks whether the helper has ended, and starts it again. Call it when sb_helper_next returns false. Never waits. */
sb_helper_news sb_helper_watch(sb_helper *helper);

/* Waits for the next record, for at most so many seconds, or until a signal comes. */
void sb_helper_wait(const sb_helper *helper, double seconds);

/* Ends the helper, for which it waits a second at most. Its last records can still be read until sb_helper_close. */
void sb_helper_end(sb_helper *helper);
void sb_helper_close(sb_helper *helper);

#endif
