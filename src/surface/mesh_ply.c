/* Meshes as PLY, binary and little-endian, for Blender. */
#include "surface/mesh_format.h"

typedef struct __attribute__((packed)) vertex {
    double place[3];
    float normal[3], velocity[3], pressure;
} vertex;

typedef struct __attribute__((packed)) face {
    uint8_t count;
    uint32_t corner[3];
} face;

static void write_ply(FILE *stream, const sb_water_mesh *mesh, double time)
{
    (void)time;
    fprintf(stream, "element vertex %zu\nproperty double x\nproperty double y\nproperty double z\n", mesh->vertices);
    static const char *const names[] = {"nx", "ny", "nz", "velocity_x", "velocity_y", "velocity_z", "pressure"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) fprintf(stream, "property float %s\n", names[i]);
    fprintf(stream, "element face %zu\nproperty list uchar int vertex_indices\nend_header\n", mesh->triangles);
    const double origin[3] = {mesh->origin.x, mesh->origin.y, mesh->origin.z};
    for (size_t v = 0; v < mesh->vertices; v++) {
        vertex out = {.pressure = mesh->pressure[v]};
        for (int a = 0; a < 3; a++) {
            out.place[a] = origin[a] + (double)mesh->position[v][a];
            out.normal[a] = mesh->normal[v][a];
            out.velocity[a] = mesh->velocity[v][a];
        }
        fwrite(&out, sizeof out, 1, stream);
    }
    for (size_t t = 0; t < mesh->triangles; t++) {
        const face out = {.count = 3, .corner = {mesh->corner[t][0], mesh->corner[t][1], mesh->corner[t][2]}};
        fwrite(&out, sizeof out, 1, stream);
    }
}

const sb_mesh_format sb_mesh_ply = {
    .name = "ply",
    .summary = "binary PLY, for Blender",
    .ending = ".ply",
    .before = "ply\nformat binary_little_endian 1.0\ncomment ",
    .after = "\n",
    .write = write_ply,
};
