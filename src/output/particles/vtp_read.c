#include "base/input.h"
#include "base/memory.h"
#include "output/particles/vtp.h"
#include "output/particles/vtp_layout.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { HEADER_MAX = 65536, MAX_BODIES = 1 << 20, MAX_FACES = 1 << 24, POINT_BLOCK = 256 };

/* An open particle file: its XML part as text, and where the appended data lie. */
typedef struct source {
    const char *path;
    FILE *stream;
    char *header;
    uint64_t base, end; /* first byte after the underscore; length of the file */
    uint64_t points;
} source;

static sb_status damaged(const source *file, sb_error *error, const char *what)
{
    return sb_fail(error, SB_BAD_INPUT, "%.500s: %s, expected a particle file of shorebreak", file->path, what);
}

/* The value of key="..." between from and to as a number; false when absent or not a number. */
static bool find_number(const char *from, const char *to, const char *key, uint64_t *value)
{
    char pattern[64];
    int length = snprintf(pattern, sizeof pattern, " %s=\"", key);
    const char *at = strstr(from, pattern);
    if (!at || at >= to) return false;
    at += length;
    char *rest;
    if (*at < '0' || *at > '9') return false;
    errno = 0;
    unsigned long long number = strtoull(at, &rest, 10);
    if (errno || *rest != '"' || rest >= to) return false;
    *value = number;
    return true;
}

static sb_status read_header(source *file, sb_error *error)
{
    file->header = sb_alloc(HEADER_MAX + 1, 1);
    if (!file->header) return sb_fail_memory(error, file->path);
    size_t got = fread(file->header, 1, HEADER_MAX, file->stream);
    const char *mark = memmem(file->header, got, SB_VTP_APPENDED, strlen(SB_VTP_APPENDED));
    if (!mark) return damaged(file, error, "no appended data");
    file->base = (uint64_t)(mark - file->header) + strlen(SB_VTP_APPENDED);
    file->header[file->base] = '\0';
    if (strlen(file->header) != file->base) return damaged(file, error, "zero bytes in the header");
    if (strncmp(file->header, SB_VTP_HEAD, strlen(SB_VTP_HEAD)) != 0)
        return damaged(file, error, "does not begin as little-endian PolyData with UInt64 headers");
    const char *end = file->header + file->base;
    if (!find_number(file->header, end, "NumberOfPoints", &file->points))
        return damaged(file, error, "no NumberOfPoints");
    if (fseeko(file->stream, 0, SEEK_END) != 0) return damaged(file, error, "not seekable");
    file->end = (uint64_t)ftello(file->stream);
    /* 24 bytes of position each: a count that the file cannot hold must not be allocated. */
    if (file->points > (file->end - file->base) / 24)
        return damaged(file, error, "too short for its number of particles");
    return SB_OK;
}

/* Moves the stream to the data of an array. Checks that the array has `tuples` tuples (0: any number, returned) of this
   type and number of components, all within the file. */
static sb_status find_array(source *file, const char *name, const char *type, uint64_t size, uint64_t components,
                            uint64_t *tuples, sb_error *error)
{
    char pattern[128], what[160];
    snprintf(pattern, sizeof pattern, "<DataArray type=\"%s\" Name=\"%s\"", type, name);
    const char *tag = strstr(file->header, pattern);
    const char *end = tag ? strchr(tag, '>') : NULL;
    uint64_t found = 0, offset = 0, length = 0;
    snprintf(what, sizeof what, "no %s array \"%s\" of %u components", type, name, (unsigned)components);
    if (!end || !find_number(tag, end, "NumberOfComponents", &found) || found != components ||
        !find_number(tag, end, "offset", &offset))
        return damaged(file, error, what);
    snprintf(what, sizeof what, "array \"%s\" is cut off or of the wrong length", name);
    uint64_t room = file->end - file->base;
    if (room < sizeof length || offset > room - sizeof length ||
        fseeko(file->stream, (off_t)(file->base + offset), SEEK_SET) != 0 ||
        fread(&length, sizeof length, 1, file->stream) != 1)
        return damaged(file, error, what);
    if (length > room - sizeof length - offset || length % (size * components) != 0) return damaged(file, error, what);
    uint64_t there = length / (size * components);
    if (*tuples && there != *tuples) return damaged(file, error, what);
    *tuples = there;
    return SB_OK;
}

static sb_status read_array(source *file, const char *name, const char *type, uint64_t size, uint64_t components,
                            uint64_t tuples, void *out, sb_error *error)
{
    if (tuples == 0) return SB_OK;
    sb_status status = find_array(file, name, type, size, components, &tuples, error);
    if (status == SB_OK && fread(out, size * components, tuples, file->stream) != tuples)
        status = damaged(file, error, "cut off");
    return status;
}

/* Converts the file's absolute doubles to floats relative to an origin. */
static sb_status read_points(source *file, sb_vec3 origin, float *position, sb_error *error)
{
    uint64_t tuples = file->points;
    if (tuples == 0) return SB_OK;
    sb_status status = find_array(file, "Points", "Float64", 8, 3, &tuples, error);
    double block[3 * POINT_BLOCK];
    for (uint64_t first = 0; status == SB_OK && first < tuples; first += POINT_BLOCK) {
        uint64_t count = tuples - first < POINT_BLOCK ? tuples - first : POINT_BLOCK;
        if (fread(block, 3 * sizeof(double), count, file->stream) != count) return damaged(file, error, "cut off");
        for (uint64_t i = 0; i < count; i++) {
            float *out = position + 3 * (first + i);
            out[0] = (float)(block[3 * i] - origin.x);
            out[1] = (float)(block[3 * i + 1] - origin.y);
            out[2] = (float)(block[3 * i + 2] - origin.z);
        }
    }
    return status;
}

/* One column of three doubles per body. */
static sb_status read_vectors(source *file, const char *name, size_t count, double *scratch, sb_error *error)
{
    return read_array(file, name, "Float64", 8, 3, count, scratch, error);
}

static sb_vec3 vector_at(const double *values, size_t i)
{
    return sb_vec(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
}

static sb_status read_bodies(source *file, sb_frame *frame, sb_error *error)
{
    enum { NAME = sizeof frame->bodies->name };
    size_t n = frame->body_count;
    double *vectors = sb_alloc(n, 3 * sizeof *vectors);
    char *bytes = sb_alloc(n, NAME);
    sb_status status = vectors && bytes ? SB_OK : sb_fail_memory(error, "bodies of a particle file");
    if (status == SB_OK) status = read_array(file, "body_name", "UInt8", 1, NAME, n, bytes, error);
    for (size_t i = 0; status == SB_OK && i < n; i++)
        snprintf(frame->bodies[i].name, NAME, "%.*s", NAME - 1, bytes + i * NAME);
    if (status == SB_OK) status = read_array(file, "body_report", "UInt8", 1, 1, n, bytes, error);
    for (size_t i = 0; status == SB_OK && i < n; i++) frame->bodies[i].report = bytes[i] != 0;
    if (status == SB_OK) status = read_vectors(file, "body_displacement", n, vectors, error);
    for (size_t i = 0; status == SB_OK && i < n; i++) frame->bodies[i].displacement = vector_at(vectors, i);
    if (status == SB_OK) status = read_vectors(file, "body_force", n, vectors, error);
    for (size_t i = 0; status == SB_OK && i < n; i++) frame->bodies[i].force = vector_at(vectors, i);
    if (status == SB_OK) status = read_vectors(file, "body_moment", n, vectors, error);
    for (size_t i = 0; status == SB_OK && i < n; i++) frame->bodies[i].moment = vector_at(vectors, i);
    sb_free(vectors);
    sb_free(bytes);
    return status;
}

/* A double that must be a whole number from 0 to 2^53. */
static bool to_count(double value, uint64_t *count)
{
    if (!(value >= 0 && value <= 9007199254740992.0) || value != floor(value)) return false;
    *count = (uint64_t)value;
    return true;
}

static sb_status read_fields(source *file, sb_frame *frame, sb_error *error)
{
    double origin[3], values[SB_VTP_STATUS_COUNT];
    sb_status status = read_array(file, "origin", "Float64", 8, 3, 1, origin, error);
    if (status == SB_OK) status = read_array(file, "spacing", "Float64", 8, 1, 1, &frame->spacing, error);
    if (status == SB_OK) status = read_array(file, "status", "Float64", 8, SB_VTP_STATUS_COUNT, 1, values, error);
    if (status != SB_OK) return status;
    frame->origin = vector_at(origin, 0);
    sb_frame_status *now = &frame->status;
    uint64_t iterations;
    if (!sb_isfinite(frame->origin) || !isfinite(frame->spacing) || !(frame->spacing > 0) ||
        !to_count(values[SB_VTP_STEP], &now->step) || !isfinite(values[SB_VTP_TIME]) ||
        !to_count(values[SB_VTP_LOST], &now->lost_particles) || !to_count(values[SB_VTP_INDEX], &frame->index) ||
        !to_count(values[SB_VTP_ITERATIONS], &iterations) || iterations > INT32_MAX)
        return damaged(file, error, "invalid values in its field data");
    now->time = values[SB_VTP_TIME];
    now->duration = values[SB_VTP_DURATION];
    now->time_step = values[SB_VTP_TIME_STEP];
    now->iterations = (int)iterations;
    now->density_error = values[SB_VTP_DENSITY_ERROR];
    now->max_speed = values[SB_VTP_MAX_SPEED];
    now->wall_seconds = values[SB_VTP_WALL];
    now->eta_seconds = values[SB_VTP_ETA];
    for (size_t k = 0; k < SB_VTP_STATUS_COUNT; k++)
        if (!isfinite(values[k])) return damaged(file, error, "a status value that is not a finite number");
    return SB_OK;
}

static bool all_finite(const float *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i])) return false;
    return true;
}

/* Rendering and tables require finite numbers. */
static sb_status check_numbers(const source *file, const sb_frame *frame, sb_error *error)
{
    if (!all_finite(frame->position, 3 * frame->count) || !all_finite(frame->velocity, 3 * frame->count) ||
        !all_finite(frame->pressure, frame->count))
        return damaged(file, error, "particles whose position, velocity or pressure is not finite");
    if (frame->density_error && !all_finite(frame->density_error, frame->count))
        return damaged(file, error, "particles whose density error is not finite");
    if (!all_finite(frame->face_pressure, frame->face_count))
        return damaged(file, error, "a face whose pressure is not finite");
    for (size_t b = 0; b < frame->body_count; b++) {
        const sb_frame_body *body = &frame->bodies[b];
        if (!sb_isfinite(body->displacement) || !sb_isfinite(body->force) || !sb_isfinite(body->moment))
            return damaged(file, error, "a body whose displacement, force or moment is not finite");
    }
    return SB_OK;
}

/* Only runs whose cameras show it write it. */
static sb_status read_density_error(source *file, sb_frame *frame, sb_error *error)
{
    if (!strstr(file->header, "Name=\"density_error\"")) return SB_OK;
    if (!sb_frame_add_density_error(frame)) return sb_fail_memory(error, file->path);
    return read_array(file, "density_error", "Float32", 4, 1, file->points, frame->density_error, error);
}

/* Only runs whose pictures show them write them. */
static sb_status read_faces(source *file, sb_frame *frame, sb_error *error)
{
    uint64_t faces = 0;
    if (!strstr(file->header, "Name=\"face_pressure\"")) return SB_OK;
    sb_status status = find_array(file, "face_pressure", "Float32", 4, 1, &faces, error);
    if (status == SB_OK && faces > MAX_FACES) status = damaged(file, error, "too many faces of bodies");
    if (status != SB_OK) return status;
    if (!sb_frame_add_faces(frame, faces)) return sb_fail_memory(error, file->path);
    return read_array(file, "face_pressure", "Float32", 4, 1, faces, frame->face_pressure, error);
}

static sb_status read_frame(source *file, sb_frame **frame, sb_error *error)
{
    uint64_t bodies = 0;
    sb_status status = SB_OK;
    if (strstr(file->header, "Name=\"body_name\""))
        status = find_array(file, "body_name", "UInt8", 1, sizeof(*frame)->bodies->name, &bodies, error);
    if (status == SB_OK && bodies > MAX_BODIES) status = damaged(file, error, "too many bodies");
    if (status != SB_OK) return status;
    sb_frame *made = sb_frame_create(file->points, bodies);
    if (!made) return sb_fail_memory(error, file->path);
    status = read_fields(file, made, error);
    if (status == SB_OK) status = read_bodies(file, made, error);
    if (status == SB_OK) status = read_faces(file, made, error);
    if (status == SB_OK) status = read_points(file, made->origin, made->position, error);
    if (status == SB_OK) status = read_array(file, "velocity", "Float32", 4, 3, file->points, made->velocity, error);
    if (status == SB_OK) status = read_array(file, "pressure", "Float32", 4, 1, file->points, made->pressure, error);
    if (status == SB_OK) status = read_array(file, "id", "UInt32", 4, 1, file->points, made->id, error);
    if (status == SB_OK) status = read_density_error(file, made, error);
    if (status == SB_OK) status = check_numbers(file, made, error);
    if (status != SB_OK)
        sb_frame_release(made);
    else
        *frame = made;
    return status;
}

static sb_status read_foam(source *file, sb_frame *frame, sb_error *error)
{
    const uint64_t n = file->points;
    if (sb_frame_add_foam(frame, n) != 0) return sb_fail_memory(error, file->path);
    sb_frame_foam *foam = &frame->foam;
    sb_status status = read_points(file, frame->origin, foam->position, error);
    if (status == SB_OK) status = read_array(file, "velocity", "Float32", 4, 3, n, foam->velocity, error);
    if (status == SB_OK) status = read_array(file, "life", "Float32", 4, 1, n, foam->life, error);
    if (status == SB_OK) status = read_array(file, "id", "UInt32", 4, 1, n, foam->id, error);
    if (status == SB_OK) status = read_array(file, "kind", "UInt8", 1, 1, n, foam->kind, error);
    if (status != SB_OK) return status;
    if (!all_finite(foam->position, 3 * n) || !all_finite(foam->velocity, 3 * n) || !all_finite(foam->life, n))
        return damaged(file, error, "foam whose position, velocity or life is not finite");
    for (uint64_t p = 0; p < n; p++)
        if (foam->kind[p] >= SB_FOAM_KINDS) return damaged(file, error, "foam of an unknown kind");
    return SB_OK;
}

sb_status sb_vtp_read_foam(const char *path, sb_frame *frame, sb_error *error)
{
    source file = {.path = path};
    sb_status status = sb_input_open(path, &file.stream, error);
    if (status != SB_OK) return status;
    status = read_header(&file, error);
    if (status == SB_OK) status = read_foam(&file, frame, error);
    sb_free(file.header);
    fclose(file.stream);
    return status;
}

sb_status sb_vtp_read(const char *path, sb_frame **frame, sb_error *error)
{
    source file = {.path = path};
    sb_status status = sb_input_open(path, &file.stream, error);
    if (status != SB_OK) return status;
    status = read_header(&file, error);
    if (status == SB_OK) status = read_frame(&file, frame, error);
    sb_free(file.header);
    fclose(file.stream);
    return status;
}
