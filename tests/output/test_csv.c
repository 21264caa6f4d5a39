/* The tables: exact headers, rows, empty fields, names that need quotes, full disks. */
#include "output/tables/csv.h"

#include "folder.h"
#include "output/tables/hashed_file.h"
#include "output/tables/series.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>
#include <errno.h>
#include <signal.h>
#include <sys/resource.h>

static sb_model_body bodies[2] = {{.name = "reactor1", .report = true}, {.name = "a \"b\", c", .report = true}};
static sb_gauge gauges[1] = {{"offshore", 1, 2, 0}};
static sb_probe probes[1] = {{"inlet", {0, 0, 0}, 0}};
static sb_flow_plane planes[1] = {
    {.name = "quay", .by = 1, .z_max = 1, .record = true, .record_interval = 0.1, .record_spacing = 1}};
static sb_runup_line lines[1] = {{"beach", 0, 0, 1, 0}};

static sb_reflection_set sets[1] = {{.name = "array"}};

static sb_wavemaker_use makers[1] = {{.name = "taker", .body = "reactor1", .law = {.absorb = true}}};

static sb_scene make_scene(int dimensions, bool all)
{
    sb_scene scene = {.dimensions = dimensions, .wavemaker_count = all, .wavemakers = makers};
    scene.measure = (sb_measure_settings){.interval = 0.1,
                                          .gauge_count = 1,
                                          .gauges = gauges,
                                          .probe_count = 1,
                                          .probes = probes,
                                          .plane_count = all,
                                          .planes = planes,
                                          .runup_count = all,
                                          .runups = lines,
                                          .reflection_count = all,
                                          .reflections = sets};
    return scene;
}

static const sb_model model = {.body_count = 2, .bodies = bodies};

static void expect(const char *name, const char *text)
{
    char *found = text_of(name);
    assert_non_null(found);
    assert_string_equal(found, text);
    sb_free(found);
}

static void headers_are_exact(void **state)
{
    (void)state;
    sb_scene scene = make_scene(3, true);
    sb_csv *csv;
    assert_int_equal(sb_csv_open(folder, &scene, &model, &csv, NULL), SB_OK);
    /* The file is not closed yet: a stopped run has the rows too. */
    expect("forces.csv", "time_s,body,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm,Fx_pressure_N,Fy_pressure_N,"
                         "Fz_pressure_N,Fx_friction_N,Fy_friction_N,Fz_friction_N\n");
    expect("gauges.csv", "time_s,gauge,eta_m,z_m\n");
    expect("probes.csv", "time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa\n");
    expect("overtopping.csv", "time_s,plane,volume_m3,flux_m3_s\n");
    expect("record.csv", SB_RECORD_HEADER "\n");
    expect("runup.csv", "time_s,line,x_m,y_m,z_m,front_m,apart_m\n");
    expect("reflections.csv",
           "time_s,set,from_s,harmonic,period_s,wavelength_m,incident_m,reflected_m,coefficient,misfit_m,"
           "separation,bound_incident_m,bound_reflected_m\n");
    expect("absorbers.csv", "time_s,body,offset_m,drift_m,law_m\n");
    expect("energy.csv", "time_s,kinetic_J,potential_J,mass_kg,momentum_x_kg_m_s,"
                         "momentum_y_kg_m_s,momentum_z_kg_m_s,bodies_J,viscosity_J,"
                         "wall_friction_J,pressure_solve_J,contact_J,time_integration_J,"
                         "left_domain_J,momentum_imbalance,packing_stress_J,sea_J,sponge_J,"
                         "surface_tension_J\n");
    assert_int_equal(sb_csv_close(csv, NULL), SB_OK);
    scene = make_scene(2, false);
    unlink(in_folder("runup.csv"));
    unlink(in_folder("absorbers.csv"));
    assert_int_equal(sb_csv_open(folder, &scene, &model, &csv, NULL), SB_OK);
    assert_int_equal(sb_csv_close(csv, NULL), SB_OK);
    expect("forces.csv", "time_s,body,Fx_N_per_m,Fy_N_per_m,Fz_N_per_m,Mx_Nm_per_m,My_Nm_per_m,Mz_Nm_per_m,"
                         "Fx_pressure_N_per_m,Fy_pressure_N_per_m,Fz_pressure_N_per_m,Fx_friction_N_per_m,"
                         "Fy_friction_N_per_m,Fz_friction_N_per_m\n");
    assert_true(access(in_folder("runup.csv"), F_OK) != 0);
    assert_true(access(in_folder("absorbers.csv"), F_OK) != 0);
}

static void rows_are_flushed_at_once(void **state)
{
    (void)state;
    sb_scene scene = make_scene(3, true);
    sb_csv *csv;
    double nan = (double)NAN;
    const sb_force_record forces[] = {
        {0, 0.1, {1, 2, 3}, {4, 5, 6}, {1.5, 2, 3}, {-0.5, 0, -0.0}},
        {1, 0.1, {1e9 / 3, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}},
    };
    const sb_gauge_record levels[] = {{0, 0, 1.25, 3.25}, {0, 0.1, nan, nan}};
    const sb_probe_record points[] = {{0, 0.1, {1, 0, -2}, 9810}, {0, 0.2, {nan, nan, nan}, nan}};
    const sb_flow_record flows[] = {{0, 0.1, 12.5, 3}};
    const sb_runup_record runups[] = {{0, 0.1, {1, 2, 3}, 4, 0.5}};
    const sb_energy_record energies[] = {
        {0.10123, 5, 6.00000000001, 7, {8, 9, 10}, {11, -12, -13, -14, -15, 16, -17, 18, 19, 20, -21}, 1e-7}};
    const sb_reflection_record splits[] = {{0, 2, 5, 10, 0.5, 3, 0.25, 0.125, 0.01, 0.75, 0.5, 0.0625},
                                           {0, 3, 5, 10, 0.2, 1, nan, nan, nan, 0, nan, nan}};
    sb_water_record waters[] = {{0, 0.1, 0, 0.25, 1.5, -2, {{0, 0, 0}}}, {0, 0.1, 0, 0.75, nan, -2, {{0, 0, 0}}}};
    for (int j = 0; j < SB_RECORD_LAYERS; j++) {
        waters[0].velocity[j] = sb_vec(1 + j, -1 - j, 0.5);
        waters[1].velocity[j] = sb_vec(nan, nan, nan);
    }
    const sb_absorber_record offsets[] = {{0, 0.1, -0.25, 0.125, 0.5}};
    const sb_measure_records records = {2,     2,      2,        1, 1,      1, forces, levels, points,
                                        flows, runups, energies, 2, splits, 2, waters, 1,      offsets};
    assert_int_equal(sb_csv_open(folder, &scene, &model, &csv, NULL), SB_OK);
    assert_int_equal(sb_csv_write(csv, &records, NULL), SB_OK);
    char *text = text_of("forces.csv"); /* before closing */
    assert_string_equal(strchr(text, '\n') + 1, "0.1,reactor1,1,2,3,4,5,6,1.5,2,3,-0.5,0,0\n"
                                                "0.1,\"a \"\"b\"\", c\",333333333,0,0,0,0,0,0,0,0,0,0,0\n");
    sb_free(text);
    expect("gauges.csv", "time_s,gauge,eta_m,z_m\n0,offshore,1.25,3.25\n0.1,offshore,,\n");
    expect("probes.csv", "time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa\n0.1,inlet,1,0,-2,9810\n"
                         "0.2,inlet,,,,\n");
    expect("overtopping.csv", "time_s,plane,volume_m3,flux_m3_s\n0.1,quay,12.5,3\n");
    expect("runup.csv", "time_s,line,x_m,y_m,z_m,front_m,apart_m\n0.1,beach,1,2,3,4,0.5\n");
    expect("absorbers.csv", "time_s,body,offset_m,drift_m,law_m\n0.1,reactor1,-0.25,0.125,0.5\n");
    text = text_of("reflections.csv");
    assert_string_equal(strchr(text, '\n') + 1,
                        "10,array,5,2,0.5,3,0.25,0.125,0.5,0.01,0.75,0.5,0.0625\n10,array,5,3,0.2,1,,,,,0,,\n");
    sb_free(text);
    text = text_of("record.csv");
    assert_string_equal(
        strchr(text, '\n') + 1,
        "0.1,quay,0,0.25,1.5,-2,1,2,3,4,5,6,7,8,-1,-2,-3,-4,-5,-6,-7,-8,0.5,0.5,0.5,0.5,0.5,0.5,0.5,0.5\n"
        "0.1,quay,0,0.75,,-2,,,,,,,,,,,,,,,,,,,,,,,,\n");
    sb_free(text);
    text = text_of("energy.csv");
    assert_string_equal(strchr(text, '\n') + 1,
                        "0.10123,5,6.00000000001,7,8,9,10,11,-12,-13,-14,-15,16,-17,1e-07,18,19,20,-21\n");
    sb_free(text);
    assert_int_equal(sb_csv_close(csv, NULL), SB_OK);
}

static void tables_read_back_as_series(void **state)
{
    (void)state;
    sb_series series;
    assert_int_equal(sb_series_read(in_folder("forces.csv"), true, &series, NULL), SB_OK);
    assert_int_equal(series.name_count, 2);
    assert_string_equal(series.names[1], "a \"b\", c");
    assert_int_equal(series.row_count, 2);
    assert_true(series.rows[0].values[7] == 6 && series.rows[1].values[2] == 333333333);
    sb_series_free(&series);
    assert_int_equal(sb_series_read(in_folder("gauges.csv"), true, &series, NULL), SB_OK);
    assert_true(isnan(series.rows[1].values[2]));
    sb_series_free(&series);
}

/* Flips one bit; a second call restores it. */
static void change_byte(const char *name, long at)
{
    FILE *file = fopen(in_folder(name), "r+");
    assert_non_null(file);
    assert_int_equal(fseek(file, at, SEEK_SET), 0);
    const int byte = fgetc(file) ^ 1;
    assert_int_equal(fseek(file, at, SEEK_SET), 0);
    assert_int_equal(fputc(byte, file), byte);
    assert_int_equal(fclose(file), 0);
}

/* Rows after the marks are removed; the rows that follow are written once. */
static void tables_continue_from_their_marks(void **state)
{
    (void)state;
    sb_scene scene = make_scene(3, false);
    sb_csv *csv;
    sb_csv_marks marks;
    sb_error error = {0};
    const sb_gauge_record levels[] = {{0, 0, 1, 1}, {0, 0.1, 2, 2}, {0, 0.2, 3, 3}};
    sb_measure_records one = {.gauge_count = 1, .gauges = levels};
    assert_int_equal(sb_csv_open(folder, &scene, &model, &csv, NULL), SB_OK);
    assert_int_equal(sb_csv_write(csv, &one, NULL), SB_OK);
    assert_int_equal(sb_csv_sync(csv, &marks, NULL), SB_OK);
    one.gauges = levels + 1;
    assert_int_equal(sb_csv_write(csv, &one, NULL), SB_OK);
    assert_int_equal(sb_csv_close(csv, NULL), SB_OK);
    expect("gauges.csv", "time_s,gauge,eta_m,z_m\n0,offshore,1,1\n0.1,offshore,2,2\n");
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_OK);
    assert_int_equal(sb_csv_resume(folder, &scene, &model, &marks, &csv, NULL), SB_OK);
    expect("gauges.csv", "time_s,gauge,eta_m,z_m\n0,offshore,1,1\n");
    one.gauges = levels + 2;
    assert_int_equal(sb_csv_write(csv, &one, NULL), SB_OK);
    assert_int_equal(sb_csv_sync(csv, &marks, NULL), SB_OK);
    expect("gauges.csv", "time_s,gauge,eta_m,z_m\n0,offshore,1,1\n0.2,offshore,3,3\n");
    assert_int_equal(marks.bytes[1], strlen("time_s,gauge,eta_m,z_m\n0,offshore,1,1\n0.2,offshore,3,3\n"));
    /* A table that was changed is refused, even if its length is the same. */
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_OK);
    change_byte("gauges.csv", 25);
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "gauges.csv: was changed since the run wrote it, expected its first 55 bytes"));
    change_byte("gauges.csv", 25);
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_OK);
    /* Writing to a table that was removed is an error. */
    unlink(in_folder("gauges.csv"));
    assert_int_equal(sb_csv_write(csv, &one, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "gauges.csv: was removed while the run wrote it"));
    assert_int_equal(sb_csv_close(csv, NULL), SB_FAILED);
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "gauges.csv: cannot read"));
    marks.bytes[0]++;
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "forces.csv: has "));
}

/* A table with the columns of another version, here without z_m, is not continued. */
static void other_columns_are_not_continued(void **state)
{
    (void)state;
    static const char old[] = "time_s,gauge,eta_m\n0,offshore,1\n";
    sb_scene scene = make_scene(3, false);
    sb_csv *csv;
    sb_csv_marks marks;
    sb_error error = {0};
    sb_running_hash hash = {0};
    unlink(in_folder("gauges.csv"));
    assert_int_equal(sb_csv_open(folder, &scene, &model, &csv, NULL), SB_OK);
    assert_int_equal(sb_csv_sync(csv, &marks, NULL), SB_OK);
    assert_int_equal(sb_csv_close(csv, NULL), SB_OK);
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_OK);
    FILE *file = fopen(in_folder("gauges.csv"), "w");
    assert_non_null(file);
    fputs(old, file);
    assert_int_equal(fclose(file), 0);
    sb_hash_add(&hash, old, strlen(old));
    marks.bytes[1] = strlen(old);
    marks.hash[1] = sb_hash_sum(&hash);
    assert_int_equal(sb_csv_check(folder, &scene, &marks, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "gauges.csv:1: has the columns `time_s,gauge,eta_m` of another version, "
                                       "expected `time_s,gauge,eta_m,z_m`: start a new run"));
    expect("gauges.csv", old);
}

static void a_full_disk_is_a_failed_run(void **state)
{
    (void)state;
    sb_scene scene = make_scene(3, false);
    sb_csv *csv = NULL;
    sb_error error = {0};
    struct rlimit kept;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &kept), 0);
    const struct rlimit limit = {100, kept.rlim_max}; /* bytes per file: the first header is longer */
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    sb_status status = sb_csv_open(folder, &scene, &model, &csv, &error);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &kept), 0);
    assert_int_equal(status, SB_FAILED);
    assert_non_null(strstr(error.text, "forces.csv: cannot write: File too large"));
    assert_int_equal(sb_csv_open("/nonexistent/folder", &scene, &model, &csv, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "/nonexistent/folder"));
}

/* After a write error nothing is written: later lines would be joined to an incomplete one. */
static void nothing_is_written_after_an_error(void **state)
{
    (void)state;
    sb_hashed_file file;
    sb_error error = {0};
    struct rlimit kept;
    assert_int_equal(sb_hashed_open(&file, in_folder("lines"), &error), SB_OK);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &kept), 0);
    const struct rlimit limit = {10, kept.rlim_max};
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    fputs("first\nsecond\n", file.stream);
    assert_true(fflush(file.stream) != 0);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &kept), 0);
    fputs("third\n", file.stream);
    (void)fflush(file.stream);
    errno = 0;
    assert_int_equal(sb_hashed_close(&file), EOF);
    assert_int_equal(errno, EFBIG);
    expect("lines", "first\n");
}

static void no_table_is_written_through_a_link(void **state)
{
    (void)state;
    char target[SB_PATH_MAX], text[16] = "";
    sb_scene scene = make_scene(3, false);
    sb_csv *csv = NULL;
    sb_error error = {0};
    snprintf(target, sizeof target, "%s", in_folder("precious"));
    FILE *file = fopen(target, "w");
    fputs("precious", file);
    fclose(file);
    unlink(in_folder("gauges.csv"));
    assert_int_equal(symlink(target, in_folder("gauges.csv")), 0);
    assert_int_equal(sb_csv_open(folder, &scene, &model, &csv, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "gauges.csv: is a symbolic link, expected a regular file or nothing"));
    file = fopen(target, "r");
    assert_non_null(fgets(text, sizeof text, file));
    fclose(file);
    assert_string_equal(text, "precious");
    unlink(in_folder("gauges.csv"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(headers_are_exact),
        cmocka_unit_test(rows_are_flushed_at_once),
        cmocka_unit_test(tables_read_back_as_series),
        cmocka_unit_test(tables_continue_from_their_marks),
        cmocka_unit_test(a_full_disk_is_a_failed_run),
        cmocka_unit_test(no_table_is_written_through_a_link),
        cmocka_unit_test(nothing_is_written_after_an_error),
        cmocka_unit_test(other_columns_are_not_continued),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
