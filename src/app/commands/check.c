#include "app/check/fit.h"
#include "app/check/measures.h"
#include "app/check/pace.h"
#include "app/check/room.h"
#include "app/check/team.h"
#include "app/check/tension.h"
#include "app/check/terrain.h"
#include "app/check/warnings.h"
#include "app/check/waves.h"
#include "app/commands/commands.h"
#include "app/grid/report.h"
#include "app/grid/water.h"
#include "app/options.h"
#include "geometry/model/model.h"
#include "output/log/json.h"
#include "sea/sea.h"
#include "sim/sim.h"

#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

static const char help[] = "usage: shorebreak check SCENE [--json] [--preset NAME] [--set KEY=VALUE]... [--threads N]\n"
                           "Builds the particles of a scene without running it. Prints their number, estimates of "
                           "memory, steps, run time and\n"
                           "disk space, and warnings.\n";

/* Costs of pictures on one core at 2.6 GHz, for estimates only: per picture, and per fluid particle in a picture. With
   80 000 particles a picture took 0.08 s where most water was hidden (the bore on the column), 0.2 s at the plant. */
static const double SECONDS_PER_PICTURE = 0.03, SECONDS_PER_DRAWN = 1.3e-6;
/* Seconds of one core per step and fluid particle, in 2D and 3D, where they cannot be measured. */
static const double SECONDS_PER_STEP[] = {1e-6, 1.5e-6};
static const double PARTICLE_FILE_BYTES = 52, PICTURE_BYTES = 7e5, CHECKPOINT_BYTES = 40;

typedef struct estimate {
    double steps, time_step, seconds, memory, disk, ghosts;
    int settling, settling_most; /* steps */
    const sb_sea_source *sea;    /* NULL: no water is given */
    sb_grid_cost grid;           /* of the depth-averaged model that gives it */
} estimate;

/* Seconds per step and fluid particle with the present number of threads. */
static double measure_pace(const sb_scene *scene)
{
    double seconds;
    sb_error error = {0};
    if (sb_pace_measure(scene, &seconds, &error) == SB_OK) return seconds;
    return SECONDS_PER_STEP[scene->dimensions == 3] / omp_get_max_threads();
}

static estimate make_estimate(const sb_scene *scene, const sb_model *model)
{
    /* Falling or surging water has a speed of about 2 sqrt(gD). */
    double dt = sb_sim_longest_step(scene, model, 2 * sb_model_wave_speed(scene, model));
    double fluid = (double)model->fluid_count;
    double files = scene->output.particle_interval > 0 ? scene->duration / scene->output.particle_interval + 1 : 0;
    double pictures = scene->render.interval > 0
                          ? (scene->duration / scene->render.interval + 1) * (double)scene->render.camera_count
                          : 0;
    pictures += (double)(scene->render.still_count * scene->render.camera_count);
    const sb_checkpoint_settings *settings = &scene->output.checkpoint;
    double saved = settings->minutes > 0 || settings->steps > 0 ? settings->keep : 0;
    double steps = ceil(scene->duration / dt), ghosts = sb_room_ghosts(scene, model);
    int settling = sb_sim_settle_expected(scene);
    double drawing = pictures * (SECONDS_PER_PICTURE + SECONDS_PER_DRAWN * fluid) / omp_get_max_threads();
    return (estimate){
        .steps = steps,
        .time_step = dt,
        .seconds = (steps + settling) * fluid * measure_pace(scene) + drawing,
        .memory = sb_room_needed(scene, model),
        .ghosts = ghosts,
        .disk = (files * PARTICLE_FILE_BYTES + saved * CHECKPOINT_BYTES) * fluid + pictures * PICTURE_BYTES,
        .settling = settling,
        .settling_most = sb_sim_settle_most(scene),
    };
}

static void add_grid(const sb_scene *scene, sb_offshore *water, estimate *e)
{
    e->grid = sb_grid_find_cost(scene, water, scene->duration - scene->given.start);
    e->seconds += e->grid.seconds;
}

static void visit_warnings(const sb_scene *scene, const sb_model *model, sb_warning_visit *visit, void *context)
{
    for (size_t w = 0; w < model->warning_count; w++) visit(context, model->warnings[w]);
    sb_error reason = {0};
    if (sb_scene_warnings(scene, visit, context, &reason) != SB_OK) visit(context, reason.text);
    if (sb_scene_nested(scene)) sb_grid_wave_warnings(scene, visit, context);
    if (sb_model_warnings(scene, model, visit, context, &reason) != SB_OK) visit(context, reason.text);
    sb_team_warnings(visit, context);
    /* Only a warning, because the run may be meant for another machine. */
    sb_error room = {0};
    if (sb_room_check(scene, model, &room) != SB_OK) visit(context, room.text);
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

/* What the strip of a side of kind sea holds. */
static void report_sea(const sb_model *model, int side)
{
    const sb_model_sea *sea = &model->sea[side];
    double low = (double)INFINITY, high = -(double)INFINITY;
    if (sea->along == 0) return;
    for (size_t c = 0; c < sea->along * sea->across; c++) {
        low = fmin(low, sea->bed[c]);
        high = fmax(high, sea->bed[c]);
    }
    printf("  sea at %s       %zu column%s, a strip %g m wide is held to the given water, %g m are measured;\n",
           sb_side_names[side], sea->along, sea->along == 1 ? "" : "s", sea->strip, sea->width - sea->strip);
    if (low < high)
        printf("                     ground from %g to %g m\n", low, high);
    else
        printf("                     ground at %g m\n", low);
}

/* Whether the nested grid has terrain beside that of the bodies. */
static bool own_bed(const sb_scene *scene)
{
    return sb_scene_nested(scene) && scene->offshore.terrain_count > 0;
}

static void report_text(const sb_scene *scene, const sb_model *model, const estimate *e)
{
    const int threads = omp_get_max_threads();
    printf("%s\n", scene->title);
    printf("  spacing            %g m in %dD\n", scene->resolution, scene->dimensions);
    printf("  fluid particles    %zu\n", model->fluid_count);
    printf("  boundary particles %zu on %zu bodies\n", model->wall_count, model->body_count);
    if (e->ghosts > 0) printf("  ghost particles    about %.0f beyond periodic sides\n", e->ghosts);
    printf("  still depth        %g m (%.1f particles)\n", model->still_depth, model->still_depth / scene->resolution);
    if (e->sea) printf("  given water        %s\n", sb_sea_about(e->sea));
    for (int side = 0; side < 4; side++) report_sea(model, side);
    sb_check_waves_text(scene, model);
    sb_check_rates_text(scene);
    sb_check_tension_text(scene, model);
    if (e->grid.cells > 0)
        printf("  grid               %.0f cells, %.0f MB, about %.0f steps of %.3g s, %.1f %% of the run time\n",
               e->grid.cells, e->grid.bytes / 1e6, e->grid.steps, e->grid.time_step,
               100 * e->grid.seconds / e->seconds);
    printf("  memory             about %.0f MB\n", e->memory / 1e6);
    printf("  steps              about %.0f of %.3g s\n", e->steps, e->time_step);
    if (e->settling > 0)
        printf("  settling           about %d steps before t = 0, at most %d\n", e->settling, e->settling_most);
    printf("  run time           about %.0f s on %d thread%s%s\n", e->seconds, threads, threads == 1 ? "" : "s",
           e->settling > 0 ? ", including settling" : "");
    printf("  disk               about %.0f MB\n", e->disk / 1e6);
    sb_check_terrain_text(model);
    if (own_bed(scene)) sb_check_bed_text(scene, &model->grid.told);
    visit_warnings(scene, model, print_line, NULL);
}

static void report_json(const sb_scene *scene, const sb_model *model, const estimate *e)
{
    sb_json json;
    sb_json_begin(&json, stdout, true);
    sb_json_open(&json, NULL, '{');
    sb_json_text(&json, "scene", scene->path);
    sb_json_text(&json, "title", scene->title);
    sb_json_count(&json, "dimensions", (uint64_t)scene->dimensions);
    sb_json_number(&json, "resolution_m", scene->resolution);
    sb_json_count(&json, "fluid_particles", model->fluid_count);
    sb_json_count(&json, "boundary_particles", model->wall_count);
    sb_json_number(&json, "ghost_particles", e->ghosts);
    sb_json_number(&json, "still_depth_m", model->still_depth);
    if (e->sea) sb_json_text(&json, "given_water", sb_sea_about(e->sea));
    sb_check_waves_json(scene, model, &json);
    sb_check_rates_json(scene, &json);
    sb_check_tension_json(scene, model, &json);
    if (e->grid.cells > 0) {
        sb_json_number(&json, "grid_cells", e->grid.cells);
        sb_json_number(&json, "grid_memory_bytes", e->grid.bytes);
        sb_json_number(&json, "grid_steps", e->grid.steps);
        sb_json_number(&json, "grid_run_time_s", e->grid.seconds);
    }
    sb_json_number(&json, "memory_bytes", e->memory);
    sb_json_number(&json, "steps", e->steps);
    sb_json_number(&json, "time_step_s", e->time_step);
    sb_json_count(&json, "settling_steps_most", (uint64_t)e->settling_most);
    sb_json_count(&json, "settling_steps", (uint64_t)e->settling);
    sb_json_number(&json, "run_time_s", e->seconds);
    sb_json_number(&json, "disk_bytes", e->disk);
    sb_json_open(&json, "bodies", '[');
    for (size_t b = 0; b < model->body_count; b++) {
        sb_json_open(&json, NULL, '{');
        sb_json_text(&json, "name", model->bodies[b].name);
        sb_json_count(&json, "boundary_particles", model->bodies[b].count);
        sb_json_bool(&json, "moves", model->bodies[b].wavemaker >= 0);
        if (model->bodies[b].mesh.told) sb_json_text(&json, "terrain", model->bodies[b].mesh.told);
        sb_json_close(&json);
    }
    sb_json_close(&json);
    if (own_bed(scene)) sb_check_bed_json(&model->grid.told, &json);
    sb_json_open(&json, "warnings", '[');
    visit_warnings(scene, model, print_json, &json);
    sb_json_close(&json);
    sb_json_close(&json);
    putchar('\n');
}

int sb_command_check(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_scene scene = {0};
    sb_model model = {0};
    sb_sea_source *sea = NULL;
    sb_status status = sb_options_parse(count, arguments, SB_OPT_JSON | SB_OPT_PRESET | SB_OPT_SET | SB_OPT_THREADS,
                                        "scene", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = sb_options_scene(&options, options.positional, &scene, &error);
    const bool grid = status == SB_OK && sb_scene_grid_alone(&scene);
    if (grid) status = sb_grid_check(&scene, options.json, &error);
    if (status == SB_OK && !grid) status = sb_fit_check(&scene, &error);
    if (status == SB_OK && !grid) status = sb_model_build(&scene, &model, &error);
    if (status == SB_OK && scene.given.source != SB_GIVEN_NONE)
        status = sb_sea_create(&scene, &model.grid, &sea, &error);
    if (status == SB_OK && !grid) status = sb_sim_foresee_start(&scene, &model, sb_model_start_speed(&model), &error);
    if (status == SB_OK && !grid) {
        estimate e = make_estimate(&scene, &model);
        e.sea = sea;
        if (sb_scene_nested(&scene)) add_grid(&scene, sb_sea_grid(sea), &e);
        (options.json ? report_json : report_text)(&scene, &model, &e);
    } else if (status != SB_OK) {
        fprintf(stderr, "shorebreak: %s\n", error.text);
    }
    sb_sea_destroy(sea);
    sb_model_free(&model);
    sb_scene_free(&scene);
    sb_options_free(&options);
    return (int)status;
}
