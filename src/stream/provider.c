/* The default provider, and LCM's output on stderr. */
#include "stream/provider.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

const char *sb_provider_url(const char *url)
{
    if (!url || !*url) url = getenv("LCM_DEFAULT_URL");
    return url && *url ? url : "udpm://239.255.76.67:7667";
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
