/* The binary answers of the server: records of GET /frames and the answer to GET /scene. docs/live.md describes them
   byte by byte. Numbers have the low byte first. */
#ifndef SB_WEB_RECORDS_H
#define SB_WEB_RECORDS_H

#include "stream/assembly.h"
#include "stream/scene.h"
#include "web/blob.h"

enum {
    SB_WEB_RECORD_HEAD = 96, /* bytes of a frame before its parts */
    SB_WEB_RECORD_PART = 32,
    SB_WEB_RECORD_MOVED = 32,
    SB_WEB_RECORD_ALIVE = 16 /* bytes of a record that only shows that the server is there */
};

/* Each returns NULL without memory, or if the record would be larger than 4 GB. */
sb_web_blob *sb_web_record_frame(const sb_live_frame *frame, int64_t run_id);
sb_web_blob *sb_web_record_alive(double seconds);
sb_web_blob *sb_web_record_scene(const sb_live_scene *scene);

#endif
