#include "sim/twin.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

static bool is_image(const sb_sim *sim, sb_record record)
{
    sb_record home = sb_space_wrap(&sim->space, record);
    return memcmp(&home, &record, sizeof home) != 0;
}

/* Returns how many there are. */
static size_t copy_walls(const sb_sim *sim, twin *t)
{
    size_t at = 0;
    for (int s = 0; s < SB_WALL_SETS; s++) {
        const sb_wall_set *set = &sim->walls[s];
        for (size_t b = 0; b < set->count; b++) {
            if (is_image(sim, set->record[b])) continue;
            t->wall_position[at] = sb_space_position(&sim->space, set->record[b]);
            t->psi[at] = (double)sb_carried_value(set->record[b]);
            t->body[at] = set->body[b];
            sb_f4 normal = set->normal[b];
            t->wall_normal[at] =
                sb_vec((double)normal[0], (double)normal[1], (double)normal[2]);
            if (s == SB_MOVING)
                t->wall_velocity[at] = sim->moving[sim->moving_of_body[set->body[b]]].velocity;
            at++;
        }
        if (s == SB_STATIC) t->static_count = at;
    }
    return at;
}

int twin_make(const sb_sim *sim, twin *t)
{
    const sb_numerics *numerics = &sim->scene->numerics;
    size_t n = sim->n, walls = sim->walls[SB_STATIC].count + sim->walls[SB_MOVING].count;
    twin made = {0};
    made.position = sb_alloc(n, sizeof(sb_vec3));
    made.velocity = sb_alloc(n, sizeof(sb_vec3));
    made.wall_position = sb_alloc(walls, sizeof(sb_vec3));
    made.wall_velocity = sb_alloc(walls, sizeof(sb_vec3));
    made.wall_normal = sb_alloc(walls, sizeof(sb_vec3));
    made.psi = sb_alloc(walls, sizeof(double));
    made.body = sb_alloc(walls, sizeof(uint32_t));
    int status = made.position && made.velocity && made.wall_position && made.wall_velocity &&
                         made.wall_normal && made.psi && made.body
                     ? 0
                     : -1;
    if (status == 0) {
        walls = copy_walls(sim, &made);
        double quantum = sim->space.quantum;
        const uint32_t *period = sim->space.period;
        for (size_t i = 0; i < n; i++) {
            sb_f4 v = sim->velocity[i];
            made.position[i] = sb_space_position(&sim->space, sim->position[i]);
            made.velocity[i] = sb_vec((double)v[0], (double)v[1], (double)v[2]);
        }
        sb_reference_cloud cloud = {
            .kernel = numerics->kernel,
            .dimension = sim->scene->dimensions,
            .h = numerics->support * sim->scene->resolution,
            .spacing = sim->scene->resolution,
            .rest_density = sim->scene->fluid.density,
            .time_step = sim->report.time_step,
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
    }
    if (status != 0)
        twin_free(&made);
    else
        *t = made;
    return status;
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

void twin_compare(twin_gap *gap, size_t at, double a, double b)
{
    double difference = fabs(a - b);
    /* Written so that a NaN stays the worst. */
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
