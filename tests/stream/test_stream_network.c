/* Subscribers in processes of their own receive all frames over UDP, with the system's receive buffer: what a busy
   machine loses is repaired. */
#include "stream_fixture.h"

#include <stdlib.h>
#include <sys/wait.h>

static char output[1 << 14];

static int bench(const char *arguments)
{
    char command[512];
    snprintf(command, sizeof command, "exec '%s/shorebreak-stream-bench' %s 2>&1", SB_BINARY_DIR, arguments);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    const size_t length = fread(output, 1, sizeof output - 1, pipe);
    output[length] = 0;
    const int status = pclose(pipe);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void three_subscribers_have_all_frames(void **state)
{
    (void)state;
    enum { ATTEMPTS = 3 }; /* another process may keep a receiver from running for longer than its buffer lasts */
    int status = 1;
    for (int i = 0; i < ATTEMPTS && status == 1; i++) status = bench("--particles 100000 --rate 10 --seconds 1");
    if (strstr(output, "multicast route")) skip();
    if (status != 0) fail_msg("%s", output);
    for (int i = 1; i <= 3; i++) {
        char begin[60];
        snprintf(begin, sizeof begin, "subscriber %d: 10 of 10 frames, ", i);
        const char *line = strstr(output, begin), *end = line ? strchr(line, '\n') : NULL;
        const char *refused = line ? strstr(line, " 0 refused, scene after ") : NULL;
        if (!refused || (end && refused > end))
            fail_msg("\"%s... 0 refused, scene after\" is not in:\n%s", begin, output);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(three_subscribers_have_all_frames)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
