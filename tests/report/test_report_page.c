/* The page of a report in Chromium: plots draw and zoom, links have the rows, hostile names stay text, no errors. */
#include "run_fixture.h"

#include "web/chromium.h"

static chromium *open_page(int width, int height, bool phone)
{
    char url[SB_PATH_MAX + 8];
    chromium *browser = chromium_start(width, height);
    if (phone) chromium_resize(browser, width, height, true);
    snprintf(url, sizeof url, "file://%s", in_folder("page.html"));
    chromium_open(browser, url);
    chromium_await(browser, "window.shorebreakReport && shorebreakReport.plots.every(({graph}) => graph)", 20);
    return browser;
}

static bool skipped(void)
{
    if (chromium_is_there()) return false;
    print_message("skipped: /usr/bin/chromium is not there (Debian's package chromium)\n");
    return true;
}

static void plots_draw_and_zoom(void **state)
{
    (void)state;
    if (skipped()) skip();
    make_run();
    sb_free(report_text());
    chromium *browser = open_page(1280, 900, false);
    assert_near(chromium_number(browser, "document.querySelectorAll('.plot canvas').length >= 4 ? 1 : 0"), 1, 0);
    /* The canvas has lines in the colours of the bodies; its grid is grey. */
    chromium_await(browser,
                   "(() => { const c = document.querySelector('.graph canvas'), d = c.getContext('2d')"
                   ".getImageData(0, 0, c.width, c.height).data; let n = 0; for (let i = 0; i < d.length; i += 4)"
                   " n += Math.abs(d[i] - d[i + 2]) > 60 && d[i + 3] > 128; return n > 100; })()",
                   5);
    const double before = chromium_number(browser, "shorebreakReport.plots[0].graph.xAxisRange()[1]");
    assert_near(before, 10, 0.5);
    chromium_true(browser, "document.querySelector('.graph').scrollIntoView({block: 'center'})");
    const double left = chromium_number(browser, "document.querySelector('.graph').getBoundingClientRect().left");
    const double top = chromium_number(browser, "document.querySelector('.graph').getBoundingClientRect().top");
    chromium_mouse(browser, "mousePressed", left + 300, top + 100);
    chromium_mouse(browser, "mouseMoved", left + 400, top + 104);
    chromium_mouse(browser, "mouseMoved", left + 600, top + 104);
    chromium_mouse(browser, "mouseReleased", left + 600, top + 104);
    chromium_await(browser, "shorebreakReport.plots[0].graph.xAxisRange()[1] < 8", 5);
    chromium_true(browser, "document.querySelector('.plot-head button').click()");
    chromium_await(browser, "shorebreakReport.plots[0].graph.xAxisRange()[1] > 9.5", 5);
    chromium_true(browser, "(() => { const s = document.querySelector('.plot-head select'); s.value = 4;"
                           " s.dispatchEvent(new Event('change')); })()");
    chromium_await(browser, "document.querySelector('.unit').textContent === 'Overturning moment, N m'", 5);
    assert_string_equal(chromium_errors(browser), "");
    chromium_stop(browser);
}

/* What a link to a CSV file saves. */
static void links_have_the_rows(void **state)
{
    (void)state;
    if (skipped()) skip();
    make_run();
    sb_free(report_text());
    chromium *browser = open_page(1280, 900, false);
    char *text =
        chromium_text(browser, "(() => { const link = document.querySelector('a.csv[data-name=body-1]');"
                               " let blob; URL.createObjectURL = (b) => { blob = b; return '#loads'; }; link.click();"
                               " return blob.text().then((t) => link.download + '\\n' + t); })()");
    static const char start[] =
        "forces-body-1.csv\ntime_s,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm\n0.1,0.6,0.8,-0.2,1,2.4,0\n";
    assert_int_equal(strncmp(text, start, sizeof start - 1), 0);
    assert_has(text, "\n5,1000001,0,0,0,0,0\n");
    size_t lines = 0;
    for (const char *at = text; (at = strchr(at, '\n')); at++) lines++;
    assert_int_equal(lines, 2 + 100);
    free(text);
    assert_string_equal(chromium_errors(browser), "");
    chromium_stop(browser);
}

static void hostile_names_on_a_phone(void **state)
{
    (void)state;
    if (skipped()) skip();
    make_run();
    write_text("run/forces.csv", FORCES_HEADER "0.1,<img src=x onerror=hacked=1>,1,0,0,0,0,0\n"
                                               "0.1,</script><script>hacked=1</script>,2,0,0,0,0,0\n"
                                               "0.2,<img src=x onerror=hacked=1>,2,0,0,0,0,0\n");
    sb_free(report_text());
    chromium *browser = open_page(390, 800, true);
    assert_true(chromium_true(browser, "typeof hacked === 'undefined'"));
    assert_true(chromium_true(browser, "document.querySelector('.series').textContent.includes('<img src=x')"));
    assert_true(chromium_true(browser, "document.documentElement.scrollWidth <= 390"));
    assert_string_equal(chromium_errors(browser), "");
    chromium_stop(browser);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(plots_draw_and_zoom), cmocka_unit_test(links_have_the_rows),
                                       cmocka_unit_test(hostile_names_on_a_phone)};
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
