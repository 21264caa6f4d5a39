/* A flood of invalid and foreign messages on all channels: the monitor on a terminal still takes keys, counts what it
   refuses, and quits. */
#include "publisher_fixture.h"

#include "base/clock.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <pty.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/socket.h>

#define GROUP "239.255.76.70"
enum { PORT = 7674, RATE = 100000, BATCH = 500, POOL = 8, PACKET = 900 };
#define URL "udpm://" GROUP ":7674?ttl=0"

static char output[1 << 20];
static size_t length;

static unsigned char status[PACKET]; /* a valid message */
static size_t status_size;

static void keep_status(const lcm_recv_buf_t *received, const char *channel, void *user)
{
    (void)channel;
    (void)user;
    if (received->data_size > 800) return;
    status_size = received->data_size;
    memcpy(status, received->data, status_size);
}

static void make_status(void)
{
    sb_stream *stream = fixture_stream("memq://", 0, 1);
    lcm_subscribe(sb_stream_provider(stream), "test_status", keep_status, NULL);
    sb_frame *frame = fixture_frame(1, 45, 10, 1);
    fixture_publish(stream, frame);
    fixture_drain(stream);
    sb_frame_release(frame);
    sb_stream_destroy(stream);
    assert_true(status_size > 100);
}

/* Writes a packet of LCM: a random channel, and random bytes or the status of a random run. */
static size_t make_packet(unsigned char packet[PACKET], uint64_t number)
{
    static const char *const channels[] = {"test_status", "test_forces", "test_gauges", "test_frame",
                                           "test_parity", "test_scene",  "test_reply",  "test_command"};
    const uint32_t head[2] = {htonl(0x4c433032), htonl((uint32_t)number)};
    const uint64_t random = (uint64_t)(1e15 * sb_random(5, number));
    const bool valid = random % 4 == 0;
    const char *channel = channels[valid ? 0 : random / 4 % 8];
    memcpy(packet, head, sizeof head);
    size_t size = sizeof head + strlen(channel) + 1;
    memcpy(packet + sizeof head, channel, strlen(channel) + 1);
    memcpy(packet + size, status, status_size);
    if (valid) { /* the run id, below 2^53 */
        for (size_t i = 2; i < 8; i++) packet[size + 12 + i] = (unsigned char)(random >> 8 * (i - 2));
        return size + status_size;
    }
    for (size_t i = 0; i < 40; i++) packet[size + random % 300 + i] = (unsigned char)(random >> i % 40);
    return size + random % status_size;
}

/* Sends RATE messages per second until it is killed. sent: their number so far. */
static pid_t start_flood(_Atomic uint64_t *sent)
{
    const pid_t made = fork();
    if (made != 0) return made;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    static unsigned char packets[POOL * BATCH][PACKET];
    static struct iovec parts[POOL * BATCH];
    static struct mmsghdr messages[POOL * BATCH];
    struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons(PORT)};
    inet_pton(AF_INET, GROUP, &to.sin_addr);
    const int out = socket(AF_INET, SOCK_DGRAM, 0);
    const unsigned char this_host = 0;
    setsockopt(out, IPPROTO_IP, IP_MULTICAST_TTL, &this_host, sizeof this_host);
    for (size_t i = 0; i < POOL * BATCH; i++) {
        parts[i] = (struct iovec){packets[i], make_packet(packets[i], i)};
        messages[i].msg_hdr =
            (struct msghdr){.msg_name = &to, .msg_namelen = sizeof to, .msg_iov = &parts[i], .msg_iovlen = 1};
    }
    uint64_t number = 0;
    for (const double begun = sb_clock();; number += BATCH) {
        const int done = sendmmsg(out, messages + number % (POOL * BATCH), BATCH, 0);
        if (done > 0) *sent += (uint64_t)done;
        const double early = (double)number / RATE - (sb_clock() - begun);
        if (early > 0) usleep((unsigned)(1e6 * early));
    }
}

/* Reads the terminal until `text` appears in what comes from now on. Returns the seconds, or -1 after 10 s. */
static double await_text(int terminal, const char *text)
{
    const size_t from = length;
    const double begun = sb_clock();
    while (sb_clock() < begun + 10) {
        struct pollfd ready = {.fd = terminal, .events = POLLIN};
        if (poll(&ready, 1, 50) <= 0) continue;
        const ssize_t got = read(terminal, output + length, sizeof output - 1 - length);
        if (got <= 0) break;
        length += (size_t)got;
        output[length] = 0;
        if (strstr(output + from, text)) return sb_clock() - begun;
    }
    return -1;
}

static double press(int terminal, const char *key, const char *text)
{
    assert_int_equal(write(terminal, key, strlen(key)), (ssize_t)strlen(key));
    return await_text(terminal, text);
}

static void a_flooded_monitor_takes_keys_and_quits(void **state)
{
    (void)state;
    enum { SECONDS = 3 };
    int start[2], terminal, code = 0;
    if (!fixture_has_route(URL)) skip();
    make_status();
    _Atomic uint64_t *sent = mmap(NULL, sizeof *sent, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    assert_true(sent != MAP_FAILED);
    assert_int_equal(pipe(start), 0);
    const pid_t publisher = fixture_publisher(URL, 1, start[0]);
    struct winsize size = {.ws_row = 24, .ws_col = 80};
    const pid_t monitor = forkpty(&terminal, NULL, NULL, &size);
    if (monitor == 0) {
        setenv("TERM", "xterm", 1);
        execl(SB_BINARY_DIR "/shorebreak-monitor", "shorebreak-monitor", "--prefix", "test", "--url", URL,
              (char *)NULL);
        _exit(127);
    }
    assert_true(monitor > 0 && await_text(terminal, "waiting for a run") >= 0);
    assert_int_equal(write(start[1], "s", 1), 1);
    assert_true(await_text(terminal, "running") >= 0);
    const pid_t flood = start_flood(sent);
    const double begun = sb_clock();
    double slowest = 0;
    bool answered = true;
    while (answered && sb_clock() < begun + SECONDS) {
        const double shown = press(terminal, "?", "scroll by a page");
        const double hidden = press(terminal, "?", "building-0");
        answered = shown >= 0 && hidden >= 0;
        if (shown > slowest) slowest = shown;
        if (hidden > slowest) slowest = hidden;
    }
    const uint64_t flooded = *sent;
    const double seconds = sb_clock() - begun;
    const double quit = press(terminal, "q", "\x1b[?1049l");
    await_text(terminal, "messages lost");
    fixture_kill(flood);
    fixture_kill(publisher);
    if (quit < 0) kill(monitor, SIGKILL);
    waitpid(monitor, &code, 0);
    close(terminal);
    print_message("%.0f messages per second; the slowest key took %.2f s, q %.2f s\n", (double)flooded / seconds,
                  slowest, quit);
    assert_true(answered && quit >= 0);
    assert_true(WIFEXITED(code) && WEXITSTATUS(code) == 0);
    assert_true(slowest < 2 && quit < 2);
    const char *refused = strstr(output, "\x1b[?1049l");
    refused = refused ? strstr(refused, "refused ") : NULL;
    assert_non_null(refused);
    assert_true(strtod(refused + strlen("refused "), NULL) > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_flooded_monitor_takes_keys_and_quits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
