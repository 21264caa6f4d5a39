/* Every paddle law of the table, Goring's check values, and the motion after the stroke. */
#include "../check.h"
#include "base/memory.h"
#include "physics/wavemakers/goring.h"
#include "physics/wavemakers/paddle_way.h"

#include <malloc.h>
#include <stdio.h>
#include <string.h>

#define TABLE SB_BINARY_DIR "/wavemaker-table.txt"
#define WAVES SB_BINARY_DIR "/wavemaker-waves.txt"
#define SIGNAL SB_BINARY_DIR "/wavemaker-signal.txt"

static void write_file(const char *path, const char *text, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

static void write_table(const char *text, size_t length)
{
    write_file(TABLE, text, length);
}

static int make_good_table(void **state)
{
    (void)state;
    const char text[] = "# paddle of a small flume\r\n\n0.5 2.0\n1 2.1 # first move\n"
                        "\t1.5 2.5\n2.25\t2.9\n3 3\n4 3\n";
    write_table(text, strlen(text));
    const char waves[] = "amplitude,period,phase\n0.05,2,30\n0.02, 1.5, -90\n";
    write_file(WAVES, waves, strlen(waves));
    char series[4096];
    size_t length = 0;
    for (int i = 0; i < 64; i++) {
        const double t = 0.25 * i, z = 0.1 * exp(-pow(t - 8, 2) / 6) * cos(M_PI * (t - 8));
        length += (size_t)snprintf(series + length, sizeof series - length, "%g %.9f\n", t, z);
    }
    write_file(SIGNAL, series, length);
    return 0;
}

/* Values that are valid for every law; each law reads those that it needs. */
static sb_wavemaker_parameters good_parameters(const sb_wavemaker *kind)
{
    const bool waves = strcmp(kind->name, "components") == 0, signal = strcmp(kind->name, "signal") == 0;
    return (sb_wavemaker_parameters){.kind = kind,
                                     .height = 0.3,
                                     .depth = 1,
                                     .stroke = 1.2,
                                     .speed = 0.8,
                                     .gravity = 9.81,
                                     .file = waves    ? WAVES
                                             : signal ? SIGNAL
                                                      : TABLE,
                                     .period = 2,
                                     .ramp = signal ? 0 : 3,
                                     .lasts = 30,
                                     .gamma = 3.3,
                                     .components = 50,
                                     .distance = 4,
                                     .focus = 15,
                                     .absorb = strcmp(kind->name, "absorber") == 0,
                                     .reach = 0.5};
}

static sb_paddle make_paddle(const sb_wavemaker_parameters *parameters)
{
    sb_paddle paddle = {0};
    sb_error error = {0};
    if (sb_paddle_create(parameters, &paddle, &error) != SB_OK) fail_msg("%s", error.text);
    return paddle;
}

static void names_are_unique_and_found(void **state)
{
    (void)state;
    size_t count = 0;
    for (const sb_wavemaker *const *row = sb_wavemakers; *row; row++, count++) {
        assert_true((*row)->name[0] && (*row)->summary[0] && (*row)->reference[0]);
        assert_ptr_equal(sb_wavemaker_find((*row)->name), *row);
        assert_true((*row)->needs != 0);
    }
    assert_true(count >= 5);
    assert_null(sb_wavemaker_find("gorin"));
}

static void every_law_starts_at_zero_and_stays_at_its_end(void **state)
{
    (void)state;
    for (const sb_wavemaker *const *row = sb_wavemakers; *row; row++) {
        sb_wavemaker_parameters parameters = good_parameters(*row);
        sb_paddle paddle = make_paddle(&parameters);
        assert_true((*row)->displacement(paddle.state, -1) == 0);
        assert_true((*row)->displacement(paddle.state, 0) == 0);
        assert_true(paddle.duration > 0 && isfinite(paddle.duration));
        assert_true((*row)->surface ? fabs(paddle.stroke_end) < 1e-3 : paddle.stroke_end > 0);
        assert_true((*row)->displacement(paddle.state, 10 * paddle.duration) == paddle.stroke_end);
        sb_paddle_destroy(&paddle);
    }
}

/* At steps far smaller than those of a simulation, the displacement has no jump larger than the law's largest speed
   allows. Except for the gate, the speed has no jump either. */
static void every_law_is_continuous(void **state)
{
    (void)state;
    for (const sb_wavemaker *const *row = sb_wavemakers; *row; row++) {
        sb_wavemaker_parameters parameters = good_parameters(*row);
        sb_paddle paddle = make_paddle(&parameters);
        bool sudden = strcmp((*row)->name, "gate") == 0;
        const sb_wave_facts *facts = (*row)->facts ? (*row)->facts(paddle.state) : NULL;
        double step = paddle.duration / 20000, top = 4 * paddle.stroke_end / paddle.duration;
        const sb_paddle_way way = sb_paddle_way_of(&paddle, 0);
        if (facts) top = 4 * M_PI * (way.most - way.least) / facts->period;
        double last = 0, last_speed = 0;
        for (int i = -100; i <= 20100; i++) {
            double x = (*row)->displacement(paddle.state, i * step), speed = (x - last) / step;
            assert_true(facts || x >= last - 1e-12);
            assert_true(fabs(speed) <= top);
            if (!sudden) assert_true(fabs(speed - last_speed) <= (facts ? 1e-2 : 2e-3) * top);
            last = x;
            last_speed = speed;
        }
        sb_paddle_destroy(&paddle);
    }
}

static void every_law_refuses_missing_or_invalid_parameters(void **state)
{
    (void)state;
    const double bad[] = {0, -1, (double)NAN, HUGE_VAL};
    for (const sb_wavemaker *const *row = sb_wavemakers; *row; row++)
        for (unsigned bit = SB_WM_HEIGHT; bit <= SB_WM_FOCUS; bit <<= 1)
            for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
                if (!((*row)->needs & bit)) continue;
                sb_wavemaker_parameters parameters = good_parameters(*row);
                if (bit == SB_WM_HEIGHT) parameters.height = bad[i];
                if (bit == SB_WM_DEPTH) parameters.depth = bad[i];
                if (bit == SB_WM_STROKE) parameters.stroke = bad[i];
                if (bit == SB_WM_SPEED) parameters.speed = bad[i];
                if (bit == SB_WM_PERIOD) parameters.period = bad[i];
                if (bit == SB_WM_DISTANCE) parameters.distance = bad[i];
                if (bit == SB_WM_FOCUS) parameters.focus = bad[i];
                if (bit == SB_WM_FILE) parameters.file = i ? "/nowhere/table" : NULL;
                sb_paddle paddle = {.duration = 77};
                sb_error error = {0};
                assert_int_equal(sb_paddle_create(&parameters, &paddle, &error), SB_BAD_INPUT);
                assert_true(error.text[0] && !strchr(error.text, '\n'));
                assert_true(paddle.duration == 77 && !paddle.kind);
            }
}

/* Creates the law with each allocation failing in turn, then without a failure, and destroys it. */
static void make_and_destroy(const sb_wavemaker *kind)
{
    sb_wavemaker_parameters parameters = good_parameters(kind);
    sb_paddle paddle = {0};
    sb_status status = SB_FAILED;
    for (long n = 1; status != SB_OK; n++) {
        assert_true(n < 100);
        sb_memory_fail_at(n);
        status = sb_paddle_create(&parameters, &paddle, NULL);
        assert_true(status == SB_FAILED || (status == SB_OK && n > 1));
    }
    sb_memory_fail_at(0);
    sb_paddle_destroy(&paddle);
    sb_paddle_destroy(&paddle);
}

/* The smallest block is 64 bytes, so a leak of one block per round amounts to 6400 bytes. */
static void every_law_leaks_nothing(void **state)
{
    (void)state;
    for (const sb_wavemaker *const *row = sb_wavemakers; *row; row++) {
        for (int round = 0; round < 10; round++) make_and_destroy(*row);
        size_t before = mallinfo2().uordblks;
        for (int round = 0; round < 100; round++) make_and_destroy(*row);
        assert_true(mallinfo2().uordblks < before + 3200);
    }
}

static void goring_check_values(void **state)
{
    (void)state;
    const struct {
        double height, depth, kappa, celerity, stroke, period, paddle[5];
    } cases[] = {
        {0.3, 1, .47434, 3.57113, 1.26491, 4.84079, {.00063, .03587, .63246, 1.22904, 1.26428}},
        {.39, .78, .78509, 3.38788, 1.27373, 3.23333, {.00064, .04248, .63687, 1.23125, 1.27310}},
    };
    for (size_t c = 0; c < 2; c++) {
        sb_goring law = sb_goring_of(cases[c].height, cases[c].depth, 9.81, false);
        assert_near(law.kappa, cases[c].kappa, 5.1e-6);
        assert_near(law.celerity, cases[c].celerity, 5.1e-6);
        assert_near(law.stroke, cases[c].stroke, 5.1e-6);
        assert_near(law.period, cases[c].period, 5.1e-6);
        for (int i = 0; i <= 4; i++)
            assert_near(sb_goring_paddle(&law, i * law.period / 4, NULL), cases[c].paddle[i], 5.1e-6);
        /* The smooth start and stop change only the ends: the displacement is exact at T/4, T/2 and 3T/4. */
        sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("goring"));
        parameters.height = cases[c].height;
        parameters.depth = cases[c].depth;
        sb_paddle paddle = make_paddle(&parameters);
        for (int i = 1; i <= 3; i++)
            assert_near(sb_paddle_displacement(&paddle, i * law.period / 4), cases[c].paddle[i], 5.1e-6);
        assert_near(paddle.stroke_end, law.stroke, 1e-12);
        sb_paddle_destroy(&paddle);
    }
}

/* X solves Goring's implicit equation, and its speed is C eta/(h + eta). */
static void goring_solves_its_equation(void **state)
{
    (void)state;
    for (int rayleigh = 0; rayleigh <= 1; rayleigh++)
        for (double height = 0.01; height <= 1; height += 0.11) {
            sb_goring law = sb_goring_of(height, 1, 9.81, rayleigh);
            for (double t = -1; t < law.period + 1; t += 0.031) {
                double speed, before, after;
                double x = sb_goring_paddle(&law, t, &speed) - law.stroke / 2;
                double phase = law.kappa * (law.celerity * (t - law.period / 2) - x);
                assert_near(x, law.stroke / 2 * tanh(phase), 1e-12);
                before = sb_goring_paddle(&law, t - 1e-5, NULL);
                after = sb_goring_paddle(&law, t + 1e-5, NULL);
                assert_near(speed, (after - before) / 2e-5, 1e-7);
            }
        }
}

static void goring_top_speed(void **state)
{
    (void)state;
    const char *names[] = {"goring", "goring-rayleigh"};
    for (int row = 0; row < 2; row++) {
        sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find(names[row]));
        sb_paddle paddle = make_paddle(&parameters);
        double top = 0, step = paddle.duration / 10000;
        for (int i = 0; i < 10000; i++) {
            double speed =
                (sb_paddle_displacement(&paddle, (i + 1) * step) - sb_paddle_displacement(&paddle, i * step)) / step;
            top = speed > top ? speed : top;
        }
        assert_near(top, sqrt(9.81 * 1.3) * 0.3 / 1.3, 1e-6);
        sb_paddle_destroy(&paddle);
    }
}

static void goring_warns_outside_of_its_range(void **state)
{
    (void)state;
    const sb_wavemaker *kind = sb_wavemaker_find("goring");
    const sb_wavemaker *wide = sb_wavemaker_find("goring-rayleigh");
    sb_wavemaker_parameters parameters = good_parameters(kind);
    assert_null(kind->warning(&parameters));
    parameters.height = 0.5;
    assert_non_null(strstr(kind->warning(&parameters), "goring-rayleigh"));
    assert_null(wide->warning(&parameters));
    parameters.height = 0.9;
    assert_non_null(strstr(kind->warning(&parameters), "breaks"));
    assert_non_null(strstr(wide->warning(&parameters), "breaks"));
    sb_paddle paddle;
    sb_error error = {0};
    parameters.height = 1.01;
    assert_int_equal(sb_paddle_create(&parameters, &paddle, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "1.01 m"));
    parameters.height = 0.3;
    parameters.gravity = 0;
    assert_int_equal(sb_paddle_create(&parameters, &paddle, &error), SB_BAD_INPUT);
}

static double speed_at(const sb_paddle *paddle, double t)
{
    return (sb_paddle_displacement(paddle, t + 1e-6) - sb_paddle_displacement(paddle, t - 1e-6)) / 2e-6;
}

static void stroke_runs_at_its_speed(void **state)
{
    (void)state;
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("stroke"));
    sb_paddle paddle = make_paddle(&parameters);
    assert_near(paddle.duration, 1.2 * 1.2 / 0.8, 1e-12);
    assert_near(paddle.stroke_end, 1.2, 1e-15);
    assert_near(speed_at(&paddle, paddle.duration / 2), 0.8, 1e-8);
    assert_near(speed_at(&paddle, 0.15), 0.4, 1e-7); /* in the middle of the acceleration */
    assert_near(speed_at(&paddle, paddle.duration), 0, 1e-5);
    sb_paddle_destroy(&paddle);
}

static void gate_is_pulled_at_constant_speed(void **state)
{
    (void)state;
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("gate"));
    sb_paddle paddle = make_paddle(&parameters);
    assert_near(paddle.duration, 1.5, 1e-15);
    assert_near(sb_paddle_displacement(&paddle, 0.5), 0.4, 1e-15);
    assert_near(sb_paddle_displacement(&paddle, 7), 1.2, 1e-15);
    sb_paddle_destroy(&paddle);
}

static void file_passes_through_its_rows(void **state)
{
    (void)state;
    const double rows[][2] = {{0.5, 0}, {1, .1}, {1.5, .5}, {2.25, .9}, {3, 1}, {4, 1}, {9, 1}};
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("file"));
    sb_paddle paddle = make_paddle(&parameters);
    assert_true(sb_paddle_displacement(&paddle, 0.4) == 0);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_near(sb_paddle_displacement(&paddle, rows[i][0]), rows[i][1], 1e-12);
    assert_near(sb_paddle_displacement(&paddle, 3.5), 1, 1e-12); /* no overshoot */
    assert_near(paddle.duration, 4, 0);
    sb_paddle_destroy(&paddle);
    const char marked[] = "\xef\xbb\xbf"
                          "0.5 2.0\n1 2.1\n"; /* as spreadsheets write */
    write_table(marked, sizeof marked - 1);
    paddle = make_paddle(&parameters);
    make_good_table(NULL);
    assert_near(sb_paddle_displacement(&paddle, 1), 0.1, 1e-12);
    sb_paddle_destroy(&paddle);
}

/* For a table of a smooth motion, the cubic interpolation gives the correct speed. */
static void file_gives_the_speed_of_a_smooth_table(void **state)
{
    (void)state;
    char text[16384];
    size_t length = 0;
    for (int i = 0; i <= 200; i++)
        length += (size_t)snprintf(text + length, sizeof text - length, "%.17g %.17g\n", i * 0.01,
                                   0.3 * (1 - cos(M_PI * i * 0.005)));
    write_table(text, length);
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("file"));
    sb_paddle paddle = make_paddle(&parameters);
    make_good_table(NULL);
    for (double t = 0.103; t < 1.9; t += 0.0171)
        assert_near(speed_at(&paddle, t), 0.15 * M_PI * sin(M_PI * t / 2), 2e-4);
    sb_paddle_destroy(&paddle);
}

/* The formats in which spreadsheets and other programs write tables. */
static void file_reads_headers_and_commas(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "0 0\n1 0.5\n",
        "0,0\n1,0.5\n",
        "0, 0\r\n1 , 0.5\r\n",
        "0;0\n1;0.5\n",
        "t x\n0 0\n1 0.5\n",
        "time s x m\n0 0\n1 0.5\n",
        "\"time (s)\",\"displacement (m)\"\n0,0\n1,0.5,\n",
        "# flume 2\n\nTime_s\tX_m\n0\t0\n1\t0.5\n",
        "\"0\",\"0\"\n\"1\",\"0.5\"\n",
        "0 0,\n1 0.5, # the end\n",
    };
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("file"));
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        write_table(texts[i], strlen(texts[i]));
        sb_paddle paddle;
        sb_error error = {0};
        if (sb_paddle_create(&parameters, &paddle, &error) != SB_OK) fail_msg("case %zu: %s", i, error.text);
        assert_near(paddle.stroke_end, 0.5, 1e-15);
        assert_near(paddle.duration, 1, 1e-15);
        sb_paddle_destroy(&paddle);
    }
    make_good_table(NULL);
}

static void file_refuses_bad_tables(void **state)
{
    (void)state;
    const struct {
        const char *text, *place, *expected;
    } cases[] = {
        {"", ":1:", "at least 2"},
        {"# nothing\n", ":2:", "at least 2"},
        {"0 0\n", ":2:", "at least 2"},
        {"0 0\n1\n", ":2:", "has 1 value, expected 2: \"time (s)"},
        {"0 0\n1 2 3\n", ":2:", "has 3 values, expected 2: \"time (s)"},
        {"0 0\n1,5 2\n", ":2:", "expected a number below 1e9"},
        {"0 0\n1 0.1m\n", ":2:", "value 2 of \"time (s) displacement (m)\" is 0.1m, expected a number"},
        {"0 0\n1 nan\n", ":2:", "expected a number below 1e9"},
        {"0 0\n1 1e400\n", ":2:", "expected a number below 1e9"},
        {"0 0\n1 0x10\n", ":2:", "expected a number below 1e9"},
        {"0 0\n1 --1\n", ":2:", "expected a number below 1e9"},
        {"0 0\n1 1e10\n", ":2:", "expected a number below 1e9"},
        {"t x\nt x\n0 0\n1 1\n", ":2:", "expected a number below 1e9"},
        {"t 0\n0 0\n1 1\n", ":1:", "expected a number below 1e9"},
        {"0 0\nt x\n1 1\n", ":2:", "expected a number below 1e9"},
        {"time, displacement (mm)\n0 0\n1 1\n", ":1:", "names the unit mm, expected \"time (s) displacement (m)\""},
        {"x_m,t_s\n0,0\n1,1\n",
         ":1:", "column 1 has another unit in the header, expected \"time (s) displacement (m)\""},
        {"time position_s\n0 0\n1 1\n", ":1:", "column 2 has another unit"},
        {"x,t\n0,0\n1,1\n", ":1:", "column 2 has another name"},
        {"time velocity\n0 0\n1 1\n", ":1:", "column 2 has another name in the header, expected \"time (s)"},
        {"Frequency (Hz); displacement (m)\n0 0\n1 1\n", ":1:", "names the unit Hz"},
        {"0,0\n1,,1\n", ":2:", "has 3 values"},
        {"0,0\n1\n", ":2:", "has 1 value"},
        {"0 0\n# a\n\n1 1\n1 2\n", ":5:", "increasing"},
        {"0 0\n2 1\n1 2\n", ":3:", "increasing"},
        {"-1 0\n2 1\n", ":1:", "before the start"},
    };
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("file"));
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        write_table(cases[i].text, strlen(cases[i].text));
        sb_paddle paddle;
        sb_error error = {0};
        assert_int_equal(sb_paddle_create(&parameters, &paddle, &error), SB_BAD_INPUT);
        char place[sizeof TABLE + 16];
        snprintf(place, sizeof place, "%s%s", TABLE, cases[i].place);
        if (strncmp(error.text, place, strlen(place)) != 0 || !strstr(error.text, cases[i].expected))
            fail_msg("case %zu: %s", i, error.text);
    }
    write_table("0 0\n1 1\0\n2 2\n", 14);
    sb_paddle paddle;
    sb_error error = {0};
    assert_int_equal(sb_paddle_create(&parameters, &paddle, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "zero byte"));
    parameters.file = "/nowhere/table.txt";
    assert_int_equal(sb_paddle_create(&parameters, &paddle, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "/nowhere/table.txt"));
    make_good_table(NULL);
}

static void refuses_file(const char *kind, const char *path, const char *text, size_t length, const char *expected)
{
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find(kind));
    sb_paddle paddle;
    sb_error error = {0};
    write_file(path, text, length);
    assert_int_equal(sb_paddle_create(&parameters, &paddle, &error), SB_BAD_INPUT);
    if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, expected))
        fail_msg("%s\n  expected: %s", error.text, expected);
}

/* Files of signal and components that are no tables, or have no waves. */
static void signals_refuse_bad_tables(void **state)
{
    (void)state;
    static const struct {
        const char *text, *expected;
    } cases[] = {
        {"0 0\n1 1\n2 0\n3 1\n2 0\n5 1\n6 0\n7 1\n", ":5: time 2 s does not follow 3 s, expected increasing times"},
        {"7 0\n6 1\n5 0\n4 1\n3 0\n2 1\n1 0\n0 1\n", ":2: time 6 s does not follow 7 s, expected increasing times"},
        {"time (s) surface (m)\n0 0\n# doubled\n0 1\n1 0\n2 1\n3 0\n4 1\n5 0\n6 1\n",
         ":4: time 0 s does not follow 0 s"},
        {"0 0\n1 1\n2 0\n3 1\n4.1 0\n5 1\n6 0\n7 1\n",
         ":5: time 4.1 s follows after 1.1 s, expected equal steps of about 1 s"},
        {"0 0\n1 1\n2 0\n3 1\n9 0\n10 1\n11 0\n12 1\n",
         ":5: time 9 s follows after 6 s, expected equal steps of about 1 s"},
        {"0 .1\n1 .1\n2 .1\n3 .1\n4 .1\n5 .1\n6 .1\n7 .1\n8 .1\n9 .1\n", "the surface is constant, expected waves"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        refuses_file("signal", SIGNAL, cases[i].text, strlen(cases[i].text), cases[i].expected);
    static const char garbage[] = "\x80h\n\x01\x02 h 3\n", zero[] = "0 0\n1 0.1\0"
                                                                    "5\n2 0\n";
    refuses_file("signal", SIGNAL, garbage, sizeof garbage - 1,
                 ":2: contains the control character 0x01, expected a text table");
    refuses_file("signal", SIGNAL, zero, sizeof zero - 1, ":2: contains a zero byte, expected a text table");
    static const char still[] = "amplitude (m) period (s) phase (degrees)\n0.1 2 0\n0.1 0 0\n";
    refuses_file("components", WAVES, still, sizeof still - 1, ":3: a wave has the amplitude 0.1 m and the period 0 s");
    refuses_file("components", WAVES, zero, sizeof zero - 1, ":2: contains a zero byte, expected a text table");
    refuses_file("file", TABLE, garbage, sizeof garbage - 1, ":2: contains the control character 0x01");
    make_good_table(NULL);
}

/* Times of 24 rows per second, rounded to milliseconds: steps of 0.041 and 0.042 s are equal ones. */
static void signals_may_have_rounded_times(void **state)
{
    (void)state;
    FILE *file = fopen(SIGNAL, "w");
    assert_non_null(file);
    for (int i = 0; i < 240; i++) fprintf(file, "%.3f %.6f\n", i / 24.0, 0.01 * sin(0.13 * i));
    assert_int_equal(fclose(file), 0);
    const sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("signal"));
    sb_paddle paddle = make_paddle(&parameters);
    sb_paddle_destroy(&paddle);
    make_good_table(NULL);
}

static void paddle_waits_for_its_start(void **state)
{
    (void)state;
    sb_wavemaker_parameters parameters = good_parameters(sb_wavemaker_find("gate"));
    parameters.start = 2;
    sb_paddle paddle = make_paddle(&parameters);
    assert_true(sb_paddle_displacement(&paddle, 2) == 0);
    assert_near(sb_paddle_displacement(&paddle, 2.5), 0.4, 1e-15);
    assert_near(sb_paddle_displacement(&paddle, 100), 1.2, 1e-15);
    sb_paddle_destroy(&paddle);
    parameters.start = HUGE_VAL; /* waits for a command */
    paddle = make_paddle(&parameters);
    assert_true(sb_paddle_displacement(&paddle, 1e9) == 0);
    sb_paddle_destroy(&paddle);
    parameters.start = -HUGE_VAL;
    assert_int_equal(sb_paddle_create(&parameters, &paddle, NULL), SB_BAD_INPUT);
}

static void paddle_returns_slowly_and_smoothly(void **state)
{
    (void)state;
    for (const sb_wavemaker *const *row = sb_wavemakers; *row; row++) {
        sb_wavemaker_parameters parameters = good_parameters(*row);
        parameters.start = 1;
        parameters.after = SB_AFTER_RETURN;
        parameters.return_time = 20;
        sb_paddle paddle = make_paddle(&parameters);
        double end = 1 + paddle.duration, stroke = paddle.stroke_end;
        assert_near(sb_paddle_displacement(&paddle, end), stroke, 1e-12);
        assert_near(sb_paddle_displacement(&paddle, end + 10), stroke / 2, 1e-12);
        assert_true(sb_paddle_displacement(&paddle, end + 20) == 0);
        assert_true(sb_paddle_displacement(&paddle, end + 1000) == 0);
        assert_near(speed_at(&paddle, end + 1e-3), 0, 1e-4);
        assert_near(speed_at(&paddle, end + 10), -1.5 * stroke / 20, 1e-7);
        assert_near(speed_at(&paddle, end + 20), 0, 1e-6);
        sb_paddle_destroy(&paddle);
        parameters.return_time = 0;
        assert_int_equal(sb_paddle_create(&parameters, &paddle, NULL), SB_BAD_INPUT);
        parameters.after = SB_AFTER_STAY;
        parameters.start = (double)NAN;
        assert_int_equal(sb_paddle_create(&parameters, &paddle, NULL), SB_BAD_INPUT);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_unique_and_found),
        cmocka_unit_test(every_law_starts_at_zero_and_stays_at_its_end),
        cmocka_unit_test(every_law_is_continuous),
        cmocka_unit_test(every_law_refuses_missing_or_invalid_parameters),
        cmocka_unit_test(every_law_leaks_nothing),
        cmocka_unit_test(goring_check_values),
        cmocka_unit_test(goring_solves_its_equation),
        cmocka_unit_test(goring_top_speed),
        cmocka_unit_test(goring_warns_outside_of_its_range),
        cmocka_unit_test(stroke_runs_at_its_speed),
        cmocka_unit_test(gate_is_pulled_at_constant_speed),
        cmocka_unit_test(file_passes_through_its_rows),
        cmocka_unit_test(file_gives_the_speed_of_a_smooth_table),
        cmocka_unit_test(file_reads_headers_and_commas),
        cmocka_unit_test(file_refuses_bad_tables),
        cmocka_unit_test(signals_refuse_bad_tables),
        cmocka_unit_test(signals_may_have_rounded_times),
        cmocka_unit_test(paddle_waits_for_its_start),
        cmocka_unit_test(paddle_returns_slowly_and_smoothly),
    };
    return cmocka_run_group_tests(tests, make_good_table, NULL);
}
