/* Encodes a scene for the stream. */
#ifndef SB_STREAM_SCENE_ENCODE_H
#define SB_STREAM_SCENE_ENCODE_H

#include "geometry/model/model.h"
#include "stream/decode.h"

/* Encodes the scene and the bodies of its model (lcmtypes/scene_t.lcm). The caller frees *bytes with sb_free. SB_FAILED
   without memory, or if the scene is larger than SB_STREAM_SCENE_MAX. */
sb_status sb_scene_encode(const sb_scene *scene, const sb_model *model, int64_t run_id, const char *run,
                          unsigned char **bytes, size_t *size, sb_error *error);

#endif
