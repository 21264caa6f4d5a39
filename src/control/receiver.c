#include "control/receiver.h"

#include "base/clock.h"
#include "control/message.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

static const double COUNTS_SECONDS = 1; /* between two reports of the counts */

/* In shared memory. */
struct sb_receiver {
    pthread_mutex_t lock; /* protects the members that change: threads and processes call the receiver */
    bool allowed;
    sb_token token;
    int64_t run_id, counter; /* counter: the highest one so far */
    int pipe;
    bool ended; /* the run reads no more */
    sb_received counts, reported;
    double reported_time; /* sb_clock() when the counts were reported */
    double allowance;     /* commands that may be passed at once */
    double filled;        /* sb_clock() when the allowance was computed */
};

/* A process that was killed may have held the lock. Each value that it leaves is valid. */
static void lock(sb_receiver *receiver)
{
    if (pthread_mutex_lock(&receiver->lock) == EOWNERDEAD) pthread_mutex_consistent(&receiver->lock);
}

static void unlock(sb_receiver *receiver)
{
    pthread_mutex_unlock(&receiver->lock);
}

sb_status sb_receiver_create(const sb_token *token, int64_t run_id, int64_t counter, int pipe, sb_receiver **receiver,
                             sb_error *error)
{
    sb_receiver *made = mmap(NULL, sizeof *made, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    pthread_mutexattr_t kind;
    if (made == MAP_FAILED) return sb_fail_memory(error, "the receiver of commands");
    pthread_mutexattr_init(&kind);
    pthread_mutexattr_setpshared(&kind, PTHREAD_PROCESS_SHARED);
    pthread_mutexattr_setrobust(&kind, PTHREAD_MUTEX_ROBUST);
    pthread_mutex_init(&made->lock, &kind);
    pthread_mutexattr_destroy(&kind);
    made->allowed = token != NULL;
    if (token) made->token = *token;
    made->run_id = run_id;
    made->counter = counter;
    made->pipe = pipe;
    made->allowance = SB_RECEIVER_BURST;
    made->filled = sb_clock();
    made->reported_time = -COUNTS_SECONDS;
    fcntl(pipe, F_SETFL, fcntl(pipe, F_GETFL) | O_NONBLOCK);
    *receiver = made;
    return SB_OK;
}

void sb_receiver_destroy(sb_receiver *receiver)
{
    if (receiver) munmap(receiver, sizeof *receiver);
}

/* ---- to the run; the caller holds the lock ---- */

static bool write_record(sb_receiver *r, const sb_command *command)
{
    ssize_t written;
    do written = write(r->pipe, command, sizeof *command);
    while (written < 0 && errno == EINTR);
    if (written < 0 && errno != EAGAIN) r->ended = true;
    return written == (ssize_t)sizeof *command;
}

static sb_status pass(sb_receiver *r, const sb_command *command, sb_error *error)
{
    const double now = sb_clock();
    r->allowance = fmin(r->allowance + SB_RECEIVER_RATE * (now - r->filled), SB_RECEIVER_BURST);
    r->filled = now;
    if (r->allowance >= 1 && write_record(r, command)) {
        r->allowance--;
        return SB_OK;
    }
    if (r->ended) return sb_fail(error, SB_FAILED, "the run has ended");
    return sb_fail(error, SB_FAILED, "more than %d commands per second, or the run does not read them",
                   SB_RECEIVER_RATE);
}

static sb_status pass_counted(sb_receiver *r, const sb_command *command, sb_error *error)
{
    const sb_status status = pass(r, command, error);
    *(status == SB_OK ? &r->counts.obeyed : &r->counts.flooded) += 1;
    return status;
}

/* ---- messages ---- */

static sb_status refuse_foreign(sb_receiver *r, const char *reason, sb_error *error)
{
    r->counts.foreign++;
    return sb_fail(error, SB_BAD_INPUT, "command message refused: %s", reason);
}

/* A signed message with a faulty command: the run replies to it, so that the sender learns the fault. */
static sb_status pass_fault(sb_receiver *r, int64_t counter, sb_error *fault, sb_error *error)
{
    sb_command bad = {.kind = SB_COMMAND_BAD, .counter = counter};
    r->counts.malformed++;
    snprintf(bad.name, sizeof bad.name, "%.*s", SB_COMMAND_NAME - 1, fault->text);
    (void)pass(r, &bad, NULL);
    return sb_fail(error, SB_BAD_INPUT, "%s", fault->text);
}

static sb_status take_signed(sb_receiver *r, const sb_command_message *message, sb_error *error)
{
    sb_command command;
    sb_error fault;
    if (message->counter <= r->counter) {
        r->counts.replayed++;
        return sb_fail(error, SB_BAD_INPUT, "command message refused: its counter is not above that of an earlier one");
    }
    r->counter = message->counter; /* also of a command that is not passed, so that nobody can send it again later */
    if (sb_command_from_json(message->text, message->text_size, &command, &fault) != SB_OK)
        return pass_fault(r, message->counter, &fault, error);
    command.counter = message->counter;
    return pass_counted(r, &command, error) == SB_OK ? SB_OK : SB_BAD_INPUT;
}

sb_status sb_receiver_take_message(sb_receiver *r, const void *bytes, size_t size, sb_error *error)
{
    sb_command_message message;
    unsigned char signature[SB_SIGNATURE_BYTES];
    sb_status status = sb_command_decode(bytes, size, &message, error);
    const bool decoded = status == SB_OK;
    const bool own = decoded && message.run_id == r->run_id;
    const bool is_signed = own && r->allowed &&
                           sb_token_sign(&r->token, message.bytes, message.signed_size, signature) == SB_OK &&
                           sb_signature_equal(signature, message.signature);
    lock(r);
    if (!decoded)
        r->counts.malformed++;
    else if (!own)
        status = refuse_foreign(r, "it is for another run", error);
    else if (!is_signed)
        status = refuse_foreign(r, "its signature is wrong", error);
    else
        status = take_signed(r, &message, error);
    unlock(r);
    return status;
}

/* ---- requests ---- */

static int64_t draw_id(void)
{
    uint64_t bits = 0;
    if (getrandom(&bits, sizeof bits, GRND_NONBLOCK) != (ssize_t)sizeof bits) bits = (uint64_t)(1e9 * sb_clock());
    return (int64_t)(bits & (uint64_t)SB_COMMAND_ID_MAX);
}

sb_status sb_receiver_take_json(sb_receiver *r, const char *text, size_t size, int64_t *id, sb_error *error)
{
    sb_command command;
    sb_status status = sb_command_from_json(text, size, &command, error);
    if (status == SB_OK && command.id == 0) command.id = draw_id();
    lock(r);
    if (status != SB_OK) {
        r->counts.malformed++;
    } else {
        *id = command.id;
        status = pass_counted(r, &command, error);
    }
    unlock(r);
    return status;
}

void sb_receiver_count_foreign(sb_receiver *r)
{
    lock(r);
    r->counts.foreign++;
    unlock(r);
}

void sb_receiver_count_malformed(sb_receiver *r)
{
    lock(r);
    r->counts.malformed++;
    unlock(r);
}

/* ---- reports ---- */

void sb_receiver_report_loss(sb_receiver *r, double lost)
{
    const sb_command command = {.kind = SB_COMMAND_LOSS, .number = {fmin(fmax(lost, 0), 1)}};
    lock(r);
    (void)write_record(r, &command);
    unlock(r);
}

static void report_counts(sb_receiver *r, double now)
{
    const sb_received *c = &r->counts;
    const sb_command command = {.kind = SB_COMMAND_COUNTS,
                                .number = {(double)c->obeyed, (double)c->malformed, (double)c->foreign,
                                           (double)c->replayed, (double)c->flooded}};
    if (!write_record(r, &command)) return;
    r->reported = r->counts;
    r->reported_time = now;
}

bool sb_receiver_serve(sb_receiver *r, bool last)
{
    const double now = sb_clock();
    struct pollfd reader = {.fd = r->pipe, .events = POLLOUT};
    lock(r);
    if (poll(&reader, 1, 0) > 0 && reader.revents & (POLLERR | POLLNVAL)) r->ended = true;
    const bool changed = memcmp(&r->counts, &r->reported, sizeof r->counts) != 0;
    if (changed && !r->ended && (last || now >= r->reported_time + COUNTS_SECONDS)) report_counts(r, now);
    const bool goes_on = !r->ended;
    unlock(r);
    return goes_on;
}

sb_received sb_receiver_count(const sb_receiver *receiver)
{
    sb_receiver *r = (sb_receiver *)receiver;
    lock(r);
    const sb_received counts = r->counts;
    unlock(r);
    return counts;
}
