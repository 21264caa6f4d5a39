/* shorebreak-live: the process that receives from the network and shows a run to browsers. A run starts it, watches it
   and ends it; it checks commands and passes them to the run through a pipe. It also works without a run, for a replay.
 */
#include "control/receiver.h"
#include "live/intake.h"
#include "live/options.h"
#include "live/serve.h"

#include <signal.h>
#include <stdio.h>
#include <sys/prctl.h>
#include <sys/resource.h>

static const char help[] =
    "usage: shorebreak-live [OPTIONS]\n"
    "Shows a run, or a replay, in a web browser. `shorebreak run SCENE --live` starts it beside the run.\n\n"
    "  --port N             port of the page, or the next free one (default: 8080)\n"
    "  --bind ADDRESS       address of this machine, in numbers, on which to listen (default: 127.0.0.1). Beyond "
    "loopback\n"
    "                       every reader needs the token\n"
    "  --host NAME          a name of this machine that browsers may use\n"
    "  --url URL            LCM provider (default: LCM_DEFAULT_URL, else LCM's default); file://LOG shows a log\n"
    "  --prefix NAME        prefix of the stream's channels (default: shorebreak)\n"
    "  --token-file FILE    a run's control.token\n"
    "  --help               this text\n\n"
    "Given by the run that starts it:\n"
    "  --no-http            serve no page\n"
    "  --command-fd N       descriptor of a pipe to the run\n"
    "  --run-id N           id of the run\n"
    "  --counter N          refuse commands whose counter is not above N\n";

/* Beside a run, which takes precedence. With 19, frames reached browsers later than the next one came; with 10 they did
   not, and the run took no more processor time (tools/live-bench). */
enum { NICENESS = 19, NICENESS_WITH_PAGE = 10 };

typedef struct live {
    sb_live_options options;
    bool has_token;
    sb_token token;
    sb_receiver *receiver; /* NULL: no run has started this process */
} live;

static sb_status open_receiver(live *l, sb_error *error)
{
    const sb_live_options *options = &l->options;
    if (options->token_file && sb_token_read(options->token_file, &l->token, error) != SB_OK) return error->status;
    l->has_token = options->token_file;
    if (options->command_fd < 0) return SB_OK;
    return sb_receiver_create(l->has_token ? &l->token : NULL, options->run_id, options->counter,
                              (int)options->command_fd, &l->receiver, error);
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
        setpriority(PRIO_PROCESS, 0, l.options.no_http ? NICENESS : NICENESS_WITH_PAGE);
    }
    if (status == SB_OK) status = open_receiver(&l, &error);
    if (status != SB_OK) {
        fprintf(stderr, "shorebreak-live: %s\n", error.text);
        return (int)status;
    }
    const int result = l.options.no_http ? sb_intake_work(&l.options, l.receiver, -1)
                                         : sb_live_serve(&l.options, l.has_token ? &l.token : NULL, l.receiver);
    if (l.receiver) sb_receiver_serve(l.receiver, true);
    sb_receiver_destroy(l.receiver);
    return result;
}
