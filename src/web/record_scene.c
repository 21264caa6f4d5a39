/* The answer to GET /scene: a description in JSON, then the vertices and triangles of all bodies. */
#include "web/records.h"

#include "output/log/json.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void put_vector(sb_json *json, const char *key, const double *v)
{
    sb_json_vector(json, key, sb_vec(v[0], v[1], v[2]));
}

static void put_cameras(sb_json *json, const sb_live_scene *scene)
{
    sb_json_open(json, "cameras", '[');
    for (size_t c = 0; c < scene->camera_count; c++) {
        const sb_live_camera *camera = &scene->cameras[c];
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", camera->name);
        sb_json_open(json, "keys", '[');
        for (size_t k = 0; k < camera->key_count; k++) {
            sb_json_open(json, NULL, '{');
            sb_json_number(json, "time", camera->time[k]);
            put_vector(json, "eye", camera->eye + 3 * k);
            put_vector(json, "target", camera->target + 3 * k);
            sb_json_number(json, "fov", camera->fov[k]);
            sb_json_close(json);
        }
        sb_json_close(json);
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_bodies(sb_json *json, const sb_live_scene *scene)
{
    sb_json_open(json, "bodies", '[');
    for (size_t b = 0; b < scene->body_count; b++) {
        const sb_live_body *body = &scene->bodies[b];
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", body->name);
        sb_json_bool(json, "reported", body->reported);
        sb_json_bool(json, "terrain", body->terrain);
        sb_json_bool(json, "moves", body->moves);
        sb_json_bool(json, "one_sided", body->one_sided);
        sb_json_open(json, "color", '[');
        for (int k = 0; k < 3; k++) sb_json_number(json, NULL, (double)body->color[k]);
        sb_json_close(json);
        sb_json_count(json, "vertices", body->vertex_count);
        sb_json_count(json, "triangles", body->triangle_count);
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_gauges(sb_json *json, const sb_live_scene *scene)
{
    sb_json_open(json, "gauges", '[');
    for (size_t g = 0; g < scene->gauge_count; g++) {
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", scene->gauges[g].name);
        sb_json_number(json, "x", scene->gauges[g].x);
        sb_json_number(json, "y", scene->gauges[g].y);
        sb_json_close(json);
    }
    sb_json_close(json);
}

static void put_wavemakers(sb_json *json, const sb_live_scene *scene)
{
    sb_json_open(json, "wavemakers", '[');
    for (size_t w = 0; w < scene->wavemaker_count; w++) sb_json_text(json, NULL, scene->wavemakers[w]);
    sb_json_close(json);
}

static void describe(FILE *stream, const sb_live_scene *scene)
{
    sb_json json;
    sb_json_begin(&json, stream, false);
    sb_json_open(&json, NULL, '{');
    sb_json_text(&json, "run", scene->run);
    sb_json_count(&json, "run_id", (uint64_t)scene->run_id);
    sb_json_text(&json, "units", scene->units);
    sb_json_count(&json, "dimensions", (uint64_t)scene->dimensions);
    sb_json_number(&json, "spacing", scene->spacing);
    sb_json_number(&json, "duration", scene->duration);
    put_vector(&json, "domain_min", scene->domain_min);
    put_vector(&json, "domain_max", scene->domain_max);
    sb_json_number(&json, "gravity", scene->gravity);
    sb_json_number(&json, "density", scene->density);
    if (scene->has_level) sb_json_number(&json, "level", scene->level);
    sb_json_number(&json, "still_depth", scene->still_depth);
    sb_json_number(&json, "speed_max", scene->speed_max);
    sb_json_number(&json, "pressure_max", scene->pressure_max);
    sb_json_number(&json, "measure_interval", scene->measure_interval);
    sb_json_number(&json, "frame_interval", scene->frame_interval);
    put_cameras(&json, scene);
    put_gauges(&json, scene);
    put_wavemakers(&json, scene);
    put_bodies(&json, scene);
    sb_json_close(&json);
}

static unsigned char *put_mesh(unsigned char *at, const sb_live_body *body)
{
    for (size_t v = 0; v < 3 * body->vertex_count; v++) at = sb_web_put_f32(at, body->vertices[v]);
    for (size_t c = 0; c < 3 * body->triangle_count; c++) at = sb_web_put_u32(at, (uint32_t)body->corners[c]);
    return at;
}

sb_web_blob *sb_web_record_scene(const sb_live_scene *scene)
{
    enum { HEAD = 8, ALIGNMENT = 4 };
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    if (!stream) return NULL;
    describe(stream, scene);
    /* Spaces behind the JSON align the meshes. */
    for (long at = ftell(stream); at % ALIGNMENT != 0; at++) fputc(' ', stream);
    sb_web_blob *blob = NULL;
    size_t size = 0;
    if (fclose(stream) != 0) goto done;
    size = HEAD + length;
    for (size_t b = 0; b < scene->body_count; b++)
        size += 12 * (scene->bodies[b].vertex_count + scene->bodies[b].triangle_count);
    if (size > UINT32_MAX) goto done;
    blob = sb_web_blob_create(size);
    if (!blob) goto done;
    unsigned char *at = sb_web_put_u32(sb_web_put_name(blob->bytes, "SBS1"), (uint32_t)length);
    memcpy(at, text, length);
    at += length;
    for (size_t b = 0; b < scene->body_count; b++) at = put_mesh(at, &scene->bodies[b]);
done:
    free(text);
    return blob;
}
