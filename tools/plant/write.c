/* The plant as Wavefront OBJ. Two decimals are enough: a centimetre on a coast. */
#include "plant.h"

#include "base/file.h"

#include <math.h>
#include <string.h>

/* A coordinate rounded to centimetres without idle zeros ("12.5", "-38", "0"). */
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

static void head(const sb_plant_options *options, FILE *stream)
{
    fprintf(stream,
            "# A coastal nuclear plant after the pattern of Fukushima Daiichi, written by "
            "tools/make-plant.\n"
            "# Metres, z up, z = 0 is still water, the paddle starts at x = 0. MIT licence, "
            "like the program.\n#");
    for (const sb_plant_option *row = sb_plant_option_table; row->name; row++)
        fprintf(stream, " --%s %g", row->name,
                *(const double *)((const char *)options + row->offset));
    fprintf(stream, "\n");
}

sb_status sb_plant_write(const sb_plant_options *options, const sb_mesh *meshes, size_t count,
                         const char *path, sb_error *error)
{
    sb_atomic_file file;
    sb_status status = sb_atomic_open(&file, path, error);
    if (status != SB_OK) return status;
    head(options, file.stream);
    size_t base = 1;
    for (size_t m = 0; m < count; m++) {
        const sb_mesh *mesh = &meshes[m];
        char x[32], y[32], z[32];
        fprintf(file.stream, "o %s\n", mesh->name);
        for (size_t i = 0; i < mesh->vertex_count; i++)
            fprintf(file.stream, "v %s %s %s\n", number(mesh->vertices[i].x, x),
                    number(mesh->vertices[i].y, y), number(mesh->vertices[i].z, z));
        for (size_t i = 0; i < mesh->triangle_count; i++) {
            const uint32_t *t = mesh->triangles[i];
            fprintf(file.stream, "f %zu %zu %zu\n", base + t[0], base + t[1], base + t[2]);
        }
        base += mesh->vertex_count;
    }
    return sb_atomic_commit(&file, 0, error);
}
