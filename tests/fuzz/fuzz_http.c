/* Fuzzes the web server. The input is what a client sends on one connection. No command may be taken without the token,
   and no answer may be given to a request that does not name this server. */
#include "fuzz.h"

#include "base/clock.h"
#include "web/server.h"

#include <arpa/inet.h>
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define TOKEN "0123456789abcdef0123456789abcdef"
#define PATIENCE 0.02 /* s without an answer, then the client leaves */

static sb_web_server *server;
static const uint8_t *input;
static size_t input_size;

static sb_status on_command(void *user, const char *json, size_t size, int64_t *id, sb_error *error)
{
    (void)user;
    FUZZ_CHECK(memmem(input, input_size, TOKEN, sizeof TOKEN - 1));
    FUZZ_CHECK(json[size] == '\0');
    *id = 1;
    return size > 0 && *json == '{' ? SB_OK : sb_fail(error, SB_BAD_INPUT, "no command: %.80s", json);
}

static void start(void)
{
    const sb_web_settings settings = {.token = TOKEN, .command = on_command};
    sb_web_view *view = sb_web_view_create();
    sb_error error = {0};
    FUZZ_CHECK(view);
    if (sb_web_server_create(&settings, view, &server, &error) == SB_OK) return;
    fprintf(stderr, "%s\n", error.text);
    abort();
}

static int join(void)
{
    const int made = socket(AF_INET, SOCK_STREAM, 0);
    const struct linger none = {.l_onoff = 1}; /* ports are free again at once */
    const struct sockaddr_in address = {.sin_family = AF_INET,
                                        .sin_port = htons((uint16_t)sb_web_server_port(server)),
                                        .sin_addr.s_addr = htonl(INADDR_LOOPBACK)};
    FUZZ_CHECK(made >= 0);
    setsockopt(made, SOL_SOCKET, SO_LINGER, &none, sizeof none);
    FUZZ_CHECK(connect(made, (const struct sockaddr *)&address, sizeof address) == 0);
    fcntl(made, F_SETFL, O_NONBLOCK);
    return made;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static char answer[1 << 16];
    if (!server) start();
    input = data;
    input_size = size;
    const int client = join();
    size_t sent = 0, got = 0;
    for (double end = sb_clock() + PATIENCE; sb_clock() < end;) {
        const ssize_t count = sent < size ? send(client, data + sent, size - sent, MSG_NOSIGNAL) : 0;
        if (count > 0) sent += (size_t)count;
        if (sent == size) shutdown(client, SHUT_WR);
        sb_web_server_run(server);
        const ssize_t read = recv(client, answer + got, sizeof answer - 1 - got, 0);
        if (read == 0 || (read < 0 && errno != EAGAIN)) break;
        if (read < 0) continue;
        got += (size_t)read;
        end = sb_clock() + PATIENCE;
        if (got == sizeof answer - 1) got = 200; /* a long answer: only its begin counts */
    }
    answer[got] = '\0';
    if (strncmp(answer, "HTTP/1.1 200", 12) == 0 || strncmp(answer, "HTTP/1.0 200", 12) == 0) {
        char *text = memcpy(calloc(size + 1, 1), data, size);
        for (size_t i = 0; i < size; i++)
            if (!text[i]) text[i] = ' ';
        FUZZ_CHECK(strcasestr(text, "localhost") || strstr(text, "127.0.0.1"));
        free(text);
    }
    close(client);
    sb_web_server_run(server);
    return 0;
}
