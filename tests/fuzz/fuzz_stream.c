/* Fuzzes LCM messages as a subscriber receives them. The input is a sequence of messages, each preceded by its length
   in two bytes, high byte first. Every message is decoded as each type, and chunks of particles are counted. */
#include "fuzz.h"

#include "stream/assembly.h"

#include <math.h>
#include <string.h>

static void check_name(const char *name)
{
    FUZZ_CHECK(memchr(name, 0, SB_STREAM_NAME));
    for (; *name; ++name) FUZZ_CHECK(*name >= ' ' && *name < 0x7f);
}

static void try_status(const void *bytes, size_t size)
{
    sb_status_message message;
    sb_error error = {0};
    sb_status status = sb_stream_decode_status(bytes, size, &message, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return;
    }
    check_name(message.run);
    FUZZ_CHECK(isfinite(message.time) && isfinite(message.eta_seconds) && message.step >= 0);
}

static void try_forces(const void *bytes, size_t size)
{
    static sb_forces_message message;
    sb_error error = {0};
    sb_status status = sb_stream_decode_forces(bytes, size, &message, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return;
    }
    FUZZ_CHECK(message.first >= 0 && message.count >= 0 && message.count <= SB_STREAM_BODIES);
    FUZZ_CHECK(message.count <= message.total - message.first);
    for (int32_t i = 0; i < message.count; ++i) check_name(message.names[i]);
    for (int32_t i = 0; i < 3 * message.count; ++i)
        FUZZ_CHECK(isfinite(message.force[i]) && isfinite(message.moment[i]) && isfinite(message.displacement[i]));
}

static void try_particles(const void *bytes, size_t size, sb_assembly *assembly)
{
    static sb_particles_message message;
    sb_error error = {0};
    sb_status status = sb_stream_decode_particles(bytes, size, &message, &error);
    if (status != SB_OK) {
        fuzz_check_refusal(status, &error);
        return;
    }
    FUZZ_CHECK(message.count >= 0 && message.count <= SB_STREAM_CHUNK);
    for (int32_t i = 0; i < 3 * message.count; ++i)
        FUZZ_CHECK(isfinite(message.position[i]) && isfinite(message.velocity[i]));
    FUZZ_CHECK(sb_assembly_add(assembly, &message) == SB_OK);
    FUZZ_CHECK(assembly->received <= assembly->chunk_count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sb_assembly assembly = {0};
    while (size > 2) {
        size_t length = (size_t)data[0] << 8 | data[1];
        data += 2;
        size -= 2;
        if (length > size) length = size;
        /* A block of exactly that size, so that a sanitizer detects a read beyond the end. */
        uint8_t *exact = malloc(length ? length : 1);
        FUZZ_CHECK(exact);
        memcpy(exact, data, length);
        try_status(exact, length);
        try_forces(exact, length);
        try_particles(exact, length, &assembly);
        free(exact);
        data += length;
        size -= length;
    }
    sb_assembly_free(&assembly);
    return 0;
}
