/* Providers that are missing, broken or stalled give an error with the remedy, or are counted. */
#include "stream_fixture.h"

#include "base/clock.h"
#include "stream/listen.h"

#include <sched.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

static sb_status create(const char *url, const char *prefix, sb_error *error)
{
    char copy[256];
    snprintf(copy, sizeof copy, "%s", url);
    sb_stream_settings settings = {.enabled = true, .url = copy, .decimation = 1};
    snprintf(settings.prefix, sizeof settings.prefix, "%s", prefix);
    sb_stream *stream = NULL;
    sb_status status = sb_stream_create(&settings, "run", &stream, error);
    if (status != SB_OK) assert_null(stream);
    sb_stream_destroy(stream);
    return status;
}

static void contains(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("\"%s\" does not contain \"%s\"", text, part);
}

static void bad_urls_give_the_remedy(void **state)
{
    (void)state;
    sb_error error = {0};
    assert_int_equal(create("udpm://999.1.1.1:7667", "", &error), SB_FAILED);
    contains(error.text, "udpm://999.1.1.1:7667");
    contains(error.text, "ip route add 224.0.0.0/4 dev lo");
    static const char *const others[] = {"carrier-pigeon://", "nonsense", "file:///no/such/dir/x?mode=w"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        error = (sb_error){0};
        assert_int_equal(create(others[i], "", &error), SB_FAILED);
        contains(error.text, others[i]);
        contains(error.text, "expected udpm://");
    }
    char prefix[64] = {0};
    memset(prefix, 'p', sizeof prefix - 1);
    assert_int_equal(create("memq://", prefix, &error), SB_BAD_INPUT);
    contains(error.text, "longer than LCM's limit of 63 bytes");
    assert_int_equal(create("memq://", "", &error), SB_OK);
}

static void environment_names_the_default(void **state)
{
    (void)state;
    sb_error error = {0};
    setenv("LCM_DEFAULT_URL", "carrier-pigeon://", 1);
    assert_int_equal(create("", "", &error), SB_FAILED);
    contains(error.text, "carrier-pigeon");
    setenv("LCM_DEFAULT_URL", "memq://", 1);
    assert_int_equal(create("", "", &error), SB_OK);
    unsetenv("LCM_DEFAULT_URL");
}

static void messages_of_lcm_stay_off_stderr(void **state)
{
    (void)state;
    FILE *file = tmpfile();
    fflush(stderr);
    int saved = dup(STDERR_FILENO);
    dup2(fileno(file), STDERR_FILENO);
    sb_error error = {0};
    create("udpm://999.1.1.1:7667", "", &error);
    fprintf(stderr, "still here");
    fflush(stderr);
    dup2(saved, STDERR_FILENO);
    close(saved);
    char text[100] = {0};
    rewind(file);
    assert_non_null(fgets(text, sizeof text, file));
    assert_string_equal(text, "still here");
    contains(error.text, "Bad multicast IP address");
    fclose(file);
}

/* Runs in a network namespace without any route. Returns 77 if the system does not allow one. */
static int without_network(void)
{
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0 && unshare(CLONE_NEWNET) != 0) return 77;
    sb_stream_settings settings = {.decimation = 1};
    sb_stream *stream = NULL;
    sb_error error = {0};
    sb_listener *listener = NULL;
    sb_listener_calls calls = {0};
    return sb_stream_create(&settings, "run", &stream, &error) == SB_FAILED && !stream &&
                   strstr(error.text, "ip link set lo multicast on; ip route add") &&
                   sb_listener_create(NULL, NULL, &calls, &listener, &error) == SB_FAILED &&
                   strstr(error.text, "ip link set lo multicast on; ip route add")
               ? 0
               : 1;
}

static void no_route_gives_the_remedy(void **state)
{
    (void)state;
    pid_t child = fork();
    if (child == 0) _exit(without_network());
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77) skip();
    assert_int_equal(WEXITSTATUS(status), 0);
}

static void refused_messages_are_counted(void **state)
{
    (void)state;
    char path[] = "/tmp/sb-stream-XXXXXX";
    int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
    char url[100];
    snprintf(url, sizeof url, "file://%s?mode=w", path);
    sb_frame *frame = fixture_frame(1, 0, 10, 2);
    sb_stream *stream = fixture_stream(url, 0, 1);
    fixture_publish(stream, frame);
    assert_int_equal(sb_stream_count(stream).messages, 2);
    sb_stream_destroy(stream);
    snprintf(url, sizeof url, "file://%s?mode=r", path); /* a log that is open for reading accepts no messages */
    stream = fixture_stream(url, 0, 1);
    fixture_publish(stream, frame);
    sb_stream_counters count = sb_stream_count(stream);
    assert_int_equal(count.errors, 2);
    assert_int_equal(count.messages + count.bytes, 0);
    sb_frame_release(frame);
    sb_stream_destroy(stream);
    unlink(path);
}

static void ignore(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)received;
    (void)channel;
    (void)user;
}

/* Publishes 30 frames of 50 k particles to a subscriber that never handles a message: the pace alone determines the
   duration. */
static void publish_to_stalled(sb_stream *stream)
{
    sb_frame *frame = fixture_frame(1, 0, 50000, 5);
    double start = sb_clock();
    for (int i = 0; i < 30; i++) {
        frame->index++;
        fixture_publish(stream, frame);
    }
    assert_true(sb_clock() - start < 5);
    assert_int_equal(sb_stream_count(stream).errors, 0);
    assert_int_equal(sb_stream_count(stream).messages, 30 * (1 + 8 + 1));
    sb_frame_release(frame);
}

static void stalled_subscriber_in_memory(void **state)
{
    (void)state;
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    lcm_subscribe(sb_stream_provider(stream), ".*", ignore, NULL);
    publish_to_stalled(stream);
    sb_stream_destroy(stream);
}

static void stalled_subscriber_over_udp(void **state)
{
    (void)state;
    const char *url = "udpm://239.255.76.67:27667";
    lcm_t *subscriber = NULL;
    sb_error error = {0};
    if (sb_provider_open(url, &subscriber, &error) != SB_OK) skip(); /* this machine has no multicast route */
    lcm_subscribe(subscriber, ".*", ignore, NULL);
    sb_stream *stream = fixture_stream(url, 0, 1);
    publish_to_stalled(stream);
    sb_stream_destroy(stream);
    lcm_destroy(subscriber);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bad_urls_give_the_remedy),        cmocka_unit_test(environment_names_the_default),
        cmocka_unit_test(messages_of_lcm_stay_off_stderr), cmocka_unit_test(no_route_gives_the_remedy),
        cmocka_unit_test(refused_messages_are_counted),    cmocka_unit_test(stalled_subscriber_in_memory),
        cmocka_unit_test(stalled_subscriber_over_udp),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
