/* Clients that read slowly or not at all have no effect on others, and memory stays bounded. */
#include "web_fixture.h"

#include "web/records.h"

#include <malloc.h>

#define HOST "Host: localhost\r\n"
enum { PARTICLES = 60000, SIZE = SB_WEB_RECORD_HEAD + 9 * SB_WEB_RECORD_PART + 8 * PARTICLES };

typedef struct reader {
    int socket;
    char *bytes; /* as received, chunked */
    size_t size, capacity;
    bool ended;
} reader;

static reader join(site *s)
{
    static const char request[] = "GET /frames HTTP/1.1\r\n" HOST "\r\n";
    reader r = {.socket = site_connect(s), .capacity = 64 << 20};
    r.bytes = malloc(r.capacity);
    assert_non_null(r.bytes);
    site_send(s, r.socket, request, sizeof request - 1);
    return r;
}

static void leave(reader *r)
{
    close(r->socket);
    free(r->bytes);
}

/* Reads what is there, at most `most` bytes. */
static void take(reader *r, size_t most)
{
    const ssize_t got =
        recv(r->socket, r->bytes + r->size, most < r->capacity - r->size ? most : r->capacity - r->size, 0);
    if (got > 0)
        r->size += (size_t)got;
    else if (got == 0 || errno != EAGAIN)
        r->ended = true;
}

/* The times of the complete frames that a reader has received; returns their number. */
static size_t times_of(reader *r, double *times, size_t most)
{
    char *body = strstr(r->bytes, "\r\n\r\n");
    if (!body) return 0;
    body += 4;
    bool complete;
    const size_t size = site_unchunk(body, r->size - (size_t)(body - r->bytes), &complete);
    size_t count = 0;
    for (size_t at = 0; at + 8 <= size && count < most;) {
        uint32_t length;
        memcpy(&length, body + at + 4, 4);
        if (at + length > size) break;
        if (memcmp(body + at, "SBF1", 4) == 0) {
            assert_int_equal(length, SIZE);
            memcpy(&times[count++], body + at + 8, 8);
        } else
            assert_memory_equal(body + at, "SBA1", 4);
        at += length;
    }
    return count;
}

/* One reads all, one reads a quarter of what is sent, one stops reading: frames 0.05 s apart, for 4 s. */
static void slow_and_stopped_clients(void **state)
{
    (void)state;
    site s;
    const sb_web_settings settings = {.stalled_seconds = 2};
    site_open(&s, &settings);
    reader fast = join(&s), slow = join(&s), stopped = join(&s);
    enum { FRAMES = 80 };
    double worst = 0;
    size_t seen_by_fast = 0;
    static double times[2 * FRAMES];
    for (int i = 1; i <= FRAMES; i++) {
        sb_frame *frame = fixture_frame((uint64_t)i, i, PARTICLES, 0);
        site_publish(&s, frame);
        sb_frame_release(frame);
        const double sent = sb_clock();
        const size_t before = fast.size;
        while (sb_clock() < sent + 0.05) {
            site_work(&s, 0.002);
            take(&fast, SIZE_MAX);
            if (fast.size - before >= SIZE && seen_by_fast < (size_t)i) {
                seen_by_fast = (size_t)i;
                if (sb_clock() - sent > worst) worst = sb_clock() - sent;
            }
        }
        take(&slow, SIZE / 4);
    }
    site_work(&s, 0.3);
    take(&fast, SIZE_MAX);
    const size_t count = times_of(&fast, times, 2 * FRAMES);
    print_message("the fast client has %zu of %d frames, at most %.1f ms after they came\n", count, FRAMES,
                  1e3 * worst);
    assert_int_equal(count, FRAMES);
    assert_near(times[count - 1], FRAMES, 0);
    const size_t few = times_of(&slow, times, 2 * FRAMES);
    print_message("the slow client has %zu frames, the last of time %g\n", few, few ? times[few - 1] : 0);
    assert_true(few > 5 && few < FRAMES / 2);
    for (size_t k = 1; k < few; k++) assert_true(times[k] > times[k - 1]);
    /* What it reads last left the server a few frames ago: only the buffers of the system are between. */
    assert_true(times[few - 1] > FRAMES - 40);
    for (int i = 0; i < 10 && sb_web_server_count(s.server).streams > 2; i++) site_work(&s, 0.2);
    assert_int_equal(sb_web_server_count(s.server).streams, 2); /* the stopped one has been dropped */
    leave(&fast);
    leave(&slow);
    leave(&stopped);
    site_close(&s);
}

static size_t bytes_in_use(void)
{
    return mallinfo2().uordblks + mallinfo2().hblkhd;
}

static void memory_is_flat(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    sb_frame *frames[4];
    for (uint64_t k = 0; k < 4; k++) frames[k] = fixture_frame(k + 1, (double)k, 5000, 3);
    size_t settled = 0;
    static const char request[] = "GET /frames HTTP/1.1\r\n" HOST "\r\n";
    for (int round = 0; round < 300; round++) {
        frames[round % 4]->index = (uint64_t)round + 1;
        site_publish(&s, frames[round % 4]);
        const int client = site_connect(&s);
        site_send(&s, client, request, sizeof request - 1);
        reply r = site_read(&s, client, round % 2 ? 2000 : 40000, 1);
        free(r.bytes);
        close(client);
        assert_int_equal(site_status(&s, "GET /status", HOST, ""), 200);
        if (round == 100) settled = bytes_in_use();
    }
    site_work(&s, 2.6);
    assert_int_equal(sb_web_server_count(s.server).clients, 0);
    const size_t now = bytes_in_use();
    print_message("%zu bytes after 100 clients, %zu after 300\n", settled, now);
    assert_true(now < settled + 200000);
    for (int k = 0; k < 4; k++) sb_frame_release(frames[k]);
    site_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(slow_and_stopped_clients),
        cmocka_unit_test(memory_is_flat),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
