/* Plots from invented tables, and videos, if gnuplot and ffmpeg are installed. */
#include "output/maps/maps.h"
#include "output/plots/plots.h"
#include "output/plots/tool.h"
#include "output/plots/video.h"
#include "output/tables/csv.h"

#include "folder.h"

#include <setjmp.h>
#include <stdarg.h>
#include <sys/stat.h>

#include <cmocka.h>

enum { BODIES = 14 };

static sb_model_body bodies[BODIES];
static sb_gauge gauges[2] = {{"offshore", 1, 2, 0}, {"it's \"near\", 5 % off", 3, 4, 0}};
static sb_probe probes[1] = {{"inlet", {0, 0, 0}, 0}};
static sb_scene scene = {
    .dimensions = 3,
    .title = (char *)"Plant's wave \"`touch /tmp/x`\" $(id)",
    .measure = {.interval = 0.1, .gauge_count = 2, .gauges = gauges, .probe_count = 1, .probes = probes}};

static void write_tables(void)
{
    sb_model model = {.body_count = BODIES, .bodies = bodies};
    for (int b = 0; b < BODIES; b++) {
        snprintf(bodies[b].name, sizeof bodies[b].name, "reactor_%d", b + 1);
        bodies[b].report = true;
    }
    sb_csv *csv;
    assert_int_equal(sb_csv_open(folder, &scene, &model, &csv, NULL), SB_OK);
    for (int k = 0; k <= 900; k++) {
        double t = 0.1 * k;
        sb_force_record forces[BODIES];
        for (int b = 0; b < BODIES; b++) {
            double size = 1e7 * (b + 1) / (1 + 0.02 * pow(t - 40 - 2 * b, 2));
            sb_vec3 f = sb_vec(size, 0.2 * size * sin(t), -0.3 * size);
            forces[b] = (sb_force_record){(size_t)b, t, f, sb_vec(0, 0, 0), f, sb_vec(0, 0, 0)};
        }
        const double none = (double)NAN, wave = 25 / pow(cosh((t - 30) / 6), 2);
        const double near = t < 35 || t > 70 ? none : 9 * exp(-(t - 35) / 12);
        const sb_gauge_record levels[] = {{0, t, none, wave}, {1, t, none, near}};
        const sb_probe_record point = {0, t, {10 * sin(t / 9), 1, 0}, 1e5 * (1 + sin(t / 5))};
        const sb_energy_record energy = {.time = t,
                                         .kinetic = 3e11 * exp(-pow(t / 30 - 1, 2)),
                                         .potential = 5e13 + 1e11 * sin(t / 15),
                                         .mass = 1.8e10};
        const sb_measure_records records = {.force_count = BODIES,
                                            .forces = forces,
                                            .gauge_count = 2,
                                            .gauges = levels,
                                            .probe_count = 1,
                                            .probes = &point,
                                            .energy_count = 1,
                                            .energies = &energy};
        assert_int_equal(sb_csv_write(csv, &records, NULL), SB_OK);
    }
    assert_int_equal(sb_csv_close(csv, NULL), SB_OK);
}

static void write_maps(bool beside)
{
    enum { COLUMNS = 130, ROWS = 115 };
    static float values[COLUMNS * ROWS];
    for (int j = 0; j < ROWS; j++)
        for (int i = 0; i < COLUMNS; i++)
            values[j * COLUMNS + i] = i > 100 + j / 10 ? NAN : (float)(38 - 0.3 * i + 0.05 * j);
    const sb_map_record map = {COLUMNS, ROWS, 0, -575, 10, values, values, values, values, values, values};
    assert_int_equal(sb_maps_write(folder, &map, beside, NULL), SB_OK);
}

static bool is_png(const char *name)
{
    unsigned char start[8] = {0};
    FILE *stream = fopen(in_folder(name), "rb");
    if (!stream) return false;
    size_t got = fread(start, 1, sizeof start, stream);
    struct stat status;
    bool large = fstat(fileno(stream), &status) == 0 && status.st_size > 5000;
    fclose(stream);
    return got == 8 && large && memcmp(start, "\x89PNG\r\n\x1a\n", 8) == 0;
}

/* A tool is started in another directory, where a relative path would mean another file. */
static void relative_folders_on_path_are_ignored(void **state)
{
    (void)state;
    char kept[4096], path[SB_PATH_MAX], relative[SB_PATH_MAX + 8];
    snprintf(kept, sizeof kept, "%s", getenv("PATH") ? getenv("PATH") : "");
    char *here = getcwd(NULL, 0);
    assert_non_null(here);
    assert_int_equal(chdir(folder), 0);
    assert_int_equal(symlink("/bin/true", "a-tool"), 0);
    snprintf(relative, sizeof relative, ".:%s", folder);
    setenv("PATH", relative, 1);
    assert_true(sb_tool_find("a-tool", path) && path[0] == '/');
    setenv("PATH", ".", 1);
    assert_false(sb_tool_find("a-tool", path));
    setenv("PATH", kept, 1);
    unlink("a-tool");
    assert_int_equal(chdir(here), 0);
    free(here);
}

static void pictures_are_drawn(void **state)
{
    (void)state;
    char program[SB_PATH_MAX];
    if (!sb_tool_find("gnuplot", program)) skip();
    write_tables();
    write_maps(false);
    sb_runlog *log;
    assert_int_equal(sb_runlog_open(in_folder("run.jsonl"), &log, NULL), SB_OK);
    int drawn = sb_plots_write(folder, &scene, log);
    assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
    char *text = text_of("run.jsonl");
    if (strstr(text, "warning")) fail_msg("%s", text);
    sb_free(text);
    assert_int_equal(drawn, 9);
    const char *const names[] = {"plots/forces.png", "plots/gauges.png",   "plots/probes.png",
                                 "plots/energy.png", "maps/max_depth.png", "maps/arrival_time.png"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) assert_true(is_png(names[i]));
    assert_true(access(in_folder("maps/ground.asc"), F_OK) == 0);
    assert_true(access(in_folder("maps/ground.png"), F_OK) != 0); /* no map of the water */
    assert_true(access(in_folder("plots/forces.gp"), F_OK) != 0);
    assert_true(access(in_folder("plots/forces.dat"), F_OK) != 0);
}

static void dry_places_have_no_plot(void **state)
{
    (void)state;
    char program[SB_PATH_MAX];
    if (!sb_tool_find("gnuplot", program)) skip();
    remove(in_folder("plots/probes.png"));
    FILE *table = fopen(in_folder("probes.csv"), "w");
    assert_non_null(table);
    fputs("time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa\n0,inlet,,,,\n1,inlet,,,,\n2,inlet,,,,\n", table);
    fclose(table);
    sb_runlog *log;
    assert_int_equal(sb_runlog_open(in_folder("run.jsonl"), &log, NULL), SB_OK);
    assert_int_equal(sb_plots_write(folder, &scene, log), 8);
    assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
    char *text = text_of("run.jsonl");
    if (strstr(text, "warning")) fail_msg("%s", text);
    assert_non_null(strstr(text, "probes.csv contains dry places only"));
    sb_free(text);
    assert_true(access(in_folder("plots/probes.png"), F_OK) != 0);
}

static void write_text(const char *name, const char *text)
{
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* A fake gnuplot that copies its script and data to a file. */
static void plots_have_the_right_titles(void **state)
{
    (void)state;
    char bin[SB_PATH_MAX];
    char *path = sb_strdup(getenv("PATH"));
    assert_int_equal(sb_make_directories(in_folder("bin"), NULL), SB_OK);
    write_text("bin/gnuplot", "#!/bin/sh\n/bin/cat \"$1\" \"${1%.gp}.dat\" >>drawn\necho >plots/part.png\n");
    assert_int_equal(chmod(in_folder("bin/gnuplot"), 0700), 0);
    snprintf(bin, sizeof bin, "%s", in_folder("bin"));
    write_text("gauges.csv", "time_s,gauge,eta_m,z_m\n0,offshore,0.5,2.5\n1,offshore,0.25,2.25\n");
    write_text("runup.csv", "time_s,line,x_m,y_m,z_m,front_m,apart_m\n0,beach,1,2,3,4,7\n1,beach,1,2,3,5,8\n");
    write_maps(false);
    write_maps(true);
    for (int level = 0; level < 2; level++) {
        sb_runlog *log;
        unlink(in_folder("drawn"));
        scene.sea = (sb_sea){.present = level, .level = 2};
        assert_int_equal(sb_runlog_open(in_folder("titles.jsonl"), &log, NULL), SB_OK);
        setenv("PATH", bin, 1);
        sb_plots_write(folder, &scene, log);
        setenv("PATH", path, 1);
        assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
        char *drawn = text_of("drawn");
        assert_non_null(drawn);
        assert_true((strstr(drawn, "'elevation above still water (m)'") != NULL) == level);
        assert_true((strstr(drawn, "\n0 0.5\n1 0.25\n") != NULL) == level);
        assert_true((strstr(drawn, "'absolute elevation z (m)'") != NULL) == !level);
        assert_true((strstr(drawn, "\n0 2.5\n1 2.25\n") != NULL) == !level);
        assert_non_null(strstr(drawn, ": greatest depth (m)'"));
        assert_non_null(strstr(drawn, ": grid, greatest depth (m)'"));
        assert_non_null(strstr(drawn, "'run-up, absolute z (m)'"));
        assert_non_null(strstr(drawn, "'front from first end (m)'"));
        assert_non_null(strstr(drawn, "'length of unconnected water (m)'"));
        assert_non_null(strstr(drawn, "\n0 3 4 7\n1 3 5 8\n"));
        sb_free(drawn);
    }
    scene.sea = (sb_sea){0};
    sb_free(path);
}

static void missing_programs_are_reported(void **state)
{
    (void)state;
    char *path = sb_strdup(getenv("PATH"));
    sb_runlog *log;
    assert_int_equal(sb_runlog_open(in_folder("absent.jsonl"), &log, NULL), SB_OK);
    setenv("PATH", "/nonexistent", 1);
    assert_int_equal(sb_plots_write(folder, &scene, log), 0);
    assert_false(sb_video_write(folder, "beach", 3, 30, log));
    setenv("PATH", path, 1);
    sb_free(path);
    assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
    char *text = text_of("absent.jsonl");
    assert_non_null(strstr(text, "gnuplot was not found"));
    assert_non_null(strstr(text, "ffmpeg was not found"));
    assert_null(strstr(text, "warning"));
    sb_free(text);
}

static void failing_programs_are_reported(void **state)
{
    (void)state;
    sb_error error = {0};
    char *const arguments[] = {"sh", "-c", "echo first; echo the reason >&2; exit 3", NULL};
    assert_int_equal(sb_tool_run("/bin/sh", arguments, folder, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "status 3: the reason"));
    char *const good[] = {"sh", "-c", "test \"$(pwd -P)\" = \"$(cd . && pwd -P)\" && touch here", NULL};
    assert_int_equal(sb_tool_run("/bin/sh", good, folder, &error), SB_OK);
    assert_int_equal(access(in_folder("here"), F_OK), 0);
    assert_int_equal(sb_tool_run("/nonexistent", good, folder, &error), SB_FAILED);
}

/* A video of three copies of one picture, with odd sides and an unusual name. */
static void videos_are_joined(void **state)
{
    (void)state;
    char gnuplot[SB_PATH_MAX], ffmpeg[SB_PATH_MAX];
    if (!sb_tool_find("gnuplot", gnuplot) || !sb_tool_find("ffmpeg", ffmpeg)) skip();
    assert_int_equal(sb_make_directories(in_folder("frames/50% 'off'"), NULL), SB_OK);
    for (int i = 1; i <= 3; i++) {
        char script[256];
        snprintf(script, sizeof script,
                 "set terminal pngcairo size 201,151; set output \"frames/50%% 'off'/%06d.png\"; "
                 "plot %d*x",
                 i, i);
        char *const arguments[] = {"gnuplot", "-e", script, NULL};
        assert_int_equal(sb_tool_run(gnuplot, arguments, folder, NULL), SB_OK);
    }
    sb_runlog *log;
    assert_int_equal(sb_runlog_open(in_folder("film.jsonl"), &log, NULL), SB_OK);
    bool made = sb_video_write(folder, "50% 'off'", 3, 30, log);
    assert_false(sb_video_write(folder, "no such camera", 3, 30, log));
    assert_false(
        sb_video_write(folder, "50% 'off'", 4, 30, log)); /* a picture is missing, and the video of three stays */
    assert_int_equal(sb_runlog_close(log, NULL), SB_OK);
    char *text = text_of("film.jsonl");
    if (!made) fail_msg("%s", text);
    assert_non_null(strstr(text, "no such camera.mp4"));
    assert_non_null(strstr(text, "picture 4 of 4 is missing"));
    sb_free(text);
    struct stat status;
    assert_int_equal(stat(in_folder("50% 'off'.mp4"), &status), 0);
    assert_true(status.st_size > 1000);
    assert_true(access(in_folder("no such camera.mp4"), F_OK) != 0);
    assert_true(access(in_folder(".50% 'off'.part.mp4"), F_OK) != 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(relative_folders_on_path_are_ignored),
        cmocka_unit_test(pictures_are_drawn),
        cmocka_unit_test(dry_places_have_no_plot),
        cmocka_unit_test(missing_programs_are_reported),
        cmocka_unit_test(failing_programs_are_reported),
        cmocka_unit_test(videos_are_joined),
        cmocka_unit_test(plots_have_the_right_titles),
    };
    return cmocka_run_group_tests(tests, folder_make, getenv("SB_KEEP_TEST_FILES") ? NULL : folder_remove);
}
