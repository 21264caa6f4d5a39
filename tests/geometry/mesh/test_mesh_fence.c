/* Tests the restrictions of the child that reads a mesh: it opens no files outside of the mesh's folder, does not
   wait for a writer, and ends on a signal. Also tests the kernel's restrictions. */
#include "base/clock.h"
#include "base/stop.h"
#include "geometry/mesh/child.h"
#include "geometry/mesh/fence.h"
#include "geometry/mesh/mesh.h"
#include "mesh_samples.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static sb_error error;
static char folder[] = "/tmp/shorebreak-fence-XXXXXX";

static const char *path_of(const char *name)
{
    static char paths[4][512];
    static int next;
    char *path = paths[next++ % 4];
    snprintf(path, sizeof paths[0], "%s/%s", folder, name);
    return path;
}

static const char *save(const char *name, const void *bytes, size_t length)
{
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
    return path;
}

static const char *save_text(const char *name, const char *text)
{
    return save(name, text, strlen(text));
}

static void expect_refusal(const char *path, const char *why)
{
    sb_mesh *meshes = NULL;
    size_t count = 99;
    const double begin = sb_clock();
    error.text[0] = '\0';
    sb_status status = sb_mesh_import(path, &meshes, &count, &error);
    if (status != SB_BAD_INPUT) fail_msg("%s: status %d, expected a refusal (%s)", path, status, error.text);
    if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, why))
        fail_msg("\"%s\" should begin with the path and say \"%s\"", error.text, why);
    if (sb_clock() - begin > 5) fail_msg("refused after %g s", sb_clock() - begin);
}

static void expect_count(const char *path, size_t expected)
{
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(count, expected);
    sample_free(meshes, count);
}

/* Writes a glTF file with a triangle whose three corners are 36 bytes of the buffer. */
static const char *gltf(const char *name, const char *uri)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36}],"
             "\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]}",
             uri);
    return save_text(name, text);
}

static const char *obj(const char *name, const char *material)
{
    char text[512];
    snprintf(text, sizeof text, "mtllib %s\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", material);
    return save_text(name, text);
}

static const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

static void files_of_the_folder_are_read(void **state)
{
    (void)state;
    save("in/near.bin", corners, sizeof corners);
    save("in/sub/deep.bin", corners, sizeof corners);
    assert_int_equal(symlink("sub/deep.bin", path_of("in/link.bin")), 0);
    expect_count(gltf("in/near.gltf", "near.bin"), 1);
    expect_count(gltf("in/deep.gltf", "sub/deep.bin"), 1);
    expect_count(gltf("in/back.gltf", "sub/../near.bin"), 1);
    expect_count(gltf("in/link.gltf", "link.bin"), 1);
    save_text("in/paint.mtl", "newmtl red\nKd 1 0 0\n");
    expect_count(obj("in/paint.obj", "paint.mtl"), 1);
    expect_count(obj("in/unpainted.obj", "missing.mtl"), 1); /* the colours come from the scene in any case */
    /* The mesh itself may be given by a link, and by a path relative to the current directory. */
    assert_int_equal(symlink("../near.gltf", path_of("in/sub/linked.gltf")), 0);
    save("in/sub/near.bin", corners, sizeof corners);
    expect_count(path_of("in/sub/linked.gltf"), 1);
    char before[512];
    assert_non_null(getcwd(before, sizeof before));
    assert_int_equal(chdir(path_of("in")), 0);
    expect_count("near.gltf", 1);
    expect_count("./near.gltf", 1);
    expect_count("sub/../paint.obj", 1);
    assert_int_equal(chdir(before), 0);
}

static void files_elsewhere_are_refused(void **state)
{
    (void)state;
    static const char *const why = "outside of its folder, expected all files in that folder";
    char absolute[600];
    save("out.bin", corners, sizeof corners);
    save_text("out.mtl", "newmtl red\nKd 1 0 0\n");
    assert_int_equal(symlink("../out.bin", path_of("in/leads-out.bin")), 0);
    assert_int_equal(symlink("..", path_of("in/up")), 0);
    expect_refusal(gltf("in/up.gltf", "../out.bin"), "it refers to the file \"../out.bin\" outside of its folder");
    expect_refusal(gltf("in/around.gltf", "sub/../../out.bin"), why);
    expect_refusal(gltf("in/by-link.gltf", "leads-out.bin"), why);
    expect_refusal(gltf("in/by-folder.gltf", "up/out.bin"), why);
    expect_refusal(obj("in/up.obj", "../out.mtl"), why);
    expect_refusal(obj("in/password.obj", "../../../../../../../../etc/passwd"), why);
    expect_refusal(gltf("in/password.gltf", "../../../../../../../../etc/passwd"), why);
    snprintf(absolute, sizeof absolute, "%s", path_of("out.bin"));
    expect_refusal(gltf("in/absolute.gltf", absolute), "");
    /* A folder whose name has the same beginning is another folder. */
    assert_int_equal(mkdir(path_of("inner"), 0700), 0);
    save("inner/near.bin", corners, sizeof corners);
    expect_refusal(gltf("in/alike.gltf", "../inner/near.bin"), why);
}

static void other_than_regular_files_are_refused(void **state)
{
    (void)state;
    assert_int_equal(mkfifo(path_of("in/pipe.bin"), 0600), 0);
    assert_int_equal(mkfifo(path_of("in/pipe.obj"), 0600), 0);
    expect_refusal(path_of("in/pipe.obj"), "is a FIFO, expected a regular file");
    expect_refusal(gltf("in/pipe.gltf", "pipe.bin"), "\"pipe.bin\", expected a regular file, not a FIFO");
    expect_refusal(obj("in/piped.obj", "pipe.bin"), "expected a regular file, not a FIFO");
    expect_refusal(obj("in/folder.obj", "sub"), "\"sub\", expected a regular file, not a directory");
    assert_int_equal(symlink("/dev/zero", path_of("in/zero.obj")), 0);
    expect_refusal(path_of("in/zero.obj"), "is a device, expected a regular file");
    assert_int_equal(symlink("/dev/zero", path_of("in/zero.bin")), 0);
    expect_refusal(gltf("in/zero.gltf", "zero.bin"), "outside of its folder");
}

/* Runs in a process of its own, because sb_mesh_fence cannot be undone. Returns 0, or the number of an operation
   that succeeded. */
static int try_behind_fence(void)
{
    char byte;
    const int before = open(path_of("out.bin"), O_RDONLY);
    sb_mesh_fence(path_of("in"));
    const int inside = open(path_of("in/near.bin"), O_RDONLY);
    if (inside < 0 || read(inside, &byte, 1) != 1 || read(before, &byte, 1) != 1) return 1;
    void *memory = malloc(1 << 24);
    if (!memory) return 2;
    memset(memory, 1, 1 << 24);
    free(memory);
    if (open("/etc/passwd", O_RDONLY) >= 0 || open(path_of("out.bin"), O_RDONLY) >= 0) return 3;
    if (open(path_of("in/near.bin"), O_RDWR) >= 0 || open(path_of("in/new"), O_WRONLY | O_CREAT, 0600) >= 0) return 4;
    if (open(path_of("in/near.bin"), O_RDONLY | O_TRUNC) >= 0 || unlink(path_of("in/near.bin")) == 0) return 5;
    if (socket(AF_UNIX, SOCK_STREAM, 0) >= 0) return 6;
    if (fork() >= 0) return 7;
    execl("/bin/true", "true", (char *)NULL);
    return kill(getppid(), 0) == 0 ? 8 : 0;
}

static void the_kernel_restricts_the_child(void **state)
{
    (void)state;
    const char *gaps = sb_mesh_fence_gaps();
    if (gaps) {
        print_message("%s\n", gaps);
        skip();
    }
    const pid_t child = fork();
    if (child == 0) _exit(try_behind_fence());
    int how;
    assert_int_equal(waitpid(child, &how, 0), child);
    assert_true(WIFEXITED(how));
    assert_int_equal(WEXITSTATUS(how), 0);
}

/* The child neither writes nor ends, like one that parses for minutes. */
static void a_signal_interrupts_the_import(void **state)
{
    (void)state;
    const pid_t process = fork();
    if (process == 0) {
        int silent[2];
        if (pipe(silent) != 0) _exit(90);
        sb_stop_watch();
        sb_mesh_link from = {
            .path = "slow.obj", .pipe = silent[0], .watch = -1, .deadline = sb_clock() + 60, .room = 1000};
        sb_mesh *meshes;
        size_t count;
        raise(SIGTERM);
        const double begin = sb_clock();
        if (sb_mesh_receive(&from, &meshes, &count, &error) == SB_OK || from.end != SB_MESH_LINK_STOPPED) _exit(91);
        _exit(sb_clock() - begin < 0.5 ? 0 : 92);
    }
    int how;
    assert_int_equal(waitpid(process, &how, 0), process);
    assert_true(WIFEXITED(how));
    assert_int_equal(WEXITSTATUS(how), 0);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) && mkdir(path_of("in"), 0700) == 0 && mkdir(path_of("in/sub"), 0700) == 0 ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_of_the_folder_are_read),         cmocka_unit_test(files_elsewhere_are_refused),
        cmocka_unit_test(other_than_regular_files_are_refused), cmocka_unit_test(the_kernel_restricts_the_child),
        cmocka_unit_test(a_signal_interrupts_the_import),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
