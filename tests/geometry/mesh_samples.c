#include "mesh_samples.h"

#include "base/memory.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A cube with side 2 and one corner at (0, 0, 0), counter-clockwise seen from outside. */
static const int cube_vertices[8][3] = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0},
                                        {0, 0, 2}, {2, 0, 2}, {0, 2, 2}, {2, 2, 2}};
static const int cube_triangles[12][3] = {{0, 2, 3}, {0, 3, 1}, {0, 1, 5}, {0, 5, 4}, {1, 3, 7}, {1, 7, 5},
                                          {3, 2, 6}, {3, 6, 7}, {2, 0, 4}, {2, 4, 6}, {4, 5, 7}, {4, 7, 6}};

__attribute__((format(printf, 2, 3))) static void add(sample_text *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    int added = vsnprintf(to->bytes + to->length, sizeof to->bytes - to->length, format, arguments);
    va_end(arguments);
    if (added < 0 || to->length + (size_t)added >= sizeof to->bytes) abort();
    to->length += (size_t)added;
}

static void add_bytes(sample_text *to, const void *bytes, size_t count)
{
    if (to->length + count >= sizeof to->bytes) abort();
    memcpy(to->bytes + to->length, bytes, count);
    to->length += count;
}

void sample_make_obj(sample_text *to)
{
    add(to, "# two cubes\no first\n");
    for (int copy = 0; copy < 2; ++copy) {
        for (int i = 0; i < 8; ++i)
            add(to, "v %d %d %d\n", cube_vertices[i][0] + 5 * copy, cube_vertices[i][1], cube_vertices[i][2]);
        for (int i = 0; i < 12; ++i)
            add(to, "f %d %d %d\n", cube_triangles[i][0] + 1 + 8 * copy, cube_triangles[i][1] + 1 + 8 * copy,
                cube_triangles[i][2] + 1 + 8 * copy);
        if (copy == 0) add(to, "o second\n");
    }
}

static void make_stl(sample_text *to)
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

void sample_make_stl_binary(sample_text *to)
{
    const char title[80] = "binary cube";
    const uint32_t count = 12;
    add_bytes(to, title, sizeof title);
    add_bytes(to, &count, sizeof count);
    for (int i = 0; i < 12; ++i) {
        float facet[12] = {0};
        const uint16_t attribute = 0;
        for (int k = 0; k < 9; ++k) facet[3 + k] = (float)cube_vertices[cube_triangles[i][k / 3]][k % 3];
        add_bytes(to, facet, sizeof facet);
        add_bytes(to, &attribute, sizeof attribute);
    }
}

static void make_ply(sample_text *to)
{
    add(to, "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\n"
            "property float z\nelement face 12\nproperty list uchar int vertex_indices\n"
            "end_header\n");
    for (int i = 0; i < 8; ++i) add(to, "%d %d %d\n", cube_vertices[i][0], cube_vertices[i][1], cube_vertices[i][2]);
    for (int i = 0; i < 12; ++i)
        add(to, "3 %d %d %d\n", cube_triangles[i][0], cube_triangles[i][1], cube_triangles[i][2]);
}

static void add_base64(sample_text *to, const unsigned char *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < count; i += 3) {
        unsigned triple = (unsigned)bytes[i] << 16;
        triple |= i + 1 < count ? (unsigned)bytes[i + 1] << 8 : 0;
        triple |= i + 2 < count ? bytes[i + 2] : 0;
        add(to, "%c%c%c%c", digits[triple >> 18], digits[triple >> 12 & 63],
            i + 1 < count ? digits[triple >> 6 & 63] : '=', i + 2 < count ? digits[triple & 63] : '=');
    }
}

/* Writes a glTF file in which two nodes use one mesh. The second is mirrored and below a shifted node. */
static size_t make_gltf_json(sample_text *to, bool binary, unsigned char buffer[168])
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

static void make_gltf(sample_text *to)
{
    unsigned char buffer[168];
    make_gltf_json(to, false, buffer);
}

static void make_glb(sample_text *to)
{
    unsigned char buffer[168];
    sample_text json = {.length = 0};
    make_gltf_json(&json, true, buffer);
    while (json.length % 4) add(&json, " ");
    const uint32_t head[5] = {0x46546c67, 2, (uint32_t)(28 + json.length + sizeof buffer), (uint32_t)json.length,
                              0x4e4f534a};
    const uint32_t chunk[2] = {sizeof buffer, 0x004e4942};
    add_bytes(to, head, sizeof head);
    add_bytes(to, json.bytes, json.length);
    add_bytes(to, chunk, sizeof chunk);
    add_bytes(to, buffer, sizeof buffer);
}

void sample_make_dae(sample_text *to)
{
    add(to, "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
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

const sample_format sample_formats[SAMPLE_FORMATS] = {
    {"cube.obj", sample_make_obj, 2}, {"ascii.stl", make_stl, 1},  {"binary.STL", sample_make_stl_binary, 1},
    {"cube.ply", make_ply, 1},        {"cube.gltf", make_gltf, 2}, {"cube.glb", make_glb, 2},
    {"cube.dae", sample_make_dae, 1},
};
void sample_free(sb_mesh *meshes, size_t count)
{
    for (size_t i = 0; i < count; ++i) sb_mesh_free(&meshes[i]);
    sb_free(meshes);
}

sample_outcome sample_judge(const char *path, sb_status status, sb_mesh *meshes, size_t count, const sb_error *why)
{
    if (status != SB_OK)
        return status == SB_BAD_INPUT && strncmp(why->text, path, strlen(path)) == 0 && !strchr(why->text, '\n')
                   ? SAMPLE_REFUSED
                   : SAMPLE_WRONG;
    bool sound = count > 0;
    for (size_t k = 0; k < count; ++k) {
        sound = sound && meshes[k].triangle_count > 0;
        for (size_t v = 0; v < meshes[k].vertex_count; ++v) sound = sound && sb_isfinite(meshes[k].vertices[v]);
        for (size_t t = 0; t < 3 * meshes[k].triangle_count; ++t)
            sound = sound && meshes[k].triangles[t / 3][t % 3] < meshes[k].vertex_count;
    }
    sample_free(meshes, count);
    return sound ? SAMPLE_SOUND : SAMPLE_WRONG;
}
