/* Records of GET /frames. */
#include "web/records.h"

#include <string.h>

static unsigned char *put_part(unsigned char *at, const sb_live_part *part)
{
    at = sb_web_put_u32(at, (uint32_t)part->first);
    at = sb_web_put_u32(at, (uint32_t)part->count);
    for (int k = 0; k < 3; k++) at = sb_web_put_f64(at, part->corner[k]);
    return at;
}

static unsigned char *put_moved(unsigned char *at, int32_t body, const double displacement[3])
{
    at = sb_web_put_u32(at, (uint32_t)body);
    at = sb_web_put_u32(at, 0);
    for (int k = 0; k < 3; k++) at = sb_web_put_f64(at, displacement[k]);
    return at;
}

sb_web_blob *sb_web_record_frame(const sb_live_frame *frame, int64_t run_id)
{
    const size_t parts = (size_t)frame->part_count, moved = (size_t)frame->moved_count;
    const size_t points = SB_STREAM_POINT * (size_t)frame->count;
    const size_t size = SB_WEB_RECORD_HEAD + SB_WEB_RECORD_PART * parts + SB_WEB_RECORD_MOVED * moved + points;
    if (size > UINT32_MAX) return NULL;
    sb_web_blob *blob = sb_web_blob_create(size);
    if (!blob) return NULL;
    unsigned char *at = sb_web_put_name(blob->bytes, "SBF1");
    at = sb_web_put_u32(at, (uint32_t)size);
    at = sb_web_put_f64(at, frame->time);
    at = sb_web_put_f64(at, (double)frame->step);
    at = sb_web_put_f64(at, (double)frame->frame);
    at = sb_web_put_f64(at, (double)run_id);
    at = sb_web_put_f64(at, frame->spacing);
    at = sb_web_put_f64(at, frame->quantum);
    at = sb_web_put_f64(at, frame->speed_max);
    at = sb_web_put_f64(at, frame->pressure_max);
    at = sb_web_put_u32(at, (uint32_t)frame->count);
    at = sb_web_put_u32(at, (uint32_t)frame->decimation);
    at = sb_web_put_u32(at, (uint32_t)parts);
    at = sb_web_put_u32(at, (uint32_t)moved);
    at = sb_web_put_f64(at, 0);
    for (size_t p = 0; p < parts; p++) at = put_part(at, &frame->parts[p]);
    for (size_t m = 0; m < moved; m++) at = put_moved(at, frame->moved[m], frame->displacement + 3 * m);
    if (points > 0) memcpy(at, frame->points, points);
    return blob;
}

sb_web_blob *sb_web_record_alive(double seconds)
{
    sb_web_blob *blob = sb_web_blob_create(SB_WEB_RECORD_ALIVE);
    if (!blob) return NULL;
    sb_web_put_f64(sb_web_put_u32(sb_web_put_name(blob->bytes, "SBA1"), SB_WEB_RECORD_ALIVE), seconds);
    return blob;
}
