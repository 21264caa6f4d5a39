/* Makes the folder of a run for reports, with chosen names and numbers of rows. */
#ifndef SB_TESTS_REPORT_FIXTURE_H
#define SB_TESTS_REPORT_FIXTURE_H

#include "../check.h"
#include "../output/folder.h"

#include "report/report.h"

#include <stdio.h>
#include <sys/stat.h>

static inline void write_text(const char *name, const char *text)
{
    FILE *file = fopen(in_folder(name), "w");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

#define FORCES_HEADER "time_s,body,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm\n"

static const char scene_text[] = "title: A quiet basin\n"
                                 "resolution: 0.1\n"
                                 "duration: 10\n"
                                 "domain: {min: [0, 0, 0], max: [2, 1, 1]}\n"
                                 "water: {boxes: [{min: [0, 0, 0], max: [1, 1, 0.5]}]}\n"
                                 "measure: {interval: 0.1, gauges: [{name: near, x: 0.5, y: 0.5}]}\n";

/* Rows of `bodies` bodies every 0.1 s. Body k has the horizontal force (k + 1) t (3, 4) N up to a peak of one row; so
   the greatest is 5 (k + 1) t at the last time, and 1e6 + k at the row `spike`. */
static inline void write_forces(int bodies, int rows, int spike)
{
    FILE *file = fopen(in_folder("run/forces.csv"), "w");
    assert_non_null(file);
    fputs(FORCES_HEADER, file);
    for (int row = 1; row <= rows; row++)
        for (int k = 0; k < bodies; k++) {
            const double time = 0.1 * row, force = (k + 1) * time;
            if (row == spike)
                fprintf(file, "%.12g,body-%d,%d,0,0,0,0,0\n", time, k, 1000000 + k);
            else
                fprintf(file, "%.12g,body-%d,%.9g,%.9g,%.9g,%.9g,%.9g,0\n", time, k, 3 * force, 4 * force,
                        -force * (row % 7), 5 * force, 12 * force);
        }
    assert_int_equal(fclose(file), 0);
}

/* A run that has ended, with two bodies and a gauge. */
static inline void make_run(void)
{
    mkdir(in_folder("run"), 0777);
    write_text("run/scene.yaml", scene_text);
    write_text("run/run.jsonl",
               "{\"event\":\"start\",\"version\":\"0.1.0\",\"fluid_particles\":5000,\"warnings\":[\"a thin plate\"]}\n"
               "{\"event\":\"arguments\",\"folder\":\"/somewhere\",\"arguments\":[\"run\",\"a b.yaml\",\"--quiet\"]}\n"
               "{\"event\":\"step\",\"step\":100,\"time_s\":9.5,\"lost\":0}\n");
    write_text("run/summary.json",
               "{\"version\":\"0.1.0\",\"title\":\"A quiet "
               "basin\",\"status\":\"done\",\"simulated_s\":10,\"resolution_m\":0.1,\"steps\":100,"
               "\"fluid_particles\":5000,\"compression_mean\":0.0001,\"compression_max\":0.01,\"capped_steps\":0,"
               "\"lost_particles\":0,\"bodies\":[{\"name\":\"body-0\",\"flow_layers\":2.5,\"too_coarse\":true,"
               "\"gap_m\":null,\"narrow_gap\":false,\"moment_point_m\":[1,0.5,0]},{\"name\":\"body-1\","
               "\"flow_layers\":6,\"too_coarse\":false,\"gap_m\":0.07,\"narrow_gap\":true}]}\n");
    write_text("run/gauges.csv", "time_s,gauge,eta_m,z_m\n0,near,,0.5\n0.1,near,,0.6\n0.2,near,,\n0.3,near,,0.4\n");
    write_text("run/energy.csv", "time_s,kinetic_J,potential_J,mass_kg,momentum_x_kg_m_s,momentum_y_kg_m_s,"
                                 "momentum_z_kg_m_s,bodies_J,viscosity_J,wall_friction_J,pressure_solve_J,contact_J,"
                                 "time_integration_J,left_domain_J,momentum_imbalance,packing_stress_J,sea_J,"
                                 "sponge_J,surface_tension_J\n"
                                 "0,0,100,1,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0\n"
                                 "0.1,10,68,1,0,0,0,0,-1,0,-1,0,0,0,0,0,0,-20,0\n");
    write_forces(2, 100, 50);
}

/* Writes the report to page.html, and returns its text; free with sb_free. */
static inline char *report_text(void)
{
    sb_error error = {0};
    size_t bytes = 0;
    if (sb_report_write(in_folder("run"), in_folder("page.html"), &(sb_report_options){0}, &bytes, &error) != SB_OK)
        fail_msg("%s", error.text);
    char *text = text_of("page.html");
    assert_non_null(text);
    assert_int_equal(strlen(text), bytes);
    assert_true(bytes < SB_REPORT_BYTES_MAX);
    return text;
}

static inline void assert_has(const char *text, const char *expected)
{
    if (!strstr(text, expected)) fail_msg("the page has no \"%s\"", expected);
}

#endif
