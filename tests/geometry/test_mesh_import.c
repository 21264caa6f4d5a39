/* Every mesh format, written here as a small file; then broken ones, and random damage to all. */
#include "base/clock.h"
#include "base/file.h"
#include "base/memory.h"
#include "base/random.h"
#include "geometry/mesh.h"
#include "geometry/mesh_child.h"

#include <dirent.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static sb_error error;
static char folder[] = "/tmp/shorebreak-mesh-XXXXXX";

/* A cube of side 2 from (0, 0, 0), counter-clockwise seen from outside. */
static const int cube_vertices[8][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0},
                                        {0, 0, 2}, {2, 0, 2}, {0, 2, 2}, {2, 2, 2}};
static const int cube_triangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4},
                                          {1, 3, 7}, {1, 7, 5}, {3, 2, 6}, {3, 6, 7},
                                          {2, 0, 4}, {2, 4, 6}, {4, 5, 7}, {4, 7, 6}};

typedef struct file_text {
    char bytes[16384];
    size_t length;
} file_text;

__attribute__((format(printf, 2, 3))) static void add(file_text *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int added = vsnprintf(to->bytes + to->length, sizeof to->bytes - to->length, format, arguments);
    va_end(arguments);
    assert_true(added >= 0 && to->length + (size_t)added < sizeof to->bytes);
    to->length += (size_t)added;
}

static void add_bytes(file_text *to, const void *bytes, size_t count)
{
    assert_true(to->length + count < sizeof to->bytes);
    memcpy(to->bytes + to->length, bytes, count);
    to->length += count;
}

static const char *path_of(const char *name)
{
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static const char *save(const char *name, const file_text *text)
{
    const char *path = path_of(name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text->bytes, 1, text->length, file), text->length);
    assert_int_equal(fclose(file), 0);
    return path;
}

static const char *save_text(const char *name, const char *text)
{
    file_text whole = {.length = 0};
    add(&whole, "%s", text);
    return save(name, &whole);
}

static void make_obj(file_text *to)
{
    add(to, "# two cubes\no first\n");
    for (int copy = 0; copy < 2; ++copy) {
        for (int i = 0; i < 8; ++i)
            add(to, "v %d %d %d\n", cube_vertices[i][0] + 5 * copy, cube_vertices[i][1],
                cube_vertices[i][2]);
        for (int i = 0; i < 12; ++i)
            add(to, "f %d %d %d\n", cube_triangles[i][0] + 1 + 8 * copy,
                cube_triangles[i][1] + 1 + 8 * copy, cube_triangles[i][2] + 1 + 8 * copy);
        if (copy == 0) add(to, "o second\n");
    }
}

static void make_stl(file_text *to)
{
    add(to, "solid cube\n");
    for (int i = 0; i < 12; ++i) {
        add(to, "facet normal 0 0 0\nouter loop\n");
        for (int k = 0; k < 3; ++k) {
            const int *v = cube_vertices[cube_triangles[i][k]];
            add(to, "vertex %d.0 %d.0 %d.0\n", v[0], v[1], v[2]);
        }
        add(to, "endloop\nendfacet\n");
    }
    add(to, "endsolid cube\n");
}

static void make_stl_binary(file_text *to)
{
    const char title[80] = "binary cube";
    const uint32_t count = 12;
    add_bytes(to, title, sizeof title);
    add_bytes(to, &count, sizeof count);
    for (int i = 0; i < 12; ++i) {
        float facet[12] = {0};
        const uint16_t attribute = 0;
        for (int k = 0; k < 9; ++k)
            facet[3 + k] = (float)cube_vertices[cube_triangles[i][k / 3]][k % 3];
        add_bytes(to, facet, sizeof facet);
        add_bytes(to, &attribute, sizeof attribute);
    }
}

static void make_ply(file_text *to)
{
    add(to, "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
            "property float z\nelement face 12\nproperty list uchar int vertex_indices\n"
            "end_header\n");
    for (int i = 0; i < 8; ++i)
        add(to, "%d %d %d\n", cube_vertices[i][0], cube_vertices[i][1], cube_vertices[i][2]);
    for (int i = 0; i < 12; ++i)
        add(to, "3 %d %d %d\n", cube_triangles[i][0], cube_triangles[i][1], cube_triangles[i][2]);
}

static void add_base64(file_text *to, const unsigned char *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        unsigned word = (unsigned)bytes[i] << 16;
        word |= i + 1 < count ? (unsigned)bytes[i + 1] << 8 : 0;
        word |= i + 2 < count ? bytes[i + 2] : 0;
        add(to, "%c%c%c%c", digits[word >> 18], digits[word >> 12 & 63],
            i + 1 < count ? digits[word >> 6 & 63] : '=', i + 2 < count ? digits[word & 63] : '=');
    }
}

/* One mesh used by two nodes, the second below a turned and shifted one and mirrored. */
static size_t make_gltf_json(file_text *to, bool binary, unsigned char buffer[168])
{
    for (int i = 0; i < 24; ++i) {
        float x = (float)cube_vertices[i / 3][i % 3];
        memcpy(buffer + 4 * i, &x, 4);
    }
    for (int i = 0; i < 36; ++i) {
        uint16_t index = (uint16_t)cube_triangles[i / 3][i % 3];
        memcpy(buffer + 96 + 2 * i, &index, 2);
    }
    add(to, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
            "\"nodes\":[{\"name\":\"first\",\"mesh\":0},"
            "{\"name\":\"shifted\",\"translation\":[10,0,0],\"children\":[2]},"
            "{\"name\":\"second, mirrored\",\"scale\":[1,1,-3],\"mesh\":0}],"
            "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
            "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":8,\"type\":\"VEC3\","
            "\"min\":[0,0,0],\"max\":[2,2,2]},"
            "{\"bufferView\":1,\"componentType\":5123,\"count\":36,\"type\":\"SCALAR\"}],"
            "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":96},"
            "{\"buffer\":0,\"byteOffset\":96,\"byteLength\":72}],\"buffers\":[{\"byteLength\":168");
    if (!binary) {
        add(to, ",\"uri\":\"data:application/octet-stream;base64,");
        add_base64(to, buffer, 168);
        add(to, "\"");
    }
    add(to, "}]}");
    return 168;
}

static void make_gltf(file_text *to)
{
    unsigned char buffer[168];
    make_gltf_json(to, false, buffer);
}

static void make_glb(file_text *to)
{
    unsigned char buffer[168];
    file_text json = {.length = 0};
    make_gltf_json(&json, true, buffer);
    while (json.length % 4) add(&json, " ");
    const uint32_t head[5] = {0x46546c67, 2, (uint32_t)(28 + json.length + sizeof buffer),
                              (uint32_t)json.length, 0x4e4f534a};
    const uint32_t chunk[2] = {sizeof buffer, 0x004e4942};
    add_bytes(to, head, sizeof head);
    add_bytes(to, json.bytes, json.length);
    add_bytes(to, chunk, sizeof chunk);
    add_bytes(to, buffer, sizeof buffer);
}

static void make_dae(file_text *to)
{
    add(to,
        "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
        "version=\"1.4.1\"><asset><unit name=\"meter\" meter=\"1\"/><up_axis>Z_UP</up_axis>"
        "</asset><library_geometries><geometry id=\"g\" name=\"g\"><mesh><source id=\"p\">"
        "<float_array id=\"pa\" count=\"24\">");
    for (int i = 0; i < 24; ++i) add(to, "%d ", cube_vertices[i / 3][i % 3]);
    add(to, "</float_array><technique_common><accessor source=\"#pa\" count=\"8\" stride=\"3\">"
            "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
            "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
            "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
            "<triangles count=\"12\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>");
    for (int i = 0; i < 36; ++i) add(to, "%d ", cube_triangles[i / 3][i % 3]);
    add(to, "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
            "<visual_scene id=\"s\"><node id=\"n1\" name=\"first\">"
            "<matrix>1 0 0 0 0 1 0 0 0 0 1 7 0 0 0 1</matrix>"
            "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
            "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n");
}

typedef struct format {
    const char *name;
    void (*make)(file_text *to);
    size_t mesh_count;
} format;

static const format formats[] = {
    {"cube.obj", make_obj, 2}, {"ascii.stl", make_stl, 1},  {"binary.STL", make_stl_binary, 1},
    {"cube.ply", make_ply, 1}, {"cube.gltf", make_gltf, 2}, {"cube.glb", make_glb, 2},
    {"cube.dae", make_dae, 1},
};
enum { FORMATS = sizeof formats / sizeof *formats };

static void free_meshes(sb_mesh *meshes, size_t count)
{
    for (size_t i = 0; i < count; ++i) sb_mesh_free(&meshes[i]);
    sb_free(meshes);
}

/* Imports what must be a cube each, watertight, of the given corner and volume. */
static void check_cube(const sb_mesh *mesh, sb_vec3 min, double volume)
{
    sb_mesh_report report;
    sb_mesh_diagnose(mesh, &report);
    assert_int_equal(mesh->vertex_count, 8);
    assert_int_equal(mesh->triangle_count, 12);
    assert_true(report.watertight);
    assert_true(fabs(report.volume - volume) < 1e-5);
    assert_true(sb_norm(sb_sub(report.min, min)) < 1e-5);
}

static void test_every_format(void **state)
{
    (void)state;
    for (size_t i = 0; i < FORMATS; ++i) {
        file_text text = {.length = 0};
        formats[i].make(&text);
        sb_mesh *meshes;
        size_t count;
        if (sb_mesh_import(save(formats[i].name, &text), &meshes, &count, &error) != SB_OK)
            fail_msg("%s", error.text);
        assert_int_equal(count, formats[i].mesh_count);
        bool dae = strstr(formats[i].name, ".dae"), gltf = strstr(formats[i].name, ".gl");
        check_cube(&meshes[0], sb_vec(0, 0, dae ? 7 : 0), 8);
        if (count > 1)
            check_cube(&meshes[1], gltf ? sb_vec(10, 0, -6) : sb_vec(5, 0, 0), gltf ? 24 : 8);
        if (dae || gltf || strstr(formats[i].name, ".obj"))
            assert_string_equal(meshes[0].name, "first");
        if (gltf) assert_string_equal(meshes[1].name, "second_ mirrored");
        free_meshes(meshes, count);
    }
}

/* Whatever a DAE says of its up axis, its coordinates stay; its unit makes them metres. */
static void test_dae_axes_and_unit(void **state)
{
    (void)state;
    static const char *const axes[] = {"X_UP", "Y_UP", "Z_UP"};
    for (int i = 0; i < 3; ++i) {
        file_text text = {.length = 0};
        make_dae(&text);
        memcpy(strstr(text.bytes, "Z_UP"), axes[i], 4);
        char *unit = strstr(text.bytes, "meter=\"1\"");
        memcpy(unit, "meter=\"4\"", 9);
        sb_mesh *meshes;
        size_t count;
        if (sb_mesh_import(save("unit.dae", &text), &meshes, &count, &error) != SB_OK)
            fail_msg("%s", error.text);
        check_cube(&meshes[0], sb_vec(0, 0, 28), 512);
        free_meshes(meshes, count);
    }
}

static void expect_refusal(const char *path, const char *why)
{
    sb_mesh *meshes = NULL;
    size_t count = 99;
    const sb_mesh_limits limits = {.memory = 1u << 28, .seconds = 1};
    error.text[0] = '\0';
    sb_status status = sb_mesh_import_within(path, &limits, &meshes, &count, &error);
    if (status != SB_BAD_INPUT)
        fail_msg("%s: status %d, expected a refusal (%s)", path, status, error.text);
    if (strncmp(error.text, path, strlen(path)) != 0 || !strstr(error.text, why) ||
        strchr(error.text, '\n'))
        fail_msg("\"%s\" should be one line, begin with the path and say \"%s\"", error.text, why);
    assert_null(meshes);
    assert_int_equal(count, 99);
}

static void test_broken_files(void **state)
{
    (void)state;
    expect_refusal("/nonexistent/cube.obj", "No such file");
    assert_int_equal(mkdir(path_of("folder.obj"), 0700), 0);
    expect_refusal(path_of("folder.obj"), "is a directory");
    assert_int_equal(mkfifo(path_of("pipe.obj"), 0600), 0);
    expect_refusal(path_of("pipe.obj"), "no regular file");
    expect_refusal(save_text("empty.obj", ""), "is empty");
    expect_refusal(save_text("notes.txt", "hello"), "unknown format");
    expect_refusal(save_text("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "");
    expect_refusal(save_text("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "finite");
    expect_refusal(save_text("nan.ply",
                             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 1\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n"),
                   "");
    expect_refusal(save_text("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"), "");
    expect_refusal(save_text("index.ply",
                             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                             "property float y\nproperty float z\nelement face 1\n"
                             "property list uchar int vertex_indices\nend_header\n"
                             "0 0 0\n1 0 0\n0 1 0\n3 0 1 77\n"),
                   "");
    expect_refusal(save_text("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "no triangles");
    expect_refusal(save_text("header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n"), "");
    expect_refusal(save_text("huge.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                                         "property float x\nproperty float y\nproperty float z\n"
                                         "element face 4000000000\nproperty list uchar int "
                                         "vertex_indices\nend_header\n0 0 0\n"),
                   "");
    file_text huge = {.length = 0};
    make_stl_binary(&huge);
    memset(huge.bytes + 80, 0xff, 4);
    expect_refusal(save("huge.stl", &huge), "");
}

static void test_cut_and_garbage(void **state)
{
    (void)state;
    for (size_t i = 0; i < FORMATS; ++i) {
        char name[64];
        file_text text = {.length = 0}, garbage = {.length = 600};
        formats[i].make(&text);
        /* Enough is left to look like the format, too little for one triangle. */
        text.length = text.length / 20;
        snprintf(name, sizeof name, "cut-%s", formats[i].name);
        expect_refusal(save(name, &text), "");
        for (size_t j = 0; j < garbage.length; ++j)
            garbage.bytes[j] = (char)(256 * sb_random(i + 1, j));
        snprintf(name, sizeof name, "garbage-%s", formats[i].name);
        expect_refusal(save(name, &garbage), "");
    }
}

static void test_degenerate_triangles_are_counted(void **state)
{
    (void)state;
    const char *path = save_text("slivers.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 0\n"
                                                "f 1 2 3\nf 1 2 4\nf 1 2 5\n");
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(count, 1);
    assert_int_equal(meshes[0].triangle_count, 1);
    assert_int_equal(meshes[0].vertex_count, 3);
    assert_int_equal(meshes[0].dropped, 2);
    assert_string_equal(meshes[0].name, "");
    free_meshes(meshes, count);
}

typedef enum outcome { SOUND, REFUSED, WRONG } outcome;

static outcome judge(const char *path, sb_status status, sb_mesh *meshes, size_t count,
                     const sb_error *why)
{
    if (status != SB_OK)
        return status == SB_BAD_INPUT && strncmp(why->text, path, strlen(path)) == 0 &&
                       !strchr(why->text, '\n')
                   ? REFUSED
                   : WRONG;
    bool sound = count > 0;
    for (size_t k = 0; k < count; ++k) {
        sound = sound && meshes[k].triangle_count > 0;
        for (size_t v = 0; v < meshes[k].vertex_count; ++v)
            sound = sound && sb_isfinite(meshes[k].vertices[v]);
        for (size_t t = 0; t < 3 * meshes[k].triangle_count; ++t)
            sound = sound && meshes[k].triangles[t / 3][t % 3] < meshes[k].vertex_count;
    }
    free_meshes(meshes, count);
    return sound ? SOUND : WRONG;
}

/* Changes up to eight bytes of one format's file and reads that. */
static outcome read_damaged(size_t which, uint64_t round)
{
    const sb_mesh_limits limits = {.memory = 1u << 28, .seconds = 1};
    const uint64_t seed = 1000 * which + round;
    char path[512];
    file_text text = {.length = 0};
    formats[which].make(&text);
    for (uint64_t j = 0; j < 1 + round % 8; ++j) {
        size_t at = (size_t)(sb_random(seed, 2 * j) * (double)text.length);
        text.bytes[at] = (char)(256 * sb_random(seed, 2 * j + 1));
    }
    snprintf(path, sizeof path, "%s/%d-%s", folder, (int)round, formats[which].name);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(text.bytes, 1, text.length, file) != text.length || fclose(file) != 0)
        return WRONG;
    sb_mesh *meshes = NULL;
    size_t count = 0;
    sb_error why = {0};
    sb_status status = sb_mesh_import_within(path, &limits, &meshes, &count, &why);
    outcome result = judge(path, status, meshes, count, &why);
    if (result == WRONG)
        print_message("%s: status %d, %zu meshes, %s\n", path, status, count, why.text);
    return result;
}

/* Whatever comes of damage must be a sound mesh or one clear line, within the limits. */
static void test_random_damage(void **state)
{
    (void)state;
    enum { ROUNDS = 44 };
    int results[3] = {0};
    double begin = sb_clock();
#pragma omp parallel for schedule(dynamic) num_threads(3)
    for (size_t i = 0; i < FORMATS * ROUNDS; ++i) {
        outcome result = read_damaged(i % FORMATS, i / FORMATS);
#pragma omp atomic
        ++results[result];
    }
    double took = sb_clock() - begin;
    print_message("%d damaged files: %d read, %d refused, %.1f s\n", FORMATS * ROUNDS,
                  results[SOUND], results[REFUSED], took);
    assert_int_equal(results[WRONG], 0);
    assert_true(results[SOUND] + results[REFUSED] >= 300);
    assert_true(results[SOUND] > 20 && results[REFUSED] > 20);
}

static void test_names_are_made_fit(void **state)
{
    (void)state;
    const char *path = save_text("names.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\no a,b\\c\nf 1 2 3\n"
                                              "o caf\xc3\xa9\nf 1 2 3\no bad\xff\nf 1 2 3\no "
                                              "0123456789012345678901234567890123456789"
                                              "0123456789012345678901\xc3\xa9\nf 1 2 3\n");
    sb_mesh *meshes;
    size_t count;
    if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(count, 4);
    assert_string_equal(meshes[0].name, "a_b_c");
    assert_string_equal(meshes[1].name, "caf\xc3\xa9");
    assert_string_equal(meshes[2].name, "bad_");
    assert_string_equal(meshes[3].name,
                        "01234567890123456789012345678901234567890123456789012345678901");
    free_meshes(meshes, count);
}

static volatile sig_atomic_t children_ended;

static void count_children(int number)
{
    (void)number;
    ++children_ended;
}

static void reap_all(int number)
{
    (void)number;
    ++children_ended;
    while (waitpid(-1, NULL, WNOHANG) > 0) continue;
}

/* The program around us may ignore ended children, reap them itself, or be interrupted by them. */
static void test_signals_and_threads(void **state)
{
    (void)state;
    file_text text = {.length = 0};
    make_obj(&text);
    char path[512];
    snprintf(path, sizeof path, "%s", save("signals.obj", &text));
    void (*const handlers[])(int) = {SIG_IGN, count_children, reap_all, SIG_DFL};
    for (size_t i = 0; i < 4; ++i) {
        struct sigaction action = {.sa_handler = handlers[i]};
        sigaction(SIGCHLD, &action, NULL);
        for (int repeat = 0; repeat < 3; ++repeat) {
            sb_mesh *meshes;
            size_t count;
            if (sb_mesh_import(path, &meshes, &count, &error) != SB_OK) fail_msg("%s", error.text);
            assert_int_equal(count, 2);
            free_meshes(meshes, count);
        }
        expect_refusal(save_text("bad.obj", "nothing"), "");
    }
    assert_true(children_ended > 0);
    int good = 0;
#pragma omp parallel for num_threads(3) reduction(+ : good)
    for (int i = 0; i < 12; ++i) {
        sb_mesh *meshes;
        size_t count;
        if (sb_mesh_import(path, &meshes, &count, NULL) == SB_OK) {
            good += count == 2;
            free_meshes(meshes, count);
        }
    }
    assert_int_equal(good, 12);
}

static size_t open_files(void)
{
    size_t count = 0;
    DIR *listing = opendir("/proc/self/fd");
    assert_non_null(listing);
    while (readdir(listing)) ++count;
    closedir(listing);
    return count;
}

static void test_nothing_is_left_behind(void **state)
{
    (void)state;
    file_text text = {.length = 0};
    make_obj(&text);
    const char *path = save("left.obj", &text);
    size_t before = open_files();
    for (int i = 0; i < 5; ++i) {
        sb_mesh *meshes;
        size_t count;
        assert_int_equal(sb_mesh_import(path, &meshes, &count, &error), SB_OK);
        free_meshes(meshes, count);
    }
    expect_refusal(save_text("bad.ply", "ply\nnothing"), "");
    assert_int_equal(open_files(), before);
    assert_int_equal(waitpid(-1, NULL, WNOHANG), -1);
    /* Without memory the failure is told and nothing leaks (the sanitizer watches). */
    int failures = 0;
    for (long n = 1; n < 12; ++n) {
        sb_mesh *meshes = NULL;
        size_t count = 0;
        sb_memory_fail_at(n);
        sb_status status = sb_mesh_import(path_of("left.obj"), &meshes, &count, &error);
        sb_memory_fail_at(0);
        failures += status != SB_OK;
        if (status == SB_OK) free_meshes(meshes, count);
    }
    assert_true(failures > 3);
}

static int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
    (void)state;
    DIR *listing = opendir(folder);
    for (struct dirent *entry; listing && (entry = readdir(listing));)
        if (entry->d_name[0] != '.') remove(path_of(entry->d_name));
    if (listing) closedir(listing);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_every_format),
        cmocka_unit_test(test_dae_axes_and_unit),
        cmocka_unit_test(test_broken_files),
        cmocka_unit_test(test_cut_and_garbage),
        cmocka_unit_test(test_degenerate_triangles_are_counted),
        cmocka_unit_test(test_random_damage),
        cmocka_unit_test(test_names_are_made_fit),
        cmocka_unit_test(test_signals_and_threads),
        cmocka_unit_test(test_nothing_is_left_behind),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
