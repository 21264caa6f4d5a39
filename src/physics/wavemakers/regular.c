/* Regular waves: a paddle by linear theory, a piston by second-order theory [Madsen 1971; Schaeffer 1996], and a piston
   that follows the water of a cnoidal wave [Goring 1978]. The piston of second order makes the first harmonic of a
   steady wave [Rienecker and Fenton 1981]. */
#include "physics/wavemakers/paddle_second.h"
#include "physics/wavemakers/paddle_third.h"
#include "physics/wavemakers/wave_train.h"
#include "physics/waves/regular_wave.h"
#include "physics/waves/steady_wave.h"

#include <math.h>

static const char *const theory_names[] = {
    [SB_WAVE_LINEAR] = "linear", [SB_WAVE_STOKES2] = "second-order", [SB_WAVE_CNOIDAL] = "cnoidal"};

static sb_status find_wave(const sb_wavemaker_parameters *p, sb_regular_wave *wave, sb_error *error)
{
    const bool flap = p->motion == SB_PADDLE_FLAP;
    if (flap && p->theory != SB_WAVE_AUTO && p->theory != SB_WAVE_LINEAR)
        return sb_fail(error, SB_BAD_INPUT,
                       "theory: %s waves are made by a piston, expected linear or auto for a flap, or motion: piston",
                       theory_names[p->theory]);
    return sb_regular_wave_create(flap ? SB_WAVE_LINEAR : p->theory, p->height, p->period, p->depth, p->gravity, wave,
                                  error);
}

/* kd beyond which water is deep for a steady wave, too. */
static const double DEEP = 10;

/* Finds the steady wave of the height, or the highest one below it, and returns the share of the height that it has.
   0: none from 0.7 of the height on. */
static double find_steady(const sb_regular_wave *wave, sb_steady_wave *steady)
{
    enum { HALVINGS = 6 };
    const double depth = fmin(wave->depth, DEEP / wave->number);
    double low = 0.7, high = 1;
    sb_steady_wave tried;
    if (sb_steady_wave_of(wave->height, wave->period, depth, wave->gravity, steady)) return 1;
    if (!sb_steady_wave_of(low * wave->height, wave->period, depth, wave->gravity, steady)) return 0;
    for (int i = 0; i < HALVINGS; i++) {
        const double share = 0.5 * (low + high);
        const bool found = sb_steady_wave_of(share * wave->height, wave->period, depth, wave->gravity, &tried);
        if (found) *steady = tried;
        *(found ? &low : &high) = share;
    }
    return low;
}

/* A steady wave of the height H has a first harmonic below H/2. Returns the amplitude of linear theory for which the
   piston makes it; near breaking the harmonic has the same share of H as that of the highest wave that is found. Where
   there is none: H/2. */
static double linear_amplitude(const sb_regular_wave *wave, bool *steep)
{
    sb_steady_wave steady;
    const double share = find_steady(wave, &steady);
    if (!(share > 0)) return 0.5 * wave->height;
    return sb_paddle_third_amplitude(steady.first / share, wave->number, wave->depth, steep);
}

static void set_second_order(sb_wave_train *train, const sb_regular_wave *wave)
{
    const double omega = 2 * M_PI / wave->period, linear = linear_amplitude(wave, NULL);
    sb_wave_train_set(train, 0, linear, omega, 0);
    /* s sin(2 omega t + ahead) = Re(-i s exp(i ahead) exp(2 i omega t)) */
    const double complex second = CMPLX(0, 1) * sb_paddle_second(2 * linear, omega, wave->depth, wave->gravity);
    train->part[1] = (sb_train_part){.omega = 2 * omega,
                                     .stroke = cabs(second),
                                     .ahead = carg(second),
                                     .amplitude = wave->second * pow(2 * linear / wave->height, 2),
                                     .number = 2 * wave->number,
                                     .bound = true};
}

static sb_status create(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    sb_regular_wave wave;
    sb_status status = find_wave(parameters, &wave, error);
    if (status != SB_OK) return status;
    const size_t parts = wave.order == SB_WAVE_CNOIDAL ? 0 : wave.order == SB_WAVE_STOKES2 ? 2 : 1;
    sb_wave_train *train = sb_wave_train_create(parameters, parts);
    if (!train) return sb_fail_memory(error, "a wave maker");
    if (parts == 1) sb_wave_train_set(train, 0, 0.5 * wave.height, 2 * M_PI / wave.period, 0);
    if (parts == 2) set_second_order(train, &wave);
    train->is_cnoidal = wave.order == SB_WAVE_CNOIDAL;
    train->cnoidal = wave.cnoidal;
    train->facts = (sb_wave_facts){.theory = theory_names[wave.order],
                                   .height_name = "height",
                                   .height = wave.height,
                                   .crest = sb_regular_wave_crest(&wave),
                                   .period = wave.period,
                                   .length = wave.length};
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

static const char *warning(const sb_wavemaker_parameters *parameters)
{
    sb_regular_wave wave;
    if (find_wave(parameters, &wave, NULL) != SB_OK || wave.order == SB_WAVE_CNOIDAL) return NULL;
    if (wave.order == SB_WAVE_STOKES2) {
        bool steep = false;
        linear_amplitude(&wave, &steep);
        return steep ? "so steep that the waves may break at the paddle, or come out several per cent too low; a lower "
                       "height is made within 3 per cent"
                     : NULL;
    }
    if (wave.ursell < SB_URSELL_LIMIT) return NULL;
    return parameters->motion == SB_PADDLE_FLAP
               ? "linear theory, but H L^2/d^3 is above 26.3: free waves of twice the frequency will come with the "
                 "waves; motion: piston makes cnoidal waves"
               : "linear theory, but H L^2/d^3 is above 26.3: free waves of twice the frequency will come with the "
                 "waves; theory: auto makes cnoidal waves";
}

const sb_wavemaker sb_wavemaker_regular = {
    .name = "regular",
    .summary = "piston for regular waves: linear, second order, or cnoidal",
    .reference = "Biesel 1951; Madsen 1971; Schaeffer 1996; Rienecker and Fenton 1981; Goring 1978",
    .needs = SB_WM_HEIGHT | SB_WM_DEPTH | SB_WM_PERIOD | SB_WM_THEORY | SB_WM_TRAIN,
    .create = create,
    .warning = warning,
    SB_WAVE_TRAIN_LAW,
};

/* A paddle at rest that only absorbs. */
static sb_status create_absorber(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    if (!parameters->absorb) return sb_fail(error, SB_BAD_INPUT, "absorb: false, expected true for an absorber");
    sb_wave_train *train = sb_wave_train_create(parameters, 0);
    if (!train) return sb_fail_memory(error, "a wave maker");
    train->facts = (sb_wave_facts){.theory = "at rest", .height_name = "height", .period = parameters->period};
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

const sb_wavemaker sb_wavemaker_absorber = {
    .name = "absorber",
    .summary = "piston at rest that absorbs the waves that reach it",
    .reference = "Biesel 1951; docs/waves.md",
    .needs = SB_WM_DEPTH | SB_WM_PERIOD | SB_WM_TRAIN,
    .create = create_absorber,
    SB_WAVE_TRAIN_LAW,
};
