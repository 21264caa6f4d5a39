/* Channel names, and LCM's output on stderr. */
#include "stream/provider.h"

#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

sb_status sb_provider_channels(const char *prefix, sb_channel channels[SB_CHANNELS], sb_error *error)
{
    static const char *const names[SB_CHANNELS] = {"status", "forces", "particles"};
    if (!prefix || !*prefix) prefix = "shorebreak";
    for (int i = 0; i < SB_CHANNELS; i++) {
        int length = snprintf(channels[i], sizeof channels[i], "%s_%s", prefix, names[i]);
        if (length < 0 || (size_t)length >= sizeof channels[i])
            return sb_fail(error, SB_BAD_INPUT,
                           "stream prefix \"%s\": the channel name %s_%s is longer than LCM's limit of %d bytes",
                           prefix, prefix, names[i], LCM_MAX_CHANNEL_NAME_LENGTH);
    }
    return SB_OK;
}

sb_stderr_catch sb_stderr_hold(void)
{
    sb_stderr_catch hold = {-1, -1};
    fflush(stderr);
    int caught = memfd_create("lcm-messages", MFD_CLOEXEC);
    int saved = fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3);
    if (caught < 0 || saved < 0 || dup2(caught, STDERR_FILENO) < 0) {
        if (caught >= 0) close(caught);
        if (saved >= 0) close(saved);
        return hold;
    }
    hold.saved = saved;
    hold.caught = caught;
    return hold;
}

void sb_stderr_release(sb_stderr_catch *hold, char *line, size_t size)
{
    line[0] = 0;
    if (hold->caught < 0) return;
    fflush(stderr);
    dup2(hold->saved, STDERR_FILENO);
    ssize_t length = pread(hold->caught, line, size - 1, 0);
    line[length > 0 ? length : 0] = 0;
    char *end = line;
    for (char *at = line; *at; at++) { /* a sequence of white space and control characters becomes one blank */
        int blank = (unsigned char)*at <= ' ' || *at == 0x7f;
        if (!blank)
            *end++ = *at;
        else if (end > line && end[-1] != ' ')
            *end++ = ' ';
    }
    while (end > line && end[-1] == ' ') end--;
    *end = 0;
    close(hold->caught);
    close(hold->saved);
    *hold = (sb_stderr_catch){-1, -1};
}
