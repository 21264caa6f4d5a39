/* Damages valid GeoTIFF and NetCDF files at random and reads them: fuzz_rasters FILES SEED. Each must give ground with
   finite heights or a one-line error within the limits, and leave no process behind. The last line is a summary; the
   exit status is 0 if no file was wrong. libFuzzer does not reach the child process that reads the files. */
#include "fuzz.h"

#include "base/clock.h"
#include "base/memory.h"
#include "base/random.h"
#include "geometry/mesh/mesh.h"
#include "grid_samples.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FORMATS = 6, BYTES_MAX = 65536 };

typedef struct content {
    const char *name;
    uint8_t bytes[BYTES_MAX];
    size_t size;
} content;

static double bowl(double x, double y)
{
    return x < 3 && y < 3 ? (double)NAN : round(x - 0.5 * y);
}

/* Writes a valid file of each format and reads its bytes. */
static void make_content(int format, content *to)
{
    static const char *const names[FORMATS] = {"strips.tif", "tiles.tif", "degrees.tif",
                                               "classic.nc", "hdf5.nc",   "degrees.nc"};
    const bool tiff = format < 3, degrees = format % 3 == 2;
    const grid_sample sample = {.columns = 24,
                                .rows = 20,
                                .x = degrees ? 141 : 0,
                                .y = degrees ? 38 : 0,
                                .dx = degrees ? 1e-5 : 1,
                                .dy = degrees ? 1e-5 : 1,
                                .height = bowl,
                                .nodata = -9999,
                                .epsg = degrees ? 4326 : 32654,
                                .geographic = degrees,
                                .whole = format & 1,
                                .tile = format % 3 == 1 ? 16 : 0};
    to->name = names[format];
    const char *path = fuzz_save(to->name, to->bytes, 0);
    (tiff ? grid_sample_tiff : grid_sample_netcdf)(&sample, path);
    FILE *file = fopen(path, "rb");
    FUZZ_CHECK(file);
    to->size = fread(to->bytes, 1, BYTES_MAX, file);
    FUZZ_CHECK(to->size > 100 && to->size < BYTES_MAX);
    fclose(file);
}

static size_t roll(uint64_t seed, uint64_t *throws, size_t sides)
{
    return (size_t)(sb_random(seed, (*throws)++) * (double)sides);
}

/* Numbers are where both formats keep their structure: the first and the last bytes are damaged more often. */
static void damage(content *of, uint64_t seed)
{
    static const uint8_t extremes[] = {0, 1, 0x7f, 0x80, 0xff};
    uint64_t throws = 0;
    for (size_t times = 1 + roll(seed, &throws, 4); times > 0 && of->size > 0; --times) {
        const size_t kind = roll(seed, &throws, 8), near = of->size < 600 ? of->size : 600;
        size_t at = roll(seed, &throws, kind < 5 ? near : of->size);
        if (kind == 4) at = of->size - 1 - at;
        if (kind == 7)
            of->size = at;
        else if (kind < 3)
            of->bytes[at] = extremes[roll(seed, &throws, sizeof extremes)];
        else
            of->bytes[at] = (uint8_t)roll(seed, &throws, 256);
    }
}

/* Reads the file as the ground of a body; 1: read, 0: refused. */
static int read_file(const char *path)
{
    sb_body body = {.name = "bed", .shape = SB_SHAPE_GRID, .role = SB_ROLE_TERRAIN, .scale = 1};
    sb_mesh *meshes = NULL;
    size_t count = 0;
    sb_error error = {0};
    char file[512];
    snprintf(file, sizeof file, "%s", path);
    body.file = file;
    /* A damaged step or position makes a large grid, which is valid: the window keeps it small. */
    body.window = (sb_window){true, 0, 0, 24, 20};
    if (strstr(path, "degrees")) body.window = (sb_window){true, 500000, 4205815, 500020, 4205836};
    body.resample = 1;
    const sb_status status = sb_mesh_from_body(&body, 1, &meshes, &count, &error);
    if (status != SB_OK) {
        if (getenv("SB_FUZZ_SHOW")) fprintf(stderr, "%s\n", error.text);
        fuzz_check_refusal(status, &error);
        FUZZ_CHECK(strstr(error.text, path));
        return 0;
    }
    FUZZ_CHECK(count == 1 && meshes->triangle_count > 0);
    for (size_t i = 0; i < meshes->vertex_count; ++i) FUZZ_CHECK(sb_isfinite(meshes->vertices[i]));
    sb_mesh_free(meshes);
    sb_free(meshes);
    return 1;
}

int main(int count, char **arguments)
{
    const long files = count > 1 ? strtol(arguments[1], NULL, 10) : 200;
    const uint64_t seed = count > 2 ? strtoull(arguments[2], NULL, 10) : 1;
    static content valid[FORMATS], damaged;
    long outcomes[2] = {0};
    double longest = 0;
    for (int format = 0; format < FORMATS; ++format) {
        make_content(format, &valid[format]);
        FUZZ_CHECK(read_file(fuzz_save(valid[format].name, valid[format].bytes, valid[format].size)) == 1);
    }
    for (long n = 0; n < files; ++n) {
        damaged = valid[n % FORMATS];
        damage(&damaged, seed * 1000003 + (uint64_t)n);
        const double begin = sb_clock();
        ++outcomes[read_file(fuzz_save(damaged.name, damaged.bytes, damaged.size))];
        longest = fmax(longest, sb_clock() - begin);
    }
    const bool left = waitpid(-1, NULL, WNOHANG) != -1 || errno != ECHILD;
    if (left) puts("a child process is left behind");
    printf("%ld refused, %ld read, longest %.1f s\n", outcomes[0], outcomes[1], longest);
    return left;
}
