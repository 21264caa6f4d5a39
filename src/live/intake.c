#include "live/intake.h"

#include "stream/decode.h"
#include "stream/guard.h"
#include "stream/listen.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

typedef struct work {
    const sb_live_options *options;
    sb_receiver *receiver;
    int socket;
} work;

/* The socket keeps messages whole: one that a crash cuts off does not arrive. The kind is the first byte. */
static void pass(int socket, sb_channel_kind kind, const void *data, size_t size)
{
    unsigned char message[1 + SB_STREAM_MESSAGE_MAX];
    message[0] = (unsigned char)kind;
    memcpy(message + 1, data, size);
    while (send(socket, message, 1 + size, MSG_NOSIGNAL) < 0 && errno == EINTR) {
    }
}

/* Whether a message is of this run: every message has the run's id behind its fingerprint and version (docs/live.md).
   Other runs may use the same channels. */
static bool is_of_run(const unsigned char *data, size_t size, int64_t run_id)
{
    enum { BEFORE = 12, BYTES = 8 };
    uint64_t id = 0;
    if (run_id < 0) return true;
    if (size < BEFORE + BYTES) return false;
    for (int k = 0; k < BYTES; k++) id = id << 8 | data[BEFORE + k];
    return id == (uint64_t)run_id;
}

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const work *w = user;
    (void)time;
    if (kind == SB_CHANNEL_COMMAND) {
        if (w->receiver) (void)sb_receiver_take_message(w->receiver, data, size, NULL);
    } else if (w->socket >= 0 && size <= SB_STREAM_MESSAGE_MAX && is_of_run(data, size, w->options->run_id))
        pass(w->socket, kind, data, size);
}

static int receive(void *argument)
{
    work *w = argument;
    sb_listener *listener = NULL;
    sb_error error = {0};
    const sb_listener_calls calls = {
        .user = w, .message = on_message, .commands = w->receiver, .only_commands = w->socket < 0};
    if (sb_listener_create(w->options->url, w->options->prefix, &calls, &listener, &error) != SB_OK) {
        fprintf(stderr, "shorebreak-live: %s\n", error.text);
        return 2;
    }
    while (sb_listener_poll(listener, 0.25) == SB_OK)
        if (w->receiver && !sb_receiver_serve(w->receiver, false)) break;
    sb_listener_destroy(listener);
    return 0;
}

static void after_crash(void)
{
    fputs("shorebreak-live: a packet crashed the receiver, which is started again\n", stderr);
}

int sb_intake_work(const sb_live_options *options, sb_receiver *receiver, int socket)
{
    work w = {options, receiver, socket};
    return sb_guard(receive, &w, after_crash);
}

sb_status sb_intake_start(const sb_live_options *options, sb_receiver *receiver, sb_intake *intake, sb_error *error)
{
    int ends[2];
    const pid_t own = getpid();
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
        return sb_fail(error, SB_FAILED, "the system refuses a pair of sockets");
    fflush(NULL);
    const pid_t made = fork();
    if (made == 0) {
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        if (getppid() != own) _exit(1);
        close(ends[0]);
        exit(sb_intake_work(options, receiver, ends[1]));
    }
    close(ends[1]);
    if (made < 0) {
        close(ends[0]);
        return sb_fail(error, SB_FAILED, "the system refuses a process for the receiver");
    }
    *intake = (sb_intake){.process = made, .socket = ends[0]};
    return SB_OK;
}

bool sb_intake_read(sb_intake *intake, int most, sb_intake_take *take, void *user, int *code)
{
    unsigned char bytes[1 + SB_STREAM_MESSAGE_MAX];
    for (int i = 0; i < most && intake->socket >= 0; i++) {
        const ssize_t got = recv(intake->socket, bytes, sizeof bytes, MSG_DONTWAIT);
        if (got > 0 && bytes[0] < SB_CHANNELS)
            take(user, (sb_channel_kind)bytes[0], bytes + 1, (size_t)got - 1);
        else if (got < 0 && (errno == EAGAIN || errno == EINTR))
            break;
        else if (got <= 0) {
            int status = 0;
            close(intake->socket);
            intake->socket = -1;
            while (waitpid(intake->process, &status, 0) < 0 && errno == EINTR) {
            }
            *code = WIFEXITED(status) ? WEXITSTATUS(status) : 2;
            return false;
        }
    }
    return true;
}

void sb_intake_stop(sb_intake *intake)
{
    if (intake->socket < 0) return;
    kill(intake->process, SIGTERM);
    close(intake->socket);
    intake->socket = -1;
    while (waitpid(intake->process, NULL, 0) < 0 && errno == EINTR) {
    }
}
