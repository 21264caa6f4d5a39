/* The token, its signatures, signed messages, and what the receiver passes to the run. */
#include "check.h"

#include "base/file.h"
#include "base/random.h"
#include "control/message.h"
#include "control/receiver.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { RUN = 77, TEXT = 32 }; /* TEXT: offset of the command in a message */

static sb_token token;
static int reading, writing;
static sb_receiver *receiver;

static int begin(void **state)
{
    (void)state;
    int ends[2];
    signal(SIGPIPE, SIG_IGN);
    for (int i = 0; i < SB_TOKEN_BYTES; i++) token.bytes[i] = (unsigned char)(7 * i + 200);
    if (pipe2(ends, O_NONBLOCK) != 0) return -1;
    reading = ends[0];
    writing = ends[1];
    return sb_receiver_create(&token, RUN, 0, writing, &receiver, NULL) == SB_OK ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    sb_receiver_destroy(receiver);
    close(reading);
    close(writing);
    return 0;
}

typedef struct message {
    size_t size;
    unsigned char bytes[SB_COMMAND_MESSAGE_MAX];
} message;

static message made(const sb_token *by, int64_t run, int64_t counter, const char *text)
{
    message m;
    sb_error error = {0};
    if (sb_command_encode(by, run, counter, text, m.bytes, &m.size, &error) != SB_OK) fail_msg("%s", error.text);
    return m;
}

/* From a block of exactly that size. */
static sb_status give(const message *m, sb_error *error)
{
    unsigned char *exact = malloc(m->size ? m->size : 1);
    memcpy(exact, m->bytes, m->size);
    const sb_status status = sb_receiver_take_message(receiver, exact, m->size, error);
    free(exact);
    return status;
}

static void refused(message m, const char *reason)
{
    sb_error error = {0};
    sb_command command;
    assert_int_equal(give(&m, &error), SB_BAD_INPUT);
    if (!strstr(error.text, reason)) fail_msg("\"%s\" does not contain \"%s\"", error.text, reason);
    assert_int_equal(read(reading, &command, sizeof command), -1); /* the run learns nothing of it */
}

static sb_command next(void)
{
    sb_command command;
    assert_int_equal(read(reading, &command, sizeof command), sizeof command);
    assert_true(sb_command_is_valid(&command));
    return command;
}

static void empty_pipe(void)
{
    sb_command command;
    while (read(reading, &command, sizeof command) > 0) {
    }
}

/* ---- the token ---- */

static void the_signature_is_that_of_rfc_4231(void **state)
{
    (void)state;
    /* Test cases 1 and 2. A key that is shorter than a block is continued with zeros, by HMAC and here. */
    static const struct {
        const char *key, *data, *digest;
    } cases[] = {
        {"\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b\x0b", "Hi There",
         "b0344c61d8db38535ca8afceaf0bf12b881dc200c9833da726e9376c2e32cff7"},
        {"Jefe", "what do ya want for nothing?", "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        sb_token key = {{0}};
        unsigned char signature[SB_SIGNATURE_BYTES];
        char text[2 * SB_SIGNATURE_BYTES + 1];
        memcpy(key.bytes, cases[i].key, strlen(cases[i].key));
        assert_int_equal(sb_token_sign(&key, cases[i].data, strlen(cases[i].data), signature), SB_OK);
        for (int b = 0; b < SB_SIGNATURE_BYTES; b++) snprintf(text + 2 * b, 3, "%02x", signature[b]);
        assert_string_equal(text, cases[i].digest);
    }
}

static void a_token_is_private(void **state)
{
    (void)state;
    char folder[] = "/tmp/sb-token-XXXXXX", path[64], text[80];
    sb_token one, two, read_back;
    sb_error error = {0};
    struct stat found;
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/" SB_TOKEN_FILE, folder);
    assert_int_equal(sb_token_read(path, &one, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "cannot open"));
    const mode_t before = umask(0);
    assert_int_equal(sb_token_make(path, &one, &error), SB_OK);
    umask(before);
    assert_int_equal(stat(path, &found), 0);
    assert_int_equal(found.st_mode & 07777, 0600);
    assert_int_equal(sb_token_read(path, &read_back, &error), SB_OK);
    assert_memory_equal(&one, &read_back, sizeof one);
    assert_int_equal(sb_token_make(path, &two, &error), SB_OK);
    assert_memory_not_equal(&one, &two, sizeof one);
    const size_t length = sb_file_start(path, text, sizeof text);
    assert_int_equal(length, SB_TOKEN_DIGITS + 1);
    assert_true(sb_token_matches(&two, text, SB_TOKEN_DIGITS));
    assert_false(sb_token_matches(&one, text, SB_TOKEN_DIGITS));
    assert_false(sb_token_matches(&two, text, SB_TOKEN_DIGITS - 1));
    assert_false(sb_token_matches(&two, text, length));
    assert_int_equal(chmod(path, 0640), 0);
    assert_int_equal(sb_token_read(path, &read_back, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "has mode 0640, expected 0600"));
    assert_int_equal(chmod(path, 0600), 0);
    assert_int_equal(truncate(path, 63), 0);
    assert_int_equal(sb_token_read(path, &read_back, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "expected a token of 64 hexadecimal digits"));
    unlink(path);
    assert_int_equal(symlink("/dev/zero", path), 0);
    assert_int_equal(sb_token_read(path, &read_back, &error), SB_BAD_INPUT);
    assert_int_equal(sb_token_make(path, &one, &error), SB_OK); /* replaces the link, not what it points to */
    assert_int_equal(lstat(path, &found), 0);
    assert_true(S_ISREG(found.st_mode));
    unlink(path);
    rmdir(folder);
}

/* ---- messages ---- */

static void a_signed_command_is_passed_once(void **state)
{
    (void)state;
    const message step = made(&token, RUN, 10, "{\"do\":\"step\",\"steps\":3,\"id\":5}");
    assert_int_equal(give(&step, NULL), SB_OK);
    const sb_command command = next();
    assert_int_equal(command.kind, SB_COMMAND_STEP);
    assert_int_equal(command.count, 3);
    assert_int_equal(command.id, 5);
    assert_int_equal(command.counter, 10);
    refused(step, "counter");
    refused(made(&token, RUN, 9, "{\"do\":\"pause\"}"), "counter");
    const message later = made(&token, RUN, 11, "{\"do\":\"pause\"}");
    assert_int_equal(give(&later, NULL), SB_OK);
    assert_int_equal(next().kind, SB_COMMAND_PAUSE);
    const sb_received counts = sb_receiver_count(receiver);
    assert_int_equal(counts.obeyed, 2);
    assert_int_equal(counts.replayed, 2);
    assert_int_equal(counts.malformed + counts.foreign + counts.flooded, 0);
}

static void foreign_messages_are_refused(void **state)
{
    (void)state;
    sb_token other = token;
    other.bytes[31] ^= 1;
    refused(made(&other, RUN, 10, "{\"do\":\"stop\"}"), "signature");
    refused(made(&token, RUN + 1, 10, "{\"do\":\"stop\"}"), "another run");
    message changed = made(&token, RUN, 10, "{\"do\":\"step\",\"steps\":1}");
    changed.bytes[TEXT + 21] = '9';
    refused(changed, "signature");
    for (size_t bit = 8 * 12; bit < 8 * changed.size; bit++) { /* any bit after fingerprint and version */
        message m = made(&token, RUN, 10, "{\"do\":\"stop\"}");
        if (bit >= 8 * m.size) break;
        m.bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        assert_int_equal(give(&m, NULL), SB_BAD_INPUT);
    }
    assert_int_equal(sb_receiver_count(receiver).obeyed, 0);
    assert_true(sb_receiver_count(receiver).foreign > 100);
    const message good = made(&token, RUN, 10, "{\"do\":\"stop\"}");
    assert_int_equal(give(&good, NULL), SB_OK);
}

static void malformed_messages_are_refused(void **state)
{
    (void)state;
    const message good = made(&token, RUN, 10, "{\"do\":\"stop\"}");
    for (size_t size = 0; size < good.size; size++) {
        message shorter = good;
        shorter.size = size;
        assert_int_equal(give(&shorter, NULL), SB_BAD_INPUT);
    }
    message longer = good;
    longer.bytes[longer.size++] = 0;
    refused(longer, "left over");
    static const unsigned char lengths[][4] = {{0}, {0xff, 0xff, 0xff, 0xff}, {0x7f, 0xff, 0xff, 0xff}, {0, 0, 4, 2}};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        message bad = good;
        memcpy(bad.bytes + TEXT - 4, lengths[i], 4);
        refused(bad, "refused");
    }
    for (uint64_t i = 0; i < 20000; i++) {
        message bad = good;
        bad.size = i % 2 ? bad.size : (size_t)(sb_random(1, 9 * i) * SB_COMMAND_MESSAGE_MAX);
        for (size_t b = i % 2 ? 8 : 0; b < bad.size; b++)
            bad.bytes[b] = (unsigned char)(256 * sb_random(2, 2000 * i + b));
        assert_int_equal(give(&bad, NULL), SB_BAD_INPUT);
    }
    assert_int_equal(sb_receiver_count(receiver).malformed, good.size + 5 + 20000);
    assert_int_equal(give(&good, NULL), SB_OK);
}

/* The sender of a signed message with a fault learns the fault from the run. */
static void a_signed_fault_is_reported(void **state)
{
    (void)state;
    sb_error error = {0};
    const message bad = made(&token, RUN, 10, "{\"do\":\"step\",\"steps\":-3}");
    assert_int_equal(give(&bad, &error), SB_BAD_INPUT);
    const sb_command command = next();
    assert_int_equal(command.kind, SB_COMMAND_BAD);
    assert_int_equal(command.counter, 10);
    assert_string_equal(command.name, "steps: -3, expected a whole number from 1 to 1000000000");
    assert_int_equal(sb_receiver_count(receiver).malformed, 1);
    refused(bad, "counter");
}

static void requests_are_passed(void **state)
{
    (void)state;
    sb_error error = {0};
    int64_t id = 0;
    static const char pause[] = "{\"do\":\"pause\"}", fault[] = "{\"do\":\"rate\",\"rate\":-1}";
    assert_int_equal(sb_receiver_take_json(receiver, pause, strlen(pause), &id, &error), SB_OK);
    assert_true(id > 0);
    const sb_command command = next();
    assert_int_equal(command.kind, SB_COMMAND_PAUSE);
    assert_true(command.id == id);
    assert_int_equal(sb_receiver_take_json(receiver, fault, strlen(fault), &id, &error), SB_BAD_INPUT);
    assert_string_equal(error.text, "rate: -1, expected a number from 0 to 1000");
    sb_receiver_count_foreign(receiver);
    const sb_received counts = sb_receiver_count(receiver);
    assert_int_equal(counts.obeyed, 1);
    assert_int_equal(counts.malformed, 1);
    assert_int_equal(counts.foreign, 1);
}

/* ---- floods ---- */

static void a_flood_is_cut(void **state)
{
    (void)state;
    size_t passed = 0;
    for (int64_t i = 1; i <= 10000; i++) {
        const message m = made(&token, RUN, i, "{\"do\":\"checkpoint\"}");
        passed += give(&m, NULL) == SB_OK;
    }
    assert_in_range(passed, SB_RECEIVER_BURST, SB_RECEIVER_BURST + 4 * SB_RECEIVER_RATE);
    const sb_received counts = sb_receiver_count(receiver);
    assert_int_equal(counts.obeyed, passed);
    assert_int_equal(counts.flooded, 10000 - passed);
    empty_pipe();
    for (int64_t i = 1; i <= 100; i++) { /* a fault is counted once, also in a flood */
        const message m = made(&token, RUN, 10000 + i, "{}");
        give(&m, NULL);
    }
    assert_int_equal(sb_receiver_count(receiver).malformed, 100);
    assert_int_equal(sb_receiver_count(receiver).flooded, counts.flooded);
    empty_pipe();
    refused(made(&token, RUN, 9999, "{\"do\":\"checkpoint\"}"), "counter"); /* one that was cut */
}

static void a_full_pipe_does_not_block(void **state)
{
    (void)state;
    static const char pause[] = "{\"do\":\"pause\"}";
    const char zeros[4096] = {0};
    int64_t id;
    sb_error error = {0};
    while (write(writing, zeros, sizeof zeros) > 0) {
    }
    assert_int_equal(sb_receiver_take_json(receiver, pause, strlen(pause), &id, &error), SB_FAILED);
    assert_int_equal(sb_receiver_count(receiver).flooded, 1);
    assert_true(sb_receiver_serve(receiver, true));
}

/* ---- reports to the run ---- */

static void counts_are_reported(void **state)
{
    (void)state;
    sb_command command;
    assert_true(sb_receiver_serve(receiver, false)); /* nothing has changed */
    assert_int_equal(read(reading, &command, sizeof command), -1);
    refused(made(&token, RUN + 1, 10, "{\"do\":\"stop\"}"), "another run");
    assert_true(sb_receiver_serve(receiver, false));
    command = next();
    assert_int_equal(command.kind, SB_COMMAND_COUNTS);
    assert_near(command.number[2], 1, 0);
    refused(made(&token, RUN + 1, 10, "{\"do\":\"stop\"}"), "another run");
    assert_true(sb_receiver_serve(receiver, false)); /* not yet a second later */
    assert_int_equal(read(reading, &command, sizeof command), -1);
    assert_true(sb_receiver_serve(receiver, true));
    assert_near(next().number[2], 2, 0);
    sb_receiver_report_loss(receiver, 0.25);
    command = next();
    assert_int_equal(command.kind, SB_COMMAND_LOSS);
    assert_near(command.number[0], 0.25, 0);
    close(reading);
    assert_false(sb_receiver_serve(receiver, false));
}

/* Subscribers that have the token report what they lost. */
static void a_signed_loss_is_passed(void **state)
{
    (void)state;
    sb_token other = token;
    other.bytes[0] ^= 1;
    const message loss = made(&token, RUN, 10, "{\"do\":\"loss\",\"lost\":0.125}"),
                  forged = made(&other, RUN, 11, "{\"do\":\"loss\",\"lost\":1}");
    assert_int_equal(give(&loss, NULL), SB_OK);
    const sb_command command = next();
    assert_int_equal(command.kind, SB_COMMAND_LOSS);
    assert_near(command.number[0], 0.125, 0);
    refused(forged, "signature");
}

/* A child that is killed, even within the receiver, leaves its counter to the one that replaces it. */
static void a_child_continues_with_the_counter(void **state)
{
    (void)state;
    const message first = made(&token, RUN, 10, "{\"do\":\"pause\"}"),
                  second = made(&token, RUN, 11, "{\"do\":\"stop\"}");
    for (int killed = 0; killed < 20; killed++) {
        const uint64_t before = sb_receiver_count(receiver).malformed;
        const pid_t child = fork();
        if (child == 0) {
            give(&first, NULL);
            for (;;) sb_receiver_count_malformed(receiver);
        }
        while (sb_receiver_count(receiver).malformed == before) usleep(200); /* until it has taken the message */
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
    }
    empty_pipe();
    refused(first, "counter");
    assert_int_equal(give(&second, NULL), SB_OK);
    assert_int_equal(sb_receiver_count(receiver).obeyed, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_signature_is_that_of_rfc_4231),
        cmocka_unit_test(a_token_is_private),
        cmocka_unit_test_setup_teardown(a_signed_command_is_passed_once, begin, end),
        cmocka_unit_test_setup_teardown(foreign_messages_are_refused, begin, end),
        cmocka_unit_test_setup_teardown(malformed_messages_are_refused, begin, end),
        cmocka_unit_test_setup_teardown(a_signed_fault_is_reported, begin, end),
        cmocka_unit_test_setup_teardown(requests_are_passed, begin, end),
        cmocka_unit_test_setup_teardown(a_flood_is_cut, begin, end),
        cmocka_unit_test_setup_teardown(a_full_pipe_does_not_block, begin, end),
        cmocka_unit_test_setup_teardown(counts_are_reported, begin, end),
        cmocka_unit_test_setup_teardown(a_signed_loss_is_passed, begin, end),
        cmocka_unit_test_setup_teardown(a_child_continues_with_the_counter, begin, end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
