/* The server's parts: requests (request.c, answer.c), connections (connections.c), streams of frames (frames.c). */
#ifndef SB_WEB_SERVER_STATE_H
#define SB_WEB_SERVER_STATE_H

#include "web/resources.h"
#include "web/server.h"

#include <microhttpd.h>

enum {
    SB_WEB_HEAD_MAX = 32 << 10,   /* bytes of a connection's buffers, and so of a request's line and headers */
    SB_WEB_COMMAND_MAX = 1 << 10, /* bytes of a command */
    SB_WEB_ROWS_MAX = 512 << 10,  /* about so many bytes of each table in an answer */
    SB_WEB_BACKLOG = 16,
    SB_WEB_ADDRESS = 64
};
#define SB_WEB_ALIVE_SECONDS 2.0    /* between records on a stream without frames */
#define SB_WEB_TICK 0.25            /* s between looks at the deadlines */
#define SB_WEB_ANSWER_SECONDS 300.0 /* from the connection to the end of an answer that is not a stream */

/* A connection. Each has one request: every answer closes its connection. */
typedef struct sb_web_client {
    struct sb_web_client *next, *previous;
    sb_web_server *server;
    struct MHD_Connection *connection;
    int socket;
    double begun;                             /* s, of sb_clock */
    bool understood, answered, streams, late; /* understood: libmicrohttpd has read its line and headers */
    char address[SB_WEB_ADDRESS];             /* of this machine, to which the client has connected */
    char *body;                               /* SB_WEB_COMMAND_MAX + 1 bytes; NULL: none yet */
    size_t body_size;
    /* Of a stream of frames: */
    bool suspended;
    sb_web_blob *record;   /* which is being sent */
    size_t sent;           /* bytes of it */
    uint64_t frame_number; /* of the last frame */
    double last;           /* s, when the last record began */
} sb_web_client;

struct sb_web_server {
    sb_web_settings settings;
    char *address, *name, *token, *plot_folder;
    bool readers_need_token;
    const sb_web_view *view;
    struct MHD_Daemon *daemon;
    int port, descriptor;
    sb_web_plots plots;
    sb_web_client *clients;
    sb_web_counts counts;
    bool closing;
    double checked, logged; /* s, of sb_clock */
    uint64_t reported;      /* refused requests in the log */
};

/* connections.c: opens the listening socket; -1 with the error. */
int sb_web_listen(sb_web_server *server, sb_error *error);
/* Called by libmicrohttpd for each connection that begins or ends. */
void sb_web_on_connection(void *user, struct MHD_Connection *connection, void **context,
                          enum MHD_ConnectionNotificationCode code);
sb_web_client *sb_web_client_of(struct MHD_Connection *connection);
/* Ends the connections whose time is over. */
void sb_web_check_deadlines(sb_web_server *server, double now);

/* request.c: called by libmicrohttpd when a request has been read. */
enum MHD_Result sb_web_on_request(void *user, struct MHD_Connection *connection, const char *url, const char *method,
                                  const char *version, const char *body, size_t *body_size, void **request);

/* answer.c: queue an answer. */
enum MHD_Result sb_web_refuse(sb_web_client *client, unsigned status, uint64_t *count, const char *reason);
enum MHD_Result sb_web_answer_file(sb_web_client *client, const sb_web_file *file);
enum MHD_Result sb_web_answer_blob(sb_web_client *client, sb_web_blob *blob);
/* text: of malloc, freed by the answer. */
enum MHD_Result sb_web_answer_json(sb_web_client *client, unsigned status, char *text, size_t size);
/* Adds the headers that every answer has, queues it and drops the reference. */
enum MHD_Result sb_web_queue(sb_web_client *client, unsigned status, const char *type, struct MHD_Response *response);

/* frames.c */
enum MHD_Result sb_web_answer_frames(sb_web_client *client);
/* Continues the streams for which there is something to send. */
void sb_web_resume_streams(sb_web_server *server, double now);

#endif
