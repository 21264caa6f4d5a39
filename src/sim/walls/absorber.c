#include "sim/walls/absorber.h"

#include "base/hash.h"
#include "base/memory.h"
#include "sim/exchange/exchange.h"
#include "sim/exchange/sums.h"

#include <math.h>

/* Periods over which the drift is a mean. */
static const double DRIFT_PERIODS = 10;

/* Along a face, at which its water at the start is looked up. */
enum { PLACES = 16 };

bool sb_absorber_repeats(const sb_scene *scene, const sb_absorber *a)
{
    for (int axis = 0; axis < 2; axis++) {
        const double period = sb_component(scene->domain.max, axis) - sb_component(scene->domain.min, axis);
        if (fabs(a->side[axis]) > 1 - 1e-9 && sb_scene_repeats(scene, axis))
            return a->from[1] - a->from[0] > period - 1e-6 * scene->resolution;
    }
    return false;
}

/* The extent of the face along itself, as far as it is within the domain. */
static void find_extent(const sb_domain *domain, const sb_mesh *mesh, sb_vec3 direction, sb_absorber *a)
{
    const sb_vec3 side = sb_vec(-direction.y, direction.x, 0), back = sb_scale(side, -1);
    a->side[0] = side.x;
    a->side[1] = side.y;
    a->from[0] = -fmin(sb_mesh_front(mesh, back), sb_domain_end(domain, back));
    a->from[1] = fmin(sb_mesh_front(mesh, side), sb_domain_end(domain, side));
}

sb_status sb_absorber_create(sb_sim *sim, size_t body, sb_moving_body *moving, sb_error *error)
{
    const sb_wavemaker_use *use = &sim->scene->wavemakers[sim->model->bodies[body].wavemaker];
    if (!use->law.absorb) return SB_OK;
    sb_absorber *a = moving->absorber = sb_alloc(1, sizeof *a);
    if (!a) return sb_fail_memory(error, "an absorbing paddle");
    a->distance = SB_ABSORB_DISTANCE * sim->model->spacing;
    a->reach = use->law.reach;
    a->period = moving->law->paddle.kind->facts(moving->law->paddle.state)->period;
    const sb_mesh *mesh = &sim->model->bodies[body].mesh;
    a->face = sb_mesh_front(mesh, use->direction);
    a->ahead = fmax(sb_domain_end(&sim->scene->domain, use->direction) - a->face, 0);
    a->behind = sb_domain_room(&sim->scene->domain, use->direction, a->face,
                               -sb_mesh_front(mesh, sb_scale(use->direction, -1)));
    if (sim->model->bodies[body].plates > 0)
        sb_plate_find(sim, body, a);
    else
        find_extent(&sim->scene->domain, mesh, use->direction, a);
    if (moving->law->filter.gain > 0) return SB_OK; /* fitted for another plate */
    return sb_paddle_fit_absorption(&use->law, &moving->law->paddle, a->distance, &moving->law->filter, error);
}

double sb_column_weight(double x)
{
    const double r = fabs(x), far = fmax(2 - r, 0), near = fmax(1 - r, 0);
    return (far * far * far - 4 * near * near * near) / 6;
}

double sb_column_window(double x)
{
    return 0.25 * (sb_column_weight(x - 1) + 2 * sb_column_weight(x) + sb_column_weight(x + 1));
}

/* Volume of the water beside the face over its width: the depth, weighted over the window. */
static double column(sb_sim *sim, const sb_moving_body *moving)
{
    const sb_absorber *a = moving->absorber;
    const sb_vec3 d = moving->direction;
    const double width = sim->model->spacing, from = a->face + moving->displacement + a->distance;
    const bool flat = sim->constant.dimension == 2, whole = flat || sb_absorber_repeats(sim->scene, a);
    const size_t n = sim->state.n;
    sb_exact sum = {0};
#pragma omp parallel
    {
        sb_exact own = {0};
#pragma omp for schedule(static) nowait
        for (size_t i = 0; i < n; i++) {
            const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
            const double ahead = (at.x * d.x + at.y * d.y - from) / width;
            if (!(fabs(ahead) < SB_ABSORB_DISTANCE)) continue;
            const double along = at.x * a->side[0] + at.y * a->side[1];
            if (whole || (along >= a->from[0] && along <= a->from[1])) sb_exact_add(&own, sb_column_window(ahead));
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

/* Whether a box of water is at a place. */
static bool boxed(const sb_scene *scene, double x, double y)
{
    for (size_t i = 0; i < scene->box_count; i++) {
        const sb_fluid_box *box = &scene->boxes[i];
        const bool along = x >= box->min.x && x <= box->max.x;
        if (along && (scene->dimensions == 2 || (y >= box->min.y && y <= box->max.y))) return true;
    }
    return false;
}

bool sb_absorber_boxed(const sb_sim *sim, const sb_moving_body *moving)
{
    const sb_absorber *a = moving->absorber;
    const double ahead = a->face + moving->displacement + a->distance;
    bool any = false;
    for (int i = 0; i < PLACES; i++) {
        const double along = a->from[0] + (a->from[1] - a->from[0]) * (i + 0.5) / PLACES;
        any |= boxed(sim->scene, ahead * moving->direction.x + along * a->side[0],
                     ahead * moving->direction.y + along * a->side[1]);
    }
    return any;
}

double sb_absorber_raised(const sb_sim *sim, const sb_moving_body *moving, double from, double to)
{
    const sb_absorber *a = moving->absorber;
    const sb_initial_wave *wave = &sim->scene->wave;
    const double ahead = a->face + moving->displacement + a->distance;
    double sum = 0;
    if (wave->kind == SB_INITIAL_NONE) return 0;
    for (int i = 0; i < PLACES; i++) {
        const double along = from + (to - from) * (i + 0.5) / PLACES;
        const double x = ahead * moving->direction.x + along * a->side[0];
        const double y = ahead * moving->direction.y + along * a->side[1];
        /* beside a sea, boxes of water have no wave */
        if (sim->scene->sea.present && boxed(sim->scene, x, y)) continue;
        sum += sb_initial_elevation(wave, sim->scene->fluid.gravity, x - wave->position);
    }
    return sum / PLACES;
}

/* The mean over whole periods, which the displacement by returning waves does not change. */
static void note_drift(sb_absorber *a, double dt)
{
    a->sum += a->state.offset * dt;
    a->elapsed += dt;
    const bool whole = a->elapsed >= DRIFT_PERIODS * a->period;
    if (whole || !a->drifted) a->drift = a->sum / a->elapsed;
    if (!whole) return;
    a->drift_most = fmax(a->drift_most, fabs(a->drift));
    a->drifted = true;
    a->sum = a->elapsed = 0;
}

double sb_absorber_advance(sb_sim *sim, sb_moving_body *moving)
{
    sb_absorber *a = moving->absorber;
    const double dt = sim->state.time_step, law = moving->displacement - a->state.offset;
    if (!a->known) a->still = a->depth - sb_absorber_raised(sim, moving, a->from[0], a->from[1]);
    a->known = true;
    if (a->plates > 0 && a->still == 0) return a->state.offset; /* a plate before land stays at its law */
    const double next = moving->next_displacement;              /* of the law */
    const sb_absorbing_input input = {.surface = a->depth - a->still,
                                      .expected = moving->law->surface,
                                      .law_speed = (next - law) / dt,
                                      .least = fmax(-a->reach, fmin(-a->behind - next, 0)),
                                      .most = fmin(a->reach, fmax(a->ahead - next, 0))};
    if (sb_absorbing_advance(&moving->law->filter, &input, dt, &a->state)) a->limited++;
    a->farthest = fmax(a->farthest, fabs(a->state.offset));
    note_drift(a, dt);
    return a->state.offset;
}

sb_absorption sb_sim_absorption(const sb_sim *sim, size_t body)
{
    const uint32_t m = sim->walls.moving_of_body[body];
    const sb_absorber *a = m == UINT32_MAX ? NULL : sim->walls.moving[m].absorber;
    if (!a || a->plate > 0) return (sb_absorption){0};
    if (a->plates == 0)
        return (sb_absorption){.absorbs = true,
                               .law = sim->walls.moving[m].law->there,
                               .offset = a->state.offset,
                               .farthest = a->farthest,
                               .limited = a->limited,
                               .drift = a->drift,
                               .drift_most = a->drift_most};
    sb_absorption all = {.absorbs = true, .law = sim->walls.moving[m].law->there, .plates = a->plates};
    double least = (double)INFINITY, most = -(double)INFINITY;
    for (size_t k = 0; k < a->plates; k++) {
        const sb_absorber *one = sim->walls.moving[m + k].absorber;
        all.offset += one->state.offset / (double)a->plates;
        all.farthest = fmax(all.farthest, one->farthest);
        all.drift += one->drift / (double)a->plates;
        all.drift_most = fmax(all.drift_most, one->drift_most);
        all.limited += one->limited;
        least = fmin(least, one->state.offset);
        most = fmax(most, one->state.offset);
    }
    all.apart = most - least;
    return all;
}

enum { REALS = 11 };

static void reals_of(const sb_absorber *a, double reals[REALS])
{
    const sb_absorbing_state *s = &a->state;
    const double all[REALS] = {a->still,    s->mean, s->low,     s->fast,  s->offset,    s->speed,
                               a->farthest, a->sum,  a->elapsed, a->drift, a->drift_most};
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
        sb_put_flag(out, a->drifted);
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
        a->drifted = sb_take_flag(in);
        sb_take_list(in, reals, REALS, sizeof *reals);
        a->limited = sb_take_count(in, UINT64_MAX);
        sb_absorbing_state *s = &a->state;
        double *const fields[REALS] = {&a->still,    &s->mean, &s->low,     &s->fast,  &s->offset,    &s->speed,
                                       &a->farthest, &a->sum,  &a->elapsed, &a->drift, &a->drift_most};
        for (int k = 0; k < REALS; k++) {
            *fields[k] = isfinite(reals[k]) ? reals[k] : 0;
            if (!isfinite(reals[k]))
                sb_archive_refuse(in, "an absorbing paddle has the value %g, expected a finite one", reals[k]);
        }
        if (!(fabs(s->offset) <= a->reach))
            sb_archive_refuse(in, "an absorbing paddle is %g m from its law, expected at most %g m", s->offset,
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
