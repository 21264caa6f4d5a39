#include "app/grid/report.h"

#include "app/check/terrain.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"
#include "output/log/json.h"

#include <math.h>
#include <omp.h>

/* Seconds of one core per cell and step, for estimates: without and with dispersion; measured on a core at 2.6 GHz. */
static const double SECONDS_PER_CELL[] = {60e-9, 170e-9};

sb_grid_cost sb_grid_find_cost(const sb_scene *scene, sb_offshore *water, double time)
{
    const sb_offshore_view v = sb_offshore_read(water);
    sb_grid_cost cost = {.cells = (double)(v.columns * v.rows),
                         .time_step = sb_offshore_time_step(water),
                         .bytes = (double)sb_offshore_held(water)};
    cost.steps = ceil(time / cost.time_step);
    cost.seconds = cost.steps * cost.cells * SECONDS_PER_CELL[scene->offshore.dispersion] / omp_get_max_threads();
    return cost;
}

double sb_grid_imbalance(const sb_offshore_balance *b)
{
    double expected = b->first + b->added + b->repaired;
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) expected += b->entered[s];
    return b->now - expected;
}

static uint64_t hash_of(const sb_offshore *water)
{
    const sb_offshore_view v = sb_offshore_read(water);
    const double *const fields[] = {v.h, v.hu, v.hv};
    uint64_t hash = 0;
    for (size_t f = 0; f < 3; f++)
        for (size_t j = 0; j < v.rows; j++) hash = sb_hash(hash, fields[f] + j * v.stride, v.columns * sizeof(double));
    return hash;
}

sb_grid_volume sb_grid_volume_of(const sb_offshore *water)
{
    const sb_offshore_balance b = sb_offshore_find_balance(water);
    sb_grid_volume volume = {
        .first = b.first, .now = b.now, .added = b.added, .repaired = b.repaired, .imbalance = sb_grid_imbalance(&b)};
    for (int s = 0; s < SB_OFFSHORE_SIDES; s++) volume.entered[s] = b.entered[s];
    return volume;
}

static void put_all(sb_json *json, const sb_grid_summary *s)
{
    const sb_offshore_effort effort = sb_offshore_find_effort(s->water);
    const double cells = (double)(s->facts->columns * s->facts->rows), steps = (double)effort.steps;
    sb_json_open(json, NULL, '{');
    sb_json_text(json, "version", SB_VERSION);
    sb_json_text(json, "model", s->scene->offshore.dispersion ? "serre-green-naghdi" : "shallow-water");
    sb_json_text(json, "title", s->scene->title);
    sb_json_text(json, "status", s->status == SB_OK ? "done" : s->status == SB_INTERRUPTED ? "interrupted" : "failed");
    if (s->reason) sb_json_text(json, "reason", s->reason);
    sb_json_number(json, "wall_s", s->wall);
    sb_json_number(json, "processor_seconds", s->processor);
    sb_json_number(json, "wall_setup_s", s->setup);
    sb_json_number(json, "simulated_s", sb_offshore_read(s->water).time);
    sb_json_count(json, "steps", effort.steps);
    sb_json_count(json, "threads", (uint64_t)s->threads);
    sb_json_count(json, "dimensions", (uint64_t)s->scene->dimensions);
    sb_json_bool(json, "per_metre", s->scene->dimensions == 2);
    sb_json_number(json, "cell_m", s->scene->offshore.cell);
    sb_json_count(json, "columns", s->facts->columns);
    sb_json_count(json, "rows", s->facts->rows);
    sb_json_number(json, "ns_per_cell_and_step", steps > 0 ? 1e9 * s->stepping / cells / steps : 0);
    sb_json_number(json, "mean_iterations", steps > 0 ? (double)s->iterations / steps : 0);
    sb_json_count(json, "breaking_cells_most", s->breaking);
    sb_json_count(json, "peak_memory_bytes", sb_memory_peak());
    sb_json_count(json, "grid_files", s->frames);
    sb_json_hash(json, "state_hash", hash_of(s->water));
    const sb_grid_volume volume = sb_grid_volume_of(s->water);
    sb_grid_volume_put(json, &volume, false);
    sb_json_close(json);
}

sb_status sb_grid_summary_write(const char *path, const sb_grid_summary *summary, sb_error *error)
{
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    sb_json json;
    sb_json_begin(&json, out.stream, true);
    put_all(&json, summary);
    return sb_atomic_commit(&out, 1, error);
}

static void print_line(void *context, const char *text)
{
    (void)context;
    printf("warning: %s\n", text);
}

static void print_json(void *context, const char *text)
{
    sb_json_text(context, NULL, text);
}

static void report_text(const sb_scene *scene, const sb_grid_facts *f, const sb_grid_cost *cost,
                        const sb_offshore_told_list *told)
{
    const int threads = omp_get_max_threads();
    printf("%s\n", scene->title);
    printf("  cells              %zu x %zu of %g m, %zu wet\n", f->columns, f->rows, scene->offshore.cell, f->wet);
    printf("  equations          %s\n", scene->offshore.dispersion ? "Serre-Green-Naghdi" : "shallow water");
    printf("  greatest depth     %g m\n", f->deepest);
    printf("  memory             about %.*f MB\n", f->bytes < 1e7 ? 1 : 0, f->bytes / 1e6);
    printf("  steps              about %.0f of %.3g s\n", cost->steps, f->time_step);
    printf("  run time           about %.3g s on %d thread%s\n", cost->seconds, threads, threads == 1 ? "" : "s");
    sb_check_bed_text(scene, told);
    sb_grid_water_warnings(scene, f, told, print_line, NULL);
}

static void report_json(const sb_scene *scene, const sb_grid_facts *f, const sb_grid_cost *cost,
                        const sb_offshore_told_list *told)
{
    sb_json json;
    sb_json_begin(&json, stdout, true);
    sb_json_open(&json, NULL, '{');
    sb_json_text(&json, "scene", scene->path);
    sb_json_text(&json, "title", scene->title);
    sb_json_count(&json, "dimensions", (uint64_t)scene->dimensions);
    sb_json_number(&json, "cell_m", scene->offshore.cell);
    sb_json_count(&json, "columns", f->columns);
    sb_json_count(&json, "rows", f->rows);
    sb_json_count(&json, "wet_cells", f->wet);
    sb_json_number(&json, "greatest_depth_m", f->deepest);
    sb_json_number(&json, "memory_bytes", f->bytes);
    sb_json_number(&json, "steps", cost->steps);
    sb_json_number(&json, "time_step_s", f->time_step);
    sb_json_number(&json, "run_time_s", cost->seconds);
    sb_check_bed_json(told, &json);
    sb_json_open(&json, "warnings", '[');
    sb_grid_water_warnings(scene, f, told, print_json, &json);
    sb_json_close(&json);
    sb_json_close(&json);
    putchar('\n');
}

sb_status sb_grid_check(const sb_scene *scene, bool json, sb_error *error)
{
    sb_offshore *water = NULL;
    sb_grid_facts facts = {0};
    sb_offshore_told_list told = {0};
    const sb_status status = sb_grid_water_create(scene, &water, &facts, &told, error);
    if (status != SB_OK) return status;
    const sb_grid_cost cost = sb_grid_find_cost(scene, water, scene->duration);
    (json ? report_json : report_text)(scene, &facts, &cost, &told);
    sb_offshore_told_free(&told);
    sb_offshore_destroy(water);
    return SB_OK;
}
