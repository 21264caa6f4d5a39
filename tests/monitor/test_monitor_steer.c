/* The monitor's commands: signed with the token, sent again until the reply comes, and given up with a message. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "steer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char path[] = "/tmp/sb-token-XXXXXX";
static sb_token token;
static sb_listener *listener;

/* The commands that were received. */
static size_t received;
static unsigned char message[SB_COMMAND_MESSAGE_MAX];
static size_t message_size;

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    (void)user;
    (void)time;
    assert_int_equal(kind, SB_CHANNEL_COMMAND);
    assert_true(size <= sizeof message);
    memcpy(message, data, size);
    message_size = size;
    received++;
}

static int begin(void **unused)
{
    (void)unused;
    const sb_listener_calls calls = {.message = on_message, .commands = true};
    const int file = mkstemp(path);
    if (file < 0) return -1;
    close(file);
    return sb_token_make(path, &token, NULL) != SB_OK ||
           sb_listener_create("memq://", "test", &calls, &listener, NULL) != SB_OK;
}

static int end(void **unused)
{
    (void)unused;
    sb_listener_destroy(listener);
    return unlink(path);
}

/* Checks the newest command: its text, run and signature. */
static void is_signed(const sb_steer *steer, const char *text, int64_t run_id)
{
    sb_command_message got;
    unsigned char signature[SB_SIGNATURE_BYTES];
    assert_int_equal(sb_command_decode(message, message_size, &got, NULL), SB_OK);
    assert_true(got.run_id == run_id && got.counter == steer->counter);
    assert_int_equal(sb_token_sign(&token, got.bytes, got.signed_size, signature), SB_OK);
    assert_true(sb_signature_equal(signature, got.signature));
    char copy[SB_COMMAND_JSON_MAX + 1] = "";
    memcpy(copy, got.text, got.text_size);
    if (!strstr(copy, text)) fail_msg("\"%s\" is not in %s", text, copy);
}

static void commands_are_signed_and_repeated_until_the_reply(void **unused)
{
    (void)unused;
    static const struct {
        sb_action action;
        const char *text;
    } rows[] = {{SB_ACTION_PAUSE, "pause"}, {SB_ACTION_RESUME, "resume"}, {SB_ACTION_STEP, "step"}};
    sb_steer steer = {.token_file = path};
    int64_t before = 0;
    for (size_t i = 0; i < 3; i++) {
        received = 0;
        assert_int_equal(sb_steer_send(&steer, listener, rows[i].action, 77, 100, NULL), SB_OK);
        assert_true(steer.waiting && steer.counter > before);
        before = steer.counter;
        sb_listener_poll(listener, 0.02);
        assert_int_equal(received, 1);
        is_signed(&steer, rows[i].text, 77);
        for (double now = 100; now < 103; now += 0.1)
            assert_int_equal(sb_steer_serve(&steer, listener, now, NULL), SB_OK);
        sb_listener_poll(listener, 0.02);
        assert_int_equal(received, 3); /* again after 0.5 s and after 1.5 s, with the same counter */
        is_signed(&steer, rows[i].text, 77);
        sb_reply_message reply = {.head = {.run_id = 77}, .counter = steer.counter - 1};
        assert_false(sb_steer_reply(&steer, &reply));
        reply.counter++;
        assert_true(sb_steer_reply(&steer, &reply));
        assert_false(sb_steer_reply(&steer, &reply));
        assert_int_equal(sb_steer_serve(&steer, listener, 200, NULL), SB_OK);
        sb_listener_poll(listener, 0.02);
        assert_int_equal(received, 3);
    }
}

static void a_command_without_a_reply_is_given_up(void **unused)
{
    (void)unused;
    sb_error error = {0};
    sb_steer steer = {.token_file = path};
    assert_int_equal(sb_steer_send(&steer, listener, SB_ACTION_PAUSE, 77, 100, NULL), SB_OK);
    assert_int_equal(sb_steer_serve(&steer, listener, 116, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "no reply of the run within 15 s"));
    assert_int_equal(sb_steer_serve(&steer, listener, 117, &error), SB_OK);
    sb_listener_poll(listener, 0.02);
}

static void losses_are_reported_every_two_seconds(void **unused)
{
    (void)unused;
    sb_steer steer = {.token_file = path}, none = {0};
    sb_live_counts count = {.messages = 1000, .refused = 7, .foreign = 3, .lost = 500};
    received = 0;
    sb_steer_report(&steer, listener, 77, &count, 100); /* what was lost before is not counted */
    count.messages += 100;
    count.refused += 5;
    count.foreign += 20; /* 75 of the run's */
    count.lost += 25;
    sb_steer_report(&steer, listener, 77, &count, 101.9);
    sb_listener_poll(listener, 0.02);
    assert_int_equal(received, 0);
    sb_steer_report(&steer, listener, 77, &count, 102.1);
    sb_listener_poll(listener, 0.02);
    assert_int_equal(received, 1);
    sb_command_message got;
    assert_int_equal(sb_command_decode(message, message_size, &got, NULL), SB_OK);
    steer.counter = got.counter;
    is_signed(&steer, "{\"do\":\"loss\",\"lost\":0.250000}", 77);
    sb_steer_report(&steer, listener, 77, &count, 105); /* nothing came */
    count.restarts++;
    count.messages += 10;
    sb_steer_report(&steer, listener, 78, &count, 108); /* another run */
    sb_steer_report(&none, listener, 77, &count, 100);
    count.messages += 10;
    sb_steer_report(&none, listener, 77, &count, 110);
    sb_listener_poll(listener, 0.02);
    assert_int_equal(received, 1);
    sb_steer_report(&steer, listener, 78, &count, 111);
    sb_listener_poll(listener, 0.02);
    assert_int_equal(received, 2);
    assert_int_equal(sb_command_decode(message, message_size, &got, NULL), SB_OK);
    steer.counter = got.counter;
    is_signed(&steer, "\"lost\":0.000000", 78);
}

static void what_is_missing_is_named(void **unused)
{
    (void)unused;
    sb_error error = {0};
    sb_steer none = {0}, early = {.token_file = path}, absent = {.token_file = "/nonexistent/control.token"},
             other = {.run = "/nonexistent"};
    received = 0;
    assert_int_equal(sb_steer_send(&none, listener, SB_ACTION_STEP, 77, 0, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "the monitor with --run RUN_DIR"));
    assert_int_equal(sb_steer_send(&early, listener, SB_ACTION_STEP, -1, 0, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "no run is seen yet"));
    assert_int_equal(sb_steer_send(&absent, listener, SB_ACTION_STEP, 77, 0, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "/nonexistent/control.token"));
    assert_int_equal(sb_steer_send(&other, listener, SB_ACTION_STEP, 77, 0, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "/nonexistent"));
    sb_listener_poll(listener, 0.02);
    assert_int_equal(received, 0);
    assert_false(none.waiting || early.waiting || absent.waiting || other.waiting);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(commands_are_signed_and_repeated_until_the_reply),
        cmocka_unit_test(a_command_without_a_reply_is_given_up),
        cmocka_unit_test(losses_are_reported_every_two_seconds),
        cmocka_unit_test(what_is_missing_is_named),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
