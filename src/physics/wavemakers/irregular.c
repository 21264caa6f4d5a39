/* Irregular and focused waves: sums of linear waves by a spectrum. */
#include "base/memory.h"
#include "physics/wavemakers/wave_train.h"

#include <math.h>

static const char *const names[] = {
    [SB_SPECTRUM_JONSWAP] = "linear sum, JONSWAP", [SB_SPECTRUM_PIERSON_MOSKOWITZ] = "linear sum, Pierson-Moskowitz"};

/* Refuses a spectrum whose significant height breaks at its peak. */
static sb_status check_height(const sb_wavemaker_parameters *p, const char *what, sb_error *error)
{
    sb_regular_wave wave;
    sb_error why = {0};
    if (sb_regular_wave_create(SB_WAVE_LINEAR, p->height, p->period, p->depth, p->gravity, &wave, &why) == SB_OK)
        return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%s: %s", what, why.text);
}

static sb_status make_train(const sb_wavemaker_parameters *p, const char *height_name, sb_spectral_wave **waves,
                            sb_wave_train **train, sb_error *error)
{
    const size_t count = (size_t)p->components;
    sb_status status = check_height(p, height_name, error);
    if (status != SB_OK) return status;
    *waves = sb_alloc(count, sizeof **waves);
    *train = *waves ? sb_wave_train_create(p, count) : NULL;
    if (!*train) {
        sb_free(*waves);
        return sb_fail_memory(error, "a wave maker");
    }
    sb_spectrum_waves(p->spectrum, p->gamma, p->height, p->period, p->seed, *waves, count);
    (*train)->facts = (sb_wave_facts){
        .theory = names[p->spectrum], .height_name = height_name, .height = p->height, .period = p->period};
    return SB_OK;
}

static sb_status create_irregular(const sb_wavemaker_parameters *p, void **state, sb_error *error)
{
    sb_spectral_wave *waves;
    sb_wave_train *train;
    sb_status status = make_train(p, "significant height", &waves, &train, error);
    if (status != SB_OK) return status;
    for (size_t i = 0; i < train->count; i++)
        sb_wave_train_set(train, i, waves[i].amplitude, 2 * M_PI * waves[i].frequency, waves[i].phase);
    sb_free(waves);
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

/* The most probable form of a high crest: amplitudes in proportion to the energies, crests of all parts at one place
   and time [Tromans, Anaturk and Hagemeijer 1991]. */
static sb_status create_focused(const sb_wavemaker_parameters *p, void **state, sb_error *error)
{
    sb_spectral_wave *waves;
    sb_wave_train *train;
    sb_status status = make_train(p, "twice the crest", &waves, &train, error);
    if (status != SB_OK) return status;
    double energy = 0;
    for (size_t i = 0; i < train->count; i++) energy += waves[i].amplitude * waves[i].amplitude;
    for (size_t i = 0; i < train->count; i++) {
        const double amplitude = 0.5 * p->height * waves[i].amplitude * waves[i].amplitude / energy;
        const double omega = 2 * M_PI * waves[i].frequency;
        sb_wave_train_set(train, i, amplitude, omega, 0);
        train->part[i].phase = remainder(train->part[i].number * p->distance - omega * p->focus, 2 * M_PI);
    }
    sb_free(waves);
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

const sb_wavemaker sb_wavemaker_irregular = {
    .name = "irregular",
    .summary = "piston for random waves of a JONSWAP or Pierson-Moskowitz spectrum",
    .reference = "Hasselmann et al. 1973; Pierson & Moskowitz 1964; Biesel 1951",
    .needs = SB_WM_HEIGHT | SB_WM_DEPTH | SB_WM_PERIOD | SB_WM_SPECTRUM | SB_WM_SEED | SB_WM_TRAIN,
    .create = create_irregular,
    SB_WAVE_TRAIN_LAW,
};

const sb_wavemaker sb_wavemaker_focused = {
    .name = "focused",
    .summary = "piston for a wave group that focuses at a place and time (NewWave)",
    .reference = "Tromans, Anaturk & Hagemeijer 1991; Biesel 1951",
    .needs = SB_WM_HEIGHT | SB_WM_DEPTH | SB_WM_PERIOD | SB_WM_SPECTRUM | SB_WM_DISTANCE | SB_WM_FOCUS | SB_WM_TRAIN,
    .create = create_focused,
    SB_WAVE_TRAIN_LAW,
};
