#include "output/particles/pvd.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

sb_status sb_pvd_write(const char *path, const sb_particle_list *list, sb_error *error)
{
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
          "byte_order=\"LittleEndian\">\n<Collection>\n",
          out.stream);
    for (size_t i = 0; i < list->count; i++)
        fprintf(out.stream, "<DataSet timestep=\"%.12g\" part=\"0\" file=\"%s\"/>\n", list->entries[i].time,
                list->entries[i].file);
    fputs("</Collection>\n</VTKFile>\n", out.stream);
    return sb_atomic_commit(&out, 0, error);
}

static sb_status parse(const char *path, const char *text, sb_particle_list *list, sb_error *error)
{
    static const char before[] = "<DataSet timestep=\"", between[] = "\" part=\"0\" file=\"";
    if (!strstr(text, "type=\"Collection\"") || !strstr(text, "</Collection>"))
        return sb_fail(error, SB_BAD_INPUT, "%.500s: not a complete list of particle files", path);
    for (const char *at = text; (at = strstr(at, before));) {
        char *rest;
        double time = strtod(at + strlen(before), &rest);
        const char *file = rest + strlen(between);
        bool good = isfinite(time) && strncmp(rest, between, strlen(between)) == 0;
        const char *end = good ? strchr(file, '"') : NULL;
        if (!end) return sb_fail(error, SB_BAD_INPUT, "%.500s: damaged entry %zu", path, list->count + 1);
        sb_status status = sb_particle_list_add(list, time, file, (size_t)(end - file), error);
        if (status != SB_OK) return status;
        at = end;
    }
    return SB_OK;
}

sb_status sb_pvd_read(const char *path, sb_particle_list *list, sb_error *error)
{
    char *text;
    size_t length;
    sb_status status = sb_file_read(path, (size_t)1 << 28, &text, &length, error);
    if (status != SB_OK) return status;
    status = parse(path, text, list, error);
    sb_free(text);
    if (status != SB_OK) sb_particle_list_free(list);
    return status;
}
