/* Measures memory per fluid particle, in total by the program itself and by array, and the cost of dry land. */
#include "base/memory.h"
#include "base/file.h"
#include "child.h"
#include "program.h"
#include "sim/walls/mirrors.h"
#include "sim/walls/normals.h"
#include "subject.h"
#include "summary_text.h"

#include <omp.h>

/* TURNS: turns per requested repeat, because the difference is smaller than the spread of a few repeats. */
enum { DRY_STEPS = 4, TURNS = 3 };

/* Runs the program as a user does, for a few steps. */
static sb_status whole_program(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    char scene[SB_PATH_MAX], *summary;
    sb_bench_program run = {
        .scene = scene,
        .threads = request->threads,
        .settings = {"numerics.settle_steps=10", "duration=0.2", request->quick ? "resolution=24" : "resolution=4"}};
    sb_status status = sb_path_join(scene, request->assets, "scenes/plant.yaml", error);
    if (status == SB_OK) status = sb_bench_program_run(&run, &summary, error);
    if (status != SB_OK) return status;
    const double particles = sb_json_number_in(summary, "fluid_particles");
    const double peak = sb_json_number_in(summary, "peak_memory_bytes");
    sb_free(summary);
    sb_bench_add_value(rows, request->quick ? "plant but coarser by the program" : "plant at 4 m by the program",
                       (size_t)particles, request->threads, "peak memory", "B/particle", peak / particles);
    return sb_bench_complete(rows, error);
}

/* ---- array by array ---- */

static void add_arrays(const char *name, const sb_bench_subject *subject, sb_bench_rows *rows)
{
    const sb_sim *sim = subject->sim;
    const sb_model *model = &subject->model;
    const double n = (double)sim->state.n;
    double walls = (double)sb_wall_normals_bytes(&sim->walls.normals) + SB_WALL_BYTES * (double)sim->walls.rest.count;
    for (int s = 0; s < SB_WALL_SETS; s++)
        walls += (double)(sb_cells_bytes(&sim->walls.set[s].cells) + sim->walls.set[s].count * SB_WALL_BYTES +
                          (sim->walls.set[s].near_mask + 1) * 8);
    const struct {
        const char *name;
        double bytes;
    } arrays[] = {
        {"pair lists in use", (double)(sizeof *sim->work.pairs.four * sim->work.pairs.used)},
        {"pair lists in reserve",
         (double)(sizeof *sim->work.pairs.four * (sim->work.pairs.capacity - sim->work.pairs.used))},
        {"groups",
         (double)(sizeof *sim->groups.group * sim->groups.capacity + sizeof *sim->groups.run * sim->groups.room)},
        {"wall pair lists", 8 * (double)sim->work.wall_pairs.capacity},
        {"images of walls", (double)(sizeof *sim->groups.image * sim->groups.images_room +
                                     sizeof *sim->groups.plane * sim->groups.planes_room)},
        {"pairs at edges", (double)(sizeof *sim->work.edge_pairs.pair * sim->work.edge_pairs.capacity)},
        {"facets of walls", (double)sb_mirrors_bytes(sim)},
        {"sums over cells", (double)(sizeof *sim->work.cell_sum * sim->work.cell_sum_capacity)},
        {"fields of particles", (double)(sb_state_bytes(&sim->state) + sim->work.bytes)},
        {"cells", (double)sb_cells_bytes(&sim->cells)},
        {"boundary particles", walls},
        {"model: fluid particles", (model->fluid_position ? 24 * n : 0) + (model->fluid_velocity ? 24 * n : 0) +
                                       (model->fluid_pressure ? 8 * n : 0)},
        {"model: boundary particles", (model->wall_position ? 24 : 0) * (double)model->wall_count +
                                          (model->wall_normal ? 24 : 0) * (double)model->wall_count},
    };
    for (size_t a = 0; a < sizeof arrays / sizeof arrays[0]; a++)
        sb_bench_add_value(rows, name, sim->state.n, omp_get_max_threads(), arrays[a].name, "B/particle",
                           arrays[a].bytes / n);
    sb_bench_add_value(rows, name, sim->state.n, omp_get_max_threads(), "memory of the simulation", "B/particle",
                       (double)sb_sim_bytes(sim) / n);
    sb_bench_add_value(rows, name, sim->state.n, omp_get_max_threads(), "pairs per particle", "1",
                       4 * (double)sim->work.pairs.used / n);
}

static sb_status arrays(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    const sb_override overrides[] = {{"resolution", request->quick ? "24" : "4"}, {"numerics.settle_steps", "10"}};
    sb_bench_subject subject;
    sb_status status = sb_bench_subject_make(request->assets, "scenes/plant.yaml", overrides, 2, 2, &subject, error);
    if (status != SB_OK) return status;
    add_arrays(request->quick ? "plant but coarser" : "plant at 4 m", &subject, rows);
    sb_bench_subject_free(&subject);
    return status;
}

/* ---- dry land ---- */

static sb_status make_shore(const sb_bench_request *request, bool long_land, sb_bench_subject *subject, sb_error *error)
{
    const sb_override overrides[] = {{"resolution", request->quick ? "0.2" : "0.06"},
                                     {"numerics.settle_steps", "5"},
                                     {"numerics.min_iterations", "10"},
                                     {"numerics.max_iterations", "10"},
                                     {"domain.max", "[44, 4, 3]"},
                                     {"bodies.land.max", "[44, 4, 1.5]"}};
    const size_t all = sizeof overrides / sizeof overrides[0];
    return sb_bench_subject_make(request->assets, "benchmark/shore.yaml", overrides, long_land ? all : all - 2, 1,
                                 subject, error);
}

/* Both shores take turns, and are first equally often, so that other programs affect both alike. Each turn gives the
   time per particle that the land adds. */
static sb_status take_turns(sb_bench_subject shore[2], int repeats, sb_bench_rows *rows, sb_error *error)
{
    static const char *const names[] = {"shore", "shore with ten times the land"};
    sb_bench_samples samples[2] = {{.count = 0}}, added = {.count = 0};
    sb_status status = SB_OK;
    const int turns = TURNS * repeats < SB_BENCH_REPEATS_MAX ? TURNS * repeats : SB_BENCH_REPEATS_MAX;
    for (int turn = 0; turn < turns && status == SB_OK; turn++) {
        double each[2] = {0};
        for (int k = 0; k < 2 && status == SB_OK; k++) {
            const int s = (turn + k) % 2;
            status = sb_bench_repeat(&shore[s], DRY_STEPS, &each[s], NULL, error);
            sb_bench_sample(&samples[s], each[s]);
            each[s] /= (double)shore[s].sim->state.n;
        }
        sb_bench_sample(&added, each[1] / each[0] - 1);
    }
    for (int s = 0; s < 2 && status == SB_OK; s++) {
        const size_t n = shore[s].sim->state.n;
        const double walls = (double)shore[s].model.wall_count, bytes = (double)sb_sim_bytes(shore[s].sim);
        sb_bench_add(rows, names[s], n, omp_get_max_threads(), SB_BENCH_STEP, "ns", &samples[s],
                     1e9 / ((double)n * DRY_STEPS));
        sb_bench_add_value(rows, names[s], n, omp_get_max_threads(), "boundary particles", "1", walls);
        sb_bench_add_value(rows, names[s], n, omp_get_max_threads(), "memory of the simulation", "B/particle",
                           bytes / (double)n);
    }
    if (status != SB_OK) return status;
    sb_bench_add(rows, names[1], shore[1].sim->state.n, omp_get_max_threads(), "time added", "%", &added, 100);
    return SB_OK;
}

static sb_status dry_land(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_bench_subject shore[2];
    sb_status status = make_shore(request, false, &shore[0], error);
    if (status != SB_OK) return status;
    status = make_shore(request, true, &shore[1], error);
    if (status == SB_OK) {
        status = take_turns(shore, request->repeats, rows, error);
        sb_bench_subject_free(&shore[1]);
    }
    sb_bench_subject_free(&shore[0]);
    return status;
}

sb_status sb_bench_memory(const sb_bench_request *request, sb_bench_rows *rows, sb_error *error)
{
    sb_status status = whole_program(request, rows, error);
    if (status == SB_OK) status = sb_bench_in_child(arrays, request, rows, error);
    if (status == SB_OK) status = sb_bench_in_child(dry_land, request, rows, error);
    return status;
}
