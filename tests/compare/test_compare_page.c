/* The page of a comparison in Chromium: one body at a time with the lines of all runs, no errors, a phone's width. */
#include "compare_fixture.h"

#include "web/chromium.h"

static bool skipped(void)
{
    if (chromium_is_there()) return false;
    print_message("skipped: /usr/bin/chromium is not there (Debian's package chromium)\n");
    return true;
}

static chromium *open_page(int width, int height, bool phone)
{
    char url[SB_PATH_MAX + 8];
    static const char *const names[] = {"low", "<img src=x onerror=hacked=1>"};
    make_run_of((made_run){.name = names[0], .seed = 1, .wall = 0.5, .factor = 14});
    make_run_of((made_run){.name = names[1], .seed = 1, .wall = 1.5, .factor = 7});
    assert_int_equal(compare_runs(names, 2, NULL, NULL), SB_OK);
    chromium *browser = chromium_start(width, height);
    if (phone) chromium_resize(browser, width, height, true);
    snprintf(url, sizeof url, "file://%s", in_folder("out/compare.html"));
    chromium_open(browser, url);
    chromium_await(browser, "window.shorebreakReport && shorebreakReport.plots.every(({graph}) => graph)", 20);
    return browser;
}

static void one_body_at_a_time(void **state)
{
    (void)state;
    if (skipped()) skip();
    chromium *browser = open_page(1280, 900, false);
    assert_near(chromium_number(browser, "shorebreakReport.plots.length"), 4, 0);
    /* barn is first, as it has the greatest force; its two lines are shown, of four. */
    assert_true(chromium_true(browser, "shorebreakReport.plots[0].visible.map(Number).join('') === '1100'"));
    assert_near(chromium_number(browser, "[...document.querySelectorAll('#loads .series li')]"
                                         ".filter((li) => !li.hidden && li.offsetHeight > 0).length"),
                2, 0);
    chromium_true(browser, "(() => { const s = document.querySelector('#loads select'); s.value = 1;"
                           " s.dispatchEvent(new Event('change')); })()");
    chromium_await(browser, "shorebreakReport.plots[0].visible.map(Number).join('') === '0011'", 5);
    /* The greatest force is 700 N here, and 1400 N on barn. */
    chromium_await(browser, "document.querySelector('#loads .unit').textContent === 'house: Horizontal force, N'", 5);
    /* The choice stays when another quantity is shown, and so does the colour of a run. */
    chromium_true(browser, "(() => { const s = document.querySelectorAll('#loads select')[1]; s.value = 4;"
                           " s.dispatchEvent(new Event('change')); })()");
    chromium_await(browser, "document.querySelector('#loads .unit').textContent === 'house: Overturning moment, kN m'",
                   5);
    assert_true(chromium_true(browser, "shorebreakReport.plots[0].visible.map(Number).join('') === '0011'"));
    assert_true(chromium_true(browser, "shorebreakReport.plots[0].colour(0) === shorebreakReport.plots[0].colour(2)"));
    assert_true(chromium_true(browser, "shorebreakReport.plots[0].colour(0) !== shorebreakReport.plots[0].colour(1)"));
    assert_string_equal(chromium_errors(browser), "");
    chromium_stop(browser);
}

static void on_a_phone(void **state)
{
    (void)state;
    if (skipped()) skip();
    chromium *browser = open_page(390, 800, true);
    assert_true(chromium_true(browser, "typeof hacked === 'undefined'"));
    assert_true(chromium_true(browser, "document.documentElement.scrollWidth <= 390"));
    assert_string_equal(chromium_errors(browser), "");
    chromium_stop(browser);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(one_body_at_a_time), cmocka_unit_test(on_a_phone)};
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
