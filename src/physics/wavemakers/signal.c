/* Waves whose surface a gauge has measured: their linear Fourier components. */
#include "base/memory.h"
#include "physics/records/wave_heights.h"
#include "physics/wavemakers/number_rows.h"
#include "physics/wavemakers/wave_train.h"

#include <complex.h>
#include <math.h>
#include <stdlib.h>

/* Rows "t eta" at equal steps. */
typedef struct series {
    const double *values; /* 2 per row */
    const size_t *lines;  /* of each row in its file */
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
                           "%.500s:%zu: time %g s follows after %g s, expected equal steps of about %g s", path,
                           s->lines[i], s->values[2 * i], step, expected);
    }
    return SB_OK;
}

/* A gap, which is part of the mean step, is one beside the median; steps of rounded times are equal beside the mean. */
static sb_status check_times(const char *path, series *s, sb_error *error)
{
    for (size_t i = 1; i < s->rows; i++)
        if (!(s->values[2 * i] > s->values[2 * i - 2]))
            return sb_fail(error, SB_BAD_INPUT, "%.500s:%zu: time %g s does not follow %g s, expected increasing times",
                           path, s->lines[i], s->values[2 * i], s->values[2 * i - 2]);
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

/* Calm water in the file lowers the significant height, and neither the highest wave nor its crest. */
static sb_status find_highest(const series *s, sb_wave_facts *facts, sb_error *error)
{
    double *t = sb_alloc(s->rows, sizeof *t), *z = sb_alloc(s->rows, sizeof *z);
    sb_wave_heights heights = {0};
    sb_status status = t && z ? SB_OK : sb_fail_memory(error, "a wave maker");
    for (size_t i = 0; status == SB_OK && i < s->rows; i++) t[i] = s->values[2 * i], z[i] = s->values[2 * i + 1];
    if (status == SB_OK) status = sb_wave_heights_of(t, z, s->rows, &heights, error);
    if (status == SB_OK && heights.count > 0) facts->highest = heights.highest;
    if (status == SB_OK) facts->crest = fmax(facts->crest, heights.crest - heights.level);
    sb_free(t);
    sb_free(z);
    return status;
}

static sb_status create(const sb_wavemaker_parameters *p, void **state, sb_error *error)
{
    sb_number_rows rows;
    sb_status status = sb_number_rows_read(p->file, 2, "time (s) surface (m)", &rows, error);
    series s = {.values = rows.values, .lines = rows.lines, .rows = rows.count};
    if (status == SB_OK) status = prepare(p->file, &s, error);
    sb_wave_train *train = status == SB_OK ? sb_wave_train_create(p, s.rows / 2) : NULL;
    if (status == SB_OK && !train) status = sb_fail_memory(error, "a wave maker");
    if (train) fill_parts(&s, p->distance, train);
    if (status == SB_OK && !(train->facts.height > 0))
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: the surface is constant, expected waves", p->file);
    if (status == SB_OK) status = sb_wave_train_sum(train, p->file, error);
    if (status == SB_OK) status = find_highest(&s, &train->facts, error);
    const double length = s.step * (double)s.rows;
    sb_free(s.turn);
    sb_number_rows_free(&rows);
    if (status != SB_OK) {
        sb_wave_train_destroy(train);
        return status;
    }
    if (train->ramp < 0) train->ramp = 0;
    train->lasts = fmin(train->lasts, length);
    train->facts.theory = "linear sum, by a measured surface";
    sb_wave_train_complete(train);
    *state = train;
    return SB_OK;
}

const sb_wavemaker sb_wavemaker_signal = {
    .name = "signal",
    .summary = "piston that makes the surface of a file at a distance, by linear theory",
    .reference = "Biesel 1951",
    .needs = SB_WM_DEPTH | SB_WM_FILE | SB_WM_DISTANCE | SB_WM_TRAIN,
    .create = create,
    SB_WAVE_TRAIN_LAW,
};
