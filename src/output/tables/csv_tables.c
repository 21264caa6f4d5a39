/* The tables of a run: what is in each line. To add a table, add a row below, and one to SB_CSV_TABLES. */
#include "output/tables/csv_tables.h"

#include "scene/record_columns.h"

#include <math.h>
#include <string.h>

/* ---- cells ---- */

void sb_csv_put_name(FILE *stream, const char *name)
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
static void begin(FILE *stream, double time, const char *name)
{
    fprintf(stream, "%.12g", time);
    if (name) {
        fputc(',', stream);
        sb_csv_put_name(stream, name);
    }
}

void sb_csv_put_number(FILE *stream, double value)
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
    sb_csv_put_number(stream, value.x);
    sb_csv_put_number(stream, value.y);
    sb_csv_put_number(stream, value.z);
}

/* ---- tables ---- */

static size_t count_forces(const sb_measure_records *records)
{
    return records->force_count;
}

static void write_forces(FILE *stream, const sb_scene *scene, const sb_model *model, const sb_measure_records *records,
                         size_t i)
{
    (void)scene;
    const sb_force_record *row = &records->forces[i];
    begin(stream, row->time, model->bodies[row->body].name);
    put_vector(stream, row->force);
    put_vector(stream, row->moment);
    put_vector(stream, row->pressure);
    put_vector(stream, row->friction);
}

static size_t count_gauges(const sb_measure_records *records)
{
    return records->gauge_count;
}

static void write_gauges(FILE *stream, const sb_scene *scene, const sb_model *model, const sb_measure_records *records,
                         size_t i)
{
    (void)model;
    const sb_gauge_record *row = &records->gauges[i];
    begin(stream, row->time, scene->measure.gauges[row->gauge].name);
    sb_csv_put_number(stream, row->eta);
    sb_csv_put_number(stream, row->z);
}

static size_t count_probes(const sb_measure_records *records)
{
    return records->probe_count;
}

static void write_probes(FILE *stream, const sb_scene *scene, const sb_model *model, const sb_measure_records *records,
                         size_t i)
{
    (void)model;
    const sb_probe_record *row = &records->probes[i];
    begin(stream, row->time, scene->measure.probes[row->probe].name);
    put_vector(stream, row->velocity);
    sb_csv_put_number(stream, row->pressure);
}

static size_t count_energies(const sb_measure_records *records)
{
    return records->energy_count;
}

static void write_energies(FILE *stream, const sb_scene *scene, const sb_model *model,
                           const sb_measure_records *records, size_t i)
{
    (void)scene;
    (void)model;
    const sb_energy_record *row = &records->energies[i];
    const sb_ledger *ledger = &row->ledger;
    const double changes[] = {ledger->bodies,  ledger->viscosity,   ledger->friction, ledger->pressure,
                              ledger->contact, ledger->integration, ledger->left,     row->momentum_imbalance,
                              ledger->stress,  ledger->sea,         ledger->sponge,   ledger->tension};
    begin(stream, row->time, NULL);
    sb_csv_put_number(stream, row->kinetic);
    put_fine(stream, row->potential);
    sb_csv_put_number(stream, row->mass);
    put_vector(stream, row->momentum);
    for (size_t c = 0; c < sizeof changes / sizeof *changes; c++) sb_csv_put_number(stream, changes[c]);
}

static bool has_planes(const sb_scene *scene)
{
    return scene->measure.plane_count > 0;
}

static size_t count_flows(const sb_measure_records *records)
{
    return records->flow_count;
}

static void write_flows(FILE *stream, const sb_scene *scene, const sb_model *model, const sb_measure_records *records,
                        size_t i)
{
    (void)model;
    const sb_flow_record *row = &records->flows[i];
    begin(stream, row->time, scene->measure.planes[row->plane].name);
    sb_csv_put_number(stream, row->volume);
    sb_csv_put_number(stream, row->flux);
}

static bool has_lines(const sb_scene *scene)
{
    return scene->measure.runup_count > 0;
}

static size_t count_runups(const sb_measure_records *records)
{
    return records->runup_count;
}

static void write_runups(FILE *stream, const sb_scene *scene, const sb_model *model, const sb_measure_records *records,
                         size_t i)
{
    (void)model;
    const sb_runup_record *row = &records->runups[i];
    begin(stream, row->time, scene->measure.runups[row->line].name);
    put_vector(stream, row->place);
    sb_csv_put_number(stream, row->front);
    sb_csv_put_number(stream, row->apart);
}

static bool has_reflections(const sb_scene *scene)
{
    return scene->measure.reflection_count > 0;
}

static size_t count_reflections(const sb_measure_records *records)
{
    return records->reflection_count;
}

static void write_reflections(FILE *stream, const sb_scene *scene, const sb_model *model,
                              const sb_measure_records *records, size_t i)
{
    (void)model;
    const sb_reflection_record *row = &records->reflections[i];
    begin(stream, row->time, scene->measure.reflections[row->set].name);
    const double values[] = {
        row->from,           (double)row->harmonic,          row->period, row->wavelength, row->incident,
        row->reflected,      row->reflected / row->incident, row->misfit, row->separation, row->bound_incident,
        row->bound_reflected};
    for (size_t c = 0; c < sizeof values / sizeof *values; c++) sb_csv_put_number(stream, values[c]);
}

static bool has_record(const sb_scene *scene)
{
    bool any = false;
    for (size_t i = 0; i < scene->measure.plane_count; i++) any = any || scene->measure.planes[i].record;
    return any;
}

static size_t count_waters(const sb_measure_records *records)
{
    return records->water_count;
}

static void write_waters(FILE *stream, const sb_scene *scene, const sb_model *model, const sb_measure_records *records,
                         size_t i)
{
    (void)model;
    const sb_water_record *row = &records->waters[i];
    begin(stream, row->time, scene->measure.planes[row->plane].name);
    sb_csv_put_number(stream, row->x);
    sb_csv_put_number(stream, row->y);
    sb_csv_put_number(stream, row->surface);
    sb_csv_put_number(stream, row->bed);
    for (int j = 0; j < SB_RECORD_LAYERS; j++) sb_csv_put_number(stream, row->velocity[j].x);
    for (int j = 0; j < SB_RECORD_LAYERS; j++) sb_csv_put_number(stream, row->velocity[j].y);
    for (int j = 0; j < SB_RECORD_LAYERS; j++) sb_csv_put_number(stream, row->velocity[j].z);
}

static bool has_absorbers(const sb_scene *scene)
{
    bool any = false;
    for (size_t i = 0; i < scene->wavemaker_count; i++) any = any || scene->wavemakers[i].law.absorb;
    return any;
}

static size_t count_absorbers(const sb_measure_records *records)
{
    return records->absorber_count;
}

static void write_absorbers(FILE *stream, const sb_scene *scene, const sb_model *model,
                            const sb_measure_records *records, size_t i)
{
    (void)scene;
    const sb_absorber_record *row = &records->absorbers[i];
    begin(stream, row->time, model->bodies[row->body].name);
    sb_csv_put_number(stream, row->offset);
    sb_csv_put_number(stream, row->drift);
    sb_csv_put_number(stream, row->law);
}

const sb_csv_table sb_csv_tables[] = {
    {.name = "forces",
     .header = "time_s,body,Fx_N,Fy_N,Fz_N,Mx_Nm,My_Nm,Mz_Nm,Fx_pressure_N,Fy_pressure_N,"
               "Fz_pressure_N,Fx_friction_N,Fy_friction_N,Fz_friction_N",
     .flat_header = "time_s,body,Fx_N_per_m,Fy_N_per_m,Fz_N_per_m,Mx_Nm_per_m,My_Nm_per_m,"
                    "Mz_Nm_per_m,Fx_pressure_N_per_m,Fy_pressure_N_per_m,Fz_pressure_N_per_m,"
                    "Fx_friction_N_per_m,Fy_friction_N_per_m,Fz_friction_N_per_m",
     .wanted = NULL,
     .count = count_forces,
     .write = write_forces},
    {.name = "gauges",
     .header = "time_s,gauge,eta_m,z_m",
     .flat_header = "time_s,gauge,eta_m,z_m",
     .wanted = NULL,
     .count = count_gauges,
     .write = write_gauges},
    {.name = "probes",
     .header = "time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa",
     .flat_header = "time_s,probe,u_m_s,v_m_s,w_m_s,p_Pa",
     .wanted = NULL,
     .count = count_probes,
     .write = write_probes},
    {.name = "energy",
     .header = "time_s,kinetic_J,potential_J,mass_kg,momentum_x_kg_m_s,momentum_y_kg_m_s,"
               "momentum_z_kg_m_s,bodies_J,viscosity_J,wall_friction_J,pressure_solve_J,contact_J,"
               "time_integration_J,left_domain_J,momentum_imbalance,packing_stress_J,sea_J,sponge_J,"
               "surface_tension_J",
     .flat_header = "time_s,kinetic_J_per_m,potential_J_per_m,mass_kg_per_m,momentum_x_kg_m_s_per_m,"
                    "momentum_y_kg_m_s_per_m,momentum_z_kg_m_s_per_m,bodies_J_per_m,viscosity_J_per_m,"
                    "wall_friction_J_per_m,pressure_solve_J_per_m,contact_J_per_m,"
                    "time_integration_J_per_m,left_domain_J_per_m,momentum_imbalance,packing_stress_J_per_m,sea_J_per_"
                    "m,sponge_J_per_m,surface_tension_J_per_m",
     .wanted = NULL,
     .count = count_energies,
     .write = write_energies},
    {.name = "overtopping",
     .header = "time_s,plane,volume_m3,flux_m3_s",
     .flat_header = "time_s,plane,volume_m3_per_m,flux_m3_s_per_m",
     .wanted = has_planes,
     .count = count_flows,
     .write = write_flows},
    {.name = "runup",
     .header = "time_s,line,x_m,y_m,z_m,front_m,apart_m",
     .flat_header = "time_s,line,x_m,y_m,z_m,front_m,apart_m",
     .wanted = has_lines,
     .count = count_runups,
     .write = write_runups},
    {.name = "reflections",
     .header =
         "time_s,set,from_s,harmonic,period_s,wavelength_m,incident_m,reflected_m,coefficient,misfit_m,separation,"
         "bound_incident_m,bound_reflected_m",
     .flat_header =
         "time_s,set,from_s,harmonic,period_s,wavelength_m,incident_m,reflected_m,coefficient,misfit_m,separation,"
         "bound_incident_m,bound_reflected_m",
     .wanted = has_reflections,
     .count = count_reflections,
     .write = write_reflections},
    {.name = "record",
     .header = SB_RECORD_HEADER,
     .flat_header = SB_RECORD_HEADER,
     .wanted = has_record,
     .count = count_waters,
     .write = write_waters},
    {.name = "absorbers",
     .header = "time_s,body,offset_m,drift_m,law_m",
     .flat_header = "time_s,body,offset_m,drift_m,law_m",
     .wanted = has_absorbers,
     .count = count_absorbers,
     .write = write_absorbers},
};
_Static_assert(sizeof sb_csv_tables == SB_CSV_TABLES * sizeof *sb_csv_tables, "one mark per table");

const char *sb_csv_name(size_t table)
{
    return table < SB_CSV_TABLES ? sb_csv_tables[table].name : NULL;
}
