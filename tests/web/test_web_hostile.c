/* Requests that the web server must refuse, clients that do not end their request, and clients that do not read. */
#include "web_fixture.h"

#include "web/allow.h"
#include "web/records.h"

#include <malloc.h>

#define HOST "Host: localhost\r\n"

static void headers_that_are_allowed(void **state)
{
    (void)state;
    static const struct {
        const char *host;
        bool allowed;
    } hosts[] = {{"localhost", true},
                 {"LocalHost:8080", true},
                 {"127.0.0.1:80", true},
                 {"127.0.0.1", true},
                 {"plant.example:9", true},
                 {NULL, false},
                 {"", false},
                 {":80", false},
                 {"evil.example", false},
                 {"localhost.evil", false},
                 {"127.0.0.1.evil", false},
                 {"localhost:", false},
                 {"localhost:8x", false},
                 {"localhost:123456", false},
                 {"localhost:80:80", false},
                 {"[127.0.0.1", false},
                 {"[::1]", false},
                 {"127.0.0.2", false}};
    for (size_t i = 0; i < sizeof hosts / sizeof *hosts; i++)
        if (sb_web_allow_host(hosts[i].host, "127.0.0.1", "plant.example") != hosts[i].allowed)
            fail_msg("Host '%s'", hosts[i].host);
    assert_true(sb_web_allow_host("[::1]:8080", "::1", NULL));
    static const char host[] = "localhost:8080";
    assert_true(sb_web_allow_origin(NULL, NULL, NULL, host, false));
    assert_true(sb_web_allow_origin("http://localhost:8080", "same-origin", "cors", host, false));
    assert_true(sb_web_allow_origin(NULL, "none", "navigate", host, true));
    assert_true(sb_web_allow_origin(NULL, "cross-site", "navigate", host, true));  /* a link */
    assert_false(sb_web_allow_origin(NULL, "cross-site", "no-cors", host, false)); /* an image */
    assert_false(sb_web_allow_origin(NULL, "same-site", "no-cors", host, true));
    assert_false(sb_web_allow_origin("http://localhost:3000", NULL, NULL, host, false));
    assert_false(sb_web_allow_origin("https://localhost:8080", NULL, NULL, host, false));
    assert_false(sb_web_allow_origin("null", NULL, NULL, host, false));
    assert_true(sb_web_allow_token(TOKEN, TOKEN));
    assert_false(sb_web_allow_token(TOKEN "0", TOKEN));
    assert_false(sb_web_allow_token("0123456789abcdef0123456789abcde", TOKEN));
    assert_false(sb_web_allow_token("", TOKEN));
    assert_false(sb_web_allow_token(NULL, TOKEN));
    assert_false(sb_web_allow_token("", ""));
    assert_true(sb_web_is_loopback("127.3.2.1") && sb_web_is_loopback("::1") && !sb_web_is_loopback("10.0.0.1"));
}

static void foreign_requests(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    static const char *const resources[] = {"GET /",      "GET /status", "GET /frames",
                                            "GET /scene", "GET /rows",   "POST /command"};
    for (size_t r = 0; r < sizeof resources / sizeof *resources; r++) {
        assert_int_equal(site_status(&s, resources[r], "Host: evil.example\r\n", ""), 403);
        assert_int_equal(site_status(&s, resources[r], "Host: localhost\r\nHost: evil.example\r\n", ""), 403);
        assert_int_equal(site_status(&s, resources[r], HOST "Origin: http://evil.example\r\n", ""), 403);
        assert_int_equal(site_status(&s, resources[r], HOST "Sec-Fetch-Site: cross-site\r\n", ""), 403);
    }
    assert_int_equal(sb_web_server_count(s.server).foreign, 24);
    site_close(&s);
}

static void commands_need_the_token(void **state)
{
    (void)state;
    site s;
    const sb_web_settings settings = {.token = TOKEN, .command = site_command};
    site_open(&s, &settings);
#define LENGTH "Content-Length: 14\r\n"
    static const char pause[] = "{\"do\":\"pause\"}";
    assert_int_equal(site_status(&s, "POST /command", HOST LENGTH, pause), 401);
    assert_int_equal(site_status(&s, "POST /command?token=" TOKEN, HOST LENGTH, pause), 401);
    assert_int_equal(site_status(&s, "POST /command", HOST LENGTH "X-Token: 0123456789abcdef\r\n", pause), 401);
    assert_int_equal(site_status(&s, "GET /command", HOST "X-Token: " TOKEN "\r\n", ""), 405);
    assert_int_equal(site_status(&s, "PUT /command", HOST LENGTH "X-Token: " TOKEN "\r\n", pause), 405);
    assert_int_equal(s.commands, 0);
    assert_int_equal(site_status(&s, "POST /command", HOST LENGTH "X-Token: " TOKEN "\r\n", pause), 202);
    assert_string_equal(s.command, pause);
    char *answer =
        site_ask(&s, "POST /command HTTP/1.1\r\n" HOST LENGTH "X-Token: " TOKEN "\r\n\r\n{\"do\":\"pause\"}");
    assert_non_null(strstr(answer, "{\"accepted\":true,\"id\":17}"));
    free(answer);
    assert_int_equal(site_status(&s, "POST /command", HOST LENGTH "X-Token: " TOKEN "\r\n", "{\"no\":\"pause\"}"), 400);
    assert_int_equal(site_status(&s, "POST /command", HOST "X-Token: " TOKEN "\r\n", ""), 400);
    assert_int_equal(s.commands, 2);
    assert_int_equal(site_status(&s, "GET /rows", HOST, ""), 200); /* readers on loopback need none */
    site_close(&s);
    site_open(&s, NULL);
    assert_int_equal(site_status(&s, "POST /command", HOST LENGTH "X-Token: " TOKEN "\r\n", pause), 403);
    site_close(&s);
}

static void readers_beyond_loopback_need_it(void **state)
{
    (void)state;
    sb_web_settings settings = {.address = "0.0.0.0"};
    sb_web_server *server = NULL;
    sb_error error = {0};
    assert_int_equal(sb_web_server_create(&settings, NULL, &server, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "--token-file"));
    settings.address = "localhost"; /* a name */
    assert_int_equal(sb_web_server_create(&settings, NULL, &server, &error), SB_BAD_INPUT);
    settings.token = "short", settings.address = NULL;
    assert_int_equal(sb_web_server_create(&settings, NULL, &server, &error), SB_BAD_INPUT);
    site s;
    settings = (sb_web_settings){.address = "0.0.0.0", .token = TOKEN};
    site_open(&s, &settings);
    static const char *const data[] = {"GET /status", "GET /frames", "GET /scene", "GET /rows"};
    for (size_t r = 0; r < sizeof data / sizeof *data; r++)
        assert_int_equal(site_status(&s, data[r], "Host: 127.0.0.1\r\n", ""), 401);
    assert_int_equal(site_status(&s, "GET /rows", "Host: 127.0.0.1\r\nX-Token: " TOKEN "\r\n", ""), 200);
    assert_int_equal(site_status(&s, "GET /", "Host: 127.0.0.1\r\n", ""), 200);
    assert_int_equal(site_status(&s, "GET /", "Host: 10.1.2.3\r\n", ""), 403);
    site_close(&s);
}

static void no_paths(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    static const char *const lines[] = {"GET /../../etc/passwd",
                                        "GET /%2e%2e/%2e%2e/etc/passwd",
                                        "GET //etc/passwd",
                                        "GET /dygraphs.js/../x",
                                        "GET /page/index.html",
                                        "GET /index.html",
                                        "GET /%00",
                                        "GET /status/",
                                        "GET /STATUS",
                                        "GET /.git/config",
                                        "POST /nothing"};
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        const int status = site_status(&s, lines[i], HOST, "");
        if (status != 404) fail_msg("%s gives %d", lines[i], status);
    }
    site_close(&s);
}

static void sizes_are_limited(void **state)
{
    (void)state;
    site s;
    const sb_web_settings settings = {.token = TOKEN, .command = site_command};
    site_open(&s, &settings);
    static char request[200000];
    /* A header above the limit. */
    size_t at = (size_t)snprintf(request, sizeof request, "GET / HTTP/1.1\r\n" HOST "X-Long: ");
    memset(request + at, 'a', 100000);
    strcpy(request + at + 100000, "\r\n\r\n");
    char *answer = site_ask(&s, request);
    assert_null(strstr(answer, "200 OK"));
    free(answer);
    /* An URL, and many headers. */
    at = (size_t)snprintf(request, sizeof request, "GET /");
    memset(request + at, 'a', 100000);
    strcpy(request + at + 100000, " HTTP/1.1\r\n" HOST "\r\n");
    answer = site_ask(&s, request);
    assert_null(strstr(answer, "200 OK"));
    free(answer);
    at = (size_t)snprintf(request, sizeof request, "GET / HTTP/1.1\r\n" HOST);
    for (int i = 0; i < 15000; i++) at += (size_t)snprintf(request + at, sizeof request - at, "X-A: 1\r\n");
    strcpy(request + at, "\r\n");
    answer = site_ask(&s, request);
    assert_null(strstr(answer, "200 OK"));
    free(answer);
    /* Bodies. */
    assert_int_equal(site_status(&s, "POST /command", HOST "X-Token: " TOKEN "\r\nContent-Length: 1025\r\n", "x"), 413);
    assert_int_equal(site_status(&s, "GET /status", HOST "Content-Length: 5\r\n", "12345"), 413);
    assert_int_equal(site_status(&s, "GET /status", HOST "Transfer-Encoding: chunked\r\n", "0\r\n\r\n"), 400);
    at = (size_t)snprintf(request, sizeof request,
                          "POST /command HTTP/1.1\r\n" HOST "X-Token: " TOKEN "\r\nTransfer-Encoding: chunked\r\n\r\n");
    for (int i = 0; i < 100; i++) at += (size_t)snprintf(request + at, sizeof request - at, "40\r\n%064d\r\n", i);
    strcpy(request + at, "0\r\n\r\n");
    answer = site_ask(&s, request);
    assert_string_equal(answer, "");
    free(answer);
    assert_int_equal(s.commands, 0);
    assert_true(sb_web_server_count(s.server).malformed >= 4);
    site_close(&s);
}

static void bytes_that_are_not_http(void **state)
{
    (void)state;
    site s;
    site_open(&s, NULL);
    for (uint64_t i = 0; i < 200; i++) {
        char noise[300];
        for (size_t k = 0; k < sizeof noise; k++) noise[k] = (char)(256 * sb_random(i, k));
        memcpy(noise + sizeof noise - 4, "\r\n\r\n", 4);
        const int client = site_connect(&s);
        site_send(&s, client, noise, sizeof noise);
        shutdown(client, SHUT_WR);
        reply r = site_read(&s, client, 10000, 2);
        assert_true(r.ended);
        assert_null(strstr(r.bytes, "200 OK"));
        free(r.bytes);
        close(client);
    }
    site_work(&s, 0.1);
    assert_int_equal(sb_web_server_count(s.server).malformed, 200);
    assert_int_equal(sb_web_server_count(s.server).clients, 0);
    /* A client that connects and leaves has done nothing wrong, nor has one that leaves a stream. */
    close(site_connect(&s));
    const int client = site_connect(&s);
    site_send(&s, client, "GET /frames HTTP/1.1\r\n" HOST "\r\n", 23 + sizeof HOST);
    site_work(&s, 0.1);
    assert_int_equal(sb_web_server_count(s.server).streams, 1);
    close(client);
    site_work(&s, 2.6);
    assert_int_equal(sb_web_server_count(s.server).clients, 0);
    assert_int_equal(sb_web_server_refused(s.server), 200);
    site_close(&s);
}

/* One byte at a time (slow-loris), an unfinished body, and silence. */
static void requests_that_do_not_end(void **state)
{
    (void)state;
    site s;
    const sb_web_settings settings = {.token = TOKEN, .command = site_command, .request_seconds = 0.6};
    site_open(&s, &settings);
    const int slow = site_connect(&s), silent = site_connect(&s), body = site_connect(&s);
    static const char begun[] = "POST /command HTTP/1.1\r\n" HOST "X-Token: " TOKEN "\r\nContent-Length: 100\r\n\r\n{";
    site_send(&s, body, begun, sizeof begun - 1);
    static const char request[] = "GET /status HTTP/1.1\r\n" HOST "\r\n";
    for (size_t i = 0; i < 14; i++) {
        site_send(&s, slow, request + i, 1);
        site_work(&s, 0.1);
    }
    const int clients[] = {slow, silent, body};
    for (int i = 0; i < 3; i++) {
        reply r = site_read(&s, clients[i], 1000, 1);
        assert_true(r.ended);
        assert_int_equal(r.size, 0);
        free(r.bytes);
        close(clients[i]);
    }
    assert_int_equal(sb_web_server_count(s.server).late, 3);
    assert_int_equal(sb_web_server_count(s.server).clients, 0);
    site_close(&s);
}

static void clients_are_limited(void **state)
{
    (void)state;
    site s;
    const sb_web_settings settings = {.clients = 8};
    site_open(&s, &settings);
    static const char request[] = "GET /frames HTTP/1.1\r\n" HOST "\r\n";
    int clients[6];
    for (int i = 0; i < 6; i++) {
        clients[i] = site_connect(&s);
        site_send(&s, clients[i], request, sizeof request - 1);
        site_work(&s, 0.02);
    }
    assert_int_equal(sb_web_server_count(s.server).streams, 6);
    assert_int_equal(site_status(&s, "GET /frames", HOST, ""), 503);
    assert_int_equal(site_status(&s, "GET /rows", HOST, ""), 200); /* there is room for other requests */
    for (int i = 0; i < 6; i++) close(clients[i]);
    site_work(&s, SB_LIVE_SILENCE + 0.6); /* they are noticed when something is sent */
    assert_int_equal(sb_web_server_count(s.server).clients, 0);
    assert_int_equal(site_status(&s, "GET /frames", "Host: x\r\n", ""), 403);
    site_close(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(headers_that_are_allowed),
        cmocka_unit_test(foreign_requests),
        cmocka_unit_test(commands_need_the_token),
        cmocka_unit_test(readers_beyond_loopback_need_it),
        cmocka_unit_test(no_paths),
        cmocka_unit_test(sizes_are_limited),
        cmocka_unit_test(bytes_that_are_not_http),
        cmocka_unit_test(requests_that_do_not_end),
        cmocka_unit_test(clients_are_limited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
