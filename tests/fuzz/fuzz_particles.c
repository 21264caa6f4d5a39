/* Fuzzes a particle file. An input that begins with 'e' is a sequence of edits to a valid file, one that begins with
   'f' a sequence of edits to a valid file of foam, one with 'g' to a valid grid file; one that begins with 'p' is a
   list of pieces beside a valid piece; any other input is the file itself. A frame that is read must have finite
   numbers, and must not change when it is written and read again. */
#include "fuzz.h"

#include "base/file.h"
#include "base/memory.h"
#include "output/maps/vti.h"
#include "output/particles/pvtp.h"
#include "output/particles/vtp.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static char *valid, *valid_foam;
static size_t length, foam_length;

static void make_valid(void)
{
    char path[SB_PATH_MAX];
    sb_frame *frame = sb_frame_create(3, 2);
    FUZZ_CHECK(frame);
    frame->spacing = 0.5;
    frame->origin = sb_vec(100, -50, 2);
    frame->status = (sb_frame_status){.step = 7, .time = 1.5, .duration = 9, .time_step = 0.01};
    for (size_t i = 0; i < 9; i++) frame->position[i] = (float)i;
    snprintf(frame->bodies[0].name, sizeof frame->bodies[0].name, "reactor");
    frame->bodies[1].force = sb_vec(1e6, 0, 0);
    FUZZ_CHECK(sb_frame_add_faces(frame, 2));
    frame->face_pressure[0] = 1000;
    frame->face_pressure[1] = 2000;
    snprintf(path, sizeof path, "%s", fuzz_save("valid.vtp", NULL, 0));
    FUZZ_CHECK(sb_vtp_write(path, frame, frame->index, NULL) == SB_OK);
    FUZZ_CHECK(sb_file_read(path, 1 << 20, &valid, &length, NULL) == SB_OK);
    FUZZ_CHECK(sb_frame_add_foam(frame, 4) == 0);
    memset(frame->foam.position, 0, 4 * 3 * sizeof(float));
    memset(frame->foam.velocity, 0, 4 * 3 * sizeof(float));
    for (uint32_t i = 0; i < 4; i++) {
        frame->foam.life[i] = 0.25f * (float)i;
        frame->foam.id[i] = i;
        frame->foam.kind[i] = (uint8_t)(i % SB_FOAM_KINDS);
    }
    FUZZ_CHECK(sb_vtp_write_foam(path, frame, NULL) == SB_OK);
    FUZZ_CHECK(sb_file_read(path, 1 << 20, &valid_foam, &foam_length, NULL) == SB_OK);
    sb_frame_release(frame);
}

/* Foam that is read has finite numbers and known kinds. */
static void try_foam(const uint8_t *data, size_t size)
{
    uint8_t *file = malloc(foam_length);
    sb_frame *frame = sb_frame_create(0, 0);
    sb_error error = {0};
    FUZZ_CHECK(file && frame);
    memcpy(file, valid_foam, foam_length);
    fuzz_edit(file, foam_length, data, size);
    const sb_status status = sb_vtp_read_foam(fuzz_save("some.vtp", file, foam_length), frame, &error);
    free(file);
    if (status != SB_OK) fuzz_check_refusal(status, &error);
    for (size_t i = 0; status == SB_OK && i < 3 * frame->foam.count; i++)
        FUZZ_CHECK(isfinite(frame->foam.position[i]) && isfinite(frame->foam.velocity[i]));
    for (size_t i = 0; status == SB_OK && i < frame->foam.count; i++)
        FUZZ_CHECK(isfinite(frame->foam.life[i]) && frame->foam.kind[i] < SB_FOAM_KINDS);
    sb_frame_release(frame);
}

static void check_finite(const sb_frame *frame)
{
    for (size_t i = 0; i < 3 * frame->count; i++)
        FUZZ_CHECK(isfinite(frame->position[i]) && isfinite(frame->velocity[i]));
    for (size_t i = 0; i < frame->count; i++) FUZZ_CHECK(isfinite(frame->pressure[i]));
    for (size_t f = 0; f < frame->face_count; f++) FUZZ_CHECK(isfinite(frame->face_pressure[f]));
    for (size_t b = 0; b < frame->body_count; b++)
        FUZZ_CHECK(sb_isfinite(frame->bodies[b].force) && sb_isfinite(frame->bodies[b].moment) &&
                   memchr(frame->bodies[b].name, 0, sizeof frame->bodies[b].name));
    FUZZ_CHECK(frame->spacing > 0 && isfinite(frame->spacing) && isfinite(frame->status.time));
}

static void check_again(const sb_frame *frame)
{
    char path[SB_PATH_MAX];
    sb_frame *again = NULL;
    snprintf(path, sizeof path, "%s", fuzz_save("again.vtp", NULL, 0));
    FUZZ_CHECK(sb_vtp_write(path, frame, frame->index, NULL) == SB_OK);
    FUZZ_CHECK(sb_vtp_read(path, &again, NULL) == SB_OK);
    FUZZ_CHECK(again->count == frame->count && again->body_count == frame->body_count);
    FUZZ_CHECK(again->index == frame->index && again->status.step == frame->status.step);
    FUZZ_CHECK(memcmp(again->velocity, frame->velocity, 12 * frame->count) == 0);
    FUZZ_CHECK(memcmp(again->pressure, frame->pressure, 4 * frame->count) == 0);
    FUZZ_CHECK(memcmp(again->id, frame->id, 4 * frame->count) == 0);
    FUZZ_CHECK(again->face_count == frame->face_count);
    FUZZ_CHECK(frame->face_count == 0 ||
               memcmp(again->face_pressure, frame->face_pressure, 4 * frame->face_count) == 0);
    sb_frame_release(again);
}

/* A grid that is read has as many values as its numbers of cells say. */
static void try_grid(const uint8_t *data, size_t size)
{
    static const float bed[6] = {-1, -2, -3, -1, -2, 0.5f}, velocity[18] = {1, 0, 0, 2};
    const sb_vti_array arrays[] = {{"bed", 1, bed}, {"velocity", 3, velocity}};
    const sb_vti image = {2.5, 3, 2, -1, 4, 0.5, 2, arrays};
    sb_vti_array wanted[] = {{"bed", 1, NULL}, {"velocity", 3, NULL}};
    char path[SB_PATH_MAX], *file = NULL;
    size_t bytes = 0;
    float *values = NULL;
    sb_vti found = {0};
    sb_error error = {0};
    snprintf(path, sizeof path, "%s", fuzz_save("valid.vti", NULL, 0));
    FUZZ_CHECK(sb_vti_write(path, &image, NULL) == SB_OK);
    FUZZ_CHECK(sb_file_read(path, 1 << 20, &file, &bytes, NULL) == SB_OK);
    fuzz_edit((uint8_t *)file, bytes, data, size);
    const sb_status status =
        sb_vti_read(fuzz_save("some.vti", (uint8_t *)file, bytes), wanted, 2, &found, &values, &error);
    sb_free(file);
    if (status != SB_OK) {
        FUZZ_CHECK(!values);
        fuzz_check_refusal(status, &error);
        return;
    }
    volatile float last = wanted[1].values[3 * found.columns * found.rows - 1];
    (void)last;
    FUZZ_CHECK(found.cell > 0 && isfinite(found.x) && isfinite(found.time));
    FUZZ_CHECK(size > 0 || (found.columns == 3 && found.rows == 2 && wanted[1].values[3] == 2));
    sb_free(values);
}

/* A list of pieces leads only to pieces beside it; the one that exists has three particles. */
static void try_pieces(const uint8_t *data, size_t size)
{
    char path[SB_PATH_MAX], beside[SB_PATH_MAX];
    sb_frame *frame = NULL, *piece = NULL;
    sb_error error = {0};
    snprintf(path, sizeof path, "%s", fuzz_save("some.pvtp", data, size));
    sb_path_folder(beside, path);
    FUZZ_CHECK(sb_vtp_read(fuzz_save("valid.vtp", (const uint8_t *)valid, length), &piece, NULL) == SB_OK);
    FUZZ_CHECK(sb_pvtp_write_piece(beside, 0, piece, 1, NULL) == SB_OK);
    sb_frame_release(piece);
    const sb_status status = sb_pvtp_read(path, &frame, &error);
    if (status != SB_OK) {
        FUZZ_CHECK(!frame);
        fuzz_check_refusal(status, &error);
        return;
    }
    FUZZ_CHECK(frame->count > 0 && frame->count % 3 == 0);
    check_finite(frame);
    sb_frame_release(frame);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (!valid) make_valid();
    if (size > 0 && data[0] == 'p') {
        try_pieces(data + 1, size - 1);
        return 0;
    }
    if (size > 0 && data[0] == 'f') {
        try_foam(data + 1, size - 1);
        return 0;
    }
    if (size > 0 && data[0] == 'g') {
        try_grid(data + 1, size - 1);
        return 0;
    }
    const bool edits = size > 0 && data[0] == 'e';
    const size_t bytes = edits ? length : size;
    uint8_t *file = malloc(bytes ? bytes : 1);
    FUZZ_CHECK(file);
    if (bytes) memcpy(file, edits ? (const uint8_t *)valid : data, bytes);
    if (edits) fuzz_edit(file, bytes, data + 1, size - 1);
    sb_frame *frame = NULL;
    sb_error error = {0};
    const sb_status status = sb_vtp_read(fuzz_save("some.vtp", file, bytes), &frame, &error);
    free(file);
    if (status != SB_OK) {
        FUZZ_CHECK(!frame);
        FUZZ_CHECK(!edits || size > 1);
        fuzz_check_refusal(status, &error);
        return 0;
    }
    FUZZ_CHECK(!edits || size > 1 || (frame->face_count == 2 && frame->face_pressure[1] >= 2000));
    check_finite(frame);
    check_again(frame);
    sb_frame_release(frame);
    return 0;
}
