/* The scene as the stream has it: what does not change during a run. Its encoding (lcmtypes/scene_t.lcm) is sent in
   pieces. */
#ifndef SB_STREAM_SCENE_H
#define SB_STREAM_SCENE_H

#include "stream/decode.h"

#include <stdbool.h>

/* A body. Vectors are stored flat. */
typedef struct sb_live_body {
    char name[SB_STREAM_NAME];
    bool reported, terrain, moves, one_sided;
    float color[3]; /* negative: the scene gives none */
    double moment_point[3];
    size_t vertex_count, triangle_count;
    float *vertices;  /* m, relative to domain_min */
    int32_t *corners; /* three indices of vertices for each triangle */
} sb_live_body;

typedef struct sb_live_camera {
    char name[SB_STREAM_NAME];
    size_t key_count; /* at least 1 */
    double *time, *eye, *target, *fov;
} sb_live_camera;

typedef struct sb_live_gauge {
    char name[SB_STREAM_NAME];
    double x, y;
} sb_live_gauge;

/* Fields as in lcmtypes/scene_t.lcm. A zero-initialised struct is empty. */
typedef struct sb_live_scene {
    int64_t run_id;
    char run[SB_STREAM_NAME], units[SB_STREAM_NAME];
    int32_t dimensions;
    double spacing, duration, domain_min[3], domain_max[3], gravity, density;
    bool has_level;
    double level, still_depth, speed_max, pressure_max, measure_interval, frame_interval;
    int32_t width, height;
    size_t body_count, camera_count, gauge_count, wavemaker_count;
    sb_live_body *bodies;
    sb_live_camera *cameras;
    sb_live_gauge *gauges;
    char (*wavemakers)[SB_STREAM_NAME]; /* names of those that wait for a command to start */
} sb_live_scene;

/* Decodes an encoded scene from untrusted bytes. SB_BAD_INPUT as in decode.h, and if a triangle names a vertex that
   does not exist; SB_FAILED without memory. *out is then unchanged. It has no pointers into the buffer. */
sb_status sb_live_scene_decode(const void *buffer, size_t size, sb_live_scene *out, sb_error *error);
void sb_live_scene_free(sb_live_scene *scene);

#endif
