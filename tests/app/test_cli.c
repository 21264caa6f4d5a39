/* Commands and options: their output and exit status. */
#include "program.h"

#include "base/clock.h"

#include "../output/json_check.h"
#include "base/memory.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static const char *const commands[] = {"run",    "check",   "preview", "sample", "render",
                                       "report", "compare", "surface", "replay", "list"};
enum { COMMANDS = sizeof commands / sizeof commands[0] };

static void help_everywhere(void **state)
{
    (void)state;
    outcome o = RUN(0, "--help");
    for (int c = 0; c < COMMANDS; c++) assert_contains(o.out, commands[c]);
    assert_string_equal(o.err, "");
    outcome_free(&o);
    for (int c = 0; c < COMMANDS; c++) {
        char begin[64];
        snprintf(begin, sizeof begin, "usage: shorebreak %s ", commands[c]);
        o = RUN(0, commands[c], "--help");
        assert_int_equal(strncmp(o.out, begin, strlen(begin)), 0);
        assert_string_equal(o.err, "");
        outcome_free(&o);
        RUN_AND_FORGET(0, commands[c], "something", "--help");
    }
}

static void version_everywhere(void **state)
{
    (void)state;
    outcome o = RUN(0, "--version");
    assert_string_equal(o.out, "shorebreak " SB_VERSION "\n");
    outcome_free(&o);
    for (int c = 0; c < COMMANDS; c++) {
        o = RUN(0, commands[c], "--version");
        assert_string_equal(o.out, "shorebreak " SB_VERSION "\n");
        outcome_free(&o);
        o = RUN(0, commands[c], "something", "--version");
        assert_string_equal(o.out, "shorebreak " SB_VERSION "\n");
        outcome_free(&o);
    }
}

static void without_a_command_usage_is_printed(void **state)
{
    (void)state;
    outcome o = program_expect(1, (const char *const[]){NULL});
    assert_string_equal(o.out, "");
    assert_contains(o.err, "usage: shorebreak COMMAND");
    outcome_free(&o);
}

/* Arguments, separated by blanks, and a text that the one-line message must contain. */
static const struct {
    const char *arguments, *expected;
} mistakes[] = {
    {"frobnicate", "frobnicate: no such command"},
    {"chekc tank2.yaml", "chekc: no such command, did you mean check?"},
    {"runs tank2.yaml", "runs: no such command, did you mean run?"},
    {"run tank2.yaml --resum", "--resum: not an option of this command, did you mean --resume?"},
    {"run tank2.yaml --untill=3", "--untill=3: not an option of this command, did you mean --until?"},
    {"run tank2.yaml --over-write", "--over-write: not an option of this command, did you mean --overwrite?"},
    {"check tank2.yaml --threds 2", "--threds: not an option of this command, did you mean --threads?"},
    {"run tank2.yaml --set resolutoin=1", "did you mean resolution?"},
    {"run tank2.yaml --set numerics.kernel=cubc", "expected cubic"},
    {"list kernel", "did you mean kernels?"},
    {"--frobnicate", "--frobnicate: no such command"},
    {"x\033[2J\a", "x?[2J?: no such command"},
    {"run", "no scene given"},
    {"check", "no scene given"},
    {"sample --out x.vtp", "no scene given"},
    {"render", "no run directory or log given"},
    {"replay", "no log given"},
    {"list", "no table given"},
    {"run tank2.yaml tank3.yaml", "tank3.yaml: expected one scene"},
    {"run tank2.yaml --nope", "--nope: not an option of this command"},
    {"run tank2.yaml --json", "--json: not an option of this command"},
    {"check tank2.yaml --quiet", "--quiet: not an option of this command"},
    {"check tank2.yaml --profile", "--profile: not an option of this command"},
    {"run tank2.yaml --quiet=yes", "--quiet=yes: takes no value"},
    {"run tank2.yaml --out", "--out: needs a value"},
    {"run tank2.yaml --set", "--set: needs a value"},
    {"render run --camera", "--camera: needs a value"},
    {"run tank2.yaml --threads 0", "--threads 0: expected"},
    {"run tank2.yaml --threads two", "--threads two: expected"},
    {"run tank2.yaml --threads 2.5", "--threads 2.5: expected"},
    {"run tank2.yaml --threads 99999999999999999999", "expected a count"},
    {"run tank2.yaml --until 0", "--until 0: expected"},
    {"run tank2.yaml --until -1", "--until -1: expected"},
    {"run tank2.yaml --until nan", "--until nan: expected"},
    {"run tank2.yaml --until inf", "--until inf: expected"},
    {"run tank2.yaml --until 3s", "--until 3s: expected"},
    {"run tank2.yaml --until=", "--until : expected"},
    {"run tank2.yaml --until 1e12", "measure.interval"},
    {"run tank2.yaml --preset best", "best is not known, expected default, paper or wen"},
    {"run tank2.yaml --set resolution", "expected KEY=VALUE"},
    {"run tank2.yaml --set =3", "expected KEY=VALUE"},
    {"run tank2.yaml --set resolution=-1", "--set: resolution: "},
    {"run tank2.yaml --set resolution=wide", "--set: resolution: "},
    {"run tank2.yaml --set nothing.such=1", "--set: nothing"},
    {"run missing.yaml", "missing.yaml: cannot read"},
    {"check missing.yaml", "missing.yaml: cannot read"},
    {"sample tank2.yaml", "no --out FILE.vtp given"},
    {"render nowhere", "nowhere/scene.yaml: cannot read"},
    {"list colours", "list colours: expected kernels, wavemakers, solvers or presets"},
};

static void mistakes_get_one_line(void **state)
{
    (void)state;
    for (size_t m = 0; m < sizeof mistakes / sizeof mistakes[0]; m++) {
        char text[256];
        const char *list[16] = {NULL};
        size_t count = 0;
        snprintf(text, sizeof text, "%s", mistakes[m].arguments);
        for (char *word = strtok(text, " "); word; word = strtok(NULL, " ")) list[count++] = word;
        outcome o = program_expect(1, list);
        assert_one_line(o.err, mistakes[m].expected);
        assert_string_equal(o.out, "");
        outcome_free(&o);
    }
    assert_false(exists("runs"));
}

static void lists_name_all_choices(void **state)
{
    (void)state;
    static const char *const tables[][6] = {
        {"kernels", "cubic", "wendland-c2", "wendland-c4"},
        {"wavemakers", "goring", "goring-rayleigh", "stroke", "file", "gate"},
        {"solvers", "jacobi", "chebyshev", "cg", "wcsph"},
        {"presets", "default", "paper", "wen"},
    };
    for (size_t t = 0; t < sizeof tables / sizeof tables[0]; t++) {
        outcome o = RUN(0, "list", tables[t][0]);
        assert_string_equal(o.err, "");
        for (int i = 1; i < 6 && tables[t][i]; i++) {
            char row[64];
            snprintf(row, sizeof row, "\n%s ", tables[t][i]);
            if (strncmp(o.out, row + 1, strlen(row + 1)) != 0) assert_contains(o.out, row);
        }
        outcome_free(&o);
    }
}

static void check_reports_the_model(void **state)
{
    (void)state;
    outcome o = RUN(0, "check", "tank3.yaml");
    assert_contains(o.out, "Tank in 3D\n");
    assert_contains(o.out, "fluid particles    384\n");
    assert_contains(o.out, "still depth        0.6 m (6.0 particles)\n");
    assert_string_equal(o.err, "");
    outcome_free(&o);
    RUN_AND_FORGET(0, "check", "tank3.yaml", "--set", "resolution=0.2", "--preset", "paper", "--threads=2");
    assert_false(exists("runs"));
}

/* What rounding leaves of a reflection is not printed. */
static void check_prints_reflections(void **state)
{
    (void)state;
    outcome o = RUN(0, "check", SB_SOURCE_DIR "/assets/scenes/bar.yaml", "--set", "resolution=0.05", "--threads", "1");
    assert_contains(o.out, "predicted reflection at 2.02 s below 0.01 %; forgets levels");
    assert_contains(o.out, "predicted reflection 1.6 %");
    assert_contains(o.out, " s on 1 thread, including settling");
    outcome_free(&o);
    o = RUN(0, "check", SB_SOURCE_DIR "/assets/scenes/bar.yaml", "--set", "resolution=0.05", "--threads", "1", "--set",
            "sponges.0.strength=1e9");
    assert_contains(o.out, "predicted reflection 100 %");
    outcome_free(&o);
}

static void check_in_json(void **state)
{
    (void)state;
    static const char *const keys[] = {"scene",           "dimensions",         "resolution_m", "steps",
                                       "fluid_particles", "boundary_particles", "bodies",       "warnings",
                                       "memory_bytes",    "run_time_s",         "disk_bytes",   "time_step_s"};
    outcome o = RUN(0, "check", "tank3.yaml", "--json");
    assert_true(json_valid(o.out));
    for (size_t k = 0; k < sizeof keys / sizeof keys[0]; k++)
        if (!json_find(o.out, keys[k])) fail_msg("no %s in %s", keys[k], o.out);
    assert_near(strtod(json_find(o.out, "fluid_particles"), NULL), 384, 0);
    assert_true(strtod(json_find(o.out, "memory_bytes"), NULL) > 384 * 100);
    assert_contains(o.out, "\"post\"");
    assert_near(strtod(json_find(o.out, "settling_steps_most"), NULL), 50, 0);
    assert_near(strtod(json_find(o.out, "settling_steps"), NULL), 50, 0); /* boxes: each of them */
    const double settled = strtod(json_find(o.out, "run_time_s"), NULL);
    outcome_free(&o);
    /* The run time includes settling. */
    o = RUN(0, "check", "tank3.yaml", "--json", "--set", "numerics.settle_steps=0");
    assert_near(strtod(json_find(o.out, "settling_steps"), NULL), 0, 0);
    assert_true(strtod(json_find(o.out, "run_time_s"), NULL) < settled);
    outcome_free(&o);
    /* The estimate uses the time step of a run. */
    o = RUN(0, "check", "tank3.yaml", "--json", "--set", "numerics.time_step_max=1e-4");
    assert_near(strtod(json_find(o.out, "time_step_s"), NULL), 1e-4, 1e-12);
    assert_near(strtod(json_find(o.out, "steps"), NULL), 3000, 1);
    outcome_free(&o);
    o = RUN(0, "check", "tank3.yaml", "--json", "--set", "numerics.artificial_viscosity=10");
    assert_true(strtod(json_find(o.out, "time_step_s"), NULL) < 2e-4);
    outcome_free(&o);
    /* Water one particle deep is too coarse, which gives a warning and no error. */
    o = RUN(0, "check", "tank3.yaml", "--json", "--set", "resolution=0.25");
    assert_true(json_valid(o.out));
    assert_true(*json_find(o.out, "warnings") == '[');
    assert_contains(json_find(o.out, "warnings"), "expected");
    outcome_free(&o);
}

/* A command whose result cannot be written fails. */
static void a_lost_result_is_an_error(void **state)
{
    (void)state;
    static const char *const requests[] = {"check tank3.yaml --json", "list kernels"};
    for (size_t i = 0; i < sizeof requests / sizeof *requests; i++) {
        char command[2200];
        snprintf(command, sizeof command, "cd '%s' && '%s/shorebreak' %s >/dev/full 2>lost.txt", in_folder("."),
                 SB_BINARY_DIR, requests[i]);
        const int how = system(command);
        assert_true(WIFEXITED(how) && WEXITSTATUS(how) == 2);
        char *message = text_of("lost.txt");
        assert_one_line(message, "standard output: cannot write: No space left on device");
        sb_free(message);
    }
}

/* The viscosity of a sponge has the speed of sound of the run, 10 sqrt(9.81 m/s^2 1 m), also where the sponge's depth
   is less. */
static void check_knows_the_viscosity_of_the_run(void **state)
{
    (void)state;
    static const char *const depths[] = {"sponges.beach.depth=0.5", "sponges.beach.depth=1"};
    write_text("viscous.yaml",
               "resolution: 0.1\nduration: 1\ndimensions: 2\ndomain: {min: [0, 0], max: [4, 1.5]}\n"
               "numerics: {preset: wen, solver: wcsph, support: 3}\nwater: {level: 1, seed: [1, 0.2]}\n"
               "sponges: [{name: beach, kind: viscous, side: x_max, length: 1, period: 1, depth: 1}]\n");
    for (size_t i = 0; i < sizeof depths / sizeof *depths; i++) {
        outcome o = RUN(0, "check", "viscous.yaml", "--json", "--set", depths[i]);
        const char *at = strstr(o.out, "\"viscosity_m2_s\": ");
        assert_non_null(at);
        assert_near(strtod(at + strlen("\"viscosity_m2_s\": "), NULL), 0.6 * 0.3 * 10 * sqrt(9.81) / 16, 1e-4);
        outcome_free(&o);
    }
}

static double figure(const char *json, const char *name)
{
    char key[64];
    snprintf(key, sizeof key, "\"%s\": ", name);
    const char *at = strstr(json, key);
    if (!at) fail_msg("%s is not in %s", name, json);
    return strtod(at + strlen(key), NULL);
}

/* Mean periods of a JONSWAP spectrum with gamma 3.3: T_m-1,0 is 0.906, T_m02 0.78 to 0.83 of the peak period, by the
   band of frequencies. The rate is 0.047 exp(-(2.35 R/H)^1.3) sqrt(g H^3) with R 0.4 m. A wave of 0.15 m and 1 s on 1 m
   is 1.658 m long in a closed flume. */
static void check_shows_waves_and_rates(void **state)
{
    (void)state;
#define PADDLE(law)                                                                                                    \
    "dimensions: 2\nresolution: 0.1\nduration: 9\ndomain: {min: [-1, 0], max: [30, 2.5]}\n"                            \
    "water: {level: 1, seed: [5, 0.2]}\nbodies: [{name: p, shape: box, min: [-0.4, 0], max: [0, 2]}]\n"                \
    "wavemakers: [{name: w, body: p, depth: 1, " law "}]\n"                                                            \
    "measure: {planes: [{name: top, from: [20], z_min: 1.4, eurotop: {height: 0.3}}]}\n"
    write_text("irregular.yaml", PADDLE("kind: irregular, height: 0.3, period: 3"));
    outcome o = RUN(0, "check", "irregular.yaml", "--json");
    assert_near(figure(o.out, "t_m_10_s"), 0.906 * 3, 0.02);
    assert_true(figure(o.out, "t_m02_s") > 0.78 * 3 && figure(o.out, "t_m02_s") < 0.83 * 3);
    assert_near(figure(o.out, "components"), 200, 0);
    const double rate = 0.047 * exp(-pow(2.35 * 0.4 / 0.3, 1.3)) * sqrt(9.81 * 0.3 * 0.3 * 0.3);
    assert_near(figure(o.out, "eurotop_m2_s"), rate, 1e-6 * rate);
    outcome_free(&o);
    /* Its amplitudes are in proportion to the energies of the same spectrum. */
    write_text("focused.yaml", PADDLE("kind: focused, height: 0.3, period: 3, distance: 8, focus: 30"));
    o = RUN(0, "check", "focused.yaml", "--json");
    assert_near(figure(o.out, "t_m_10_s"), 0.906 * 3, 0.03);
    outcome_free(&o);
    write_text("steep.yaml", PADDLE("kind: regular, height: 0.15, period: 1"));
    o = RUN(0, "check", "steep.yaml", "--json");
    assert_near(figure(o.out, "steady_wavelength_m"), 1.6585, 5e-4);
    outcome_free(&o);
    write_text("solitary.yaml", PADDLE("kind: goring, height: 0.3"));
    o = RUN(0, "check", "solitary.yaml");
    assert_contains(o.out, "wave of w: solitary, goring");
    assert_contains(o.out, "H/d 0.3");
    outcome_free(&o);
    o = RUN(0, "check", "solitary.yaml", "--json");
    assert_near(figure(o.out, "height_over_depth"), 0.3, 1e-9);
    assert_near(figure(o.out, "speed_m_s"), sqrt(9.81 * 1.3), 0.01);
    outcome_free(&o);
#undef PADDLE
}

/* A scene that can run but is probably not what the user meant gives a warning in `check` and in `run`. */
static void a_doubtful_scene_gives_a_warning(void **state)
{
    (void)state;
    static const char longer[] = "measure.interval: 7 s is longer than the run of ", slow[] = "measure.interval=7";
    outcome o = RUN(0, "check", "tank3.yaml", "--set", slow);
    assert_contains(o.out, "warning: ");
    assert_contains(o.out, longer);
    outcome_free(&o);
    o = RUN(0, "run", "tank3.yaml", "--set", slow, "--until=0.01", "--out=slow", "--quiet");
    assert_contains(o.err, "shorebreak: warning: ");
    assert_contains(o.err, longer);
    outcome_free(&o);
    char *log = text_of("slow/run.jsonl");
    assert_contains(log, longer);
    sb_free(log);
    o = RUN(0, "check", "tank3.yaml", "--set", "water.wave={kind: solitary, height: 0.2, depth: 0.4}");
    assert_contains(o.out, "the theory third-order is accurate up to 0.4");
    outcome_free(&o);
    o = RUN(0, "run", "tank3.yaml", "--until=0.05", "--out=slow", "--overwrite", "--quiet");
    assert_null(strstr(o.err, "warning"));
    outcome_free(&o);
}

static double memory_with_support(const char *support)
{
    outcome o = RUN(0, "check", "tank3.yaml", "--json", "--set", support);
    const char *value = json_find(o.out, "memory_bytes");
    assert_non_null(value);
    const double bytes = strtod(value, NULL);
    outcome_free(&o);
    return bytes;
}

/* Most memory is used by neighbour lists: 384 particles with 4 pi/3 s^3 neighbours each. */
static void check_counts_neighbours_as_memory(void **state)
{
    (void)state;
    const double more = memory_with_support("numerics.support=3") - memory_with_support("numerics.support=2");
    assert_true(more > 384 * 79.5 * 4 && more < 384 * 79.6 * 4.5);
}

/* Counts the particles of each kind in the file's Int32 array "body". */
static void count_bodies(const char *path, size_t points, size_t *walls, size_t *fluid)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    static char text[1 << 20];
    size_t length = fread(text, 1, sizeof text, file);
    fclose(file);
    assert_true(length < sizeof text);
    const char *field = strstr(text, "Name=\"body\"");
    assert_non_null(field);
    size_t offset = strtoul(strstr(field, "offset=\"") + 8, NULL, 10);
    const char *raw = strchr(strstr(text, "<AppendedData"), '_') + 1 + offset;
    uint64_t bytes;
    memcpy(&bytes, raw, sizeof bytes);
    assert_int_equal(bytes, 4 * points);
    for (size_t i = 0; i < points; i++) {
        int32_t body;
        memcpy(&body, raw + 8 + 4 * i, sizeof body);
        assert_in_range(body + 1, 0, 3); /* water, post, sill, the tank */
        (*(body < 0 ? fluid : walls))++;
    }
}

static void sample_writes_the_particles(void **state)
{
    (void)state;
    outcome o = RUN(0, "sample", "tank3.yaml", "--out", "sample.vtp");
    size_t walls = 0, fluid = 0, found_walls = 0, found_fluid = 0;
    assert_int_equal(sscanf(o.out, "%zu boundary and %zu fluid particles", &walls, &fluid), 2);
    outcome_free(&o);
    assert_int_equal(fluid, 384);
    /* 10.6 m2 of tank and bodies: between 0.5 and 1.3 particles per square of wall_spacing, 0.8 spacings. */
    assert_in_range(walls, 828, 2156);
    char *head = text_of("sample.vtp"), points[64];
    snprintf(points, sizeof points, "NumberOfPoints=\"%zu\"", walls + fluid);
    assert_contains(head, points);
    sb_free(head);
    count_bodies(in_folder("sample.vtp"), walls + fluid, &found_walls, &found_fluid);
    assert_int_equal(found_walls, walls);
    assert_int_equal(found_fluid, fluid);
    o = RUN(1, "sample", "tank3.yaml", "--out", "tank3.yaml");
    assert_one_line(o.err, "--out tank3.yaml: is the scene file, expected another file");
    outcome_free(&o);
    o = RUN(2, "sample", "tank3.yaml", "--out", "tank3.yaml/sample.vtp");
    assert_one_line(o.err, "tank3.yaml/sample.vtp: ");
    outcome_free(&o);
}

/* Copies the hex digits of the state hash from summary.json. */
static void copy_hash(const char *summary, char hash[32])
{
    char *text = text_of(summary);
    const char *at = strstr(text, "\"state_hash\"");
    assert_non_null(at);
    assert_int_equal(sscanf(at, "\"state_hash\": \"%31[^\"]\"", hash), 1);
    sb_free(text);
}

static void profile_prints_times_and_changes_nothing(void **state)
{
    (void)state;
    char hashes[2][32];
    outcome o = RUN(0, "run", "tank2.yaml", "--until", "0.05", "--quiet", "--out", "plain");
    assert_string_equal(o.out, "");
    outcome_free(&o);
    o = RUN(0, "run", "tank2.yaml", "--until", "0.05", "--quiet", "--profile", "--out", "profiled");
    static const char *const expected[] = {"ns per particle-step\n",
                                           "\nneighbours ",
                                           "\npressure ",
                                           "\nall stages ",
                                           " iterations per step, ",
                                           " particle-steps per second, 1 thread\n",
                                           "\nmemory: simulation ",
                                           "\n  stream: off, no LCM thread\n"};
    for (size_t w = 0; w < sizeof expected / sizeof expected[0]; w++) assert_contains(o.out, expected[w]);
    outcome_free(&o);
    copy_hash("plain/summary.json", hashes[0]);
    copy_hash("profiled/summary.json", hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
}

static void bad_scene_gives_its_place(void **state)
{
    (void)state;
    write_text("bad.yaml", "title: bad\n"
                           "duration: 1\n"
                           "resolution:   -0.1\n"
                           "domain: {min: [0, 0, 0], max: [1, 1, 1]}\n"
                           "water: {level: 0.5, seed: [0.5, 0.5, 0.2]}\n");
    static const char *const uses[] = {"run", "check", "sample"};
    for (int c = 0; c < 3; c++) {
        outcome o = c == 1 ? RUN(1, uses[c], "bad.yaml") : RUN(1, uses[c], "bad.yaml", "--out", "b");
        assert_one_line(o.err, "bad.yaml:3:15: resolution: ");
        assert_contains(o.err, "expected");
        assert_string_equal(o.out, "");
        outcome_free(&o);
    }
    assert_false(exists("b"));
}

/* The part of a body outside the domain costs nothing. A body so far away that rounding would change the rest is
 * refused.
 */
static void bodies_may_extend_far_within_a_limit(void **state)
{
    (void)state;
    const double begin = sb_clock();
    outcome o = RUN(0, "check", "tank3.yaml", "--set", "bodies[0].max=[1e6, 0.6, 0.8]");
    outcome_free(&o);
    assert_true(sb_clock() - begin < 20); /* s; sampling the whole body would take days */
    o = RUN(1, "check", "tank3.yaml", "--set", "bodies[0].max=[1e12, 0.6, 0.8]");
    assert_one_line(
        o.err, "body \"post\" extends to (1e+12, 0.3, 0) m: expected at most 1e+07 m, 1e8 spacings, from the domain");
    outcome_free(&o);
}

/* `run` and `check` refuse walls through which water would pass; `sample` still writes their particles. */
static void walls_that_would_leak_are_refused(void **state)
{
    (void)state;
    static const char set[] = "numerics.wall_offset=0.1";
    for (int run = 0; run < 2; run++) {
        outcome o = run ? RUN(1, "run", "tank3.yaml", "--out", "leak", "--set", set)
                        : RUN(1, "check", "tank3.yaml", "--set", set);
        assert_one_line(o.err, "tank3.yaml: numerics.wall_offset: 0.1 spacings: water passes walls whose boundary "
                               "particles are this close to their surface, expected 0.25 or more");
        outcome_free(&o);
    }
    RUN_AND_FORGET(0, "sample", "tank3.yaml", "--out", "leak.vtp", "--set", set);
}

/* Libraries for graphics and mesh formats are loaded only when they are needed. */
static void the_program_starts_without_graphics(void **state)
{
    (void)state;
    assert_int_equal(setenv("LD_TRACE_LOADED_OBJECTS", "1", 1), 0);
    outcome o = RUN(0, "list");
    unsetenv("LD_TRACE_LOADED_OBJECTS");
    assert_contains(o.out, "libc.so");
    assert_null(strstr(o.out, "OSMesa"));
    assert_null(strstr(o.out, "LLVM"));
    assert_null(strstr(o.out, "assimp"));
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_everywhere),
        cmocka_unit_test(version_everywhere),
        cmocka_unit_test(without_a_command_usage_is_printed),
        cmocka_unit_test(mistakes_get_one_line),
        cmocka_unit_test(lists_name_all_choices),
        cmocka_unit_test(check_reports_the_model),
        cmocka_unit_test(check_prints_reflections),
        cmocka_unit_test(check_in_json),
        cmocka_unit_test(check_knows_the_viscosity_of_the_run),
        cmocka_unit_test(check_shows_waves_and_rates),
        cmocka_unit_test(a_lost_result_is_an_error),
        cmocka_unit_test(a_doubtful_scene_gives_a_warning),
        cmocka_unit_test(check_counts_neighbours_as_memory),
        cmocka_unit_test(sample_writes_the_particles),
        cmocka_unit_test(profile_prints_times_and_changes_nothing),
        cmocka_unit_test(bad_scene_gives_its_place),
        cmocka_unit_test(bodies_may_extend_far_within_a_limit),
        cmocka_unit_test(walls_that_would_leak_are_refused),
        cmocka_unit_test(the_program_starts_without_graphics),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
