/* Writes the plant as Wavefront OBJ, with coordinates rounded to a centimetre. */
#include "plant.h"

#include "base/file.h"

#include <math.h>
#include <string.h>

/* A coordinate rounded to centimetres without trailing zeros ("12.5", "-38", "0"). */
static const char *number(double value, char out[32])
{
    double rounded = round(value * 100) / 100;
    snprintf(out, 32, "%.2f", rounded == 0 ? 0.0 : rounded);
    size_t end = strlen(out);
    while (out[end - 1] == '0') end--;
    if (out[end - 1] == '.') end--;
    out[end] = '\0';
    return out;
}

static void write_head(const sb_plant_options *options, FILE *stream)
{
    fprintf(stream, "# A coastal nuclear plant after the pattern of Fukushima Daiichi, written by "
                    "tools/make-plant.\n"
                    "# Metres, z up, z = 0 is still water, the paddle starts at x = 0. MIT licence, "
                    "like the program.\n#");
    for (const sb_plant_option *row = sb_plant_option_table; row->name; row++)
        fprintf(stream, " --%s %g", row->name, *(const double *)((const char *)options + row->offset));
    fprintf(stream, "\n");
}

/* The part of the plant to which a body belongs. Each part is a file, so that a scene can set its role and colour. */
static const struct {
    const char *prefix, *part;
} parts[] = {
    {"terrain", "terrain"},  {"breakwater", "breakwaters"}, {"quay", "waterfront"}, {"intake", "waterfront"},
    {"reactor", "reactors"}, {"turbine", "turbines"},       {"stack", "stacks"},    {"tank", "tanks"},
    {"", "annexes"},
};
enum { PARTS = sizeof parts / sizeof *parts };

static const char *part_of(const sb_mesh *mesh)
{
    size_t i = 0;
    while (strncmp(mesh->name, parts[i].prefix, strlen(parts[i].prefix)) != 0) i++;
    return parts[i].part;
}

static void write_mesh(const sb_mesh *mesh, size_t base, FILE *stream)
{
    char x[32], y[32], z[32];
    fprintf(stream, "o %s\n", mesh->name);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        sb_vec3 at = mesh->vertices[i];
        fprintf(stream, "v %s %s %s\n", number(at.x, x), number(at.y, y), number(at.z, z));
    }
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *t = mesh->triangles[i];
        fprintf(stream, "f %zu %zu %zu\n", base + t[0], base + t[1], base + t[2]);
    }
}

/* Writes the meshes of the part; NULL: all. */
static sb_status write_file(const sb_plant_options *options, const sb_mesh *meshes, size_t count, const char *part,
                            const char *path, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    write_head(options, file.stream);
    size_t base = 1;
    for (size_t m = 0; m < count; m++) {
        if (part && strcmp(part_of(&meshes[m]), part) != 0) continue;
        write_mesh(&meshes[m], base, file.stream);
        base += meshes[m].vertex_count;
    }
    return sb_atomic_commit(&file, 0, error);
}

sb_status sb_plant_write(const sb_plant_options *options, const sb_mesh *meshes, size_t count, const char *path,
                         sb_error *error)
{
    return write_file(options, meshes, count, NULL, path, error);
}

sb_status sb_plant_write_parts(const sb_plant_options *options, const sb_mesh *meshes, size_t count, const char *folder,
                               sb_error *error)
{
    sb_status status = sb_make_directories(folder, error);
    for (size_t i = 0; i < PARTS && status == SB_OK; i++) {
        char name[64], path[SB_PATH_MAX];
        if (i > 0 && strcmp(parts[i].part, parts[i - 1].part) == 0) continue;
        snprintf(name, sizeof name, "%s.obj", parts[i].part);
        status = sb_path_join(path, folder, name, error);
        if (status == SB_OK) status = write_file(options, meshes, count, parts[i].part, path, error);
    }
    return status;
}
