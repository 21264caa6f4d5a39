#include "sim/walls/absorber.h"

#include "base/hash.h"
#include "base/memory.h"
#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"

#include <math.h>

/* The face from the body's boundary particles, which lie behind it by the wall's offset. */
static void find_face(const sb_sim *sim, const sb_model_body *body, sb_vec3 direction, sb_absorber *a)
{
    const sb_model *model = sim->model;
    const double back = sim->scene->numerics.wall_offset * model->spacing;
    a->side[0] = -direction.y;
    a->side[1] = direction.x;
    a->face = a->from[1] = -(double)INFINITY;
    a->from[0] = (double)INFINITY;
    for (size_t i = body->begin; i < body->begin + body->count; i++) {
        const sb_vec3 at = model->wall_position[i];
        const double along = at.x * a->side[0] + at.y * a->side[1];
        a->face = fmax(a->face, sb_dot(at, direction) + back);
        a->from[0] = fmin(a->from[0], along - back);
        a->from[1] = fmax(a->from[1], along + back);
    }
}

sb_status sb_absorber_create(sb_sim *sim, size_t body, sb_moving_body *moving, sb_error *error)
{
    const sb_wavemaker_use *use = &sim->scene->wavemakers[sim->model->bodies[body].wavemaker];
    if (!use->law.absorb) return SB_OK;
    sb_absorber *a = moving->absorber = sb_alloc(1, sizeof *a);
    if (!a) return sb_fail_memory(error, "an absorbing paddle");
    a->distance = SB_ABSORB_DISTANCE * sim->model->spacing;
    a->reach = use->law.reach;
    if (sim->model->bodies[body].plates > 0)
        sb_plate_find(sim, body, use->direction, a);
    else
        find_face(sim, &sim->model->bodies[body], use->direction, a);
    return sb_paddle_fit_absorption(&use->law, &moving->paddle, a->distance, &a->filter, error);
}

double sb_column_weight(double x)
{
    const double r = fabs(x), far = fmax(2 - r, 0), near = fmax(1 - r, 0);
    return (far * far * far - 4 * near * near * near) / 6;
}

/* Volume of the water beside the face over its width: the depth, weighted over twice the distance ahead of the face at
   which it is measured, so that the column begins at the face. */
static double column(sb_sim *sim, const sb_moving_body *moving)
{
    const sb_absorber *a = moving->absorber;
    const sb_vec3 d = moving->direction;
    const double width = 0.5 * a->distance, from = a->face + moving->displacement + a->distance;
    const bool flat = sim->constant.dimension == 2;
    const size_t n = sim->state.n;
    sb_exact sum = {0};
#pragma omp parallel
    {
        sb_exact own = {0};
#pragma omp for schedule(static) nowait
        for (size_t i = 0; i < n; i++) {
            const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
            const double ahead = (at.x * d.x + at.y * d.y - from) / width;
            if (!(fabs(ahead) < 2)) continue;
            const double along = at.x * a->side[0] + at.y * a->side[1];
            if (flat || (along >= a->from[0] && along <= a->from[1])) sb_exact_add(&own, sb_column_weight(ahead));
        }
        sb_sums_merge(&sum, &own, 1);
    }
    sim->exchange->sum(sim, &sum, 1);
    const double volume = (double)sim->constant.mass / (double)sim->constant.rest_density;
    return sb_exact_value(&sum) * volume / (width * (flat ? 1 : a->from[1] - a->from[0]));
}

int sb_absorbers_measure(sb_sim *sim)
{
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_moving_body *moving = &sim->walls.moving[m];
        if (!moving->absorber || moving->absorber->plate > 0) continue;
        if (moving->absorber->plates == 0)
            moving->absorber->depth = column(sim, moving);
        else if (sb_plates_measure(sim, moving) != 0)
            return -1;
    }
    return 0;
}

/* Each filter is advanced exactly for an input that is constant over the step. */
double sb_absorber_advance(sb_sim *sim, sb_moving_body *moving)
{
    sb_absorber *a = moving->absorber;
    const double dt = sim->state.time_step, depth = a->depth;
    if (!a->known) a->still = depth;
    a->known = true;
    const double expected = moving->paddle.kind->surface(moving->paddle.state, sim->state.time - moving->paddle.start);
    const double surface = depth - a->still - expected;
    a->low += (surface - a->low) * -expm1(-a->filter.slow * dt);
    a->fast += (surface - a->low - a->fast) * -expm1(-a->filter.pole * dt);
    a->speed = -a->filter.gain * a->fast - a->filter.slow * a->offset;
    double next = a->offset + a->speed * dt;
    if (fabs(next) > a->reach) {
        next = copysign(a->reach, next);
        a->speed = (next - a->offset) / dt;
        a->limited++;
    }
    a->offset = next;
    a->farthest = fmax(a->farthest, fabs(next));
    return next;
}

sb_absorption sb_sim_absorption(const sb_sim *sim, size_t body)
{
    const uint32_t m = sim->walls.moving_of_body[body];
    const sb_absorber *a = m == UINT32_MAX ? NULL : sim->walls.moving[m].absorber;
    if (!a || a->plate > 0) return (sb_absorption){0};
    if (a->plates == 0) return (sb_absorption){true, a->offset, a->farthest, a->limited, 0, 0};
    sb_absorption all = {.absorbs = true, .plates = a->plates};
    double least = (double)INFINITY, most = -(double)INFINITY;
    for (size_t k = 0; k < a->plates; k++) {
        const sb_absorber *one = sim->walls.moving[m + k].absorber;
        all.offset += one->offset / (double)a->plates;
        all.farthest = fmax(all.farthest, one->farthest);
        all.limited += one->limited;
        least = fmin(least, one->offset);
        most = fmax(most, one->offset);
    }
    all.apart = most - least;
    return all;
}

enum { REALS = 6 };

static void reals_of(const sb_absorber *a, double reals[REALS])
{
    const double all[REALS] = {a->still, a->low, a->fast, a->offset, a->speed, a->farthest};
    for (int k = 0; k < REALS; k++) reals[k] = all[k];
}

void sb_absorbers_save(const sb_sim *sim, sb_archive_out *out)
{
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        const sb_absorber *a = sim->walls.moving[m].absorber;
        double reals[REALS];
        if (!a) continue;
        reals_of(a, reals);
        sb_put_flag(out, a->known);
        sb_put_list(out, reals, REALS, sizeof *reals);
        sb_put_count(out, a->limited);
    }
}

void sb_absorbers_load(sb_sim *sim, sb_archive_in *in)
{
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        sb_absorber *a = sim->walls.moving[m].absorber;
        double reals[REALS] = {0};
        if (!a) continue;
        a->known = sb_take_flag(in);
        sb_take_list(in, reals, REALS, sizeof *reals);
        a->limited = sb_take_count(in, UINT64_MAX);
        double *const fields[REALS] = {&a->still, &a->low, &a->fast, &a->offset, &a->speed, &a->farthest};
        for (int k = 0; k < REALS; k++) {
            *fields[k] = isfinite(reals[k]) ? reals[k] : 0;
            if (!isfinite(reals[k]))
                sb_archive_refuse(in, "an absorbing paddle has the value %g, expected a finite one", reals[k]);
        }
        if (!(fabs(a->offset) <= a->reach))
            sb_archive_refuse(in, "an absorbing paddle is %g m from its law, expected at most %g m", a->offset,
                              a->reach);
    }
}

uint64_t sb_absorbers_hash(const sb_sim *sim, uint64_t hash)
{
    for (size_t m = 0; m < sim->walls.moving_count; m++) {
        const sb_absorber *a = sim->walls.moving[m].absorber;
        double reals[REALS];
        if (!a) continue;
        reals_of(a, reals);
        hash = sb_hash(hash, reals, sizeof reals);
        hash = sb_hash(hash, &a->limited, sizeof a->limited);
    }
    return hash;
}
