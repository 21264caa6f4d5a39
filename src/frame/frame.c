/* Creates frames, carries them to another time, and counts the references to them. */
#include "frame/frame.h"

#include "base/memory.h"

#include <string.h>

static void free_foam(sb_frame_foam *foam)
{
    sb_free(foam->position);
    sb_free(foam->velocity);
    sb_free(foam->life);
    sb_free(foam->id);
    sb_free(foam->kind);
    *foam = (sb_frame_foam){0};
}

static void destroy(sb_frame *frame)
{
    free_foam(&frame->foam);
    sb_free(frame->position);
    sb_free(frame->velocity);
    sb_free(frame->pressure);
    sb_free(frame->id);
    sb_free(frame->density_error);
    sb_free(frame->face_pressure);
    sb_free(frame->bodies);
    sb_free(frame);
}

sb_frame *sb_frame_create(size_t count, size_t body_count)
{
    /* The product 3 * count is computed here, so the allocator cannot detect its overflow. */
    if (count > SIZE_MAX / (3 * sizeof(float))) return NULL;
    sb_frame *frame = sb_alloc(1, sizeof *frame);
    if (!frame) return NULL;
    frame->count = count;
    frame->body_count = body_count;
    frame->position = sb_alloc_untouched(3 * count, sizeof *frame->position);
    frame->velocity = sb_alloc_untouched(3 * count, sizeof *frame->velocity);
    frame->pressure = sb_alloc_untouched(count, sizeof *frame->pressure);
    frame->id = sb_alloc_untouched(count, sizeof *frame->id);
    frame->bodies = sb_alloc(body_count, sizeof *frame->bodies);
    if (!frame->position || !frame->velocity || !frame->pressure || !frame->id || !frame->bodies) {
        destroy(frame);
        return NULL;
    }
    frame->references = 1;
    return frame;
}

int sb_frame_add_foam(sb_frame *frame, size_t count)
{
    sb_frame_foam foam = {.count = count};
    if (count > SIZE_MAX / (3 * sizeof(float))) return -1;
    foam.position = sb_alloc_untouched(3 * count, sizeof *foam.position);
    foam.velocity = sb_alloc_untouched(3 * count, sizeof *foam.velocity);
    foam.life = sb_alloc_untouched(count, sizeof *foam.life);
    foam.id = sb_alloc_untouched(count, sizeof *foam.id);
    foam.kind = sb_alloc_untouched(count, sizeof *foam.kind);
    if (!foam.position || !foam.velocity || !foam.life || !foam.id || !foam.kind) {
        free_foam(&foam);
        return -1;
    }
    frame->foam = foam;
    return 0;
}

bool sb_frame_add_density_error(sb_frame *frame)
{
    frame->density_error = sb_alloc_untouched(frame->count, sizeof *frame->density_error);
    return frame->density_error != NULL;
}

bool sb_frame_add_faces(sb_frame *frame, size_t count)
{
    frame->face_pressure = sb_alloc_untouched(count, sizeof *frame->face_pressure);
    frame->face_count = frame->face_pressure ? count : 0;
    return frame->face_pressure != NULL;
}

/* A copy of an array with room for more. NULL if memory runs out. */
static void *longer(const void *from, size_t count, size_t more, size_t size)
{
    void *made = sb_alloc_untouched(count + more, size);
    if (made) memcpy(made, from, count * size);
    return made;
}

int sb_frame_extend(sb_frame *frame, size_t more)
{
    const size_t n = frame->count;
    if (more > SIZE_MAX / (3 * sizeof(float)) - n) return -1;
    float *position = longer(frame->position, 3 * n, 3 * more, sizeof *position);
    float *velocity = longer(frame->velocity, 3 * n, 3 * more, sizeof *velocity);
    float *pressure = longer(frame->pressure, n, more, sizeof *pressure);
    uint32_t *id = longer(frame->id, n, more, sizeof *id);
    float *error = frame->density_error ? longer(frame->density_error, n, more, sizeof *error) : NULL;
    const bool made = position && velocity && pressure && id && (error || !frame->density_error);
    sb_free(made ? frame->position : position);
    sb_free(made ? frame->velocity : velocity);
    sb_free(made ? frame->pressure : pressure);
    sb_free(made ? frame->id : id);
    sb_free(made ? frame->density_error : error);
    if (!made) return -1;
    if (error) memset(error + n, 0, more * sizeof *error);
    frame->density_error = error;
    frame->position = position;
    frame->velocity = velocity;
    frame->pressure = pressure;
    frame->id = id;
    frame->count = n + more;
    return 0;
}

void sb_frame_carry(sb_frame *frame, double time)
{
    const double dt = time - frame->status.time;
    const float step = (float)dt;
    for (size_t k = 0; k < 3 * frame->count; k++) frame->position[k] += frame->velocity[k] * step;
    for (size_t k = 0; k < 3 * frame->foam.count; k++) frame->foam.position[k] += frame->foam.velocity[k] * step;
    for (size_t b = 0; b < frame->body_count; b++)
        frame->bodies[b].displacement = sb_madd(frame->bodies[b].displacement, dt, frame->bodies[b].velocity);
    frame->status.time = time;
}

sb_vec3 sb_frame_displacement(const sb_frame *frame, size_t index, const char *name)
{
    if (index < frame->body_count && strcmp(frame->bodies[index].name, name) == 0)
        return frame->bodies[index].displacement;
    for (size_t b = 0; b < frame->body_count; b++)
        if (strcmp(frame->bodies[b].name, name) == 0) return frame->bodies[b].displacement;
    return sb_vec(0, 0, 0);
}

/* The reference count is the only part of a published frame that changes, hence the casts. */
const sb_frame *sb_frame_retain(const sb_frame *frame)
{
    if (frame) ((sb_frame *)frame)->references++;
    return frame;
}

void sb_frame_release(const sb_frame *frame)
{
    sb_frame *mutable = (sb_frame *)frame;
    if (mutable && --mutable->references == 0) destroy(mutable);
}
