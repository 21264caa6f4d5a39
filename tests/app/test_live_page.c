/* The page of a run in Chromium: the token, a step, pause and resume, the plots, and the end. */
#include "shown.h"

#include "web/chromium.h"

#include <stdio.h>
#include <unistd.h>

static void page_of_a_run(void **state)
{
    (void)state;
    if (!chromium_is_there()) {
        print_message("skipped: /usr/bin/chromium is not there (Debian's package chromium)\n");
        skip();
    }
    const pid_t run = shown_start("page", "resolution=0.05", "1000");
    chromium *browser = chromium_start(1280, 800);
    char text[256];
    snprintf(text, sizeof text, "http://127.0.0.1:%d/", shown_port);
    chromium_open(browser, text);
    chromium_await(browser,
                   "window.shorebreak && document.getElementById('state').textContent === 'paused' &&"
                   " shorebreak.view.scene !== undefined",
                   20);
    snprintf(text, sizeof text,
             "(document.getElementById('token').value = '%s',"
             " document.querySelector('#login button').click())",
             shown_token());
    chromium_true(browser, text);
    chromium_press(browser, "command-step");
    chromium_await(browser, "document.getElementById('why').textContent === 'Step: 1 step, then paused'", 5);
    chromium_press(browser, "command-resume");
    chromium_await(browser, "shorebreak.times.time > 0.1", 10);
    chromium_await(browser, "document.getElementById('state').textContent === 'running'", 5);
    chromium_press(browser, "command-pause");
    chromium_await(browser, "document.getElementById('state').textContent === 'paused'", 5);
    usleep(300000);
    const double time = chromium_number(browser, "shorebreak.times.time");
    usleep(800000);
    assert_near(chromium_number(browser, "shorebreak.times.time"), time, 0);
    chromium_press(browser, "command-resume");
    snprintf(text, sizeof text, "shorebreak.times.time > %.9g", time);
    chromium_await(browser, text, 10);
    chromium_await(browser, "document.querySelectorAll('#forces canvas').length > 0", 5);
    /* A button that ends the run is pressed twice. */
    chromium_press(browser, "command-stop");
    chromium_press(browser, "command-stop");
    chromium_await(browser, "document.getElementById('notice').textContent.startsWith('The run has ended')", 10);
    outcome o = program_finish(run);
    assert_contains(o.err, "stopped by a command");
    outcome_free(&o);
    chromium_stop(browser);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(page_of_a_run)};
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
