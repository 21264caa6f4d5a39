#include "clients.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/random.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

enum { HEAD = 40, READ = 1 << 16, SLOW = 1000 }; /* HEAD: bytes of a record up to its frame number and run */
#define STOPPED_SECONDS 60                       /* after which the one that does not read joins again */
#define REJOIN 0.5                               /* s between leaving and joining again */

typedef enum role { STOPPED, SLOWLY, WELL } role;

typedef struct client {
    role role;
    bool leaves, joined; /* joined: no frame yet; the first one is as old as it is */
    int socket;          /* -1: not connected */
    double change;       /* s, of sb_clock: when it joins or leaves next */
    double allowed;      /* bytes that the slow one may read */
    /* The answer: headers, then chunks, each a line with its size in hexadecimal digits, its bytes and an empty line.
     */
    unsigned newlines; /* consecutive ones at the end of the headers */
    bool in_body, in_size;
    uint64_t left; /* bytes of the chunk, with the two behind it */
    /* The record: */
    unsigned char head[HEAD];
    size_t filled;
    uint32_t size;
} client;

struct sb_bench_clients {
    int port;
    size_t count;
    double interval, before; /* before: sb_clock at the last read */
    uint64_t draws;
    sb_bench_reception result;
    client *clients;
};

static double random_seconds(sb_bench_clients *c, double least, double most)
{
    return least + (most - least) * sb_random(36, c->draws++);
}

static void leave(client *k)
{
    if (k->socket >= 0) close(k->socket);
    k->socket = -1;
    k->change = sb_clock() + REJOIN;
}

static void join(sb_bench_clients *c, client *k)
{
    static const char request[] = "GET /frames HTTP/1.1\r\nHost: localhost\r\n\r\n";
    const struct sockaddr_in address = {
        .sin_family = AF_INET, .sin_port = htons((uint16_t)c->port), .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    k->socket = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (k->socket < 0 || connect(k->socket, (const struct sockaddr *)&address, sizeof address) != 0 ||
        send(k->socket, request, sizeof request - 1, MSG_NOSIGNAL) < 0) {
        leave(k);
        return;
    }
    fcntl(k->socket, F_SETFL, O_NONBLOCK);
    k->joined = true;
    k->newlines = 0;
    k->in_body = k->in_size = false;
    k->filled = k->size = 0;
    k->left = 0;
    k->change = k->role == STOPPED ? sb_clock() + STOPPED_SECONDS
                : k->leaves        ? sb_clock() + random_seconds(c, 3, 20)
                                   : (double)INFINITY;
    c->result.joins++;
}

sb_status sb_bench_clients_create(int port, size_t count, sb_bench_clients **clients, sb_error *error)
{
    sb_bench_clients *made = sb_alloc(1, sizeof *made);
    client *list = sb_alloc(count, sizeof *list);
    if (!made || !list) {
        sb_free(made);
        sb_free(list);
        return sb_fail_memory(error, "the clients");
    }
    *made =
        (sb_bench_clients){.port = port, .count = count, .interval = INFINITY, .before = sb_clock(), .clients = list};
    for (size_t i = 0; i < count; i++)
        list[i] = (client){.role = i < WELL ? (role)i : WELL,
                           .leaves = i >= WELL && i % 2 == 1,
                           .socket = -1,
                           .change = sb_clock() + random_seconds(made, 0, 2)};
    *clients = made;
    return SB_OK;
}

void sb_bench_clients_destroy(sb_bench_clients *clients)
{
    if (!clients) return;
    for (size_t i = 0; i < clients->count; i++) leave(&clients->clients[i]);
    sb_free(clients->clients);
    sb_free(clients);
}

/* A record is complete. */
static void end_record(sb_bench_clients *c, client *k, const sb_bench_arrivals *arrivals)
{
    double number;
    memcpy(&number, k->head + 24, sizeof number);
    if (memcmp(k->head, "SBF1", 4) != 0) return;
    c->result.frames++;
    const bool first = k->joined;
    k->joined = false;
    const int64_t frame = (int64_t)number;
    const double there = arrivals->time[frame % SB_BENCH_FRAMES];
    if (first || frame > arrivals->newest || frame + 1 < arrivals->newest - SB_BENCH_FRAMES || !(there > 0)) return;
    const double delay = sb_clock() - there;
    if (delay > c->result.latest) c->result.latest = delay;
    c->result.late += delay > c->interval;
}

static void take_record_bytes(sb_bench_clients *c, client *k, const unsigned char *bytes, size_t count,
                              const sb_bench_arrivals *arrivals)
{
    while (count > 0) {
        size_t used = k->size > 0 ? k->size - k->filled : 8 - k->filled;
        if (used > count) used = count;
        for (size_t i = 0; i < used && k->filled + i < HEAD; i++) k->head[k->filled + i] = bytes[i];
        k->filled += used;
        bytes += used;
        count -= used;
        if (k->size == 0 && k->filled == 8) memcpy(&k->size, k->head + 4, sizeof k->size);
        if (k->size == 0 || k->filled < k->size) continue;
        end_record(c, k, arrivals);
        k->filled = k->size = 0;
    }
}

/* One byte of a chunk's size, or of the line's end. */
static void take_size(client *k, unsigned char byte)
{
    if (byte == '\n' && k->in_size) {
        k->in_size = false;
        k->left += 2;
    } else if (byte >= '0' && byte <= '9') {
        k->left = 16 * k->left + (byte - '0');
        k->in_size = true;
    } else if ((byte | 32) >= 'a' && (byte | 32) <= 'f') {
        k->left = 16 * k->left + ((byte | 32) - 'a' + 10U);
        k->in_size = true;
    }
}

static void take_bytes(sb_bench_clients *c, client *k, const unsigned char *bytes, size_t count,
                       const sb_bench_arrivals *arrivals)
{
    for (size_t i = 0; i < count;) {
        if (!k->in_body) {
            k->newlines = bytes[i] == '\n' ? k->newlines + 1 : bytes[i] == '\r' ? k->newlines : 0;
            k->in_body = k->newlines == 2;
            i++;
        } else if (k->in_size || k->left == 0) {
            take_size(k, bytes[i++]);
        } else {
            size_t used = count - i < k->left ? count - i : (size_t)k->left;
            const size_t own = k->left > 2 ? (k->left - 2 < used ? (size_t)k->left - 2 : used) : 0;
            take_record_bytes(c, k, bytes + i, own, arrivals);
            k->left -= used;
            i += used;
        }
    }
}

static void read_one(sb_bench_clients *c, client *k, const sb_bench_arrivals *arrivals)
{
    static unsigned char bytes[READ];
    for (;;) {
        const size_t most = k->role == WELL ? sizeof bytes : (size_t)k->allowed;
        if (most == 0) return;
        const ssize_t got = recv(k->socket, bytes, most < sizeof bytes ? most : sizeof bytes, 0);
        if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
        if (got <= 0) {
            c->result.dropped++;
            leave(k);
            return;
        }
        if (k->role == SLOWLY) {
            k->allowed -= (double)got;
            continue;
        }
        c->result.bytes += (uint64_t)got;
        take_bytes(c, k, bytes, (size_t)got, arrivals);
    }
}

void sb_bench_clients_read(sb_bench_clients *clients, const sb_bench_arrivals *arrivals)
{
    const double now = sb_clock(), passed = now - clients->before;
    clients->before = now;
    for (size_t i = 0; i < clients->count; i++) {
        client *k = &clients->clients[i];
        if (now >= k->change && k->socket >= 0)
            leave(k);
        else if (now >= k->change)
            join(clients, k);
        if (k->socket < 0) continue;
        k->allowed = k->role == SLOWLY ? fmin(k->allowed + SLOW * passed, SLOW) : 0;
        if (k->role != STOPPED) read_one(clients, k, arrivals);
    }
}

void sb_bench_clients_interval(sb_bench_clients *clients, double interval)
{
    clients->interval = interval;
}

sb_bench_reception sb_bench_clients_result(const sb_bench_clients *clients)
{
    return clients->result;
}
