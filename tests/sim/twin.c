#include "sim/twin.h"

#include "base/memory.h"
#include "physics/kernels/wall_volume.h"
#include "sim/search/around.h"
#include "sim/walls/normals.h"

#include <math.h>
#include <string.h>

static bool is_image(const sb_sim *sim, sb_record record)
{
    sb_record home = sb_space_wrap(&sim->space, record);
    return memcmp(&home, &record, sizeof home) != 0;
}

/* Copies the boundary particles. Returns their number. */
static size_t copy_walls(const sb_sim *sim, twin *t)
{
    size_t at = 0;
    for (int s = 0; s < SB_WALL_SETS; s++) {
        const sb_wall_set *set = &sim->walls.set[s];
        for (size_t b = 0; b < set->count; b++) {
            if (is_image(sim, set->record[b])) continue;
            t->wall_position[at] = sb_space_position(&sim->space, set->record[b]);
            t->psi[at] = (double)sb_carried_value(set->record[b]);
            t->body[at] = set->body[b];
            sb_f4 normal = sb_wall_normal(sim, set, b);
            t->wall_normal[at] = sb_vec((double)normal[0], (double)normal[1], (double)normal[2]);
            if (s == SB_MOVING)
                t->wall_velocity[at] = sim->walls.moving[sim->walls.moving_of_body[set->body[b]]].velocity;
            at++;
        }
        if (s == SB_STATIC) t->static_count = at;
    }
    return at;
}

/* Copies the slopes of fluid pairs that are in the simulation's lists. Their roots are rounded to 15 bits;
   test_neighbours compares them with the kernel. */
static void take_slopes(const sb_sim *sim, twin *t)
{
    const sb_reference *r = &t->reference;
    const double quantum = sim->space.quantum, near = 1e-3 * r->cloud.spacing;
    for (size_t i = 0; i < sim->state.n && sim->groups.count > 0; i++)
        for (size_t k = 0; k < twin_listed(sim, i, false); k++) {
            const twin_entry entry = twin_list(sim, i, false, k);
            const size_t ghost = entry.other - sim->state.n;
            const size_t other = entry.other < sim->state.n  ? entry.other
                                 : ghost < sim->ghosts.count ? sim->ghosts.of[ghost]
                                                             : i;
            const sb_f4 d = sb_offset(sim->state.position[i], sim->state.position[entry.other]);
            const sb_vec3 offset = sb_scale(sb_vec((double)d[0], (double)d[1], (double)d[2]), quantum);
            for (size_t p = r->fluid_start[i]; p < r->fluid_start[i + 1] && !entry.padding; p++)
                if (r->fluid[p].other == other && sb_norm(sb_sub(r->fluid[p].offset, offset)) < near)
                    r->fluid[p].gradient = sb_scale(r->fluid[p].offset, entry.slope / (quantum * r->mass));
        }
}

int twin_make(const sb_sim *sim, twin *t)
{
    const sb_numerics *numerics = &sim->scene->numerics;
    size_t n = sim->state.n, walls = sim->walls.set[SB_STATIC].count + sim->walls.set[SB_MOVING].count;
    twin made = {0};
    made.position = sb_alloc(n, sizeof(sb_vec3));
    made.velocity = sb_alloc(n, sizeof(sb_vec3));
    made.wall_position = sb_alloc(walls, sizeof(sb_vec3));
    made.wall_velocity = sb_alloc(walls, sizeof(sb_vec3));
    made.wall_normal = sb_alloc(walls, sizeof(sb_vec3));
    made.psi = sb_alloc(walls, sizeof(double));
    made.body = sb_alloc(walls, sizeof(uint32_t));
    int status = made.position && made.velocity && made.wall_position && made.wall_velocity && made.wall_normal &&
                         made.psi && made.body
                     ? 0
                     : -1;
    if (status == 0) {
        walls = copy_walls(sim, &made);
        double quantum = sim->space.quantum;
        const uint32_t *period = sim->space.period;
        for (size_t i = 0; i < n; i++) {
            sb_f4 v = sim->state.velocity[i];
            made.position[i] = sb_space_position(&sim->space, sim->state.position[i]);
            made.velocity[i] = sb_vec((double)v[0], (double)v[1], (double)v[2]);
        }
        sb_reference_cloud cloud = {
            .kernel = numerics->kernel,
            .dimension = sim->scene->dimensions,
            .h = numerics->support * sim->scene->resolution,
            .spacing = sim->scene->resolution,
            .rest_density = sim->scene->fluid.density,
            .time_step = sim->state.time_step,
            .fluid_count = n,
            .position = made.position,
            .velocity = made.velocity,
            .wall_count = walls,
            .wall_position = made.wall_position,
            .wall_velocity = made.wall_velocity,
            .wall_normal = made.wall_normal,
            .psi = made.psi,
            .body = made.body,
            .sound_speed = (double)sim->constant.sound_speed,
            .artificial_viscosity = numerics->artificial_viscosity,
            .wall_friction = numerics->wall_friction,
            .period = sb_vec(period[0] * quantum, period[1] * quantum, period[2] * quantum),
        };
        status = sb_reference_create(&cloud, &made.reference);
        if (status == 0) take_slopes(sim, &made);
    }
    if (status != 0)
        twin_free(&made);
    else
        *t = made;
    return status;
}

double twin_gamma(const sb_sim *sim)
{
    const sb_numerics *n = &sim->scene->numerics;
    if (!sim->needs.images) return 1;
    return sb_wall_gamma(n->kernel, sim->scene->dimensions, n->support, n->wall_offset, n->wall_spacing);
}

/* (M14) with v = (z^2, 0, 0) on a lattice, divided by 2 nu. The density is the lattice's. */
double twin_lattice_shear(const sb_sim *sim)
{
    const sb_numerics *n = &sim->scene->numerics;
    const int dimension = sim->scene->dimensions, far = (int)ceil(n->support), across = dimension == 3 ? far : 0;
    double sum = 0, density = 0;
    for (int i = -far; i <= far; i++)
        for (int j = -across; j <= across; j++)
            for (int k = -far; k <= far; k++) {
                const double r = sqrt(i * i + j * j + k * k);
                density += sb_kernel_value(n->kernel, dimension, n->support, r);
                if (r > 0)
                    sum -= i * i * k * k * sb_kernel_slope(n->kernel, dimension, n->support, r) /
                           (r * (r * r + 0.01 * n->support * n->support));
            }
    return (dimension + 2) * sum / density;
}

void twin_free(twin *t)
{
    sb_reference_destroy(&t->reference);
    sb_free(t->position);
    sb_free(t->velocity);
    sb_free(t->wall_position);
    sb_free(t->wall_velocity);
    sb_free(t->wall_normal);
    sb_free(t->psi);
    sb_free(t->body);
    *t = (twin){0};
}

size_t twin_wall(const twin *t, uint32_t listed)
{
    return (listed & 0x7fffffffu) + (listed >> 31 ? t->static_count : 0);
}

size_t twin_listed(const sb_sim *sim, size_t i, bool walls)
{
    return walls ? sim->work.wall_pairs.count[i] : 4 * (size_t)sim->work.pairs.count[i];
}

/* The group that particle i belongs to. */
static const sb_group *group_of(const sb_sim *sim, size_t i)
{
    size_t low = 0, high = sim->groups.count;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (sim->groups.group[middle].first <= i)
            low = middle;
        else
            high = middle;
    }
    return &sim->groups.group[low];
}

/* Index in the particle arrays for a place in a list of the group. */
static uint32_t around_index(const sb_sim *sim, const sb_group *group, uint16_t place)
{
    const sb_run *run = sim->groups.run + group->run;
    uint32_t left = place / SB_PLACE_STEP;
    while (left >= run->count) left -= run++->count;
    return run->begin + left;
}

twin_entry twin_list(const sb_sim *sim, size_t i, bool walls, size_t k)
{
    if (walls) {
        const size_t at = sim->work.wall_pairs.first[i] + k;
        const double slope = (double)sim->work.wall_pairs.slope[at];
        return (twin_entry){sim->work.wall_pairs.index[at], slope, slope == 0};
    }
    const sb_four_pairs *four = &sim->work.pairs.four[sim->work.pairs.first[i] + k / 4];
    const uint32_t other = around_index(sim, group_of(sim, i), four->place[k % 4]);
    const double root = (double)four->slope[k % 4];
    return (twin_entry){other, (double)sim->work.pairs.unit * root * root, other == i};
}

void twin_compare(twin_gap *gap, size_t at, double a, double b)
{
    double difference = fabs(a - b);
    /* The comparison keeps a NaN as the worst value. */
    if (!(difference <= gap->worst)) {
        gap->worst = isnan(gap->worst) ? gap->worst : difference;
        gap->at = at;
    }
    if (fabs(b) > gap->scale) gap->scale = fabs(b);
}

double twin_relative(const twin_gap *gap)
{
    return gap->scale > 0 ? gap->worst / gap->scale : gap->worst;
}
