#include "output/pvd.h"

#include "base/file.h"
#include "base/memory.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

void sb_pvd_free(sb_pvd *pvd)
{
    sb_free(pvd->entries);
    *pvd = (sb_pvd){0};
}

static sb_status append(sb_pvd *pvd, double time, const char *file, size_t length, sb_error *error)
{
    if (length == 0 || length >= sizeof pvd->entries->file || memchr(file, '"', length) || memchr(file, '<', length) ||
        memchr(file, '&', length))
        return sb_fail(error, SB_BAD_INPUT, "%.*s: not a valid file name in a pvd", length < 300 ? (int)length : 300,
                       file);
    if (sb_grow((void **)&pvd->entries, &pvd->capacity, pvd->count + 1, sizeof *pvd->entries) != 0)
        return sb_fail_memory(error, "list of particle files");
    sb_pvd_entry *entry = &pvd->entries[pvd->count++];
    entry->time = time;
    memcpy(entry->file, file, length);
    entry->file[length] = '\0';
    return SB_OK;
}

sb_status sb_pvd_note(sb_pvd *pvd, double time, const char *file, sb_error *error)
{
    return append(pvd, time, file, strlen(file), error);
}

sb_status sb_pvd_add(sb_pvd *pvd, const char *path, double time, const char *file, sb_error *error)
{
    sb_status status = sb_pvd_note(pvd, time, file, error);
    if (status != SB_OK) return status;
    status = sb_pvd_write(pvd, path, error);
    pvd->count -= status != SB_OK;
    return status;
}

sb_status sb_pvd_write(const sb_pvd *pvd, const char *path, sb_error *error)
{
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    fputs("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" "
          "byte_order=\"LittleEndian\">\n<Collection>\n",
          out.stream);
    for (size_t i = 0; i < pvd->count; i++)
        fprintf(out.stream, "<DataSet timestep=\"%.12g\" part=\"0\" file=\"%s\"/>\n", pvd->entries[i].time,
                pvd->entries[i].file);
    fputs("</Collection>\n</VTKFile>\n", out.stream);
    return sb_atomic_commit(&out, 0, error);
}

static sb_status parse(const char *path, const char *text, sb_pvd *pvd, sb_error *error)
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
        if (!end) return sb_fail(error, SB_BAD_INPUT, "%.500s: damaged entry %zu", path, pvd->count + 1);
        sb_status status = append(pvd, time, file, (size_t)(end - file), error);
        if (status != SB_OK) return status;
        at = end;
    }
    return SB_OK;
}

sb_status sb_pvd_read(const char *path, sb_pvd *pvd, sb_error *error)
{
    char *text;
    size_t length;
    sb_status status = sb_file_read(path, (size_t)1 << 28, &text, &length, error);
    if (status != SB_OK) return status;
    status = parse(path, text, pvd, error);
    sb_free(text);
    if (status != SB_OK) sb_pvd_free(pvd);
    return status;
}
