/* Inputs that are not regular files, or are slow to read: the program refuses them at once, in one line with the place.
 */
#include "program.h"

#include "base/clock.h"
#include "base/memory.h"

#include <dirent.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* s; a refusal is immediate, but the machine may be busy. Waiting for a pipe or reading a device takes far longer. */
static const double PROMPT = 10;

typedef enum kind { PIPE, FOLDER, DEVICE, KINDS } kind;
static const char *const kind_names[KINDS] = {"a FIFO", "a directory", "a device"};

static void put(const char *name, kind of)
{
    const char *path = in_folder("%s", name);
    const int made = of == PIPE ? mkfifo(path, 0600) : of == FOLDER ? mkdir(path, 0700) : symlink("/dev/zero", path);
    assert_int_equal(made, 0);
}

static void remove_place(const char *name)
{
    assert_int_equal(remove(in_folder("%s", name)), 0);
}

/* The program refuses the file in one line that contains its name and `expected`. */
static void expect_refusal(const char *name, const char *expected, const char *const *arguments)
{
    const double begin = sb_clock();
    const pid_t process = program_start(arguments);
    outcome o = program_finish(process);
    if (sb_clock() - begin > PROMPT) fail_msg("%s: refused after %g s", name, sb_clock() - begin);
    /* 1, or 2 when a file of the run itself is replaced. */
    if (o.status != 1 && o.status != 2) fail_msg("%s: exit status %d: %s", name, o.status, o.err);
    assert_one_line(o.err, name);
    assert_contains(o.err, expected);
    outcome_free(&o);
}

/* The tank in 3D with other bodies, without the keys after `bodies`. */
static void write_scene(const char *name, const char *bodies)
{
    char text[1024];
    const char *end = strstr(tank_3d, "bodies:\n");
    assert_non_null(end);
    snprintf(text, sizeof text, "%.*sbodies:\n%s", (int)(end - tank_3d), tank_3d, bodies);
    write_text(name, text);
}

static void a_scene_is_a_file(void **state)
{
    (void)state;
    for (kind k = 0; k < KINDS; k++) {
        put("odd.yaml", k);
        expect_refusal("odd.yaml", kind_names[k], (const char *const[]){"check", "odd.yaml", NULL});
        expect_refusal("odd.yaml", kind_names[k], (const char *const[]){"run", "odd.yaml", "--out", "none", NULL});
        expect_refusal("odd.yaml", kind_names[k],
                       (const char *const[]){"sample", "odd.yaml", "--out", "particles.vtp", NULL});
        remove_place("odd.yaml");
    }
    expect_refusal("/dev/tty", "a device", (const char *const[]){"check", "/dev/tty", NULL});
    assert_false(exists("none/run.jsonl"));
}

static void files_named_in_a_scene_are_regular(void **state)
{
    (void)state;
    static const char *const bodies[] = {"  - {name: odd, shape: mesh, file: odd.obj}\n",
                                         "  - {name: odd, shape: grid, file: odd.asc}\n",
                                         "  - {name: odd, shape: grid, file: odd.xyz}\n",
                                         "  - {name: odd, shape: box, min: [0, 0, 0], max: [0.1, 0.8, 1]}\n"
                                         "wavemakers:\n  - {name: w, body: odd, kind: file, file: odd.txt}\n"};
    static const char *const files[] = {"odd.obj", "odd.asc", "odd.xyz", "odd.txt"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++)
        for (kind k = 0; k < KINDS; k++) {
            write_scene("names.yaml", bodies[f]);
            put(files[f], k);
            expect_refusal("names.yaml:", kind_names[k], (const char *const[]){"check", "names.yaml", NULL});
            remove_place(files[f]);
        }
}

/* A part of a mesh outside of the mesh's folder is not read. */
static void a_mesh_reads_its_own_folder(void **state)
{
    (void)state;
    write_scene("mesh.yaml", "  - {name: odd, shape: mesh, file: odd.obj}\n");
    static const char shape[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    char mesh[512];
    snprintf(mesh, sizeof mesh, "mtllib ../../../../../../etc/passwd\n%s", shape);
    write_text("odd.obj", mesh);
    expect_refusal("odd.obj", "outside of its folder", (const char *const[]){"check", "mesh.yaml", NULL});
    for (kind k = 0; k < KINDS; k++) {
        put("odd.mtl", k);
        snprintf(mesh, sizeof mesh, "mtllib odd.mtl\n%s", shape);
        write_text("odd.obj", mesh);
        expect_refusal("odd.obj", k == DEVICE ? "outside of its folder" : kind_names[k],
                       (const char *const[]){"check", "mesh.yaml", NULL});
        remove_place("odd.mtl");
    }
}

/* A symbolic link is never accepted as a file of a run. */
static const char *const run_file_kinds[KINDS] = {"a FIFO", "a directory", ", expected a "};

static void files_that_render_and_resume_read_are_regular(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "done", "--quiet", "--set", "render.interval=0");
    static const char *const files[] = {"done/particles/000001.vtp", "done/particles.pvd", "done/scene.yaml"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++)
        for (kind k = 0; k < KINDS; k++) {
            assert_int_equal(rename(in_folder("%s", files[f]), in_folder("kept")), 0);
            put(files[f], k);
            expect_refusal(files[f], run_file_kinds[k],
                           (const char *const[]){"render", "done", "--out", "drawn", NULL});
            remove_place(files[f]);
            assert_int_equal(rename(in_folder("kept"), in_folder("%s", files[f])), 0);
        }
    expect_refusal("done/scene.yaml", "does not begin as a log of lcm-logger",
                   (const char *const[]){"render", "done/scene.yaml", NULL});
}

static void a_checkpoint_is_a_file(void **state)
{
    (void)state;
    char name[300] = "";
    RUN_AND_FORGET(0, "run", "tank2.yaml", "--out", "saved", "--quiet", "--until", "0.02");
    DIR *directory = opendir(in_folder("saved/checkpoints"));
    assert_non_null(directory);
    for (const struct dirent *entry; (entry = readdir(directory));)
        if (strstr(entry->d_name, ".state")) snprintf(name, sizeof name, "saved/checkpoints/%.255s", entry->d_name);
    closedir(directory);
    assert_true(exists(name));
    for (kind k = 0; k < KINDS; k++) {
        remove_place(name);
        put(name, k);
        expect_refusal(name, run_file_kinds[k],
                       (const char *const[]){"run", "tank2.yaml", "--out", "saved", "--resume", NULL});
    }
}

/* A file that the library reads for a very long time: a list of vertices whose header does not end. */
static void a_slow_mesh_does_not_delay_a_signal(void **state)
{
    (void)state;
    static const int signals[] = {SIGINT, SIGTERM};
    write_text("slow.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
    write_scene("slow.yaml", "  - {name: odd, shape: mesh, file: slow.ply}\n");
    for (size_t s = 0; s < 2; s++) {
        const pid_t process = program_start((const char *const[]){"run", "slow.yaml", "--out", "slow", NULL});
        usleep(500000);
        const double begin = sb_clock();
        assert_int_equal(kill(process, signals[s]), 0);
        outcome o = program_finish(process);
        /* Users are promised half a second. The limit allows for a busy machine; reading the file takes 20 s. */
        if (sb_clock() - begin > 4) fail_msg("it took %g s to stop", sb_clock() - begin);
        if (o.status != 128 + signals[s]) fail_msg("exit status %d: %s", o.status, o.err);
        assert_one_line(o.err, "stopped by a signal while the model was built: nothing is computed yet");
        outcome_free(&o);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_scene_is_a_file),           cmocka_unit_test(files_named_in_a_scene_are_regular),
        cmocka_unit_test(a_mesh_reads_its_own_folder), cmocka_unit_test(files_that_render_and_resume_read_are_regular),
        cmocka_unit_test(a_checkpoint_is_a_file),      cmocka_unit_test(a_slow_mesh_does_not_delay_a_signal),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
