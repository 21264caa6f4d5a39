/* Waves by a table: a list of linear waves, or the surface that a gauge has measured. */
#include "base/memory.h"
#include "physics/breaking.h"
#include "physics/number_rows.h"
#include "physics/wave_train.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

/* The waves of a train together, by the rule of irregular waves. *height: of the sum, m. */
static sb_status check_sum(const sb_wavemaker_parameters *p, const sb_wave_train *train, double *height,
                           sb_error *error)
{
    sb_sum_height all = {0};
    sb_error why = {0};
    for (size_t i = 0; i < train->count; i++) sb_sum_height_add(&all, train->part[i].amplitude, train->part[i].number);
    *height = sb_sum_height_of(&all);
    if (sb_sum_height_check(&all, p->depth, &why) == SB_OK) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s: %.300s", p->file, why.text);
}

static sb_status check_wave(const sb_wavemaker_parameters *p, size_t row, const double v[3], sb_error *error)
{
    sb_regular_wave wave;
    sb_error why = {0};
    if (!(v[0] >= 0 && v[1] > 0))
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: wave %zu has the amplitude %g m and the period %g s, expected >= 0 "
                       "and > 0",
                       p->file, row + 1, v[0], v[1]);
    if (v[0] == 0 || sb_regular_wave_create(SB_WAVE_LINEAR, 2 * v[0], v[1], p->depth, p->gravity, &wave, &why) == SB_OK)
        return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s: wave %zu: %.300s", p->file, row + 1, why.text);
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

/* Share of the amplitudes that is left of waves that cancel. */
static const double NOTHING = 1e-9;

static sb_status create_components(const sb_wavemaker_parameters *p, void **state, sb_error *error)
{
    double *values = NULL, highest = 0, sum = 0;
    size_t rows = 0;
    sb_status status =
        sb_number_rows_read(p->file, 3, "amplitude (m) period (s) phase (degrees)", &values, &rows, error);
    if (status != SB_OK) return status;
    for (size_t i = 0; i < rows && status == SB_OK; i++) status = check_wave(p, i, values + 3 * i, error);
    sb_wave_train *train = status == SB_OK ? sb_wave_train_create(p, rows) : NULL;
    if (status == SB_OK && !train) status = sb_fail_memory(error, "a wave maker");
    if (train) train->count = 0;
    for (size_t i = 0; train && i < rows; i++) add_wave(train, values + 3 * i);
    for (size_t i = 0; train && i < rows; i++) {
        const double period = values[3 * i + 1], amplitude = train->part[part_of(train, 2 * M_PI / period)].amplitude;
        if (amplitude >= highest) train->facts.period = period;
        highest = fmax(highest, amplitude);
        sum += values[3 * i];
    }
    sb_free(values);
    if (status == SB_OK && !(highest > NOTHING * sum))
        status =
            sb_fail(error, SB_BAD_INPUT, "%.500s: all amplitudes are 0, alone or together, expected a wave", p->file);
    if (status == SB_OK) status = check_sum(p, train, &train->facts.height, error);
    if (status != SB_OK) {
        sb_wave_train_destroy(train);
        return status;
    }
    train->facts.theory = "linear sum";
    train->facts.height_name = "significant height";
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

/* Rows "t eta" at equal steps. */
typedef struct series {
    double *values;       /* 2 per row */
    double complex *turn; /* exp(-2 pi i k/rows) for row k */
    size_t rows;
    double step; /* s */
} series;

enum { LEAST_ROWS = 8, MOST_ROWS = 20000 };

static int compare_steps(const void *a, const void *b)
{
    const double one = *(const double *)a, other = *(const double *)b;
    return (one > other) - (one < other);
}

/* Whether all steps are `expected` s within a share of it. */
static sb_status check_steps(const char *path, const series *s, double expected, double share, sb_error *error)
{
    for (size_t i = 1; i < s->rows; i++) {
        const double step = s->values[2 * i] - s->values[2 * i - 2];
        if (fabs(step - expected) > share * expected)
            return sb_fail(error, SB_BAD_INPUT,
                           "%.500s: row %zu, of %g s, follows after %g s, expected equal steps of about %g s", path,
                           i + 1, s->values[2 * i], step, expected);
    }
    return SB_OK;
}

/* A gap, which is part of the mean step, is one beside the median; steps of rounded times are equal beside the mean. */
static sb_status check_times(const char *path, series *s, sb_error *error)
{
    for (size_t i = 1; i < s->rows; i++)
        if (!(s->values[2 * i] > s->values[2 * i - 2]))
            return sb_fail(error, SB_BAD_INPUT,
                           "%.500s: row %zu: time %g s does not follow %g s, expected increasing times", path, i + 1,
                           s->values[2 * i], s->values[2 * i - 2]);
    s->step = (s->values[2 * (s->rows - 1)] - s->values[0]) / (double)(s->rows - 1);
    double *steps = sb_alloc(s->rows - 1, sizeof *steps);
    if (!steps) return sb_fail_memory(error, path);
    for (size_t i = 1; i < s->rows; i++) steps[i - 1] = s->values[2 * i] - s->values[2 * i - 2];
    qsort(steps, s->rows - 1, sizeof *steps, compare_steps);
    const double usual = steps[(s->rows - 1) / 2];
    sb_free(steps);
    const sb_status status = check_steps(path, s, usual, 0.5, error);
    return status == SB_OK ? check_steps(path, s, s->step, 0.02, error) : status;
}

/* Checks the rows and prepares their transform. */
static sb_status prepare(const char *path, series *s, sb_error *error)
{
    if (s->rows < LEAST_ROWS || s->rows > MOST_ROWS)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: %zu rows, expected %d to %d", path, s->rows, LEAST_ROWS,
                       MOST_ROWS);
    /* The mean of equal values is rounded, so that its Fourier components are not 0. */
    bool constant = true;
    for (size_t i = 1; i < s->rows && constant; i++) constant = s->values[2 * i + 1] == s->values[1];
    if (constant) return sb_fail(error, SB_BAD_INPUT, "%.500s: the surface is constant, expected waves", path);
    const sb_status status = check_times(path, s, error);
    if (status != SB_OK) return status;
    s->turn = sb_alloc(s->rows, sizeof *s->turn);
    if (!s->turn) return sb_fail_memory(error, path);
    for (size_t k = 0; k < s->rows; k++) s->turn[k] = cexp(CMPLX(0, -2 * M_PI * (double)k / (double)s->rows));
    return SB_OK;
}

/* The Fourier coefficient n of the series less its mean: A in Re(A exp(2 pi i n t/T)), T = rows * step. */
static double complex coefficient(const series *s, size_t n, double mean)
{
    double complex sum = 0;
    for (size_t i = 0, at = 0; i < s->rows; i++, at = (at + n) % s->rows)
        sum += (s->values[2 * i + 1] - mean) * s->turn[at];
    return (2 * n == s->rows ? 1.0 : 2.0) / (double)s->rows * sum;
}

/* Share of the series' energy that may be left out at high frequencies: noise of the gauge, which asks for much speed.
 */
static const double LEFT_OUT = 1e-4;

/* Fills the parts with the lowest frequencies, until all but LEFT_OUT of the energy is in them. */
static void fill_parts(const series *s, double distance, sb_wave_train *train)
{
    double mean = 0, energy = 0, sum = 0, highest = 0;
    for (size_t i = 0; i < s->rows; i++) mean += s->values[2 * i + 1] / (double)s->rows;
    for (size_t i = 0; i < s->rows; i++) energy += pow(s->values[2 * i + 1] - mean, 2) * 2 / (double)s->rows;
    const double length = s->step * (double)s->rows;
    const size_t most = train->count;
    train->count = 0;
    for (size_t n = 1; n <= most && sum < (1 - LEFT_OUT) * energy; n++) {
        const double complex a = coefficient(s, n, mean);
        const double amplitude = cabs(a), omega = 2 * M_PI * (double)n / length;
        sb_wave_train_set(train, n - 1, amplitude, omega, 0);
        train->part[n - 1].phase = remainder(carg(a) + train->part[n - 1].number * distance, 2 * M_PI);
        train->count = n;
        sum += amplitude * amplitude;
        if (amplitude > highest) train->facts.period = length / (double)n;
        highest = fmax(highest, amplitude);
    }
    train->facts.height = sqrt(8 * sum);
}

static sb_status create_signal(const sb_wavemaker_parameters *p, void **state, sb_error *error)
{
    series s = {0};
    sb_status status = sb_number_rows_read(p->file, 2, "time (s) surface (m)", &s.values, &s.rows, error);
    if (status == SB_OK) status = prepare(p->file, &s, error);
    sb_wave_train *train = status == SB_OK ? sb_wave_train_create(p, s.rows / 2) : NULL;
    if (status == SB_OK && !train) status = sb_fail_memory(error, "a wave maker");
    if (train) fill_parts(&s, p->distance, train);
    if (status == SB_OK && !(train->facts.height > 0))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: the surface is constant, expected waves", p->file);
    if (status == SB_OK) status = check_sum(p, train, &train->facts.height, error);
    const double length = s.step * (double)s.rows;
    sb_free(s.turn);
    sb_free(s.values);
    if (status != SB_OK) {
        sb_wave_train_destroy(train);
        return status;
    }
    if (train->ramp < 0) train->ramp = 0;
    train->lasts = fmin(train->lasts, length);
    train->facts.theory = "linear sum, by a measured surface";
    train->facts.height_name = "significant height";
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

const sb_wavemaker sb_wavemaker_components = {
    .name = "components",
    .summary = "piston for a sum of linear waves listed in a file",
    .reference = "Biesel 1951",
    .needs = SB_WM_DEPTH | SB_WM_FILE | SB_WM_TRAIN,
    .create = create_components,
    SB_WAVE_TRAIN_LAW,
};

const sb_wavemaker sb_wavemaker_signal = {
    .name = "signal",
    .summary = "piston that makes the surface of a file at a distance, by linear theory",
    .reference = "Biesel 1951",
    .needs = SB_WM_DEPTH | SB_WM_FILE | SB_WM_DISTANCE | SB_WM_TRAIN,
    .create = create_signal,
    SB_WAVE_TRAIN_LAW,
};
