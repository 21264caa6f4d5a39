#include "physics/wavemakers/wave_train.h"

#include "base/memory.h"
#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"

#include <math.h>

sb_wave_train *sb_wave_train_create(const sb_wavemaker_parameters *parameters, size_t count)
{
    sb_wave_train *train = sb_alloc(1, sizeof *train);
    if (!train) return NULL;
    *train = (sb_wave_train){.motion = parameters->motion,
                             .depth = parameters->depth,
                             .gravity = parameters->gravity,
                             .ramp = parameters->ramp,
                             .lasts = parameters->lasts,
                             .count = count,
                             .part = count > 0 ? sb_alloc(count, sizeof *train->part) : NULL};
    if (count == 0 || train->part) return train;
    sb_free(train);
    return NULL;
}

void sb_wave_train_destroy(void *state)
{
    sb_wave_train *train = state;
    if (train) sb_free(train->part);
    sb_free(train);
}

void sb_wave_train_set(sb_wave_train *train, size_t i, double amplitude, double omega, double phase)
{
    const double number = sb_wave_number(2 * M_PI / omega, train->depth, train->gravity);
    train->part[i] = (sb_train_part){.omega = omega,
                                     .phase = remainder(phase, 2 * M_PI),
                                     .amplitude = amplitude,
                                     .number = number,
                                     .stroke = amplitude / sb_paddle_gain(train->motion, number, train->depth)};
}

/* All crests at once, or about that of the highest of some hundred waves. */
static double crest_of_sum(const sb_wave_train *train)
{
    double sum = 0;
    for (size_t i = 0; i < train->count; i++) sum += train->part[i].amplitude;
    return fmin(sum, train->facts.height);
}

sb_status sb_wave_train_sum(sb_wave_train *train, const char *path, sb_error *error)
{
    sb_sum_height all = {0};
    sb_error why = {0};
    for (size_t i = 0; i < train->count; i++) sb_sum_height_add(&all, train->part[i].amplitude, train->part[i].number);
    train->facts.height = sb_sum_height_of(&all);
    train->facts.height_name = "significant height";
    train->facts.crest = crest_of_sum(train);
    if (sb_sum_height_check(&all, train->depth, &why) == SB_OK) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s: %.300s", path, why.text);
}

/* Part of the full motion at time t: a smooth step over `ramp` at the start, and back at the end. */
static double ramp_at(const sb_wave_train *train, double t)
{
    const double left = train->lasts - t;
    const double s = train->ramp > 0 ? fmin(fmin(t, left) / train->ramp, 1) : 1;
    return s <= 0 ? 0 : s * s * (3 - 2 * s);
}

static double full_displacement(const sb_wave_train *train, double t)
{
    double sum = 0;
    if (train->is_cnoidal) return sb_cnoidal_piston(&train->cnoidal, t, NULL);
    for (size_t i = 0; i < train->count; i++)
        sum += train->part[i].stroke * sin(train->part[i].omega * t + train->part[i].phase + train->part[i].ahead);
    return sum;
}

double sb_wave_train_displacement(const void *state, double t)
{
    const sb_wave_train *train = state;
    if (t <= 0) return 0;
    if (t >= train->lasts) t = train->lasts;
    const double ramp = ramp_at(train, t);
    return ramp > 0 ? ramp * (full_displacement(train, t) - train->origin) : 0;
}

double sb_wave_train_duration(const void *state)
{
    return ((const sb_wave_train *)state)->lasts;
}

/* Of a cnoidal wave at time t, at the place ahead of the paddle, m. */
static double cnoidal_elevation(const sb_wave_train *train, double t)
{
    double phase;
    sb_wave_motion motion;
    (void)sb_cnoidal_piston(&train->cnoidal, t, &phase);
    phase += train->place / train->cnoidal.length;
    sb_cnoidal_at(&train->cnoidal, phase - round(phase), 0, &motion);
    return motion.elevation;
}

/* The paddle stays longer before crests, which move with it. */
static double cnoidal_mean(const sb_wave_train *train)
{
    enum { SAMPLES = 400 };
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++) sum += cnoidal_elevation(train, train->facts.period * i / SAMPLES);
    return sum / SAMPLES;
}

void sb_wave_train_place(void *state, double distance)
{
    sb_wave_train *train = state;
    train->place = distance;
    if (train->is_cnoidal) train->mean = cnoidal_mean(train);
    for (size_t i = 0; i < train->count; i++) {
        sb_train_part *p = &train->part[i];
        p->near = p->bound ? 0 : sb_paddle_evanescent(train->motion, p->omega, train->depth, train->gravity, distance);
    }
}

double sb_wave_train_surface(const void *state, double t)
{
    const sb_wave_train *train = state;
    if (t <= 0 || t >= train->lasts) return 0;
    double sum = train->is_cnoidal ? cnoidal_elevation(train, t) - train->mean : 0;
    for (size_t i = 0; i < train->count; i++) {
        const sb_train_part *p = &train->part[i];
        const double angle = p->omega * t + p->phase;
        sum += p->amplitude * cos(angle - p->number * train->place) + p->near * p->stroke * sin(angle);
    }
    return ramp_at(train, t) * sum;
}

size_t sb_wave_train_band(const void *state, sb_band_part *band, size_t capacity)
{
    const sb_wave_train *train = state;
    size_t count = 0;
    if (train->count == 0 && capacity > 0) band[count++] = (sb_band_part){2 * M_PI / train->facts.period, 1};
    for (size_t i = 0; i < train->count && count < capacity; i++) {
        const sb_train_part *p = &train->part[i];
        if (!p->bound && p->amplitude > 0) band[count++] = (sb_band_part){p->omega, p->amplitude * p->amplitude};
    }
    return count;
}

const sb_wave_facts *sb_wave_train_facts(const void *state)
{
    return &((const sb_wave_train *)state)->facts;
}

/* Angular frequency of the waves over the rate at which an absorbing paddle forgets levels: its time is 6.4 periods. */
static const double SLOW = 40;

void sb_wave_train_complete(sb_wave_train *train)
{
    sb_wave_facts *facts = &train->facts;
    facts->ramp = train->ramp = train->ramp < 0 ? 2 * facts->period : train->ramp;
    train->origin = train->ramp > 0 ? 0 : full_displacement(train, 0);
    if (!(facts->crest > 0)) facts->crest = crest_of_sum(train);
    facts->slow = 2 * M_PI / facts->period / SLOW;
    facts->depth = train->depth;
    facts->number =
        facts->length > 0 ? 2 * M_PI / facts->length : sb_wave_number(facts->period, train->depth, train->gravity);
    facts->length = 2 * M_PI / facts->number;
    const double linear = 2 * M_PI / sb_wave_number(facts->period, train->depth, train->gravity);
    facts->ursell = facts->height * linear * linear / (train->depth * train->depth * train->depth);
    facts->count = train->count;
    facts->repeats = train->is_cnoidal || train->count == 1 || (train->count == 2 && train->part[1].bound);
}
