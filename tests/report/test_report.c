/* The page of a report: what it says, its size, hostile names, and files that are missing or damaged. */
#include "run_fixture.h"

#include "report/html.h"

static void page_of_a_run(void **state)
{
    (void)state;
    make_run();
    char *text = report_text();
    static const char *const parts[] = {
        SB_REPORT_START,
        "<title>A quiet basin</title>",
        "Run complete, 10 s simulated",
        "id=\"loads\"",
        "<b>body-0</b> 2.5",
        "<b>body-1</b> 0.07 m",
        "a thin plate",
        "shorebreak run &#39;a b.yaml&#39; --quiet",
        "in /somewhere",
        "title: A quiet basin",
        "compressed by 0.01 % on average: up to 1 % pressures as a whole are not in doubt",
        "in which it was worst, by 1 %.",
        "<b class=\"mark\">good</b><div><b>Density.</b>",
        "id=\"data\"",
        "add up to its total change within less than 0.01 %",
        "stress of the particle packing 0 %",
        "sponges -200 %."};
    for (size_t p = 0; p < sizeof parts / sizeof *parts; p++) assert_has(text, parts[p]);
    assert_null(strstr(text, "Missing or damaged files"));
    /* No address is opened: dygraphs and the styles are in the page. */
    assert_null(strstr(text, "<link rel=\"stylesheet\""));
    assert_null(strstr(text, " src=\"http"));
    assert_has(text, "default-src 'none'");
    /* The greater load comes first. */
    assert_true(strstr(text, "row\">body-1") < strstr(text, "row\">body-0"));
    sb_free(text);
}

/* A density that is good on average beside a particle that was pressed together: the words fit both. */
static void density_of_the_worst_particle(void **state)
{
    (void)state;
    make_run();
    write_text("run/summary.json", "{\"status\":\"done\",\"compression_mean\":0.0008,\"compression_max\":0.511,"
                                   "\"capped_steps\":0}");
    char *text = report_text();
    assert_has(text, "<b class=\"mark\">note</b><div><b>Density.</b>");
    assert_has(text, "by 0.08 % on average: up to 1 % pressures as a whole are not in doubt. A single particle, in the "
                     "step in which it was worst, by 51.1 %. That is water that hits a wall or other water: do not");
    sb_free(text);
    write_text("run/summary.json", "{\"status\":\"done\",\"compression_mean\":0.02,\"compression_max\":0.05}");
    text = report_text();
    assert_has(text, "<b class=\"mark\">caution</b><div><b>Density.</b>");
    assert_has(text, "by 2 % on average: above 1 % pressures are doubtful. A single");
    assert_null(strstr(text, "hits a wall"));
    sb_free(text);
}

/* The table of probes has the unit of the plot above it, which is that of the greatest pressure of all. */
static void one_unit_of_pressure(void **state)
{
    (void)state;
    static const struct {
        const char *second, *head, *cell, *other;
    } cases[] = {{"1234", "Greatest pressure, kPa</th>", "<td>1.23</td>", "<td>0.2</td>"},
                 {"-1234", "Greatest pressure, kPa</th>", "<td>-1.23</td>", "<td>0.2</td>"},
                 {"123", "Greatest pressure, Pa</th>", "<td>123</td>", "<td>200</td>"},
                 {"2e7", "Greatest pressure, MPa</th>", "<td>20</td>", "<td>0.0002</td>"}};
    make_run();
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char rows[200];
        snprintf(rows, sizeof rows, "time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa\n0.1,a,0,0,0,200\n0.1,b,0,0,0,%s\n",
                 cases[c].second);
        write_text("run/probes.csv", rows);
        char *text = report_text();
        assert_has(text, cases[c].head);
        assert_has(text, cases[c].cell);
        assert_has(text, cases[c].other);
        sb_free(text);
    }
}

/* Both forces are flagged: the page begins with what can be read, and the spacing that 2.5 layers of 0.1 m need. */
static void what_a_coarse_run_can_tell(void **state)
{
    (void)state;
    make_run();
    char *text = report_text();
    assert_has(text, "The forces on 2 of 2 loaded bodies are not reliable");
    assert_has(text, "about 0.062 m resolves");
    assert_true(strstr(text, "What this run can tell") < strstr(text, "id=\"pictures\""));
    assert_has(text, "not reliable</td>"); /* the table keeps its flags */
    sb_free(text);
    write_text("run/summary.json", "{\"status\":\"done\",\"bodies\":[{\"name\":\"body-0\",\"flow_layers\":6,"
                                   "\"too_coarse\":false,\"narrow_gap\":false}]}");
    text = report_text();
    assert_null(strstr(text, "What this run can tell"));
    sb_free(text);
}

/* A film of the size is in the page, and a larger one stays out with a reason. */
static void film_in_the_page(void **state)
{
    (void)state;
    static const size_t sizes[] = {9, 2000000, 4500000};
    char *text = NULL;
    make_run();
    FILE *scene = fopen(in_folder("run/scene.yaml"), "w");
    fprintf(scene, "%srender: {interval: 1, cameras: [{name: side, eye: [0, -3, 1], target: [0, 0, 0]}]}\n",
            scene_text);
    assert_int_equal(fclose(scene), 0);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        FILE *film = fopen(in_folder("run/side.mp4"), "w");
        for (size_t i = 0; i < sizes[s]; i++) fputc('x', film);
        assert_int_equal(fclose(film), 0);
        const sb_report_options options = {.film = true};
        size_t bytes = 0;
        assert_int_equal(sb_report_write(in_folder("run"), in_folder("page.html"), &options, &bytes, NULL), SB_OK);
        assert_true(bytes < SB_REPORT_BYTES_MAX);
        assert_true((bytes > sizes[s]) == (s < 2));
        text = text_of("page.html");
        assert_has(text, s < 2 ? "src=\"data:video/mp4;base64,eHh4" : "The film is not in this page");
        sb_free(text);
    }
    unlink(in_folder("run/side.mp4"));
    assert_int_equal(
        sb_report_write(in_folder("run"), in_folder("page.html"), &(sb_report_options){.film = true}, NULL, NULL),
        SB_OK);
    text = text_of("page.html");
    assert_has(text, "The run has no film");
    sb_free(text);
}

/* Names and texts are data, wherever they stand. */
static void hostile_names(void **state)
{
    (void)state;
    static const char name[] = "</script><script>alert(1)</script>";
    char line[512];
    make_run();
    snprintf(line, sizeof line, FORCES_HEADER "0.1,%s,1,0,0,0,0,0\n0.1,\"a\"\"b,c\",2,0,0,0,0,0\n", name);
    write_text("run/forces.csv", line);
    snprintf(line, sizeof line, "{\"status\":\"failed\",\"title\":\"%s&\",\"reason\":\"<img src=x onerror=1>\"}", name);
    write_text("run/summary.json", line);
    snprintf(line, sizeof line,
             "{\"event\":\"warning\",\"text\":\"%s\"}\n{\"event\":\"arguments\",\"arguments\":[\"%s\"]}\n", name, name);
    write_text("run/run.jsonl", line);
    snprintf(line, sizeof line, "title: \"%s \xff\"\n", name);
    write_text("run/scene.yaml", line);
    char *text = report_text();
    assert_null(strstr(text, "<script>alert"));
    assert_null(strstr(text, "<img src=x"));
    assert_has(text, "&lt;/script&gt;&lt;script&gt;alert(1)&lt;/script&gt;");
    assert_has(text, "\\u003c/script>");
    assert_has(text, "a&quot;b,c");
    /* The byte that is not UTF-8 is replaced. */
    assert_null(strchr(text, '\xff'));
    sb_free(text);
}

/* The summary's lists about waves are tables; a set's periods are summed. */
static void waves_of_the_summary(void **state)
{
    (void)state;
    make_run();
    write_text("run/summary.json",
               "{\"status\":\"done\",\"waves\":[{\"gauge\":\"toe<\",\"waves\":37,\"spectral_height_m\":0.23,"
               "\"mean_period_s\":1.56}],\"reflections\":[{\"name\":\"set\",\"period_s\":2,\"incident_m\":0.1,"
               "\"reflected_m\":0.05,\"misfit_m\":0.01,\"coefficient\":0.5},{\"name\":\"set\",\"period_s\":1,"
               "\"incident_m\":0.02,"
               "\"reflected_m\":0.01,"
               "\"coefficient\":0.5},{\"name\":\"set\",\"period_s\":0.5,\"incident_m\":1,\"reflected_m\":1,"
               "\"distinct\":false},{\"name\":\"set\",\"period_s\":0.7,\"incident_m\":0.004,\"reflected_m\":0.006,"
               "\"misfit_m\":0.003},{\"name\":7}],"
               "\"overtopping\":[{\"plane\":\"crest\",\"rate_m2_s\":0.0046,\"eurotop_m2_s\":0.00463}]}");
    char *text = report_text();
    assert_has(text, "Waves at gauges");
    assert_has(text, "<tr><th scope=\"row\">toe&lt;</th><td>37</td><td>0.23</td>");
    assert_has(text, "<tr><th scope=\"row\">set</th><td>2</td><td>0.1</td><td>0.05</td><td>0.5</td><td>0.01</td></tr>");
    assert_has(text,
               "<tr><th scope=\"row\">set</th><td>all</td><td>0.102</td><td>0.051</td><td>0.5</td><td>–</td></tr>");
    assert_has(text, "Overtopping beside EurOtop");
    assert_has(text, "<td>0.0046</td><td>0.00463</td>");
    sb_free(text);
}

static void a_run_that_has_not_ended(void **state)
{
    (void)state;
    make_run();
    write_text("run/summary.json", "{\"version\":\"0.1.0\",\"title\":\"A quiet basin\",\"status\":\"running\"}\n");
    char *text = report_text();
    assert_has(text, "Run not finished, 9.5 s simulated");
    assert_has(text, "The run has not ended, or was killed");
    assert_has(text, "judged only at the end of a run");
    assert_has(text, "The run has no pictures.");
    sb_free(text);
}

/* Each file in turn is missing, cut in the middle, or noise: the page says so, and names the file. */
static void missing_and_damaged_files(void **state)
{
    (void)state;
    static const char *const files[] = {"summary.json", "run.jsonl",  "scene.yaml",
                                        "forces.csv",   "gauges.csv", "energy.csv"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) {
        char name[64], expected[80];
        snprintf(name, sizeof name, "run/%s", files[f]);
        snprintf(expected, sizeof expected, "%s: ", files[f]);
        make_run();
        assert_int_equal(unlink(in_folder(name)), 0);
        char *text = report_text();
        assert_has(text, "Missing or damaged files");
        assert_has(text, expected);
        sb_free(text);
        write_text(name, "\x01{[ noise,\n,,\n\"\xfe");
        text = report_text();
        assert_has(text, "Missing or damaged files");
        assert_has(text, files[f]);
        sb_free(text);
        write_text(name, "");
        sb_free(report_text());
    }
}

static void damaged_lines_are_counted(void **state)
{
    (void)state;
    make_run();
    write_text("run/forces.csv", FORCES_HEADER "0.1,a,1,0,0,0,0,0\n0.2,a,x,0,0,0,0,0\n0.2,a,3,0\n0.1,a,9,0,0,0,0,0\n"
                                               "0.3,a,2,0,0,0,0,0\n0.4,a,1");
    char *text = report_text();
    assert_has(text, "forces.csv: 3 lines are damaged and are left out");
    assert_has(text, "\"0.1,1,0,0,0,0,0\\n0.3,2,0,0,0,0,0\\n\"");
    sb_free(text);
}

static void folders_that_are_no_runs(void **state)
{
    (void)state;
    sb_error error = {0};
    mkdir(in_folder("empty"), 0777);
    const sb_report_options options = {0};
    assert_int_equal(sb_report_write(in_folder("empty"), in_folder("x.html"), &options, NULL, &error), SB_BAD_INPUT);
    assert_has(error.text, "empty: expected the folder of a run");
    assert_int_equal(access(in_folder("x.html"), F_OK), -1);
    make_run();
    assert_int_equal(sb_report_write(in_folder("run"), in_folder("none/x.html"), &options, NULL, &error), SB_FAILED);
}

static void without_dygraphs(void **state)
{
    (void)state;
    make_run();
    const sb_report_options options = {.dygraphs = folder, .title = "Own <title>"};
    assert_int_equal(sb_report_write(in_folder("run"), in_folder("page.html"), &options, NULL, NULL), SB_OK);
    char *text = text_of("page.html");
    assert_has(text, "<title>Own &lt;title&gt;</title>");
    assert_true(strlen(text) < 60000);
    sb_free(text);
}

/* 40 bodies with 4000 rows each: the page is small enough, says that it is thinned, and keeps the peaks of one row. */
static void a_long_run(void **state)
{
    (void)state;
    make_run();
    write_forces(40, 4000, 1234);
    char *text = report_text();
    assert_has(text, "so that no peak is lost");
    for (int k = 0; k < 40; k++) {
        char row[64];
        snprintf(row, sizeof row, "\\n123.4,%d,0,0,0,0,0\\n", 1000000 + k);
        assert_has(text, row);
    }
    sb_free(text);
}

/* Each allocation in turn fails: the page is written without a part, or not at all. */
static void memory_that_runs_out(void **state)
{
    (void)state;
    make_run();
    const sb_report_options options = {0};
    long n = 0;
    for (bool pending = false; !pending;) {
        sb_error error = {0};
        unlink(in_folder("page.html"));
        sb_memory_fail_at(++n);
        const sb_status status = sb_report_write(in_folder("run"), in_folder("page.html"), &options, NULL, &error);
        pending = sb_memory_fail_pending();
        sb_memory_fail_at(0);
        assert_int_equal(status == SB_OK, access(in_folder("page.html"), F_OK) == 0);
        assert_int_equal(status == SB_OK, *error.text == '\0');
        assert_int_equal(access(in_folder("page.html.tmp"), F_OK), -1);
    }
    assert_true(n > 20);
}

static void figures(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } cases[] = {{0, "0"},
                 {1, "1"},
                 {33.52, "33.5"},
                 {-0.00123456, "-0.00123"},
                 {1234, "1230"},
                 {203456, "203\u202f000"},
                 {99.96, "100"},
                 {999.7, "1000"},
                 {-12345, "-12\u202f300"},
                 {1e12, "1.00e+12"},
                 {NAN, "–"},
                 {0.1, "0.1"}};
    char out[SB_FIGURE_MAX];
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++)
        assert_string_equal(sb_figure(out, cases[c].value), cases[c].text);
}

static void base64(void **state)
{
    (void)state;
    static const char *const texts[] = {"", "f", "fo", "foo", "foob"}, /* RFC 4648, section 10 */
        *const coded[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        char *out = NULL;
        size_t size = 0;
        FILE *stream = open_memstream(&out, &size);
        sb_html_base64(stream, (const unsigned char *)texts[t], strlen(texts[t]));
        fclose(stream);
        assert_string_equal(out, coded[t]);
        free(out);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(page_of_a_run),
        cmocka_unit_test(density_of_the_worst_particle),
        cmocka_unit_test(one_unit_of_pressure),
        cmocka_unit_test(what_a_coarse_run_can_tell),
        cmocka_unit_test(film_in_the_page),
        cmocka_unit_test(hostile_names),
        cmocka_unit_test(waves_of_the_summary),
        cmocka_unit_test(a_run_that_has_not_ended),
        cmocka_unit_test(missing_and_damaged_files),
        cmocka_unit_test(damaged_lines_are_counted),
        cmocka_unit_test(folders_that_are_no_runs),
        cmocka_unit_test(without_dygraphs),
        cmocka_unit_test(a_long_run),
        cmocka_unit_test(memory_that_runs_out),
        cmocka_unit_test(figures),
        cmocka_unit_test(base64),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
