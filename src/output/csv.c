#include "output/csv.h"

#include "base/file.h"
#include "base/input.h"
#include "base/memory.h"
#include "output/hashed_file.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { FORCES, GAUGES, PROBES, ENERGY, OVERTOPPING, RUNUP, TABLES };
_Static_assert((int)TABLES == (int)SB_CSV_TABLES, "one mark per table");

typedef struct table {
    sb_hashed_file file;
    char path[SB_PATH_MAX];
} table;

struct sb_csv {
    const sb_scene *scene;
    const sb_model *model;
    table tables[TABLES];
};

const char *const sb_csv_names[SB_CSV_TABLES + 1] = {
    [FORCES] = "forces", [GAUGES] = "gauges",           [PROBES] = "probes",
    [ENERGY] = "energy", [OVERTOPPING] = "overtopping", [RUNUP] = "runup",
};

/* Header lines in 3D and in 2D. */
static const struct {
    const char *header, *flat_header;
} formats[TABLES] = {
    [FORCES] = {"time_s,body,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm,Fx_pressure_N,Fy_pressure_N,"
                "Fz_pressure_N,Fx_friction_N,Fy_friction_N,Fz_friction_N",
                "time_s,body,Fx_N_per_m,Fy_N_per_m,Fz_N_per_m,Mx_Nm_per_m,My_Nm_per_m,"
                "Mz_Nm_per_m,Fx_pressure_N_per_m,Fy_pressure_N_per_m,Fz_pressure_N_per_m,"
                "Fx_friction_N_per_m,Fy_friction_N_per_m,Fz_friction_N_per_m"},
    [GAUGES] = {"time_s,gauge,eta_m,z_m", "time_s,gauge,eta_m,z_m"},
    [PROBES] = {"time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa", "time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa"},
    [ENERGY] = {"time_s,kinetic_J,potential_J,mass_kg,momentum_x_kg_m_s,momentum_y_kg_m_s,"
                "momentum_z_kg_m_s,bodies_J,viscosity_J,wall_friction_J,pressure_solve_J,contact_J,"
                "time_integration_J,left_domain_J,momentum_imbalance,packing_stress_J",
                "time_s,kinetic_J_per_m,potential_J_per_m,mass_kg_per_m,momentum_x_kg_m_s_per_m,"
                "momentum_y_kg_m_s_per_m,momentum_z_kg_m_s_per_m,bodies_J_per_m,viscosity_J_per_m,"
                "wall_friction_J_per_m,pressure_solve_J_per_m,contact_J_per_m,"
                "time_integration_J_per_m,left_domain_J_per_m,momentum_imbalance,packing_stress_J_per_m"},
    [OVERTOPPING] = {"time_s,plane,volume_m3,flux_m3_s", "time_s,plane,volume_m3_per_m,flux_m3_s_per_m"},
    [RUNUP] = {"time_s,line,x_m,y_m,z_m,front_m,apart_m", "time_s,line,x_m,y_m,z_m,front_m,apart_m"},
};

/* The message of the first file that failed, or SB_OK. A removed file is an error too: its rows would be lost. */
static sb_status check(const sb_csv *csv, sb_error *error)
{
    for (int k = 0; k < TABLES; k++) {
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
    return scene->dimensions == 2 ? formats[k].flat_header : formats[k].header;
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
    snprintf(name, sizeof name, "%s.csv", sb_csv_names[k]);
    return sb_path_join(path, directory, name, error);
}

static bool has_table(const sb_scene *scene, int k)
{
    return k == OVERTOPPING ? scene->measure.plane_count > 0 : k == RUNUP ? scene->measure.runup_count > 0 : true;
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
    for (int k = 0; status == SB_OK && k < TABLES; k++) {
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
    for (int k = 0; status == SB_OK && k < TABLES; k++) {
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
    for (int k = 0; k < TABLES; k++) {
        const table *t = &csv->tables[k];
        errno = 0;
        if (!t->file.stream) continue;
        if (fflush(t->file.stream) != 0 || fsync(fileno(t->file.file)) != 0) return cannot_write(t, error);
        marks->bytes[k] = t->file.length;
        marks->hash[k] = sb_hash_sum(&t->file.hash);
    }
    return SB_OK;
}

/* Quoted only where RFC 4180 requires it. */
static void put_name(FILE *stream, const char *name)
{
    if (!strpbrk(name, ",\"\r\n")) {
        fputs(name, stream);
        return;
    }
    fputc('"', stream);
    for (; *name; name++) {
        if (*name == '"') fputc('"', stream);
        fputc(*name, stream);
    }
    fputc('"', stream);
}

/* Time has three more digits than other values: it resolves steps of 0.1 ms over a day. */
static void begin_row(FILE *stream, double time, const char *name)
{
    fprintf(stream, "%.12g", time);
    if (name) {
        fputc(',', stream);
        put_name(stream, name);
    }
}

static void put(FILE *stream, double value)
{
    if (isnan(value))
        fputc(',', stream);
    else
        fprintf(stream, ",%.9g", value + 0.0); /* + 0.0: no "-0" */
}

/* Potential energy needs more digits, because it is much larger than its changes. */
static void put_fine(FILE *stream, double value)
{
    fprintf(stream, ",%.12g", value);
}

static void put_vector(FILE *stream, sb_vec3 value)
{
    put(stream, value.x);
    put(stream, value.y);
    put(stream, value.z);
}

static void write_forces(const sb_csv *csv, const sb_measure_records *records)
{
    FILE *stream = csv->tables[FORCES].file.stream;
    for (size_t i = 0; i < records->force_count; i++) {
        const sb_force_record *row = &records->forces[i];
        begin_row(stream, row->time, csv->model->bodies[row->body].name);
        put_vector(stream, row->force);
        put_vector(stream, row->moment);
        put_vector(stream, row->pressure);
        put_vector(stream, row->friction);
        fputc('\n', stream);
    }
}

static void write_instants(const sb_csv *csv, const sb_measure_records *records)
{
    const sb_measure_settings *settings = &csv->scene->measure;
    FILE *stream = csv->tables[GAUGES].file.stream;
    for (size_t i = 0; i < records->gauge_count; i++) {
        begin_row(stream, records->gauges[i].time, settings->gauges[records->gauges[i].gauge].name);
        put(stream, records->gauges[i].eta);
        put(stream, records->gauges[i].z);
        fputc('\n', stream);
    }
    stream = csv->tables[PROBES].file.stream;
    for (size_t i = 0; i < records->probe_count; i++) {
        begin_row(stream, records->probes[i].time, settings->probes[records->probes[i].probe].name);
        put_vector(stream, records->probes[i].velocity);
        put(stream, records->probes[i].pressure);
        fputc('\n', stream);
    }
    stream = csv->tables[RUNUP].file.stream;
    for (size_t i = 0; stream && i < records->runup_count; i++) {
        begin_row(stream, records->runups[i].time, settings->runups[records->runups[i].line].name);
        put_vector(stream, records->runups[i].place);
        put(stream, records->runups[i].front);
        put(stream, records->runups[i].apart);
        fputc('\n', stream);
    }
}

static void write_energies(const sb_csv *csv, const sb_measure_records *records)
{
    FILE *stream = csv->tables[ENERGY].file.stream;
    for (size_t i = 0; i < records->energy_count; i++) {
        const sb_energy_record *row = &records->energies[i];
        const sb_ledger *ledger = &row->ledger;
        const double changes[] = {ledger->bodies,   ledger->viscosity,       ledger->friction,
                                  ledger->pressure, ledger->contact,         ledger->integration,
                                  ledger->left,     row->momentum_imbalance, ledger->stress};
        begin_row(stream, row->time, NULL);
        put(stream, row->kinetic);
        put_fine(stream, row->potential);
        put(stream, row->mass);
        put_vector(stream, row->momentum);
        for (size_t c = 0; c < sizeof changes / sizeof *changes; c++) put(stream, changes[c]);
        fputc('\n', stream);
    }
}

static void write_totals(const sb_csv *csv, const sb_measure_records *records)
{
    FILE *stream = csv->tables[OVERTOPPING].file.stream;
    for (size_t i = 0; stream && i < records->flow_count; i++) {
        const sb_flow_record *row = &records->flows[i];
        begin_row(stream, row->time, csv->scene->measure.planes[row->plane].name);
        put(stream, row->volume);
        put(stream, row->flux);
        fputc('\n', stream);
    }
}

sb_status sb_csv_write(sb_csv *csv, const sb_measure_records *records, sb_error *error)
{
    size_t rows = records->force_count + records->gauge_count + records->probe_count + records->flow_count +
                  records->runup_count + records->energy_count;
    if (rows == 0) return SB_OK;
    errno = 0;
    write_forces(csv, records);
    write_instants(csv, records);
    write_totals(csv, records);
    write_energies(csv, records);
    for (int k = 0; k < TABLES; k++)
        if (csv->tables[k].file.stream) fflush(csv->tables[k].file.stream);
    return check(csv, error);
}

sb_status sb_csv_close(sb_csv *csv, sb_error *error)
{
    if (!csv) return SB_OK;
    sb_status status = check(csv, error);
    for (int k = 0; k < TABLES; k++) {
        table *t = &csv->tables[k];
        if (sb_hashed_close(&t->file) != 0 && status == SB_OK)
            status = sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", t->path, strerror(errno));
    }
    sb_free(csv);
    return status;
}
