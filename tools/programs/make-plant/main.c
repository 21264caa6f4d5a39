/* tools/make-plant: writes the coastal plant as a mesh. */
#include "plant.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void usage(FILE *out)
{
    fprintf(out, "usage: make-plant [--out FILE | --parts FOLDER] [--HEIGHT METRES]...\n"
                 "Writes a coastal nuclear plant as one mesh (Wavefront OBJ), every building an "
                 "object.\n\n"
                 "  --out FILE          file to write (plant.obj)\n"
                 "  --parts FOLDER      writes one file per part instead: terrain, reactors, ...\n");
    for (const sb_plant_option *row = sb_plant_option_table; row->name; row++)
        fprintf(out, "  --%-17s %s (%g; %g to %g)\n", row->name, row->summary, row->value, row->least, row->most);
    fprintf(out, "  --help, --version\n");
}

static int bad(const char *what, const char *which)
{
    fprintf(stderr, "make-plant: %s: %s; see --help\n", which, what);
    return SB_BAD_INPUT;
}

/* Sets the height of that name. Returns NULL, or what is wrong. */
static const char *set_height(sb_plant_options *options, const char *name, const char *text)
{
    for (const sb_plant_option *row = sb_plant_option_table; row->name; row++) {
        if (strcmp(row->name, name) != 0) continue;
        char *end;
        double value = strtod(text, &end);
        if (end == text || *end != '\0' || !isfinite(value)) return "expected a number of metres";
        *(double *)((char *)options + row->offset) = value;
        return NULL;
    }
    return "no such option";
}

static int make(const sb_plant_options *options, const char *path, bool parts)
{
    sb_error error = {0};
    sb_mesh *meshes = NULL;
    size_t count = 0, triangles = 0;
    sb_status status = sb_plant_build(options, &meshes, &count, &error);
    if (status == SB_OK)
        status = parts ? sb_plant_write_parts(options, meshes, count, path, &error)
                       : sb_plant_write(options, meshes, count, path, &error);
    if (status != SB_OK) fprintf(stderr, "make-plant: %s\n", error.text);
    for (size_t i = 0; i < count; i++) triangles += meshes[i].triangle_count;
    if (status == SB_OK) printf("%s: %zu bodies, %zu triangles\n", path, count, triangles);
    sb_plant_free(meshes, count);
    return (int)status;
}

int main(int argc, char **argv)
{
    sb_plant_options options = sb_plant_defaults();
    const char *path = "plant.obj";
    bool parts = false;
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-h") == 0) {
            usage(stdout);
            return 0;
        }
        if (strcmp(argv[i], "--version") == 0) {
            printf("make-plant %s\n", SB_VERSION);
            return 0;
        }
        if (strncmp(argv[i], "--", 2) != 0) return bad("not an option", argv[i]);
        if (i + 1 == argc) return bad("expected a value, or no such option", argv[i]);
        const char *name = argv[i] + 2, *value = argv[++i];
        if (strcmp(name, "out") == 0 || strcmp(name, "parts") == 0) {
            path = value;
            parts = *name == 'p';
            continue;
        }
        const char *wrong = set_height(&options, name, value);
        if (wrong) return bad(wrong, argv[i - 1]);
    }
    return make(&options, path, parts);
}
