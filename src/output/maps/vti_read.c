#include "base/input.h"
#include "base/memory.h"
#include "output/maps/vti.h"

#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { HEADER_MAX = 4096, CELLS_MAX = 1 << 28 };
#define APPENDED "<AppendedData encoding=\"raw\">\n_"

/* An open file: its XML part as text, and the first byte of its data. */
typedef struct source {
    const char *path;
    FILE *stream;
    char header[HEADER_MAX + 1];
    uint64_t base, end;
} source;

static sb_status damaged(const source *file, sb_error *error, const char *what)
{
    return sb_fail(error, SB_BAD_INPUT, "%.500s: %s, expected a grid file of shorebreak", file->path, what);
}

static sb_status read_header(source *file, sb_error *error)
{
    const size_t got = fread(file->header, 1, HEADER_MAX, file->stream);
    const char *mark = memmem(file->header, got, APPENDED, strlen(APPENDED));
    if (!mark) return damaged(file, error, "no appended data");
    file->base = (uint64_t)(mark - file->header) + strlen(APPENDED);
    file->header[file->base] = '\0';
    if (strlen(file->header) != file->base) return damaged(file, error, "zero bytes in the header");
    if (strncmp(file->header, SB_VTI_HEAD, strlen(SB_VTI_HEAD)) != 0)
        return damaged(file, error, "does not begin as little-endian ImageData with UInt64 headers");
    if (fseeko(file->stream, 0, SEEK_END) != 0) return damaged(file, error, "not seekable");
    file->end = (uint64_t)ftello(file->stream);
    return SB_OK;
}

static sb_status read_size(const source *file, sb_vti *image, sb_error *error)
{
    double step[2];
    const char *extent = strstr(file->header, "<ImageData WholeExtent=");
    const char *time = strstr(file->header, "Name=\"TimeValue\"");
    time = time ? strchr(time, '>') : NULL;
    if (!extent || !time || sscanf(time, ">%lg", &image->time) != 1 ||
        sscanf(extent, "<ImageData WholeExtent=\"0 %zu 0 %zu 0 0\" Origin=\"%lg %lg 0\" Spacing=\"%lg %lg",
               &image->columns, &image->rows, &image->x, &image->y, &image->cell, &step[0]) != 6)
        return damaged(file, error, "no extent, origin, spacing or time");
    if (image->columns == 0 || image->rows == 0 || image->columns > CELLS_MAX ||
        image->rows > CELLS_MAX / image->columns || !isfinite(image->x) || !isfinite(image->y) ||
        !isfinite(image->time) || !isfinite(image->cell) || !(image->cell > 0) || step[0] != image->cell)
        return damaged(file, error, "invalid extent, origin, spacing or time");
    return SB_OK;
}

static sb_status read_array(const source *file, const sb_vti_array *array, size_t cells, float *values, sb_error *error)
{
    char pattern[160], what[160];
    const uint64_t bytes = (uint64_t)cells * array->components * sizeof(float);
    uint64_t offset = 0, length = 0;
    snprintf(pattern, sizeof pattern,
             "<DataArray type=\"Float32\" Name=\"%s\" NumberOfComponents=\"%zu\" format=\"appended\" ", array->name,
             array->components);
    const char *tag = strstr(file->header, pattern);
    snprintf(what, sizeof what, "no array \"%s\" of %zu components", array->name, array->components);
    if (!tag || sscanf(tag + strlen(pattern), "offset=\"%" SCNu64 "\"", &offset) != 1)
        return damaged(file, error, what);
    snprintf(what, sizeof what, "array \"%s\" is cut off or of the wrong length", array->name);
    const uint64_t room = file->end - file->base;
    if (room < sizeof length || offset > room - sizeof length ||
        fseeko(file->stream, (off_t)(file->base + offset), SEEK_SET) != 0 ||
        fread(&length, sizeof length, 1, file->stream) != 1 || length != bytes ||
        length > room - sizeof length - offset || fread(values, 1, bytes, file->stream) != bytes)
        return damaged(file, error, what);
    return SB_OK;
}

static sb_status read_arrays(const source *file, sb_vti *image, sb_vti_array *wanted, float **values, sb_error *error)
{
    const size_t cells = image->columns * image->rows;
    size_t components = 0;
    for (size_t k = 0; k < image->array_count; k++) components += wanted[k].components;
    /* A number of cells that the file cannot hold must not be allocated. */
    if ((uint64_t)cells > (file->end - file->base) / (components * sizeof(float)))
        return damaged(file, error, "too short for its number of cells");
    float *made = sb_alloc(cells * components, sizeof *made), *next = made;
    sb_status status = made ? SB_OK : sb_fail_memory(error, file->path);
    for (size_t k = 0; k < image->array_count && status == SB_OK; k++) {
        status = read_array(file, &wanted[k], cells, next, error);
        wanted[k].values = next;
        next += cells * wanted[k].components;
    }
    if (status == SB_OK)
        *values = made;
    else
        sb_free(made);
    return status;
}

sb_status sb_vti_read(const char *path, sb_vti_array *wanted, size_t count, sb_vti *image, float **values,
                      sb_error *error)
{
    source file = {.path = path};
    sb_vti made = {.array_count = count, .arrays = wanted};
    sb_status status = sb_input_open(path, &file.stream, error);
    if (status != SB_OK) return status;
    status = read_header(&file, error);
    if (status == SB_OK) status = read_size(&file, &made, error);
    if (status == SB_OK) status = read_arrays(&file, &made, wanted, values, error);
    if (status == SB_OK) *image = made;
    fclose(file.stream);
    return status;
}
