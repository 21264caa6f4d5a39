/* The web server of a run: a fixed list of resources, all in memory (docs/live.md, "HTTP"). It works in the caller's
   thread: the caller waits until the server's descriptor is readable or the time is over, and calls sb_web_server_run.
   A client gets the newest complete frame whenever it has read the one before; none waits for another one. */
#ifndef SB_WEB_SERVER_H
#define SB_WEB_SERVER_H

#include "base/status.h"
#include "web/view.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_web_server sb_web_server;

/* Zero: the default in brackets. */
typedef struct sb_web_settings {
    const char *address;     /* numeric, [127.0.0.1] */
    int port;                /* 0: any */
    bool next_port;          /* take one of the next ports if that one is in use */
    const char *name;        /* a host name under which browsers may ask; NULL: none */
    const char *token;       /* NULL: no commands. Beyond loopback it is required, and every reader must send it */
    const char *plot_folder; /* folder of dygraphs; NULL: Debian's */
    size_t clients; /* connections at a time [40]; a quarter of them is kept for requests that are not /frames */
    double request_seconds;   /* from the connection to the end of a request [10] */
    unsigned stalled_seconds; /* without a byte sent or received [30] */
    void *user;
    /* A command from a client that has the token: untrusted text, zero-terminated. SB_OK: accepted, *id is that of the
       reply; SB_BAD_INPUT: it is wrong; SB_FAILED: not now. NULL: no commands. */
    sb_status (*command)(void *user, const char *json, size_t size, int64_t *id, sb_error *error);
    /* A line for the log, at most one in ten seconds. NULL: none. */
    void (*log)(void *user, const char *line);
} sb_web_settings;

/* Binds and listens. The texts of the settings are copied; the view must outlive the server. SB_BAD_INPUT, with the
   remedy, for a wrong address or a missing token; SB_FAILED if the port cannot be bound. */
sb_status sb_web_server_create(const sb_web_settings *settings, const sb_web_view *view, sb_web_server **server,
                               sb_error *error);
void sb_web_server_destroy(sb_web_server *server);

int sb_web_server_port(const sb_web_server *server);
int sb_web_server_descriptor(const sb_web_server *server);
/* Handles what has arrived and sends what can be sent. Returns the seconds after which it is to be called again. */
double sb_web_server_run(sb_web_server *server);

typedef struct sb_web_counts {
    uint64_t requests, commands;
    uint64_t foreign;     /* another Host or Origin */
    uint64_t no_token;    /* a token was missing or wrong */
    uint64_t unknown;     /* a resource or method that there is not */
    uint64_t malformed;   /* not HTTP, or too large */
    uint64_t wrong;       /* commands that are not valid */
    uint64_t late;        /* requests that did not end in time */
    uint64_t unavailable; /* too many clients */
    uint64_t frames, bytes;
    size_t clients, streams; /* now */
} sb_web_counts;
sb_web_counts sb_web_server_count(const sb_web_server *server);
/* Requests that were refused so far. */
uint64_t sb_web_server_refused(const sb_web_server *server);

#endif
