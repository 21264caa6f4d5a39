/* What the server shows of a run: its scene, its newest complete frame, its status, and the rows of its tables. Takes
   the messages of the stream as they arrived, from untrusted bytes. */
#ifndef SB_WEB_VIEW_H
#define SB_WEB_VIEW_H

#include "stream/live.h"
#include "web/blob.h"
#include "web/history.h"

typedef struct sb_web_view sb_web_view;

/* NULL without memory. */
sb_web_view *sb_web_view_create(void);
void sb_web_view_destroy(sb_web_view *view);

/* Takes one message, as sb_live_take does. time: s, of sb_clock. */
void sb_web_view_take(sb_web_view *view, sb_channel_kind kind, const void *data, size_t size, double time);

/* The newest records; NULL: none yet. They are valid until the next message is taken, unless they are kept. */
sb_web_blob *sb_web_view_frame(const sb_web_view *view);
sb_web_blob *sb_web_view_scene(const sb_web_view *view);
/* Changes with each complete frame. */
uint64_t sb_web_view_frame_number(const sb_web_view *view);

const sb_history_table *sb_web_view_forces(const sb_web_view *view);
const sb_history_table *sb_web_view_gauges(const sb_web_view *view);

/* Whether a status has arrived. */
bool sb_web_view_has_status(const sb_web_view *view);
const sb_live *sb_web_view_live(const sb_web_view *view);
/* The id of the run that is shown; -1: none yet. */
int64_t sb_web_view_run_id(const sb_web_view *view);

/* What the server adds to the status. */
typedef struct sb_web_extra {
    bool commands; /* commands are accepted */
    bool plots;    /* dygraphs is there */
    size_t clients;
    uint64_t refused; /* requests */
} sb_web_extra;
/* Writes the answer to GET /status. The view must have a status. now: s, of sb_clock. */
void sb_web_view_write_status(const sb_web_view *view, const sb_web_extra *extra, double now, FILE *stream);

#endif
