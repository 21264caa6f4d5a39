#include "sim/terms/surface_tension.h"

#include "base/memory.h"
#include "sim/exchange/sums.h"
#include "sim/step/ledger.h"
#include "sim/terms/nodes.h"

#include <math.h>
#include <string.h>

/* Gradients of phi per node below this one are disorder of the particle packing. At a surface they are up to 0.4. */
static const double NOISE = 0.005;

/* Binomial means of phi, and of the weights by which forces are divided. The second is larger by one: the stress
   reaches one node farther than phi, and each node with a force needs particles that take it. */
enum { MEANS = 1, SPREADS = 2 };

/* A particle takes a part of a force in proportion to (1 - phi + LEAST)^2 at its place, so that the force acts on the
   outermost layer. Forces that act d below the surface raise the pressure of a drop by (D - 1) d/R. LEAST only leaves
   no node without takers. */
static const double LEAST = 0.001;

/* |grad phi|, less where it is noise, over |grad phi|^2: the factor of the stress. square > 0. */
static double stress_factor(double square)
{
    return 1 / sqrt(square + NOISE * NOISE);
}

/* Integral of the quadratic B-spline up to x. */
static double step_of(double x)
{
    if (x <= -1.5) return 0;
    if (x >= 1.5) return 1;
    if (x < -0.5) return pow(x + 1.5, 3) / 6;
    if (x > 0.5) return 1 - pow(1.5 - x, 3) / 6;
    return 0.5 + 0.75 * x - x * x * x / 3;
}

double sb_tension_of_plane(void)
{
    enum { PLACES = 64, REACH = 5 };
    double sum = 0;
    for (int p = 0; p < PLACES; p++)
        for (int k = -REACH; k <= REACH; k++) {
            const double x = k - (p + 0.5) / PLACES;
            /* phi after one mean, at x + 1 less that at x */
            const double slope = 0.25 * (step_of(x + 2) + step_of(x + 1) - step_of(x) - step_of(x - 1));
            sum += slope * slope * stress_factor(slope * slope);
        }
    return sum / PLACES;
}

/* The arrays over nodes. spare: of three values per node; it is the memory of the stress. */
typedef struct fields {
    double *phi, *share, *force, *stress, *spare;
} fields;

static fields divide(const sb_sim *sim, size_t count)
{
    double *values = sim->work.node;
    return (fields){values, values + count, values + 2 * count, values + 5 * count, values + 5 * count};
}

/* The gradient of phi times the width of a cell of nodes, from its corners. at: the node with the least coordinates. */
static void gradient(const sb_nodes *nodes, const double *phi, size_t at, double g[3])
{
    const size_t row = sb_nodes_stride(nodes, 1), layer = sb_nodes_stride(nodes, 2), across = nodes->flat ? 1 : 2;
    g[0] = g[1] = g[2] = 0;
    for (size_t z = 0; z < 2; z++)
        for (size_t y = 0; y < across; y++)
            for (size_t x = 0; x < 2; x++) {
                const double value = phi[at + z * layer + y * row + x] / (2 * (double)across);
                g[0] += x ? value : -value;
                g[1] += across == 1 ? 0 : y ? value : -value;
                g[2] += z ? value : -value;
            }
}

/* T/sigma times the width of the cells of one row: xx, yy, zz, xy, xz, yz. */
static void stress_row(const sb_nodes *nodes, size_t y, size_t z, const fields *f)
{
    const size_t first = (z * nodes->size[1] + y) * nodes->size[0];
    const bool last = z + 1 == nodes->size[2] || (!nodes->flat && y + 1 == nodes->size[1]);
    for (size_t x = 0; x < nodes->size[0]; x++) {
        double *t = f->stress + 6 * (first + x), g[3] = {0};
        if (!last && x + 1 < nodes->size[0]) gradient(nodes, f->phi, first + x, g);
        const double square = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
        const double factor = square > 0 ? stress_factor(square) : 0;
        for (int k = 0; k < 3; k++) t[k] = factor * (square - g[k] * g[k]);
        t[3] = -factor * g[0] * g[1];
        t[4] = -factor * g[0] * g[2];
        t[5] = -factor * g[1] * g[2];
    }
}

/* div T/sigma times the squared width, of the nodes of one row, over the volume of the particles that take it. */
static void force_row(const sb_nodes *nodes, size_t y, size_t z, const fields *f)
{
    const size_t row = sb_nodes_stride(nodes, 1), layer = sb_nodes_stride(nodes, 2), across = nodes->flat ? 1 : 2;
    const size_t first = (z * nodes->size[1] + y) * nodes->size[0];
    for (size_t x = 0; x < nodes->size[0]; x++) {
        double *force = f->force + 3 * (first + x);
        const double share = f->share[first + x];
        force[0] = force[1] = force[2] = 0;
        if (!(share > 0) || x == 0 || z == 0 || (!nodes->flat && y == 0)) continue;
        for (size_t c = 0; c < 4 * across; c++) { /* the cells around */
            const size_t dx = c & 1, dz = c >> 1 & 1, dy = across == 1 ? 1 : c >> 2;
            const double *t = f->stress + 6 * (first + x - (1 - dx) - (1 - dz) * layer - (1 - dy) * row);
            const double sx = dx ? 1 : -1, sy = across == 1 ? 0 : dy ? 1 : -1, sz = dz ? 1 : -1;
            force[0] += sx * t[0] + sy * t[3] + sz * t[4];
            force[1] += sx * t[3] + sy * t[1] + sz * t[5];
            force[2] += sx * t[4] + sy * t[5] + sz * t[2];
        }
        for (int k = 0; k < 3; k++) force[k] /= 2 * (double)across * share;
    }
}

/* The shares of the particles, as pull[i][3], and their sums at the nodes. Returns 0, or -1 without memory. */
static int find_shares(sb_sim *sim, const sb_nodes *nodes, const fields *f, double volume)
{
    const size_t n = sim->state.n;
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        double phi[3];
        sb_nodes_take(sim, nodes, i, f->phi, 1, phi);
        const double air = fmax(1 - phi[0], 0) + LEAST;
        sim->work.pull[i][3] = (float)(air * air);
    }
    memset(f->share, 0, nodes->count * sizeof *f->share);
    if (sb_nodes_give(sim, nodes, sim->work.pull, volume, f->share) != 0) return -1;
    for (int k = 0; k < SPREADS; k++) sb_nodes_smooth(nodes, f->share, 1, f->spare);
    return 0;
}

static void find_forces(const sb_nodes *nodes, const fields *f)
{
    const size_t rows = nodes->size[1] * nodes->size[2];
#pragma omp parallel for schedule(static)
    for (size_t r = 0; r < rows; r++) stress_row(nodes, r % nodes->size[1], r / nodes->size[1], f);
#pragma omp parallel for schedule(static)
    for (size_t r = 0; r < rows; r++) force_row(nodes, r % nodes->size[1], r / nodes->size[1], f);
    for (int k = 0; k < SPREADS; k++) sb_nodes_smooth(nodes, f->force, 3, f->spare);
}

sb_status sb_stage_surface_tension(sb_sim *sim, sb_error *error)
{
    const sb_nodes nodes = sb_nodes_around(sim);
    const sb_constants *c = &sim->constant;
    const size_t n = sim->state.n;
    static const char *const purpose = "the surface tension of water that is spread over so large a box";
    if (sim->work.everywhere == 0) return SB_OK;
    const int grown =
        sb_grow((void **)&sim->work.node, &sim->work.node_capacity, nodes.count, SB_TENSION_VALUES * sizeof(double));
    if (sb_ranks_any(sim->ranks, grown != 0)) return sb_fail_memory(error, purpose);
    const fields f = divide(sim, nodes.count);
    const double volume = pow((double)c->spacing / nodes.width, c->dimension);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) sim->work.pull[i] = (sb_f4){0, 0, 0, 1};
    memset(f.phi, 0, nodes.count * sizeof *f.phi);
    if (sb_nodes_give(sim, &nodes, sim->work.pull, volume, f.phi) != 0) return sb_fail_memory(error, purpose);
    for (int k = 0; k < MEANS; k++) sb_nodes_smooth(&nodes, f.phi, 1, f.spare);
    if (find_shares(sim, &nodes, &f, volume) != 0) return sb_fail_memory(error, purpose);
    find_forces(&nodes, &f);
    const double unit =
        (double)c->surface_tension / ((double)c->rest_density * nodes.width * nodes.width * sb_tension_of_plane());
    const sb_f4 dt = sb_splat((float)sim->state.time_step);
#pragma omp parallel for schedule(static)
    for (size_t i = 0; i < n; i++) {
        double sum[3];
        sb_nodes_take(sim, &nodes, i, f.force, 3, sum);
        const double own = unit * (double)sim->work.pull[i][3];
        sim->work.pull[i] = (sb_f4){(float)(own * sum[0]), (float)(own * sum[1]), (float)(own * sum[2]), 0};
        sim->work.predicted[i] += sim->work.pull[i] * dt;
    }
    return SB_OK;
}

static double sum_work(sb_sim *sim, const sb_group *group, double terms[SB_SUMS_MAX])
{
    const sb_f4 dt = sb_splat((float)sim->state.time_step);
    terms[0] = 0;
    for (size_t i = group->first; i < group->end; i++)
        terms[0] +=
            sb_ledger_work((sb_f4){0}, sim->work.pull[i] * dt, sim->state.velocity[i], sim->work.end_velocity[i]);
    return 0;
}

sb_status sb_stage_surface_work(sb_sim *sim, sb_error *error)
{
    (void)error;
    sim->work.tension_work = 0;
    if (sim->policy->runs) sb_sum_groups(sim, 1, sum_work, &sim->work.tension_work);
    return SB_OK;
}
