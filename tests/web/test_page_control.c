/* The page in Chromium: its buttons and fields work, and it goes on when the run is started again. */
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

/* Waits for the run's reply to a command, which is the command itself. */
static void await_reply(const char *text)
{
    char expression[512];
    snprintf(expression, sizeof expression, "document.getElementById('why').textContent === '%s'", text);
    chromium_await(browser, expression, 5);
}

static bool is_disabled(const char *id)
{
    char expression[128];
    snprintf(expression, sizeof expression, "document.getElementById('%s').disabled", id);
    return chromium_true(browser, expression);
}

/* Fills fields of the page as a user does. */
static void enter(const char *id, const char *value)
{
    char expression[256];
    snprintf(expression, sizeof expression,
             "(() => { const f = document.getElementById('%s'); f.value = '%s';"
             " return f.dispatchEvent(new Event('input', {bubbles: true})); })()",
             id, value);
    assert_true(chromium_true(browser, expression));
}

static void submit(const char *form)
{
    char expression[128];
    snprintf(expression, sizeof expression, "document.querySelector('#%s [type=submit]').click()", form);
    chromium_true(browser, expression);
}

static void wave_makers_and_the_stream(void **state)
{
    SKIP_WITHOUT_CHROMIUM();
    const int port = free_port();
    const pid_t run = start_source(port, 5000);
    open_page(port);
    const size_t errors = strlen(chromium_errors(browser)); /* of pages before this one */
    assert_true(chromium_number(browser, "document.querySelectorAll('#starts button').length") == 2);
    chromium_await(browser, "document.getElementById('why').textContent.includes('token')", 5);
    assert_true(is_disabled("start-0") &&
                chromium_true(browser, "document.querySelector('#stream-rate button').disabled"));
    chromium_true(browser, "(document.getElementById('token').value = '" TOKEN "',"
                           " document.querySelector('#login button').click())");
    chromium_await(browser, "!document.getElementById('start-0').disabled", 5);
    /* The first click asks. */
    click("start-0");
    chromium_await(browser, "document.getElementById('start-0').textContent === 'Start piston?'", 1);
    assert_true(chromium_true(browser, "document.getElementById('why').textContent === ''"));
    click("start-0");
    await_reply("Start piston: {\"do\":\"trigger\",\"wavemaker\":\"piston\"}");
    assert_true(is_disabled("start-0"));
    click("start-1");
    click("start-1");
    await_reply("Start slide: refused: {\"do\":\"trigger\",\"wavemaker\":\"slide\"}");
    assert_false(is_disabled("start-1"));
    chromium_true(browser, "document.getElementById('stream').open = true");
    /* The fields show what the run sends: all of the domain. */
    chromium_await(browser, "document.getElementById('region-x-to').value === '400'", 2);
    screenshot("stream");
    chromium_resize(browser, 390, 844, true);
    assert_true(chromium_true(browser, "document.documentElement.scrollWidth <= innerWidth"));
    chromium_true(browser, "scrollTo(0, 500)");
    usleep(300000);
    screenshot("stream-phone");
    chromium_resize(browser, 1280, 800, false);
    enter("rate", "2.5");
    submit("stream-rate");
    await_reply("Frames per second: {\"do\":\"rate\",\"rate\":2.5}");
    enter("decimation", "4");
    submit("stream-decimation");
    await_reply("One particle in: {\"do\":\"decimation\",\"decimation\":4}");
    enter("region-x-from", "-50.5");
    enter("region-z-to", "30");
    submit("stream-region");
    await_reply("Region: {\"do\":\"region\",\"min\":[-50.5,0,0],\"max\":[400,300,30]}");
    click("stream-whole");
    await_reply("Region: {\"do\":\"region\",\"off\":true}");
    /* Numbers out of range are not sent. */
    enter("decimation", "0");
    submit("stream-decimation");
    usleep(700000);
    await_reply("Region: {\"do\":\"region\",\"off\":true}");
    assert_int_equal(strlen(chromium_errors(browser)), errors);
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(pause_and_resume), cmocka_unit_test(wave_makers_and_the_stream),
                                       cmocka_unit_test(started_again)};
    return cmocka_run_group_tests(tests, start_browser, stop_browser);
}
