#include "live/options.h"

#include "control/command.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

static sb_status take_number(const char *name, const char *text, int64_t most, int64_t *out, sb_error *error)
{
    char *end;
    errno = 0;
    const long long value = strtoll(text, &end, 10);
    if (end == text || *end || errno || value < 0 || value > most)
        return sb_fail(error, SB_BAD_INPUT, "%s %.100s: expected a whole number from 0 to %lld", name, text,
                       (long long)most);
    *out = value;
    return SB_OK;
}

/* Takes an option that has a value. */
static sb_status take(const char *name, const char *value, sb_live_options *options, sb_error *error)
{
    const struct {
        const char *name;
        const char **text;
        int64_t *number, most;
    } known[] = {{"--url", &options->url, NULL, 0},
                 {"--prefix", &options->prefix, NULL, 0},
                 {"--token-file", &options->token_file, NULL, 0},
                 {"--bind", &options->bind, NULL, 0},
                 {"--host", &options->host, NULL, 0},
                 {"--port", NULL, &options->port, UINT16_MAX},
                 {"--command-fd", NULL, &options->command_fd, 1 << 20},
                 {"--run-id", NULL, &options->run_id, SB_COMMAND_ID_MAX},
                 {"--counter", NULL, &options->counter, SB_COMMAND_ID_MAX}};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++) {
        if (strcmp(name, known[k].name) != 0) continue;
        if (!value) return sb_fail(error, SB_BAD_INPUT, "%s: needs a value", name);
        if (known[k].number) return take_number(name, value, known[k].most, known[k].number, error);
        *known[k].text = value;
        return SB_OK;
    }
    return sb_fail(error, SB_BAD_INPUT, "%.200s: no such option; --help lists the options", name);
}

sb_status sb_live_options_parse(int count, char **arguments, sb_live_options *options, sb_error *error)
{
    *options = (sb_live_options){.command_fd = -1, .run_id = -1, .port = SB_LIVE_PORT};
    for (int i = 0; i < count; i++) {
        if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0) {
            options->help = true;
            return SB_OK;
        }
        if (strcmp(arguments[i], "--no-http") == 0) {
            options->no_http = true;
            continue;
        }
        const sb_status status = take(arguments[i], i + 1 < count ? arguments[i + 1] : NULL, options, error);
        if (status != SB_OK) return status;
        i++;
    }
    if (options->command_fd >= 0 && options->run_id < 0)
        return sb_fail(error, SB_BAD_INPUT, "--command-fd: expected together with --run-id, as a run gives them");
    return SB_OK;
}
