#include "chromium.h"

#include "check.h"

#include "base/clock.h"

#include <errno.h>
#include <fcntl.h>
#include <glib.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#define PROGRAM "/usr/bin/chromium"
#define ANSWER_SECONDS 60.0

struct chromium {
    pid_t process;
    int to, from;
    int id; /* of the last request */
    char session[128], folder[64];
    char *received; /* bytes of messages, each ended by a zero */
    size_t size, capacity;
    char errors[4096];
};

bool chromium_is_there(void)
{
    return access(PROGRAM, X_OK) == 0;
}

/* The descriptors 3 and 4 are those that --remote-debugging-pipe reads and writes. */
static void execute(const char *folder, int in, int out)
{
    char data[96];
    snprintf(data, sizeof data, "--user-data-dir=%s", folder);
    const int log = open("/dev/null", O_WRONLY);
    const int high_in = fcntl(in, F_DUPFD, 10), high_out = fcntl(out, F_DUPFD, 10);
    dup2(high_in, 3);
    dup2(high_out, 4);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    close(high_in);
    close(high_out);
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    execl(PROGRAM, PROGRAM, "--headless=new", "--remote-debugging-pipe", data, "--no-first-run", "--no-sandbox",
          "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-extensions",
          "--disable-dev-shm-usage", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
          "--hide-scrollbars", "--mute-audio", "about:blank", (char *)NULL);
    _exit(127);
}

static void note_error(chromium *browser, const char *text)
{
    const size_t length = strlen(browser->errors);
    snprintf(browser->errors + length, sizeof browser->errors - length, "%s\n", text);
}

static void take_event(chromium *browser, const char *method, json_t *params)
{
    const char *level = "", *text = "";
    char *all = NULL;
    if (strcmp(method, "Runtime.exceptionThrown") == 0) {
        all = json_dumps(params, 0);
        note_error(browser, all);
    } else if (strcmp(method, "Runtime.consoleAPICalled") == 0) {
        json_unpack(params, "{s:s}", "type", &level);
        if (strcmp(level, "error") == 0 || strcmp(level, "assert") == 0) {
            all = json_dumps(json_object_get(params, "args"), 0);
            note_error(browser, all);
        }
    } else if (strcmp(method, "Log.entryAdded") == 0) {
        json_unpack(params, "{s:{s:s,s:s}}", "entry", "level", &level, "text", &text);
        if (strcmp(level, "error") == 0) note_error(browser, text);
    }
    free(all);
}

/* The next message; NULL when the time is over. */
static json_t *next_message(chromium *browser, double end)
{
    for (;;) {
        char *zero = browser->size > 0 ? memchr(browser->received, 0, browser->size) : NULL;
        if (zero) {
            json_t *message = json_loads(browser->received, 0, NULL);
            const size_t length = (size_t)(zero - browser->received) + 1;
            memmove(browser->received, zero + 1, browser->size - length);
            browser->size -= length;
            assert_non_null(message);
            return message;
        }
        const double left = end - sb_clock();
        struct pollfd ready = {.fd = browser->from, .events = POLLIN};
        if (left <= 0 || poll(&ready, 1, (int)(1e3 * left) + 1) <= 0) return NULL;
        if (browser->capacity - browser->size < 1 << 16) {
            browser->capacity = 2 * browser->capacity + (1 << 17);
            browser->received = realloc(browser->received, browser->capacity);
            assert_non_null(browser->received);
        }
        const ssize_t got = read(browser->from, browser->received + browser->size, browser->capacity - browser->size);
        if (got <= 0) fail_msg("Chromium has ended");
        browser->size += (size_t)got;
    }
}

/* Sends a request and waits for its result. params is released. */
static json_t *call(chromium *browser, const char *method, json_t *params)
{
    json_t *request =
        json_pack("{s:i,s:s,s:o}", "id", ++browser->id, "method", method, "params", params ? params : json_object());
    if (*browser->session) json_object_set_new(request, "sessionId", json_string(browser->session));
    char *text = json_dumps(request, JSON_COMPACT);
    const size_t size = strlen(text) + 1;
    if (write(browser->to, text, size) != (ssize_t)size) fail_msg("Chromium does not read");
    free(text);
    json_decref(request);
    const double end = sb_clock() + ANSWER_SECONDS;
    for (json_t *message; (message = next_message(browser, end)); json_decref(message)) {
        const char *event = json_string_value(json_object_get(message, "method"));
        if (event) take_event(browser, event, json_object_get(message, "params"));
        if (json_integer_value(json_object_get(message, "id")) != browser->id) continue;
        json_t *problem = json_object_get(message, "error");
        if (problem) fail_msg("%s: %s", method, json_dumps(problem, 0));
        json_t *result = json_incref(json_object_get(message, "result"));
        json_decref(message);
        return result;
    }
    fail_msg("Chromium does not answer to %s", method);
    return NULL;
}

static void tell(chromium *browser, const char *method, json_t *params)
{
    json_decref(call(browser, method, params));
}

chromium *chromium_start(int width, int height)
{
    chromium *browser = calloc(1, sizeof *browser);
    assert_non_null(browser);
    strcpy(browser->folder, "/tmp/shorebreak-chromium-XXXXXX");
    assert_non_null(mkdtemp(browser->folder));
    int in[2], out[2];
    assert_int_equal(pipe2(in, O_CLOEXEC), 0);
    assert_int_equal(pipe2(out, O_CLOEXEC), 0);
    signal(SIGPIPE, SIG_IGN);
    browser->process = fork();
    if (browser->process == 0) execute(browser->folder, in[0], out[1]);
    close(in[0]);
    close(out[1]);
    browser->to = in[1];
    browser->from = out[0];
    json_t *made = call(browser, "Target.createTarget", json_pack("{s:s}", "url", "about:blank"));
    json_t *attached = call(browser, "Target.attachToTarget",
                            json_pack("{s:O,s:b}", "targetId", json_object_get(made, "targetId"), "flatten", 1));
    snprintf(browser->session, sizeof browser->session, "%s",
             json_string_value(json_object_get(attached, "sessionId")));
    json_decref(attached);
    json_decref(made);
    tell(browser, "Page.enable", NULL);
    tell(browser, "Runtime.enable", NULL);
    tell(browser, "Log.enable", NULL);
    chromium_resize(browser, width, height, false);
    return browser;
}

void chromium_stop(chromium *browser)
{
    kill(-browser->process, SIGKILL);
    waitpid(browser->process, NULL, 0);
    close(browser->to);
    close(browser->from);
    char command[96];
    snprintf(command, sizeof command, "rm -rf %s", browser->folder);
    if (system(command) != 0) print_message("%s is left\n", browser->folder);
    free(browser->received);
    free(browser);
}

void chromium_open(chromium *browser, const char *url)
{
    tell(browser, "Page.navigate", json_pack("{s:s}", "url", url));
}

void chromium_resize(chromium *browser, int width, int height, bool phone)
{
    tell(browser, "Emulation.setDeviceMetricsOverride",
         json_pack("{s:i,s:i,s:i,s:b}", "width", width, "height", height, "deviceScaleFactor", phone ? 2 : 1, "mobile",
                   phone));
    tell(browser, "Emulation.setTouchEmulationEnabled", json_pack("{s:b}", "enabled", phone));
}

static json_t *evaluate(chromium *browser, const char *expression)
{
    json_t *result = call(browser, "Runtime.evaluate",
                          json_pack("{s:s,s:b,s:b}", "expression", expression, "returnByValue", 1, "awaitPromise", 1));
    json_t *problem = json_object_get(result, "exceptionDetails");
    if (problem) fail_msg("%s: %s", expression, json_dumps(problem, 0));
    json_t *value = json_incref(json_object_get(json_object_get(result, "result"), "value"));
    json_decref(result);
    return value;
}

double chromium_number(chromium *browser, const char *expression)
{
    json_t *value = evaluate(browser, expression);
    if (!json_is_number(value)) fail_msg("%s is not a number", expression);
    const double number = json_number_value(value);
    json_decref(value);
    return number;
}

bool chromium_true(chromium *browser, const char *expression)
{
    json_t *value = evaluate(browser, expression);
    const bool is = json_is_true(value);
    json_decref(value);
    return is;
}

char *chromium_text(chromium *browser, const char *expression)
{
    json_t *value = evaluate(browser, expression);
    if (!json_is_string(value)) fail_msg("%s is not a text", expression);
    char *text = strdup(json_string_value(value));
    json_decref(value);
    return text;
}

void chromium_await(chromium *browser, const char *expression, double seconds)
{
    for (const double end = sb_clock() + seconds; sb_clock() < end; usleep(50000))
        if (chromium_true(browser, expression)) return;
    char *state = chromium_text(browser, "document.body.innerText");
    fail_msg("not within %g s: %s\nerrors: %s\npage: %s", seconds, expression, browser->errors, state);
}

void chromium_press(chromium *browser, const char *id)
{
    char expression[128];
    snprintf(expression, sizeof expression, "!document.getElementById('%s').disabled", id);
    chromium_await(browser, expression, 10);
    snprintf(expression, sizeof expression, "document.getElementById('%s').click()", id);
    chromium_true(browser, expression);
}

void chromium_mouse(chromium *browser, const char *type, double x, double y)
{
    tell(browser, "Input.dispatchMouseEvent",
         json_pack("{s:s,s:f,s:f,s:s,s:i,s:i}", "type", type, "x", x, "y", y, "button", "left", "buttons", 1,
                   "clickCount", 1));
}

void chromium_wheel(chromium *browser, double x, double y, double by)
{
    tell(browser, "Input.dispatchMouseEvent",
         json_pack("{s:s,s:f,s:f,s:f,s:f}", "type", "mouseWheel", "x", x, "y", y, "deltaX", 0.0, "deltaY", by));
}

void chromium_screenshot(chromium *browser, const char *path)
{
    json_t *result = call(browser, "Page.captureScreenshot", json_pack("{s:s}", "format", "png"));
    gsize size = 0;
    guchar *bytes = g_base64_decode(json_string_value(json_object_get(result, "data")), &size);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    g_free(bytes);
    json_decref(result);
}

const char *chromium_errors(chromium *browser)
{
    evaluate(browser, "0"); /* takes the events that wait */
    return browser->errors;
}
