#include "output/tables/csv.h"

#include "base/file.h"
#include "base/input.h"
#include "base/memory.h"
#include "output/tables/hashed_file.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct table {
    sb_hashed_file file;
    char path[SB_PATH_MAX];
} table;

struct sb_csv {
    const sb_scene *scene;
    const sb_model *model;
    table tables[SB_CSV_TABLES];
};

/* The message of the first file that failed, or SB_OK. A removed file is an error too: its rows would be lost. */
static sb_status check(const sb_csv *csv, sb_error *error)
{
    for (int k = 0; k < SB_CSV_TABLES; k++) {
        const table *t = &csv->tables[k];
        struct stat found;
        if (!t->file.stream) continue;
        if (ferror(t->file.stream))
            return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", t->path, strerror(errno ? errno : EIO));
        if (fstat(fileno(t->file.file), &found) == 0 && found.st_nlink == 0)
            return sb_fail(error, SB_FAILED, "%.500s: was removed while the run wrote it", t->path);
    }
    return SB_OK;
}

static sb_status cannot_write(const table *t, sb_error *error)
{
    return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", t->path, strerror(errno ? errno : EIO));
}

static sb_status start_table(table *t, const char *header, sb_error *error)
{
    sb_status status = sb_hashed_open(&t->file, t->path, error);
    if (status != SB_OK) return status;
    errno = 0;
    if (fprintf(t->file.stream, "%s\n", header) < 0 || fflush(t->file.stream) != 0) return cannot_write(t, error);
    return SB_OK;
}

static const char *header_of(const sb_scene *scene, int k)
{
    return scene->dimensions == 2 ? sb_csv_tables[k].flat_header : sb_csv_tables[k].header;
}

/* Rows of this version must not follow the column names of another version. */
static sb_status check_header(const char *path, const char *expected, sb_error *error)
{
    char found[1024] = "";
    FILE *file;
    sb_status status = sb_input_open(path, &file, error);
    if (status != SB_OK) return status;
    if (!fgets(found, sizeof found, file)) found[0] = '\0';
    fclose(file);
    found[strcspn(found, "\r\n")] = '\0';
    if (strcmp(found, expected) == 0) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.300s:1: has the columns `%.200s` of another version, expected `%.200s`: "
                   "start a new run in another folder, or resume this one with the version that started it",
                   path, found, expected);
}

static sb_status path_of(const char *directory, int k, char path[SB_PATH_MAX], sb_error *error)
{
    char name[32];
    snprintf(name, sizeof name, "%s.csv", sb_csv_tables[k].name);
    return sb_path_join(path, directory, name, error);
}

static bool has_table(const sb_scene *scene, int k)
{
    return !sb_csv_tables[k].wanted || sb_csv_tables[k].wanted(scene);
}

/* marks NULL: creates new tables. */
static sb_status open_tables(const char *directory, const sb_scene *scene, const sb_model *model,
                             const sb_csv_marks *marks, sb_csv **csv, sb_error *error)
{
    sb_csv *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "CSV files");
    made->scene = scene;
    made->model = model;
    sb_status status = SB_OK;
    for (int k = 0; status == SB_OK && k < SB_CSV_TABLES; k++) {
        table *t = &made->tables[k];
        if (!has_table(scene, k)) continue;
        status = path_of(directory, k, t->path, error);
        if (status == SB_OK)
            status = marks ? sb_hashed_resume(&t->file, t->path, marks->bytes[k], error)
                           : start_table(t, header_of(scene, k), error);
    }
    if (status != SB_OK) {
        sb_csv_close(made, NULL);
        return status;
    }
    *csv = made;
    return SB_OK;
}

sb_status sb_csv_open(const char *directory, const sb_scene *scene, const sb_model *model, sb_csv **csv,
                      sb_error *error)
{
    return open_tables(directory, scene, model, NULL, csv, error);
}

sb_status sb_csv_resume(const char *directory, const sb_scene *scene, const sb_model *model, const sb_csv_marks *marks,
                        sb_csv **csv, sb_error *error)
{
    return open_tables(directory, scene, model, marks, csv, error);
}

sb_status sb_csv_check(const char *directory, const sb_scene *scene, const sb_csv_marks *marks, sb_error *error)
{
    sb_status status = SB_OK;
    for (int k = 0; status == SB_OK && k < SB_CSV_TABLES; k++) {
        char path[SB_PATH_MAX];
        if (!has_table(scene, k)) continue;
        status = path_of(directory, k, path, error);
        if (status == SB_OK) status = sb_hashed_check(path, marks->bytes[k], marks->hash[k], error);
        if (status == SB_OK) status = check_header(path, header_of(scene, k), error);
    }
    return status;
}

sb_status sb_csv_sync(sb_csv *csv, sb_csv_marks *marks, sb_error *error)
{
    *marks = (sb_csv_marks){{0}, {0}};
    for (int k = 0; k < SB_CSV_TABLES; k++) {
        const table *t = &csv->tables[k];
        errno = 0;
        if (!t->file.stream) continue;
        if (fflush(t->file.stream) != 0 || fsync(fileno(t->file.file)) != 0) return cannot_write(t, error);
        marks->bytes[k] = t->file.length;
        marks->hash[k] = sb_hash_sum(&t->file.hash);
    }
    return SB_OK;
}

sb_status sb_csv_write(sb_csv *csv, const sb_measure_records *records, sb_error *error)
{
    bool some = false;
    errno = 0;
    for (int k = 0; k < SB_CSV_TABLES; k++) {
        const size_t rows = sb_csv_tables[k].count(records);
        FILE *stream = csv->tables[k].file.stream;
        some |= rows > 0;
        for (size_t i = 0; stream && i < rows; i++) {
            sb_csv_tables[k].write(stream, csv->scene, csv->model, records, i);
            fputc('\n', stream);
        }
    }
    if (!some) return SB_OK;
    for (int k = 0; k < SB_CSV_TABLES; k++)
        if (csv->tables[k].file.stream) fflush(csv->tables[k].file.stream);
    return check(csv, error);
}

sb_status sb_csv_close(sb_csv *csv, sb_error *error)
{
    if (!csv) return SB_OK;
    sb_status status = check(csv, error);
    for (int k = 0; k < SB_CSV_TABLES; k++) {
        table *t = &csv->tables[k];
        if (sb_hashed_close(&t->file) != 0 && status == SB_OK)
            status = sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", t->path, strerror(errno));
    }
    sb_free(csv);
    return status;
}
