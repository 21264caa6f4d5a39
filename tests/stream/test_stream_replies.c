/* Replies to commands arrive once, in their order, and the generated decoder agrees. */
#include "stream_fixture.h"

#include "shorebreak_reply_t.h"

enum { MOST = 2 * SB_STREAM_REPLIES_WAITING };

static struct {
    size_t count, compared;
    sb_reply_message replies[MOST];
} all;

static void on_reply(void *user, const sb_reply_message *message)
{
    (void)user;
    assert_true(all.count < MOST);
    all.replies[all.count++] = *message;
}

static void compare(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)channel;
    (void)user;
    shorebreak_reply_t other;
    sb_reply_message own;
    assert_int_equal(shorebreak_reply_t_decode(received->data, 0, (int)received->data_size, &other),
                     received->data_size);
    assert_int_equal(sb_stream_decode_reply(received->data, received->data_size, &own, NULL), SB_OK);
    assert_int_equal(other.run_id, own.head.run_id);
    assert_int_equal(other.sequence, own.head.sequence);
    assert_int_equal(other.id, own.id);
    assert_int_equal(other.counter, own.counter);
    assert_int_equal(other.result, own.refused);
    assert_int_equal(other.step, own.step);
    assert_true(other.time == own.time);
    shorebreak_reply_t_decode_cleanup(&other);
    all.compared++;
}

static sb_reply_message reply_of(int64_t id)
{
    sb_reply_message reply = {.id = id, .counter = 10 * id, .refused = id % 2 == 0, .step = 5 * id, .time = 0.25};
    snprintf(reply.text, sizeof reply.text, "reply %lld", (long long)id);
    return reply;
}

static void replies_arrive(void **state)
{
    (void)state;
    const sb_live_calls calls = {.reply = on_reply};
    sb_live *live = sb_live_create(&calls);
    sb_stream *stream = fixture_stream("memq://", 1, 1);
    fixture_follow(stream, live);
    lcm_subscription_set_queue_capacity(lcm_subscribe(sb_stream_provider(stream), "test_reply", compare, NULL), MOST);
    sb_reply_message long_one = reply_of(3);
    memset(long_one.text, 'x', sizeof long_one.text - 1);
    long_one.text[0] = '\xc3';
    const sb_reply_message sent[] = {reply_of(1), reply_of(2), long_one, reply_of(SB_STREAM_RUN_MAX / 10)};
    for (size_t i = 0; i < 3; i++) sb_stream_reply(stream, &sent[i]);
    sb_stream_serve(stream);
    sb_stream_serve(stream);
    sb_stream_reply(stream, &sent[3]);
    sb_stream_finish(stream);
    fixture_drain(stream);
    assert_int_equal(all.count, 4);
    assert_int_equal(all.compared, 4);
    for (size_t i = 0; i < all.count; i++) {
        assert_int_equal(all.replies[i].id, sent[i].id);
        assert_int_equal(all.replies[i].counter, sent[i].counter);
        assert_int_equal(all.replies[i].refused, sent[i].refused);
        assert_int_equal(all.replies[i].step, sent[i].step);
        if (i != 2) assert_string_equal(all.replies[i].text, sent[i].text);
    }
    assert_int_equal(strlen(all.replies[2].text), SB_STREAM_TEXT - 1);
    assert_int_equal(all.replies[2].text[0], '?');
    assert_int_equal(sb_live_count(live).lost + sb_live_count(live).refused, 0);
    sb_live_destroy(live);
    sb_stream_destroy(stream);
}

/* A provider that blocks keeps replies waiting: those beyond the limit are counted. */
static void too_many_replies_are_counted(void **state)
{
    (void)state;
    sb_stream *stream = fixture_stream("memq://", 1, 1);
    const sb_reply_message reply = reply_of(1);
    for (int i = 0; i < SB_STREAM_REPLIES_WAITING + 7; i++) sb_stream_reply(stream, &reply);
    assert_int_equal(sb_stream_count(stream).errors, 7);
    sb_stream_destroy(stream);
}

static void the_channel_of_commands_has_a_name(void **state)
{
    (void)state;
    sb_channel channel, channels[SB_CHANNELS];
    sb_error error;
    assert_int_equal(sb_channel_name_command(NULL, channel, &error), SB_OK);
    assert_string_equal(channel, "shorebreak_command");
    assert_int_equal(sb_channels_name(NULL, channels, &error), SB_OK);
    assert_int_equal(sb_channel_find("shorebreak_reply", (const sb_channel *)channels), SB_CHANNEL_REPLY);
    assert_int_equal(sb_channel_find(channel, (const sb_channel *)channels),
                     SB_CHANNELS); /* a run does not send on it */
    assert_int_equal(sb_channel_guess(channel), SB_CHANNELS);
    char prefix[64];
    memset(prefix, 'p', sizeof prefix - 1);
    prefix[63] = 0;
    assert_int_equal(sb_channel_name_command(prefix, channel, &error), SB_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(replies_arrive), cmocka_unit_test(too_many_replies_are_counted),
                                       cmocka_unit_test(the_channel_of_commands_has_a_name)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
