#include "base/file.h"
#include "base/memory.h"
#include "output/particles/vtp.h"
#include "output/particles/vtp_layout.h"

#include <assert.h>
#include <inttypes.h>
#include <string.h>

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the files are little-endian");

/* Produces `count` tuples from `first` on into buffer. */
typedef void (*producer)(const void *source, size_t first, size_t count, void *buffer);

typedef struct array {
    const char *name, *type;
    size_t size, components, tuples; /* size: of one component, bytes */
    const void *source;
    producer produce; /* NULL: source is the data itself */
} array;

enum { BLOCK = 4096, MAX_ARRAYS = 24 };

/* All arrays of a file, in the order of their data. */
typedef struct layout {
    size_t points;
    size_t field_count, point_count, total; /* field data, then point data, then points, verts */
    array arrays[MAX_ARRAYS];
} layout;

static void add(layout *file, array item)
{
    assert(file->total < MAX_ARRAYS);
    file->arrays[file->total++] = item;
}

static void produce_index(const void *source, size_t first, size_t count, void *buffer)
{
    (void)source;
    int32_t *out = buffer;
    for (size_t i = 0; i < count; i++) out[i] = (int32_t)(first + i);
}

static void produce_next(const void *source, size_t first, size_t count, void *buffer)
{
    produce_index(source, first + 1, count, buffer);
}

/* Places relative to an origin. */
typedef struct places {
    sb_vec3 origin;
    const float *position;
} places;

static void produce_points(const void *source, size_t first, size_t count, void *buffer)
{
    const places *from = source;
    const float *at = from->position + 3 * first;
    double *out = buffer;
    for (size_t i = 0; i < count; i++, at += 3, out += 3) {
        out[0] = from->origin.x + (double)at[0];
        out[1] = from->origin.y + (double)at[1];
        out[2] = from->origin.z + (double)at[2];
    }
}

static size_t array_bytes(const array *item)
{
    return item->size * item->components * item->tuples;
}

static void write_tag(FILE *stream, const array *item, bool field, uint64_t *offset)
{
    fprintf(stream, "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%zu\"", item->type, item->name,
            item->components);
    if (field) fprintf(stream, " NumberOfTuples=\"%zu\"", item->tuples);
    fprintf(stream, " format=\"appended\" offset=\"%" PRIu64 "\"/>\n", *offset);
    *offset += sizeof(uint64_t) + array_bytes(item);
}

static void write_header(FILE *stream, const layout *file)
{
    const array *at = file->arrays;
    uint64_t offset = 0;
    fputs(SB_VTP_HEAD "<PolyData>\n<FieldData>\n", stream);
    for (size_t i = 0; i < file->field_count; i++) write_tag(stream, at++, true, &offset);
    fprintf(stream,
            "</FieldData>\n<Piece NumberOfPoints=\"%zu\" NumberOfVerts=\"%zu\" "
            "NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData>\n",
            file->points, file->points);
    for (size_t i = 0; i < file->point_count; i++) write_tag(stream, at++, false, &offset);
    fputs("</PointData>\n<Points>\n", stream);
    write_tag(stream, at++, false, &offset);
    fputs("</Points>\n<Verts>\n", stream);
    write_tag(stream, at++, false, &offset);
    write_tag(stream, at++, false, &offset);
    fputs("</Verts>\n</Piece>\n</PolyData>\n" SB_VTP_APPENDED, stream);
}

static void write_data(FILE *stream, const array *item, void *buffer)
{
    uint64_t bytes = array_bytes(item);
    fwrite(&bytes, sizeof bytes, 1, stream);
    if (!item->produce) {
        if (bytes) fwrite(item->source, 1, bytes, stream);
        return;
    }
    for (size_t first = 0; first < item->tuples; first += BLOCK) {
        size_t count = item->tuples - first < BLOCK ? item->tuples - first : BLOCK;
        item->produce(item->source, first, count, buffer);
        fwrite(buffer, item->size * item->components, count, stream);
    }
}

static sb_status write_file(const char *path, const layout *file, sb_error *error)
{
    if (file->points > INT32_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: has %zu points, expected at most %d", path, file->points,
                       INT32_MAX);
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    void *buffer = sb_alloc(BLOCK, 3 * sizeof(double));
    if (!buffer) {
        sb_atomic_abort(&out);
        return sb_fail_memory(error, path);
    }
    write_header(out.stream, file);
    for (size_t i = 0; i < file->total; i++) write_data(out.stream, &file->arrays[i], buffer);
    fputs("\n</AppendedData>\n</VTKFile>\n", out.stream);
    sb_free(buffer);
    return sb_atomic_commit(&out, 0, error);
}

/* The three arrays at the end of every file. */
static void add_geometry(layout *file, const void *source, producer produce)
{
    add(file, (array){"Points", "Float64", 8, 3, file->points, source, produce});
    add(file, (array){"connectivity", "Int32", 4, 1, file->points, NULL, produce_index});
    add(file, (array){"offsets", "Int32", 4, 1, file->points, NULL, produce_next});
}

/* The bodies' records as one array per quantity. */
typedef struct body_columns {
    double *displacement, *force, *moment;
    uint8_t *report;
    char *names;
} body_columns;

static void free_columns(body_columns *columns)
{
    sb_free(columns->displacement);
    sb_free(columns->force);
    sb_free(columns->moment);
    sb_free(columns->report);
    sb_free(columns->names);
}

static void put_vector(double *out, size_t i, sb_vec3 v)
{
    out[3 * i] = v.x;
    out[3 * i + 1] = v.y;
    out[3 * i + 2] = v.z;
}

static sb_status make_columns(const sb_frame *frame, body_columns *columns, sb_error *error)
{
    size_t n = frame->body_count;
    columns->displacement = sb_alloc(n, 3 * sizeof(double));
    columns->force = sb_alloc(n, 3 * sizeof(double));
    columns->moment = sb_alloc(n, 3 * sizeof(double));
    columns->report = sb_alloc(n, 1);
    columns->names = sb_alloc(n, sizeof frame->bodies->name);
    if (!columns->displacement || !columns->force || !columns->moment || !columns->report || !columns->names)
        return sb_fail_memory(error, "bodies of a particle file");
    for (size_t i = 0; i < n; i++) {
        const sb_frame_body *body = &frame->bodies[i];
        put_vector(columns->displacement, i, body->displacement);
        put_vector(columns->force, i, body->force);
        put_vector(columns->moment, i, body->moment);
        columns->report[i] = body->report;
        snprintf(columns->names + i * sizeof body->name, sizeof body->name, "%s", body->name);
    }
    return SB_OK;
}

static void add_bodies(layout *file, const sb_frame *frame, const body_columns *columns)
{
    size_t n = frame->body_count;
    if (n == 0) return;
    add(file, (array){"body_name", "UInt8", 1, sizeof frame->bodies->name, n, columns->names, NULL});
    add(file, (array){"body_report", "UInt8", 1, 1, n, columns->report, NULL});
    add(file, (array){"body_displacement", "Float64", 8, 3, n, columns->displacement, NULL});
    add(file, (array){"body_force", "Float64", 8, 3, n, columns->force, NULL});
    add(file, (array){"body_moment", "Float64", 8, 3, n, columns->moment, NULL});
}

sb_status sb_vtp_write(const char *path, const sb_frame *frame, uint64_t index, sb_error *error)
{
    const sb_frame_status *now = &frame->status;
    const double origin[3] = {frame->origin.x, frame->origin.y, frame->origin.z};
    const double status_values[SB_VTP_STATUS_COUNT] = {
        [SB_VTP_STEP] = (double)now->step,     [SB_VTP_TIME] = now->time,
        [SB_VTP_DURATION] = now->duration,     [SB_VTP_TIME_STEP] = now->time_step,
        [SB_VTP_ITERATIONS] = now->iterations, [SB_VTP_DENSITY_ERROR] = now->density_error,
        [SB_VTP_MAX_SPEED] = now->max_speed,   [SB_VTP_WALL] = now->wall_seconds,
        [SB_VTP_ETA] = now->eta_seconds,       [SB_VTP_LOST] = (double)now->lost_particles,
        [SB_VTP_INDEX] = (double)index,
    };
    body_columns columns = {0};
    sb_status status = make_columns(frame, &columns, error);
    if (status == SB_OK) {
        layout file = {.points = frame->count};
        add(&file, (array){"TimeValue", "Float64", 8, 1, 1, &now->time, NULL});
        add(&file, (array){"origin", "Float64", 8, 3, 1, origin, NULL});
        add(&file, (array){"spacing", "Float64", 8, 1, 1, &frame->spacing, NULL});
        add(&file, (array){"status", "Float64", 8, SB_VTP_STATUS_COUNT, 1, status_values, NULL});
        add_bodies(&file, frame, &columns);
        if (frame->face_count > 0)
            add(&file, (array){"face_pressure", "Float32", 4, 1, frame->face_count, frame->face_pressure, NULL});
        file.field_count = file.total;
        add(&file, (array){"velocity", "Float32", 4, 3, frame->count, frame->velocity, NULL});
        add(&file, (array){"pressure", "Float32", 4, 1, frame->count, frame->pressure, NULL});
        add(&file, (array){"id", "UInt32", 4, 1, frame->count, frame->id, NULL});
        if (frame->density_error)
            add(&file, (array){"density_error", "Float32", 4, 1, frame->count, frame->density_error, NULL});
        file.point_count = file.total - file.field_count;
        const places at = {frame->origin, frame->position};
        add_geometry(&file, &at, produce_points);
        status = write_file(path, &file, error);
    }
    free_columns(&columns);
    return status;
}

sb_status sb_vtp_write_foam(const char *path, const sb_frame *frame, sb_error *error)
{
    const sb_frame_foam *foam = &frame->foam;
    const places at = {frame->origin, foam->position};
    layout file = {.points = foam->count};
    add(&file, (array){"TimeValue", "Float64", 8, 1, 1, &frame->status.time, NULL});
    file.field_count = file.total;
    add(&file, (array){"velocity", "Float32", 4, 3, foam->count, foam->velocity, NULL});
    add(&file, (array){"life", "Float32", 4, 1, foam->count, foam->life, NULL});
    add(&file, (array){"id", "UInt32", 4, 1, foam->count, foam->id, NULL});
    add(&file, (array){"kind", "UInt8", 1, 1, foam->count, foam->kind, NULL});
    file.point_count = file.total - file.field_count;
    add_geometry(&file, &at, produce_points);
    return write_file(path, &file, error);
}

sb_status sb_vtp_write_points(const char *path, size_t count, const sb_vec3 *positions, const sb_vec3 *normals,
                              const int32_t *bodies, sb_error *error)
{
    static_assert(sizeof(sb_vec3) == 3 * sizeof(double), "vectors are written without conversion");
    layout file = {.points = count};
    if (normals) add(&file, (array){"normal", "Float64", 8, 3, count, normals, NULL});
    if (bodies) add(&file, (array){"body", "Int32", 4, 1, count, bodies, NULL});
    file.point_count = file.total;
    add_geometry(&file, positions, NULL);
    return write_file(path, &file, error);
}
