/* Waves that a file lists: a sum of linear waves. */
#include "base/memory.h"
#include "physics/wavemakers/number_rows.h"
#include "physics/wavemakers/wave_train.h"
#include "physics/waves/regular_wave.h"

#include <complex.h>
#include <math.h>

static sb_status check_wave(const sb_wavemaker_parameters *p, size_t line, const double v[3], sb_error *error)
{
    sb_regular_wave wave;
    sb_error why = {0};
    if (!(v[0] >= 0 && v[1] > 0))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s:%zu: a wave has the amplitude %g m and the period %g s, expected >= 0 and > 0", p->file,
                       line, v[0], v[1]);
    if (v[0] == 0 || sb_regular_wave_create(SB_WAVE_LINEAR, 2 * v[0], v[1], p->depth, p->gravity, &wave, &why) == SB_OK)
        return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %.300s", p->file, line, why.text);
}

/* The part of that frequency; train->count: there is none. */
static size_t part_of(const sb_wave_train *train, double omega)
{
    size_t i = 0;
    while (i < train->count && train->part[i].omega != omega) i++;
    return i;
}

/* Adds a row's wave; rows of one period are one wave. */
static void add_wave(sb_wave_train *train, const double v[3])
{
    const double omega = 2 * M_PI / v[1], phase = v[2] * M_PI / 180;
    const size_t i = part_of(train, omega);
    if (i == train->count) {
        sb_wave_train_set(train, train->count++, v[0], omega, phase);
        return;
    }
    const sb_train_part *part = &train->part[i];
    const double complex sum = part->amplitude * cexp(CMPLX(0, part->phase)) + v[0] * cexp(CMPLX(0, phase));
    sb_wave_train_set(train, i, cabs(sum), omega, carg(sum));
}

/* Each step sums them. */
enum { ROWS_MAX = 10000 };

/* Share of the amplitudes that is left of waves that cancel. */
static const double NOTHING = 1e-9;

static sb_status create(const sb_wavemaker_parameters *p, void **state, sb_error *error)
{
    double highest = 0, sum = 0;
    sb_number_rows rows;
    sb_status status = sb_number_rows_read(p->file, 3, "amplitude (m) period (s) phase (degrees)", &rows, error);
    if (status != SB_OK) return status;
    if (rows.count > ROWS_MAX)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: %zu waves, expected at most %d", p->file,
                         rows.lines[ROWS_MAX], rows.count, ROWS_MAX);
    const double *values = rows.values;
    for (size_t i = 0; i < rows.count && status == SB_OK; i++)
        status = check_wave(p, rows.lines[i], values + 3 * i, error);
    sb_wave_train *train = status == SB_OK ? sb_wave_train_create(p, rows.count) : NULL;
    if (status == SB_OK && !train) status = sb_fail_memory(error, "a wave maker");
    if (train) train->count = 0;
    for (size_t i = 0; train && i < rows.count; i++) add_wave(train, values + 3 * i);
    for (size_t i = 0; train && i < rows.count; i++) {
        const double period = values[3 * i + 1], amplitude = train->part[part_of(train, 2 * M_PI / period)].amplitude;
        if (amplitude >= highest) train->facts.period = period;
        highest = fmax(highest, amplitude);
        sum += values[3 * i];
    }
    sb_number_rows_free(&rows);
    if (status == SB_OK && !(highest > NOTHING * sum))
        status =
            sb_fail(error, SB_BAD_INPUT, "%.500s: all amplitudes are 0, alone or together, expected a wave", p->file);
    if (status == SB_OK) status = sb_wave_train_sum(train, p->file, error);
    if (status != SB_OK) {
        sb_wave_train_destroy(train);
        return status;
    }
    train->facts.theory = "linear sum";
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

const sb_wavemaker sb_wavemaker_components = {
    .name = "components",
    .summary = "piston for a sum of linear waves listed in a file",
    .reference = "Biesel 1951",
    .needs = SB_WM_DEPTH | SB_WM_FILE | SB_WM_TRAIN,
    .create = create,
    SB_WAVE_TRAIN_LAW,
};
