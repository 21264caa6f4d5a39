/* Decoders with invalid and forged messages. Each message is in a block of exactly its size, so that ASan and UBSan
   detect every read beyond its end. */
#include "stream_fixture.h"

#include "shorebreak_forces_t.h"
#include "shorebreak_particles_t.h"
#include "shorebreak_status_t.h"

#include <math.h>
#include <stdlib.h>

typedef struct message {
    size_t size;
    unsigned char bytes[SB_STREAM_MESSAGE_MAX];
} message;

enum { STATUS, FORCES, PARTICLES, TYPES };
static message good[TYPES];
/* Offsets of the counts and names in the messages of good[]. */
enum { STATUS_RUN = 8, FORCES_TOTAL = 24, FORCES_N = 32, FORCES_NAME = 40 };
enum { PARTICLES_CHUNK = 24, PARTICLES_TOTAL = 32, PARTICLES_FIRST = 40, PARTICLES_COUNT = 84 };

static void capture(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)user;
    message *to = &good[strstr(channel, "status") ? STATUS : strstr(channel, "forces") ? FORCES : PARTICLES];
    to->size = received->data_size;
    memcpy(to->bytes, received->data, received->data_size);
}

static int capture_all(void **state)
{
    (void)state;
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    lcm_subscribe(sb_stream_provider(stream), ".*", capture, NULL);
    sb_frame *frame = fixture_frame(3, 4.5, 50, 4);
    sb_stream_publish(stream, frame);
    sb_frame_release(frame);
    fixture_drain(stream);
    sb_stream_destroy(stream);
    return good[STATUS].size && good[FORCES].size && good[PARTICLES].size ? 0 : -1;
}

/* Decodes the bytes as `type` from a block of exactly that size, and checks a successful result. */
static sb_status decode(int type, const unsigned char *bytes, size_t size, sb_error *error)
{
    static union {
        sb_status_message status;
        sb_forces_message forces;
        sb_particles_message particles;
    } out;
    unsigned char *exact = malloc(size ? size : 1);
    assert_non_null(exact);
    memcpy(exact, bytes, size);
    sb_status status;
    if (type == STATUS) {
        status = sb_stream_decode_status(exact, size, &out.status, error);
        if (status == SB_OK) assert_true(isfinite(out.status.time) && strlen(out.status.run) < SB_STREAM_NAME);
    } else if (type == FORCES) {
        status = sb_stream_decode_forces(exact, size, &out.forces, error);
        for (int32_t i = 0; status == SB_OK && i < 3 * out.forces.count; i++) {
            assert_true(isfinite(out.forces.force[i]) && isfinite(out.forces.moment[i]));
            for (const char *at = out.forces.names[i / 3]; *at; at++) assert_in_range(*at, 0x20, 0x7e);
        }
    } else {
        status = sb_stream_decode_particles(exact, size, &out.particles, error);
        for (int32_t i = 0; status == SB_OK && i < 3 * out.particles.count; i++)
            assert_true(isfinite(out.particles.position[i]) && isfinite(out.particles.velocity[i]));
    }
    free(exact);
    return status;
}

static void refused(int type, const message *bad, const char *reason)
{
    sb_error error = {0};
    assert_int_equal(decode(type, bad->bytes, bad->size, &error), SB_BAD_INPUT);
    if (!strstr(error.text, reason)) fail_msg("\"%s\" does not contain \"%s\"", error.text, reason);
}

static void put32(message *to, size_t at, uint32_t value)
{
    for (size_t i = 0; i < 4; i++) to->bytes[at + i] = (unsigned char)(value >> (24 - 8 * i));
}

static void good_messages_pass(void **state)
{
    (void)state;
    for (int type = 0; type < TYPES; type++)
        for (int as = 0; as < TYPES; as++)
            assert_int_equal(decode(as, good[type].bytes, good[type].size, NULL), as == type ? SB_OK : SB_BAD_INPUT);
}

static void truncated_and_padded(void **state)
{
    (void)state;
    for (int type = 0; type < TYPES; type++) {
        for (size_t size = 0; size < good[type].size; size++)
            assert_int_equal(decode(type, good[type].bytes, size, NULL), SB_BAD_INPUT);
        message longer = good[type];
        longer.bytes[longer.size++] = 0;
        refused(type, &longer, "left over");
    }
    message large = {.size = SB_STREAM_MESSAGE_MAX};
    unsigned char *over = calloc(1, 1 << 20);
    memcpy(over, good[PARTICLES].bytes, good[PARTICLES].size);
    assert_int_equal(decode(PARTICLES, over, 1 << 20, NULL), SB_BAD_INPUT);
    free(over);
    refused(STATUS, &large, "fingerprint");
}

static void hostile_counts(void **state)
{
    (void)state;
    static const uint32_t counts[] = {0, 1, 5, 51, 2140, 0x7fffffff, 0x80000000, 0xffffffff, 0x55555556, 0xaaaaaaaa};
    static const struct {
        int type;
        size_t at;
    } places[] = {{STATUS, STATUS_RUN},
                  {FORCES, FORCES_N},
                  {FORCES, FORCES_N + 4},
                  {FORCES, FORCES_NAME},
                  {PARTICLES, PARTICLES_COUNT},
                  {PARTICLES, PARTICLES_COUNT + 4},
                  {PARTICLES, PARTICLES_CHUNK + 4},
                  {PARTICLES, PARTICLES_TOTAL},
                  {PARTICLES, PARTICLES_FIRST + 4}};
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            message bad = good[places[p].type];
            put32(&bad, places[p].at, counts[c]);
            bool same = memcmp(&bad, &good[places[p].type], sizeof bad) == 0;
            assert_int_equal(decode(places[p].type, bad.bytes, bad.size, NULL), same ? SB_OK : SB_BAD_INPUT);
            /* Both counts changed consistently, three to one: only the size reveals the error. */
            put32(&bad, places[p].at + 4, 3 * counts[c]);
            if (places[p].at == FORCES_N || places[p].at == PARTICLES_COUNT)
                assert_int_equal(decode(places[p].type, bad.bytes, bad.size, NULL), SB_BAD_INPUT);
        }
}

static void invalid_contents(void **state)
{
    (void)state;
    message bad = good[FORCES];
    bad.bytes[FORCES_NAME + 4 + 3] = 0;
    refused(FORCES, &bad, "not terminated by a zero");
    bad = good[STATUS];
    bad.bytes[STATUS_RUN + 4 + strlen("a run")] = 'x';
    refused(STATUS, &bad, "not terminated by a zero");
    bad = good[STATUS];
    put32(&bad, STATUS_RUN + 4 + strlen("a run") + 1 + 8, 0x7ff80000); /* time becomes NaN */
    refused(STATUS, &bad, "not finite");
    bad = good[PARTICLES];
    put32(&bad, bad.size - 4, 0x7f800000); /* the last pressure becomes infinite */
    refused(PARTICLES, &bad, "not finite");

    sb_status_message out;
    bad = good[STATUS];
    memcpy(&bad.bytes[STATUS_RUN + 4], "\x1b[2J\xff", 5);
    assert_int_equal(sb_stream_decode_status(bad.bytes, bad.size, &out, NULL), SB_OK);
    assert_string_equal(out.run, "?[2J?");
}

static void failure_leaves_the_output_unchanged(void **state)
{
    (void)state;
    sb_status_message out, before;
    memset(&out, 0x5a, sizeof out);
    before = out;
    message bad = good[STATUS];
    assert_int_equal(sb_stream_decode_status(bad.bytes, bad.size - 1, &out, NULL), SB_BAD_INPUT);
    assert_memory_equal(&out, &before, sizeof out);
}

static uint64_t draws;
static uint32_t draw(uint32_t below)
{
    return (uint32_t)(sb_random(2024, draws++) * below);
}

static void mutate(message *victim)
{
    switch (draw(4)) {
    case 0: /* flip bits */
        for (uint32_t n = 1 + draw(8); n > 0; n--)
            victim->bytes[draw((uint32_t)victim->size)] ^= (unsigned char)(1u << draw(8));
        break;
    case 1: /* replace an aligned word of the header by a random value */
        put32(victim, 8 + 4 * draw(30), draw(2) ? draw(UINT32_MAX) : draw(300));
        break;
    case 2: /* random bytes of random length after the correct fingerprint */
        victim->size = 8 + draw(600);
        for (size_t i = 8; i < victim->size; i++) victim->bytes[i] = (unsigned char)draw(draw(2) ? 256 : 3);
        break;
    default: /* move a range of bytes, then truncate */
        if (victim->size > 80) memmove(victim->bytes + 8 + draw(30), victim->bytes + 8 + draw(30), victim->size - 80);
        victim->size -= draw((uint32_t)victim->size);
    }
}

static void seeded_mutations(void **state)
{
    (void)state;
    size_t accepted = 0;
    for (int i = 0; i < 20000; i++) {
        int type = i % TYPES;
        message victim = good[type];
        mutate(&victim);
        accepted += decode(type, victim.bytes, victim.size, NULL) == SB_OK;
        decode((int)draw(TYPES), victim.bytes, victim.size, NULL);
    }
    /* Flipped bits in plain values are not an error; wrong lengths always are. */
    assert_in_range(accepted, 500, 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_messages_pass),
        cmocka_unit_test(truncated_and_padded),
        cmocka_unit_test(hostile_counts),
        cmocka_unit_test(invalid_contents),
        cmocka_unit_test(failure_leaves_the_output_unchanged),
        cmocka_unit_test(seeded_mutations),
    };
    return cmocka_run_group_tests(tests, capture_all, NULL);
}
