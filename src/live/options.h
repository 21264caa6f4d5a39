/* The command line of shorebreak-live. */
#ifndef SB_LIVE_OPTIONS_H
#define SB_LIVE_OPTIONS_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>

enum { SB_LIVE_PORT = 8080 }; /* unless --port is given */

typedef struct sb_live_options {
    const char *url, *prefix; /* of the stream; NULL: not given */
    const char *token_file;   /* the token of commands, and of readers beyond loopback; NULL: no commands */
    int64_t command_fd;       /* the writing end of the pipe to the run that started this process; -1: none did */
    int64_t run_id;           /* of that run; -1: not given */
    int64_t counter;          /* commands up to this counter are replayed ones */
    const char *bind;         /* address of the web server; NULL: 127.0.0.1 */
    const char *host;         /* a name of this machine that browsers may use; NULL: none */
    int64_t port;             /* of the web server: this one, or the next free one */
    bool no_http, help;
} sb_live_options;

/* Parses the arguments after the program's name. SB_BAD_INPUT names the first one that is wrong. */
sb_status sb_live_options_parse(int count, char **arguments, sb_live_options *options, sb_error *error);

#endif
