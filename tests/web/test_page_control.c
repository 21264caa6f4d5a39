/* The page in Chromium: its buttons work, and it goes on when the run is started again. */
#include "page_fixture.h"

static void pause_and_resume(void **state)
{
    SKIP_WITHOUT_CHROMIUM();
    const int port = free_port();
    const pid_t run = start_source(port, 5000);
    open_page(port);
    chromium_await(browser, "document.getElementById('why').textContent.includes('token')", 5);
    assert_true(chromium_true(browser, "document.getElementById('command-pause').disabled"));
    chromium_true(browser, "(document.getElementById('token').value = '" TOKEN "',"
                           " document.querySelector('#login button').click())");
    chromium_await(browser, "!document.getElementById('command-pause').disabled", 5);
    click("command-pause");
    chromium_await(browser, "document.getElementById('state').textContent === 'paused'", 5);
    usleep(300000);
    const double time = chromium_number(browser, "shorebreak.times.time");
    const double picture = picture_of(0);
    usleep(1000000);
    assert_near(chromium_number(browser, "shorebreak.times.time"), time, 0);
    assert_near(picture_of(0), picture, 0);
    /* The same frame coloured by pressure; 10 m of still water have 100 kPa at the bottom. */
    static const char recolour[] = "(() => { const c = document.getElementById('colour'); c.value = '%s';"
                                   " c.dispatchEvent(new Event('change')); return true; })()";
    char expression[256];
    snprintf(expression, sizeof expression, recolour, "pressure");
    assert_true(chromium_true(browser, expression));
    assert_true(picture_of(0) != picture);
    chromium_await(browser, "document.getElementById('ticks').lastChild.textContent === '100'", 2);
    screenshot("pressure");
    snprintf(expression, sizeof expression, recolour, "speed");
    assert_true(chromium_true(browser, expression));
    assert_near(picture_of(0), picture, 0);
    screenshot("paused");
    click("command-resume");
    chromium_await(browser, "document.getElementById('state').textContent === 'running'", 5);
    usleep(500000);
    assert_true(chromium_number(browser, "shorebreak.times.time") > time);
    /* A command that the run refuses is reported. */
    click("command-checkpoint");
    chromium_await(browser, "document.getElementById('why').textContent.includes('no such command')", 5);
    /* The refusal is the only message on the console. */
    const char *errors = chromium_errors(browser);
    assert_true(strstr(errors, "400") && !strchr(strchr(errors, '\n') + 1, '\n'));
    stop_source(run);
}

static void started_again(void **state)
{
    SKIP_WITHOUT_CHROMIUM();
    const int port = free_port();
    pid_t run = start_source(port, 5000);
    open_page(port);
    stop_source(run);
    chromium_await(browser, "document.getElementById('notice').textContent.includes('is lost')", 10);
    screenshot("lost");
    run = start_source(port, 5000);
    chromium_await(browser, "document.getElementById('notice').textContent.includes('started again')", 10);
    const double frames = chromium_number(browser, "shorebreak.times.frames");
    usleep(1500000);
    assert_true(chromium_number(browser, "shorebreak.times.frames") > frames + 3);
    stop_source(run);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(pause_and_resume), cmocka_unit_test(started_again)};
    return cmocka_run_group_tests(tests, start_browser, stop_browser);
}
