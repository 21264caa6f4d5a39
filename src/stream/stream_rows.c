/* Keeps the rows of forces and gauges until the stream's thread sends them. */
#include "stream/stream_state.h"

#include "base/memory.h"

#include "shorebreak_forces_t.h"
#include "shorebreak_gauges_t.h"

#include <math.h>
#include <string.h>

/* Appends rows; returns the number that did not fit. */
static size_t append(void **rows, size_t *count, size_t *capacity, const void *more, size_t added, size_t size)
{
    if (added == 0) return 0;
    if (*count + added > SB_STREAM_ROWS_WAITING || sb_grow(rows, capacity, *count + added, size) != 0) return added;
    memcpy((char *)*rows + *count * size, more, added * size);
    *count += added;
    return 0;
}

void sb_stream_measure(sb_stream *stream, const sb_measure_records *records)
{
    if (!stream->scene || records->force_count + records->gauge_count == 0) return;
    sb_stream_rows *to = &stream->waiting;
    pthread_mutex_lock(&stream->lock);
    void *forces = to->forces, *gauges = to->gauges;
    size_t dropped = append(&forces, &to->force_count, &to->force_capacity, records->forces, records->force_count,
                            sizeof *to->forces);
    dropped += append(&gauges, &to->gauge_count, &to->gauge_capacity, records->gauges, records->gauge_count,
                      sizeof *to->gauges);
    to->forces = forces;
    to->gauges = gauges;
    pthread_mutex_unlock(&stream->lock);
    stream->row_errors += dropped;
}

/* The generated types take plain pointers, and their encoders do not write through them. */
static char *text(const char *constant)
{
    return (char *)(uintptr_t)constant;
}

static void send_forces(sb_stream *stream, const sb_force_record *rows, size_t total)
{
    char *names[SB_STREAM_ROWS];
    int32_t body[SB_STREAM_ROWS];
    double force[3 * SB_STREAM_ROWS], moment[3 * SB_STREAM_ROWS];
    double pressure[3 * SB_STREAM_ROWS], friction[3 * SB_STREAM_ROWS];
    for (size_t first = 0; first < total; first += SB_STREAM_ROWS) {
        const size_t count = total - first < SB_STREAM_ROWS ? total - first : SB_STREAM_ROWS;
        for (size_t i = 0; i < count; i++) {
            const sb_force_record *row = &rows[first + i];
            names[i] = text(stream->model->bodies[row->body].name);
            body[i] = (int32_t)row->body;
            sb_stream_store(&force[3 * i], row->force);
            sb_stream_store(&moment[3 * i], row->moment);
            sb_stream_store(&pressure[3 * i], row->pressure);
            sb_stream_store(&friction[3 * i], row->friction);
        }
        shorebreak_forces_t message = {
            .version = SB_STREAM_VERSION,
            .run_id = stream->run_id,
            .time = rows[first].time,
            .total = (int32_t)total,
            .first = (int32_t)first,
            .n = (int32_t)count,
            .components = (int32_t)(3 * count),
            .names = names,
            .body = body,
            .force = force,
            .moment = moment,
            .pressure = pressure,
            .friction = friction,
        };
        sb_sender_send(&stream->sender, SB_CHANNEL_FORCES, stream->buffer,
                       shorebreak_forces_t_encode(stream->buffer, 0, sizeof stream->buffer, &message));
    }
}

static void send_gauges(sb_stream *stream, const sb_gauge_record *rows, size_t total)
{
    char *names[SB_STREAM_ROWS];
    int8_t wet[SB_STREAM_ROWS];
    double eta[SB_STREAM_ROWS], z[SB_STREAM_ROWS];
    for (size_t first = 0; first < total; first += SB_STREAM_ROWS) {
        const size_t count = total - first < SB_STREAM_ROWS ? total - first : SB_STREAM_ROWS;
        for (size_t i = 0; i < count; i++) {
            const sb_gauge_record *row = &rows[first + i];
            names[i] = text(stream->scene->measure.gauges[row->gauge].name);
            wet[i] = isfinite(row->z);
            z[i] = wet[i] ? row->z : 0;
            eta[i] = wet[i] && isfinite(row->eta) ? row->eta : 0;
        }
        shorebreak_gauges_t message = {
            .version = SB_STREAM_VERSION,
            .run_id = stream->run_id,
            .time = rows[first].time,
            .total = (int32_t)total,
            .first = (int32_t)first,
            .n = (int32_t)count,
            .names = names,
            .wet = wet,
            .eta = eta,
            .z = z,
        };
        sb_sender_send(&stream->sender, SB_CHANNEL_GAUGES, stream->buffer,
                       shorebreak_gauges_t_encode(stream->buffer, 0, sizeof stream->buffer, &message));
    }
}

void sb_stream_send_rows(sb_stream *stream)
{
    sb_stream_rows *rows = &stream->sending;
    pthread_mutex_lock(&stream->lock);
    const sb_stream_rows taken = stream->waiting;
    stream->waiting = *rows;
    stream->waiting.force_count = stream->waiting.gauge_count = 0;
    pthread_mutex_unlock(&stream->lock);
    *rows = taken;
    /* Rows of one instant follow each other. */
    for (size_t i = 0, end = 0; i < rows->force_count; i = end) {
        while (end < rows->force_count && !(rows->forces[end].time > rows->forces[i].time)) end++;
        send_forces(stream, rows->forces + i, end - i);
    }
    for (size_t i = 0, end = 0; i < rows->gauge_count; i = end) {
        while (end < rows->gauge_count && !(rows->gauges[end].time > rows->gauges[i].time)) end++;
        send_gauges(stream, rows->gauges + i, end - i);
    }
    rows->force_count = rows->gauge_count = 0;
}
