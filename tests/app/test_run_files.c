/* The files of a run: they exist, and their contents are as documented. */
#include "program.h"

#include "../output/json_check.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "output/particles/pvd.h"
#include "output/particles/vtp.h"
#include "scene/scene.h"

#include <ftw.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NUMBERS = 13 }; /* time and twelve components */

static char names_there[64][160]; /* names of the files found */
static size_t count_there;

typedef struct force_row {
    char body[64];
    double value[NUMBERS];
} force_row;

static const char forces_3d[] =
    "time_s,body,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm,Fx_pressure_N,Fy_pressure_N,Fz_pressure_N,"
    "Fx_friction_N,Fy_friction_N,Fz_friction_N\n";
static const char forces_2d[] = "time_s,body,Fx_N_per_m,Fy_N_per_m,Fz_N_per_m,Mx_Nm_per_m,My_Nm_per_m,Mz_Nm_per_m,"
                                "Fx_pressure_N_per_m,Fy_pressure_N_per_m,Fz_pressure_N_per_m,Fx_friction_N_per_m,"
                                "Fy_friction_N_per_m,Fz_friction_N_per_m\n";

/* Makes one run of each tank, used by most tests. The 3D run has steps of at most 1/200 s, so that a step ends at 0.3
 * s. */
static int setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "r3", "--set", "numerics.time_step_max=0.005");
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out=r2", "--quiet");
    return 0;
}

/* The rows after the header, which must be this one. */
static const char *rows_of(const char *text, const char *header)
{
    if (strncmp(text, header, strlen(header)) != 0) fail_msg("not the expected header:\n%s", text);
    return text + strlen(header);
}

static const char *next_line(const char *line)
{
    const char *end = strchr(line, '\n');
    if (!end) fail_msg("a line without a newline: %s", line);
    return end + 1;
}

static size_t read_forces(const char *name, const char *header, force_row *rows, size_t most)
{
    char *text = text_of(name);
    size_t count = 0;
    for (const char *line = rows_of(text, header); *line; line = next_line(line)) {
        assert_true(count < most);
        force_row *row = &rows[count++];
        char *end;
        row->value[0] = strtod(line, &end);
        int length = 0;
        assert_int_equal(sscanf(end, ",%63[^,]%n", row->body, &length), 1);
        end += length;
        for (int k = 1; k < NUMBERS; k++) {
            assert_int_equal(*end, ',');
            const char *field = end + 1;
            row->value[k] = strtod(field, &end);
            assert_true(end > field && isfinite(row->value[k]));
        }
        assert_int_equal(*end, '\n');
    }
    sb_free(text);
    return count;
}

static void every_file_is_there(void **state)
{
    (void)state;
    static const char *const names[] = {"scene.yaml",
                                        "run.jsonl",
                                        "forces.csv",
                                        "gauges.csv",
                                        "probes.csv",
                                        "energy.csv",
                                        "frames/side/000001.png",
                                        "frames/side/000004.png",
                                        "frames/front/000001.png",
                                        "frames/front/000004.png",
                                        "particles/000001.vtp",
                                        "particles/000004.vtp",
                                        "particles.pvd",
                                        "summary.json"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (access(in_folder("r3/%s", names[i]), F_OK) != 0) fail_msg("no %s", names[i]);
    assert_false(exists("r3/particles/000005.vtp"));
    assert_false(exists("r2/frames"));
    assert_false(any_ending("r3", ".tmp"));
}

static void scene_is_written_as_resolved(void **state)
{
    (void)state;
    sb_scene first = {0}, again = {0};
    sb_error error = {0};
    assert_int_equal(sb_scene_read(in_folder("r3/scene.yaml"), NULL, NULL, 0, &first, &error), SB_OK);
    assert_near(first.numerics.time_step_max, 0.005, 0);
    assert_near(first.fluid.density, 1000, 0);
    char *text = text_of("r3/scene.yaml");
    static const char *const defaults[] = {
        "density:", "viscosity:", "kernel:", "wall_offset:", "sides:", "decimation:", "video_rate:"};
    for (size_t d = 0; d < sizeof defaults / sizeof defaults[0]; d++) assert_contains(text, defaults[d]);
    sb_free(text);
    /* The written scene gives the same run. */
    RUN_AND_FORGET(0, "run", "r3/scene.yaml", "--out", "again", "--quiet");
    assert_int_equal(sb_scene_read(in_folder("again/scene.yaml"), NULL, NULL, 0, &again, &error), SB_OK);
    assert_string_equal(first.title, again.title);
    char *forces = text_of("r3/forces.csv"), *forces_again = text_of("again/forces.csv");
    assert_string_equal(forces, forces_again);
    sb_free(forces);
    sb_free(forces_again);
    sb_scene_free(&first);
    sb_scene_free(&again);
}

static void log_is_lines_of_objects(void **state)
{
    (void)state;
    char *text = text_of("r3/run.jsonl");
    static const char *const events[] = {"\"start\"", "\"skipped\"", "\"step\"", "\"end\""};
    for (size_t e = 0; e < sizeof events / sizeof events[0]; e++) assert_contains(text, events[e]);
    size_t lines = 0;
    for (char *line = text, *end; *line; line = end + 1, lines++) {
        end = strchr(line, '\n');
        assert_non_null(end);
        *end = '\0';
        if (*line != '{' || !json_valid(line)) fail_msg("no JSON object: %s", line);
    }
    assert_true(lines >= 6);
    sb_free(text);
}

static void forces_have_a_row_per_body_and_interval(void **state)
{
    (void)state;
    force_row rows[64];
    assert_int_equal(read_forces("r3/forces.csv", forces_3d, rows, 64), 2 * 6);
    for (size_t i = 0; i < 12; i++) {
        assert_near(rows[i].value[0], 0.05 * (double)(1 + i / 2), 1e-12);
        assert_string_equal(rows[i].body, i % 2 ? "sill" : "post");
        for (int k = 1; k <= 3; k++) /* the total is the sum of pressure and friction */
            assert_near(rows[i].value[k], rows[i].value[k + 6] + rows[i].value[k + 9],
                        1e-6 * (1 + fabs(rows[i].value[k])));
    }
    assert_true(rows[10].value[1] > 0); /* the water pushes the post in the +x direction */
    assert_int_equal(read_forces("r2/forces.csv", forces_2d, rows, 64), 6);
    for (size_t i = 0; i < 6; i++) {
        assert_near(rows[i].value[0], 0.05 * (double)(1 + i), 1e-12);
        assert_string_equal(rows[i].body, "step");
        assert_near(rows[i].value[2], 0, 0);
    }
}

/* The three numbers of "impulse_vector_Ns" behind a body's name. */
static void impulse_of(const char *summary, const char *body, double impulse[3])
{
    char name[80];
    snprintf(name, sizeof name, "\"name\": \"%s\"", body);
    const char *at = strstr(summary, name);
    assert_non_null(at);
    at = json_find(at, "impulse_vector_Ns");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "[%lf, %lf, %lf]", &impulse[0], &impulse[1], &impulse[2]), 3);
}

static void forces_add_up_to_the_impulse(void **state)
{
    (void)state;
    force_row rows[64];
    size_t count = read_forces("r3/forces.csv", forces_3d, rows, 64);
    char *summary = text_of("r3/summary.json");
    assert_near(json_number_of("r3/summary.json", "simulated_s"), 0.3, 1e-9);
    double size = 0;
    for (int b = 0; b < 2; b++) {
        double impulse[3], sum[3] = {0};
        impulse_of(summary, b ? "sill" : "post", impulse);
        for (size_t i = (size_t)b; i < count; i += 2)
            for (int k = 0; k < 3; k++) sum[k] += 0.05 * rows[i].value[1 + k];
        for (int k = 0; k < 3; k++) size += fabs(impulse[k]);
        for (int k = 0; k < 3; k++) assert_near(sum[k], impulse[k], 1e-6 * (size + 1));
    }
    assert_true(size > 1);
    sb_free(summary);
}

static void gauges_are_empty_where_dry(void **state)
{
    (void)state;
    char *text = text_of("r3/gauges.csv");
    size_t wet = 0, dry = 0;
    for (const char *line = rows_of(text, "time_s,gauge,eta_m,z_m\n"); *line; line = next_line(line)) {
        double time;
        char name[64];
        int length = 0;
        assert_int_equal(sscanf(line, "%lf,%63[^,],%n", &time, name, &length), 2);
        bool is_dry = strcmp(name, "dry") == 0;
        assert_int_equal(line[length], ','); /* the scene has no still-water level, so eta is empty */
        if (is_dry)
            assert_int_equal(line[length + 1], '\n');
        else
            assert_near(strtod(line + length + 1, NULL), 0.5, 0.2);
        assert_near(time, 0.05 * (double)(is_dry ? dry++ : wet++), 1e-12);
    }
    assert_int_equal(wet, 7);
    assert_int_equal(dry, 7);
    sb_free(text);
}

static void probes_have_all_columns(void **state)
{
    (void)state;
    char *text = text_of("r3/probes.csv");
    size_t count = 0;
    for (const char *line = rows_of(text, "time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa\n"); *line;
         line = next_line(line), count++) {
        double time, u, v, w, p;
        assert_int_equal(sscanf(line, "%lf,deep,%lf,%lf,%lf,%lf\n", &time, &u, &v, &w, &p), 5);
        assert_near(time, 0.05 * (double)count, 1e-12);
        assert_true(fabs(u) < 3 && fabs(v) < 3 && fabs(w) < 3);
        assert_true(p >= 0 && p < 1e5);
    }
    assert_int_equal(count, 7);
    sb_free(text);
}

static void particle_files_and_their_list(void **state)
{
    (void)state;
    sb_particle_list list = {0};
    sb_error error = {0};
    assert_int_equal(sb_pvd_read(in_folder("r3/particles.pvd"), &list, &error), SB_OK);
    assert_int_equal(list.count, 4);
    for (size_t i = 0; i < list.count; i++) {
        sb_frame *frame = NULL;
        /* The first state at or after the due time: at most one step late. */
        assert_in_range(1000 * list.entries[i].time + 1e-6, 100 * i, 100 * i + 5);
        assert_int_equal(sb_vtp_read(in_folder("r3/%s", list.entries[i].file), &frame, &error), SB_OK);
        assert_near(frame->status.time, list.entries[i].time, 1e-9);
        assert_int_equal(frame->count, 384);
        sb_frame_release(frame);
    }
    sb_particle_list_free(&list);
}

static void summary_has_its_keys(void **state)
{
    (void)state;
    static const char *const keys[] = {
        "wall_s",          "simulated_s",        "steps",          "fluid_particles", "boundary_particles",
        "mean_iterations", "bytes_per_particle", "lost_particles", "peak_N",          "peak_time_s",
        "impulse_Ns"};
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++)
        assert_true(json_number_of("r3/summary.json", keys[k]) >= 0);
    assert_near(json_number_of("r3/summary.json", "steps"), 60, 0);
    assert_near(json_number_of("r3/summary.json", "fluid_particles"), 384, 0);
    assert_near(json_number_of("r3/summary.json", "lost_particles"), 0, 0);
    assert_near(json_number_of("r3/summary.json", "pictures"), 4, 0);
    char *text = text_of("r3/summary.json");
    assert_contains(text, "\"version\": \"" SB_VERSION "\"");
    assert_contains(text, "\"preset\": \"default\"");
    assert_contains(text, "\"status\": \"done\"");
    assert_contains(text, "\"name\": \"post\"");
    assert_contains(text, "\"name\": \"sill\"");
    assert_contains(text, "\"per_metre\": false");
    sb_free(text);
    text = text_of("r2/summary.json");
    assert_contains(text, "\"per_metre\": true");
    sb_free(text);
}

static void until_set_and_preset_count(void **state)
{
    (void)state;
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "changed", "--until", "0.12", "--preset", "paper", "--set",
                    "fluid.density=1025", "--set", "resolution=0.05", "--set", "output.particle_interval=0", "--quiet");
    assert_string_equal(o.out, "");
    outcome_free(&o);
    double simulated = json_number_of("changed/summary.json", "simulated_s");
    assert_true(simulated >= 0.12 && simulated < 0.13);
    assert_near(json_number_of("changed/summary.json", "fluid_particles"), 192, 0);
    assert_near(json_number_of("changed/summary.json", "mass_kg"), 0.48 * 1025, 0.01);
    assert_false(exists("changed/particles.pvd"));
    char *text = text_of("changed/summary.json");
    assert_contains(text, "\"preset\": \"paper\"");
    sb_free(text);
    force_row rows[8];
    assert_int_equal(read_forces("changed/forces.csv", forces_2d, rows, 8), 2);
    sb_scene scene = {0};
    sb_error error = {0};
    assert_int_equal(sb_scene_read(in_folder("changed/scene.yaml"), NULL, NULL, 0, &scene, &error), SB_OK);
    assert_near(scene.duration, 0.12, 0);
    assert_near(scene.fluid.density, 1025, 0);
    assert_near(scene.resolution, 0.05, 0);
    assert_int_equal(scene.numerics.preset, SB_PRESET_PAPER);
    sb_scene_free(&scene);
}

/* The tank as a periodic slab: its sill continues across the sides. */
static void periodic_sides_run(void **state)
{
    (void)state;
    static const char sides[] = "domain.sides={y_min: periodic, y_max: periodic}";
    outcome o = RUN(0, "check", "tank3.yaml", "--set", sides);
    assert_contains(o.out, "  ghost particles    about 264 beyond periodic sides\n");
    assert_null(strstr(o.out, "warning"));
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--set", sides, "--out=slab", "--quiet");
    assert_near(json_number_of("slab/summary.json", "lost_particles"), 0, 0);
    assert_near(json_number_of("slab/summary.json", "left_domain"), 0, 0);
    assert_near(json_number_of("slab/summary.json", "through_walls"), 0, 0);
    char *log = text_of("slab/run.jsonl"), *other = text_of("r3/run.jsonl");
    assert_null(strstr(log, "periodic sides: none, no ghost particles"));
    assert_contains(other, "periodic sides: none, no ghost particles");
    sb_free(log);
    sb_free(other);
}

static int list_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)where;
    if (kind == FTW_D) return 0;
    if (count_there == sizeof names_there / sizeof *names_there) return -1;
    snprintf(names_there[count_there++], sizeof *names_there, "%.159s", path + strlen(in_folder("used/")));
    return 0;
}

/* A run with all outputs, with the user's files beside it, is replaced by a run without optional outputs. */
static void an_earlier_run_leaves_nothing(void **state)
{
    (void)state;
    static const char *const own[] = {"notes.csv",           "talk.mp4",       "maps/hills.asc",
                                      "plots/mine.png",      "holiday.mp4",    "frames/side/best.png",
                                      "particles/first.vtp", "forces.csv.old", "frames/holiday/000001.png"};
    static const char *const gone[] = {"overtopping.csv", "runup.csv", "maps/max_depth.asc",
                                       "particles.pvd",   "side.mp4",  "frames/front"};
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "used", "--quiet", "--until", "0.12", "--set",
                   "measure.planes=[{name: p, from: [0.9, 0], to: [0.9, 0.8]}]", "--set",
                   "measure.runups=[{name: r, from: [0.2, 0.4], to: [2.4, 0.4]}]", "--set", "measure.map={}", "--set",
                   "output.plots=true", "--set", "render.video=true");
    assert_true(exists("used/overtopping.csv") && exists("used/runup.csv") && exists("used/maps/max_depth.asc"));
    assert_true(exists("used/frames/front/000002.png"));
    write_text("used/.side.part.mp4", "cut short\n");
    write_text("used/particles/last-good.vtp", "<?xml of a failed run\n");
    write_text("used/maps/max_speed.asc.tmp", "of a killed run\n");
    write_text("used/plots/max_speed.gp", "of a killed run\n");
    assert_int_equal(mkdir(in_folder("used/frames/holiday"), 0777), 0);
    for (size_t k = 0; k < sizeof own / sizeof *own; k++) {
        char name[96];
        snprintf(name, sizeof name, "used/%s", own[k]);
        write_text(name, "mine\n");
    }
    outcome o = RUN(0, "run", "tank2.yaml", "--out", "used", "--quiet", "--overwrite", "--until", "0.02", "--set",
                    "output={particle_interval: 0, plots: false, checkpoint: {minutes: 0}}");
    assert_contains(o.err, " and 8 more: are not files of a run; they are kept\n");
    outcome_free(&o);
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "anew", "--quiet", "--until", "0.02", "--set",
                   "output={particle_interval: 0, plots: false, checkpoint: {minutes: 0}}");
    for (size_t k = 0; k < sizeof gone / sizeof *gone; k++)
        if (access(in_folder("used/%s", gone[k]), F_OK) == 0) fail_msg("%s is still there", gone[k]);
    count_there = 0;
    assert_int_equal(nftw(in_folder("used"), list_one, 16, FTW_PHYS), 0);
    for (size_t i = 0; i < count_there; i++) {
        bool known = access(in_folder("anew/%s", names_there[i]), F_OK) == 0;
        for (size_t k = 0; k < sizeof own / sizeof *own; k++) known = known || strcmp(names_there[i], own[k]) == 0;
        if (!known) fail_msg("%s is still there", names_there[i]);
    }
    for (size_t k = 0; k < sizeof own / sizeof *own; k++)
        if (access(in_folder("used/%s", own[k]), F_OK) != 0) fail_msg("%s was removed", own[k]);
    RUN_AND_FORGET(
        1, "render", "used", "--set",
        "render.cameras=[{name: a, eye: [1, -3, 1], target: [1, 0, 0]}]"); /* no particle files of the earlier run */
}

static void out_has_a_default(void **state)
{
    (void)state;
    outcome o = RUN(0, "run", "tank2.yaml", "--until=0.02");
    assert_contains(o.out, "300 fluid");
    outcome_free(&o);
    assert_true(exists("runs/tank2/summary.json"));
}

/* Only the scene's ending is removed, not everything after the first dot: wave-0.1 and wave-0.2 are two runs. */
static void out_keeps_the_dots_of_a_name(void **state)
{
    (void)state;
    char *text = text_of("tank2.yaml");
    write_text("wave-0.1m.yaml", text);
    sb_free(text);
    RUN_AND_FORGET(0, "run", "wave-0.1m.yaml", "--until=0.02", "--quiet");
    assert_true(exists("runs/wave-0.1m/summary.json"));
}

/* A run that cannot begin leaves the earlier run and its own scene file unchanged. */
static void a_refused_run_keeps_the_earlier_run(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "dear", "--quiet", "--until", "0.02");
    char *forces = text_of("dear/forces.csv"), *summary = text_of("dear/summary.json");
    outcome o =
        RUN(1, "run", "tank2.yaml", "--out", "dear", "--quiet", "--overwrite", "--set", "numerics.time_step_max=1e-6");
    assert_one_line(o.err, "the first time step would be 1e-06 s, expected at least ");
    outcome_free(&o);
    o = RUN(1, "check", "tank2.yaml", "--set", "numerics.time_step_max=1e-6");
    assert_one_line(o.err, "the first time step would be 1e-06 s, expected at least ");
    outcome_free(&o);
    o = RUN(1, "run", "tank2.yaml", "--out", "dear", "--quiet", "--overwrite", "--set", "fluid.viscosity=1e12");
    assert_one_line(o.err, "the first time step would be ");
    outcome_free(&o);
    assert_int_equal(rename(in_folder("dear/energy.csv"), in_folder("dear/kept.csv")), 0);
    assert_int_equal(symlink("kept.csv", in_folder("dear/energy.csv")), 0);
    o = RUN(2, "run", "tank2.yaml", "--out", "dear", "--quiet", "--overwrite");
    assert_one_line(o.err, "dear/energy.csv: is a symbolic link, expected a file of a run or nothing");
    outcome_free(&o);
    char *forces_now = text_of("dear/forces.csv"), *summary_now = text_of("dear/summary.json");
    assert_string_equal(forces, forces_now);
    assert_string_equal(summary, summary_now);
    sb_free(forces);
    sb_free(forces_now);
    sb_free(summary);
    sb_free(summary_now);

    char *scene = text_of("tank2.yaml");
    assert_int_equal(mkdir(in_folder("home"), 0777), 0);
    write_text("home/scene.yaml", scene);
    o = RUN(1, "run", "home/scene.yaml", "--out", "home", "--quiet");
    assert_one_line(o.err,
                    "home: holds \"scene.yaml\" but no run of shorebreak; name an empty or a new directory with --out");
    outcome_free(&o);
    char *scene_now = text_of("home/scene.yaml");
    assert_string_equal(scene, scene_now);
    sb_free(scene);
    sb_free(scene_now);
    RUN_AND_FORGET(0, "run", "dear/scene.yaml", "--out", "own", "--quiet");
    RUN_AND_FORGET(0, "run", "own/scene.yaml", "--out", "own", "--quiet", "--overwrite"); /* its own scene */
}

static void unwritable_out_fails(void **state)
{
    (void)state;
    static const char *const places[] = {"tank3.yaml", "tank3.yaml/below"};
    for (size_t k = 0; k < 2; k++) {
        outcome o = RUN(1, "run", "tank2.yaml", "--out", places[k], "--quiet");
        assert_one_line(o.err, "tank3.yaml: is not a directory, expected one");
        assert_string_equal(o.out, "");
        outcome_free(&o);
    }
}

/* The numbers of a row from a cell on. */
static void read_cells(const char *cell, double *values, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        char *end;
        values[k] = strtod(cell, &end);
        cell = end + (*end == ',');
    }
}

/* Waves of a box of water that sloshes: waves.csv and eurotop.csv have the figures of the summary. */
static void waves_are_in_tables_and_in_the_summary(void **state)
{
    (void)state;
    write_text("slosh.yaml", "title: t\ndimensions: 2\nresolution: 0.1\nduration: 0.8\noutput: {plots: false}\n"
                             "domain: {min: [0, 0], max: [2, 1.5]}\n"
                             "water: {level: 0.5, seed: [0.1, 0.1], boxes: [{min: [0, 0.5], max: [0.5, 1]}]}\n"
                             "measure: {interval: 0.02, gauges: [{name: end, x: 0.1}], waves: {period: 0.4}, "
                             "planes: [{name: middle, from: [1], z_min: 0.6, eurotop: {height: 0.3}}]}\n");
    RUN_AND_FORGET(0, "run", "slosh.yaml", "--out=slosh", "--quiet", "--overwrite");
    char *summary = text_of("slosh/summary.json"), *waves = text_of("slosh/waves.csv"),
         *rates = text_of("slosh/eurotop.csv");
    double column[14], harmonic[5], rate[6];
    read_cells(next_line(waves) + strlen("end,"), column, 14);
    const char *list = strstr(summary, "\"harmonics_m\"");
    assert_non_null(list);
    read_cells(strchr(list, '[') + 1, harmonic, 5);
    for (size_t k = 0; k < 5; k++) assert_near(harmonic[k], column[9 + k], 1e-6 * column[9]);
    assert_true(harmonic[0] > 0.001);
    assert_near(json_number_of("slosh/summary.json", "mean_z_m"), column[3], 1e-6);
    read_cells(next_line(rates) + strlen("middle,"), rate, 6);
    assert_near(rate[2], json_number_of("slosh/summary.json", "rate_m2_s"), 1e-6 * fabs(rate[2]));
    assert_near(rate[3], json_number_of("slosh/summary.json", "eurotop_m2_s"), 1e-6 * rate[3]);
    assert_true(rate[0] == 0 && rate[1] == 0.8 && rate[4] > 0 && rate[5] == 0.3);
    sb_free(summary);
    sb_free(waves);
    sb_free(rates);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_file_is_there),           cmocka_unit_test(scene_is_written_as_resolved),
        cmocka_unit_test(log_is_lines_of_objects),       cmocka_unit_test(forces_have_a_row_per_body_and_interval),
        cmocka_unit_test(forces_add_up_to_the_impulse),  cmocka_unit_test(gauges_are_empty_where_dry),
        cmocka_unit_test(probes_have_all_columns),       cmocka_unit_test(particle_files_and_their_list),
        cmocka_unit_test(summary_has_its_keys),          cmocka_unit_test(waves_are_in_tables_and_in_the_summary),
        cmocka_unit_test(until_set_and_preset_count),    cmocka_unit_test(periodic_sides_run),
        cmocka_unit_test(an_earlier_run_leaves_nothing), cmocka_unit_test(out_has_a_default),
        cmocka_unit_test(out_keeps_the_dots_of_a_name),  cmocka_unit_test(a_refused_run_keeps_the_earlier_run),
        cmocka_unit_test(unwritable_out_fails),
    };
    return cmocka_run_group_tests(tests, setup, program_teardown);
}
