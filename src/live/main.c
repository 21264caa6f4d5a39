/* shorebreak-live: the process of a run that receives from the network. The run starts it, watches it and ends it; it
   checks commands and passes them to the run through a pipe. */
#include "control/receiver.h"
#include "live/options.h"
#include "stream/guard.h"
#include "stream/listen.h"

#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>

static const char help[] =
    "usage: shorebreak-live [OPTIONS]\n"
    "Receives the stream of a run and commands to it. `shorebreak run SCENE --control` starts it beside the run, with\n"
    "all options that it needs.\n\n"
    "  --url URL            LCM provider (default: LCM_DEFAULT_URL, else LCM's default)\n"
    "  --prefix NAME        prefix of the stream's channels (default: shorebreak)\n"
    "  --no-http            serve no page\n"
    "  --token-file FILE    the run's control.token: commands that are signed with it are passed to the run\n"
    "  --command-fd N       descriptor of a pipe to the run\n"
    "  --run-id N           id of the run\n"
    "  --counter N          refuse commands whose counter is not above N\n";

enum { NICENESS = 19 };

typedef struct live {
    sb_live_options options;
    sb_receiver *receiver; /* NULL: no run has started this process */
} live;

static void on_message(void *user, sb_channel_kind kind, const void *data, size_t size, double time)
{
    const live *l = user;
    (void)time;
    if (kind == SB_CHANNEL_COMMAND && l->receiver) (void)sb_receiver_take_message(l->receiver, data, size, NULL);
}

/* Works in a child process, which a forged packet may crash. */
static int work(void *argument)
{
    live *l = argument;
    sb_listener *listener = NULL;
    sb_error error = {0};
    const sb_listener_calls calls = {
        .user = l, .message = on_message, .commands = true, .only_commands = l->options.no_http};
    if (sb_listener_create(l->options.url, l->options.prefix, &calls, &listener, &error) != SB_OK) {
        fprintf(stderr, "shorebreak-live: %s\n", error.text);
        return 2;
    }
    while (sb_listener_poll(listener, 0.25) == SB_OK)
        if (l->receiver && !sb_receiver_serve(l->receiver, false)) break;
    sb_listener_destroy(listener);
    return 0;
}

static void after_crash(void)
{
    fputs("shorebreak-live: a packet crashed the receiver, which is started again\n", stderr);
}

static sb_status open_receiver(live *l, sb_error *error)
{
    const sb_live_options *options = &l->options;
    sb_token token;
    if (options->command_fd < 0) return SB_OK;
    sb_status status = options->token_file ? sb_token_read(options->token_file, &token, error) : SB_OK;
    return status == SB_OK ? sb_receiver_create(options->token_file ? &token : NULL, options->run_id, options->counter,
                                                (int)options->command_fd, &l->receiver, error)
                           : status;
}

int main(int count, char **arguments)
{
    live l = {0};
    sb_error error = {0};
    sb_status status = sb_live_options_parse(count - 1, arguments + 1, &l.options, &error);
    if (status == SB_OK && l.options.help) {
        fputs(help, stdout);
        return 0;
    }
    signal(SIGPIPE, SIG_IGN);
    if (l.options.command_fd >= 0) { /* the pipe tells if the run had ended before this call */
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        setpriority(PRIO_PROCESS, 0, NICENESS); /* the run takes precedence */
    }
    if (status == SB_OK) status = open_receiver(&l, &error);
    if (status != SB_OK) {
        fprintf(stderr, "shorebreak-live: %s\n", error.text);
        return (int)status;
    }
    const int result = sb_guard(work, &l, after_crash);
    if (l.receiver) sb_receiver_serve(l.receiver, true);
    sb_receiver_destroy(l.receiver);
    return result;
}
