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

static sb_status curve_of(sb_sheet_slot *slot, const char *folder, const char *table, const char *where, const char *x,
                          const char *y, sb_curve *curve, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_error why = {0};
    sb_status status = sb_path_join(path, folder, table, error);
    if (status == SB_OK) status = fill(slot, path, error);
    if (status != SB_OK) return status;
    status = sb_sheet_curve(&slot->sheet, where, x, y, curve, &why);
    if (status != SB_OK) sb_fail(error, status, "%.400s: %.400s", path, why.text);
    return status;
}

sb_status sb_run_curve(const sb_case_run *run, const char *table, const char *where, const char *x, const char *y,
                       sb_curve *curve, sb_error *error)
{
    return curve_of(run->slot, run->folder, table, where, x, y, curve, error);
}

sb_status sb_reference_curve(const sb_case_run *run, const char *table, const char *where, const char *x, const char *y,
                             sb_curve *curve, sb_error *error)
{
    sb_sheet_slot own = {0};
    sb_status status = curve_of(&own, run->assets, table, where, x, y, curve, error);
    empty(&own);
    return status;
}

sb_status sb_plot_run(sb_plot *plot, const sb_case_run *run, const sb_curve *curve, sb_error *error)
{
    sb_plot_style style = SB_PLOT_LINE;
    if (strcmp(run->preset, "paper") == 0)
        style = SB_PLOT_ASIDE;
    else if (run->seed != 1)
        style = SB_PLOT_SEED;
    else if (run->judged)
        style = SB_PLOT_JUDGED;
    return sb_plot_curve(plot, style, run->label, curve, error);
}

static sb_status summary_text(const char *folder, char **text, sb_error *error)
{
    char path[SB_PATH_MAX];
    size_t length;
    sb_status status = sb_path_join(path, folder, "summary.json", error);
    return status == SB_OK ? sb_file_read(path, (size_t)1 << 26, text, &length, error) : status;
}

double sb_run_number(const sb_case_run *run, const char *key)
{
    char *text = NULL;
    if (summary_text(run->folder, &text, NULL) != SB_OK) return (double)NAN;
    double value = sb_json_number_in(text, key);
    sb_free(text);
    return value;
}

sb_status sb_finished_read(sb_finished *run, const char *folder, sb_error *error)
{
    char path[SB_PATH_MAX], *text = NULL;
    *run = (sb_finished){0};
    snprintf(run->folder, sizeof run->folder, "%s", folder);
    sb_status status = sb_path_join(path, folder, "scene.yaml", error);
    if (status == SB_OK) status = sb_scene_read(path, NULL, NULL, 0, &run->scene, error);
    if (status == SB_OK) status = summary_text(folder, &text, error);
    if (status != SB_OK) {
        sb_finished_free(run);
        return status;
    }
    run->view = (sb_case_run){.folder = run->folder,
                              .scene = &run->scene,
                              .resolution = run->scene.resolution,
                              .wall = sb_json_number_in(text, "wall_s"),
                              .iterations = sb_json_number_in(text, "mean_iterations"),
                              .particles = (size_t)sb_json_number_in(text, "fluid_particles"),
                              .steps = (size_t)sb_json_number_in(text, "steps"),
                              .label = run->label,
                              .slot = &run->slot};
    run->cpu = sb_json_number_in(text, "processor_seconds");
    run->threads = (int)sb_json_number_in(text, "threads");
    sb_free(text);
    return SB_OK;
}

void sb_finished_free(sb_finished *run)
{
    empty(&run->slot);
    sb_scene_free(&run->scene);
}
