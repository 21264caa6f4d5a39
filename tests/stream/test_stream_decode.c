/* Decoders with invalid and forged messages. Each message is in a block of exactly its size, so that ASan and UBSan
   detect every read beyond its end. */
#include "captured.h"

#include <math.h>
#include <stdlib.h>

enum { TYPES = SB_CHANNELS, STATUS = SB_CHANNEL_STATUS, FORCES = SB_CHANNEL_FORCES, FRAME = SB_CHANNEL_FRAME };
enum { GAUGES = SB_CHANNEL_GAUGES, PARITY = SB_CHANNEL_PARITY, SCENE = SB_CHANNEL_SCENE, REPLY = SB_CHANNEL_REPLY };
static message scene; /* the encoded scene, which fits into one piece */
/* Offsets of the counts and names in the messages of good[]: after fingerprint, version, run id and sequence. */
enum { VERSION = 8, RUN_ID = 12, BODY = 28 };
enum { STATUS_RUN = BODY, FORCES_TOTAL = BODY + 8, FORCES_N = BODY + 16, FORCES_NAME = BODY + 24 };
enum { GAUGES_N = BODY + 16 };
enum { FRAME_PART = BODY + 24, FRAME_TOTAL = BODY + 32, FRAME_FIRST = BODY + 40, FRAME_MOVED = BODY + 108 };
enum { FRAME_COUNT = FRAME_MOVED + 8 + 28 }; /* one body has moved */
enum { REPLY_ID = BODY, REPLY_RESULT = BODY + 16, REPLY_TIME = BODY + 25, REPLY_TEXT = BODY + 33 };
enum { PARITY_PARTS = BODY + 8, PARITY_GROUP = BODY + 12, PARITY_COUNT = BODY + 20 };
enum { PIECE_TOTAL = BODY + 8, PIECE_PIECE = BODY + 16, PIECE_OFFSET = BODY + 24, PIECE_COUNT = BODY + 32 };

static int capture_all(void **state)
{
    (void)state;
    fixture_scene f;
    sb_stream *stream = captured_stream(&f, 50);
    if (!stream) return -1;
    const message part = good[FRAME];
    sb_frame *frame = fixture_frame(4, 5, 8 * SB_STREAM_POINTS, 4); /* large enough for parity */
    fixture_publish(stream, frame);
    sb_frame_release(frame);
    fixture_drain(stream);
    good[FRAME] = part;
    sb_stream_destroy(stream);
    fixture_scene_free(&f);
    sb_scene_piece_message piece;
    if (sb_stream_decode_piece(good[SCENE].bytes, good[SCENE].size, &piece, NULL) != SB_OK) return -1;
    scene.size = (size_t)piece.count;
    memcpy(scene.bytes, piece.data, scene.size);
    for (int type = 0; type < TYPES; type++)
        if (good[type].size == 0) return -1;
    return piece.piece_count == 1 ? 0 : -1;
}

/* A block of exactly that size. */
static unsigned char *exact_copy(const unsigned char *bytes, size_t size)
{
    unsigned char *exact = malloc(size ? size : 1);
    assert_non_null(exact);
    memcpy(exact, bytes, size);
    return exact;
}

static void check_names(char (*names)[SB_STREAM_NAME], int32_t count)
{
    for (int32_t i = 0; i < count; i++)
        for (const char *at = names[i]; *at; at++) assert_in_range(*at, 0x20, 0x7e);
}

/* Decodes the bytes as `type` from a block of exactly that size, and checks a successful result. */
static sb_status decode(int type, const unsigned char *bytes, size_t size, sb_error *error)
{
    static union {
        sb_status_message status;
        sb_forces_message forces;
        sb_gauges_message gauges;
        sb_frame_message frame;
        sb_parity_message parity;
        sb_scene_piece_message piece;
        sb_reply_message reply;
    } out;
    unsigned char *exact = exact_copy(bytes, size);
    sb_status status = SB_BAD_INPUT;
    if (type == STATUS) {
        status = sb_stream_decode_status(exact, size, &out.status, error);
        if (status == SB_OK) assert_true(isfinite(out.status.time) && strlen(out.status.run) < SB_STREAM_NAME);
    } else if (type == FORCES) {
        status = sb_stream_decode_forces(exact, size, &out.forces, error);
        if (status == SB_OK) check_names(out.forces.names, out.forces.count);
        for (int32_t i = 0; status == SB_OK && i < 3 * out.forces.count; i++)
            assert_true(isfinite(out.forces.force[i]) && isfinite(out.forces.friction[i]));
    } else if (type == GAUGES) {
        status = sb_stream_decode_gauges(exact, size, &out.gauges, error);
        if (status == SB_OK) check_names(out.gauges.names, out.gauges.count);
        for (int32_t i = 0; status == SB_OK && i < out.gauges.count; i++) assert_true(isfinite(out.gauges.z[i]));
    } else if (type == FRAME) {
        status = sb_stream_decode_frame(exact, size, &out.frame, error);
        if (status == SB_OK)
            assert_true(out.frame.points >= exact &&
                        out.frame.points + SB_STREAM_POINT * out.frame.count <= exact + size);
    } else if (type == PARITY) {
        status = sb_stream_decode_parity(exact, size, &out.parity, error);
        if (status == SB_OK) assert_true(out.parity.data + out.parity.count <= exact + size);
    } else if (type == REPLY) {
        status = sb_stream_decode_reply(exact, size, &out.reply, error);
        if (status == SB_OK) assert_true(isfinite(out.reply.time) && strlen(out.reply.text) < SB_STREAM_TEXT);
    } else {
        status = sb_stream_decode_piece(exact, size, &out.piece, error);
        if (status == SB_OK) assert_true(out.piece.data >= exact && out.piece.data + out.piece.count <= exact + size);
    }
    free(exact);
    return status;
}

static sb_status decode_scene(const message *bytes, sb_error *error)
{
    sb_live_scene out;
    unsigned char *exact = exact_copy(bytes->bytes, bytes->size);
    const sb_status status = sb_live_scene_decode(exact, bytes->size, &out, error);
    free(exact);
    for (size_t b = 0; status == SB_OK && b < out.body_count; b++)
        for (size_t c = 0; c < 3 * out.bodies[b].triangle_count; c++)
            assert_in_range(out.bodies[b].corners[c], 0, out.bodies[b].vertex_count - 1);
    if (status == SB_OK) sb_live_scene_free(&out);
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
    memcpy(over, good[FRAME].bytes, good[FRAME].size);
    assert_int_equal(decode(FRAME, over, 1 << 20, NULL), SB_BAD_INPUT);
    free(over);
    refused(STATUS, &large, "fingerprint");
}

static void another_version_is_refused(void **state)
{
    (void)state;
    for (int type = 0; type < TYPES; type++) {
        message other = good[type];
        put32(&other, VERSION, SB_STREAM_VERSION + 1);
        refused(type, &other, "its version is not 2");
        other = good[type];
        put32(&other, RUN_ID, 0x00200000); /* 2^53 and more */
        refused(type, &other, "run id");
    }
}

static void hostile_counts(void **state)
{
    (void)state;
    static const uint32_t counts[] = {0, 1, 5, 51, 7101, 0x7fffffff, 0x80000000, 0xffffffff, 0x55555556, 0xaaaaaaaa};
    static const struct {
        int type;
        size_t at;
        uint32_t each; /* the next number is so many times this one; 0: it is not */
    } places[] = {{STATUS, STATUS_RUN, 0},     {FORCES, FORCES_N, 3},       {FORCES, FORCES_N + 4, 0},
                  {FORCES, FORCES_NAME, 0},    {GAUGES, GAUGES_N, 0},       {FRAME, FRAME_COUNT, 8},
                  {FRAME, FRAME_COUNT + 4, 0}, {FRAME, FRAME_MOVED, 3},     {FRAME, FRAME_MOVED + 4, 0},
                  {FRAME, FRAME_PART + 4, 0},  {FRAME, FRAME_TOTAL, 0},     {FRAME, FRAME_FIRST + 4, 0},
                  {SCENE, PIECE_TOTAL, 0},     {SCENE, PIECE_TOTAL + 4, 0}, {SCENE, PIECE_PIECE, 0},
                  {SCENE, PIECE_PIECE + 4, 0}, {SCENE, PIECE_OFFSET, 0},    {SCENE, PIECE_OFFSET + 4, 0},
                  {SCENE, PIECE_COUNT, 0},     {PARITY, PARITY_COUNT, 0},   {REPLY, REPLY_TEXT, 0}};
    for (size_t p = 0; p < sizeof places / sizeof *places; p++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            message bad = good[places[p].type];
            put32(&bad, places[p].at, counts[c]);
            const bool same = memcmp(&bad, &good[places[p].type], sizeof bad) == 0;
            assert_int_equal(decode(places[p].type, bad.bytes, bad.size, NULL), same ? SB_OK : SB_BAD_INPUT);
            /* Both counts changed consistently: only the size reveals the error. */
            if (places[p].each == 0 || same) continue;
            put32(&bad, places[p].at + 4, places[p].each * counts[c]);
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
    bad.bytes[STATUS_RUN + 4 + strlen("a run") + 1] = 3;
    refused(STATUS, &bad, "its state is not 0, 1 or 2");
    bad = good[STATUS];
    put32(&bad, STATUS_RUN + 4 + strlen("a run") + 1 + 1 + 8, 0x7ff80000); /* time becomes NaN */
    refused(STATUS, &bad, "not finite");
    bad = good[GAUGES];
    put32(&bad, bad.size - 8, 0x7ff00000); /* the last elevation becomes infinite */
    refused(GAUGES, &bad, "not finite");
    bad = good[FRAME];
    put32(&bad, FRAME_MOVED + 8, 0xffffffff);
    refused(FRAME, &bad, "the index of a body is negative");

    bad = good[REPLY];
    bad.bytes[REPLY_RESULT] = 2;
    refused(REPLY, &bad, "its id, counter, step or result");
    bad = good[REPLY];
    put32(&bad, REPLY_ID, 0x80000000);
    refused(REPLY, &bad, "its id, counter, step or result");
    bad = good[REPLY];
    put32(&bad, REPLY_TIME, 0x7ff80000);
    refused(REPLY, &bad, "not finite");

    sb_status_message out;
    bad = good[STATUS];
    memcpy(&bad.bytes[STATUS_RUN + 4], "\x1b[2J\xff", 5);
    assert_int_equal(sb_stream_decode_status(bad.bytes, bad.size, &out, NULL), SB_OK);
    assert_string_equal(out.run, "?[2J?");
}

static void damaged_scenes(void **state)
{
    (void)state;
    sb_error error = {0};
    assert_int_equal(decode_scene(&scene, &error), SB_OK);
    for (size_t size = 0; size < scene.size; size++) {
        const message shorter = scene;
        unsigned char *exact = exact_copy(shorter.bytes, size);
        sb_live_scene out;
        assert_int_equal(sb_live_scene_decode(exact, size, &out, NULL), SB_BAD_INPUT);
        free(exact);
    }
    /* Every aligned and unaligned word as a hostile count: refused, or a value that is not a count. */
    static const uint32_t words[] = {0x7fffffff, 0x80000000, 0xffffffff, 0x00ffffff};
    size_t refusals = 0;
    for (size_t at = 0; at + 4 <= scene.size; at++)
        for (size_t w = 0; w < sizeof words / sizeof *words; w++) {
            message bad = scene;
            put32(&bad, at, words[w]);
            refusals += decode_scene(&bad, NULL) != SB_OK;
        }
    assert_true(refusals > scene.size / 4);
    /* The count of wave makers stands before their names, "piston" and "slide", at the end. */
    const size_t count_at = scene.size - 4 - (4 + 7) - (4 + 6);
    static const uint32_t counts[] = {1, 3, 4, 5, 0x10000000, 0xffffffff};
    message few = scene;
    put32(&few, count_at, 2);
    assert_memory_equal(few.bytes, scene.bytes, scene.size);
    for (size_t w = 0; w < sizeof counts / sizeof *counts; w++) {
        put32(&few, count_at, counts[w]);
        assert_int_equal(decode_scene(&few, NULL), SB_BAD_INPUT);
    }
    for (long n = 1; n <= 13; n++) {
        sb_memory_fail_at(n);
        assert_int_equal(decode_scene(&scene, &error), SB_FAILED);
        sb_memory_fail_at(0);
    }
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
        put32(victim, 8 + 4 * draw(40), draw(2) ? draw(UINT32_MAX) : draw(300));
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
        victim = scene;
        mutate(&victim);
        decode_scene(&victim, NULL);
    }
    /* Flipped bits in plain values are not an error; wrong lengths always are. */
    assert_in_range(accepted, 500, 10000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_messages_pass),
        cmocka_unit_test(truncated_and_padded),
        cmocka_unit_test(another_version_is_refused),
        cmocka_unit_test(hostile_counts),
        cmocka_unit_test(invalid_contents),
        cmocka_unit_test(damaged_scenes),
        cmocka_unit_test(failure_leaves_the_output_unchanged),
        cmocka_unit_test(seeded_mutations),
    };
    return cmocka_run_group_tests(tests, capture_all, NULL);
}
