#include "run.h"

#include "base/memory.h"
#include "summary_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void empty(sb_sheet_slot *slot)
{
    sb_free(slot->path);
    sb_sheet_free(&slot->sheet);
    slot->path = NULL;
}

/* Reads the table into the slot unless it is there. */
static sb_status fill(sb_sheet_slot *slot, const char *path, sb_error *error)
{
    if (slot->path && strcmp(slot->path, path) == 0) return SB_OK;
    empty(slot);
    sb_status status = sb_sheet_read(path, &slot->sheet, error);
    if (status != SB_OK) return status;
    slot->path = sb_strdup(path);
    return slot->path ? SB_OK : sb_fail_memory(error, path);
}

/* Reads a table of a folder into the slot, unless something failed before. */
static const sb_sheet *open_sheet(const sb_case_run *run, sb_sheet_slot *slot, const char *folder, const char *table)
{
    static const sb_sheet none;
    char path[SB_PATH_MAX];
    if (run->error->status != SB_OK || sb_path_join(path, folder, table, run->error) != SB_OK ||
        fill(slot, path, run->error) != SB_OK)
        return &none;
    return &slot->sheet;
}

static sb_curve *curve_of(const sb_case_run *run, sb_sheet_slot *slot, const char *folder, const char *table,
                          const char *where, const char *x, const char *y)
{
    sb_error why = {0};
    sb_curve *curve = sb_curve_new(run->made);
    const sb_sheet *sheet = open_sheet(run, slot, folder, table);
    if (run->error->status == SB_OK && sb_sheet_curve(sheet, where, x, y, curve, &why) != SB_OK)
        sb_fail(run->error, why.status, "%.400s: %.400s", slot->path, why.text);
    return curve;
}

const sb_sheet *sb_run_sheet(const sb_case_run *run, const char *table)
{
    return open_sheet(run, run->slot, run->folder, table);
}

sb_curve *sb_run_curve(const sb_case_run *run, const char *table, const char *where, const char *x, const char *y)
{
    return curve_of(run, run->slot, run->folder, table, where, x, y);
}

sb_curve *sb_reference_curve(const sb_case_run *run, const char *table, const char *where, const char *x, const char *y)
{
    sb_sheet_slot own = {0};
    sb_curve *curve = curve_of(run, &own, run->assets, table, where, x, y);
    empty(&own);
    return curve;
}

sb_status sb_run_close(const sb_case_run *run, sb_error *error)
{
    const sb_error first = *run->error;
    *run->error = (sb_error){0};
    if (!sb_curves_free(run->made)) return sb_fail_memory(error, "a curve");
    return first.status == SB_OK ? SB_OK : sb_fail(error, first.status, "%s", first.text);
}

void sb_plot_run(sb_plot *plot, const sb_case_run *run, const sb_curve *curve)
{
    sb_plot_style style = SB_PLOT_LINE;
    if (strcmp(run->preset, "default") != 0)
        style = SB_PLOT_ASIDE;
    else if (run->seed != 1)
        style = SB_PLOT_SEED;
    else if (run->judged)
        style = SB_PLOT_JUDGED;
    sb_plot_curve(plot, style, run->label, curve);
}

void sb_plot_points(sb_plot *plot, const char *label, size_t count, double *x, double *y)
{
    sb_plot_curve(plot, SB_PLOT_REFERENCE, label, &(sb_curve){.count = count, .x = x, .y = y});
}

sb_status sb_finished_read(sb_finished *run, const char *folder, sb_error *error)
{
    char path[SB_PATH_MAX], *text = NULL;
    *run = (sb_finished){0};
    snprintf(run->folder, sizeof run->folder, "%s", folder);
    sb_status status = sb_path_join(path, folder, "scene.yaml", error);
    if (status == SB_OK) status = sb_scene_read(path, NULL, NULL, 0, &run->scene, error);
    if (status == SB_OK) status = sb_summary_read(folder, &text, error);
    if (status != SB_OK) {
        sb_finished_free(run);
        return status;
    }
    const bool grid = sb_scene_grid_alone(&run->scene);
    run->view = (sb_case_run){.folder = run->folder,
                              .scene = &run->scene,
                              .resolution = grid ? run->scene.offshore.cell : run->scene.resolution,
                              .wall = sb_json_number_in(text, "wall_s"),
                              .cpu = sb_json_number_in(text, "processor_seconds"),
                              .iterations = sb_json_number_in(text, "mean_iterations"),
                              .particles = grid ? 0 : (size_t)sb_json_number_in(text, "fluid_particles"),
                              .steps = (size_t)sb_json_number_in(text, "steps"),
                              .label = run->label,
                              .slot = &run->slot,
                              .made = &run->made,
                              .error = &run->error};
    run->cpu = run->view.cpu;
    run->threads = (int)sb_json_number_in(text, "threads");
    sb_free(text);
    return SB_OK;
}

void sb_finished_free(sb_finished *run)
{
    empty(&run->slot);
    sb_curves_free(&run->made);
    sb_scene_free(&run->scene);
}
