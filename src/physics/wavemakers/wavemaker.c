/* The table of paddle laws, and the motion of a paddle in scene time. */
#include "physics/wavemakers/wavemaker.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* To add a law, define sb_wavemaker_<name> in a file of its own and add one ROW here. */
#define ROWS(ROW)                                                                                                      \
    ROW(goring)                                                                                                        \
    ROW(goring_rayleigh)                                                                                               \
    ROW(stroke)                                                                                                        \
    ROW(file)                                                                                                          \
    ROW(gate)                                                                                                          \
    ROW(regular)                                                                                                       \
    ROW(irregular)                                                                                                     \
    ROW(components)                                                                                                    \
    ROW(focused)                                                                                                       \
    ROW(signal)                                                                                                        \
    ROW(absorber)

#define DECLARE(name) extern const sb_wavemaker sb_wavemaker_##name;
#define POINT(name) &sb_wavemaker_##name,

ROWS(DECLARE)

const sb_wavemaker *const sb_wavemakers[] = {ROWS(POINT) NULL};

const sb_wavemaker *sb_wavemaker_find(const char *name)
{
    for (const sb_wavemaker *const *row = sb_wavemakers; *row; row++)
        if (strcmp((*row)->name, name) == 0) return *row;
    return NULL;
}

sb_status sb_wavemaker_check(const sb_wavemaker_parameters *parameters, sb_error *error)
{
    const struct {
        unsigned bit;
        const char *name, *unit;
        double value;
    } keys[] = {
        {SB_WM_HEIGHT, "height", "m", parameters->height}, {SB_WM_DEPTH, "depth", "m", parameters->depth},
        {SB_WM_STROKE, "stroke", "m", parameters->stroke}, {SB_WM_SPEED, "speed", "m/s", parameters->speed},
        {SB_WM_PERIOD, "period", "s", parameters->period}, {SB_WM_DISTANCE, "distance", "m", parameters->distance},
        {SB_WM_FOCUS, "focus", "s", parameters->focus},
    };
    const char *law = parameters->kind->name;
    unsigned needs = parameters->kind->needs;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (needs & keys[i].bit && !(keys[i].value > 0 && isfinite(keys[i].value)))
            return sb_fail(error, SB_BAD_INPUT, "wave maker %s: %s is %g %s, expected more than 0", law, keys[i].name,
                           keys[i].value, keys[i].unit);
    if (needs & SB_WM_FILE && !(parameters->file && *parameters->file))
        return sb_fail(error, SB_BAD_INPUT, "wave maker %s: no file, expected a time-displacement table", law);
    if (!(parameters->start > -HUGE_VAL))
        return sb_fail(error, SB_BAD_INPUT, "wave maker %s: start is %g s, expected a number", law, parameters->start);
    if (needs & SB_WM_TRAIN && !(parameters->lasts > 0))
        return sb_fail(error, SB_BAD_INPUT, "wave maker %s: lasts is %g s, expected more than 0", law,
                       parameters->lasts);
    if (needs & SB_WM_TRAIN && !(parameters->gravity > 0))
        return sb_fail(error, SB_BAD_INPUT, "wave maker %s: gravity is %g m/s^2, expected more than 0", law,
                       parameters->gravity);
    if (needs & SB_WM_SPECTRUM && !(parameters->components > 0))
        return sb_fail(error, SB_BAD_INPUT, "wave maker %s: components is %d, expected more than 0", law,
                       parameters->components);
    if (parameters->absorb && !(parameters->reach > 0))
        return sb_fail(error, SB_BAD_INPUT, "wave maker %s: reach is %g m, expected more than 0", law,
                       parameters->reach);
    if (parameters->after == SB_AFTER_RETURN && !(parameters->return_time > 0 && isfinite(parameters->return_time)))
        return sb_fail(error, SB_BAD_INPUT, "wave maker %s: return_time is %g s, expected more than 0", law,
                       parameters->return_time);
    return SB_OK;
}

sb_status sb_paddle_create(const sb_wavemaker_parameters *parameters, sb_paddle *paddle, sb_error *error)
{
    sb_status status = sb_wavemaker_check(parameters, error);
    if (status != SB_OK) return status;
    sb_paddle made = {.kind = parameters->kind,
                      .start = parameters->start,
                      .after = parameters->after,
                      .return_time = parameters->return_time};
    status = made.kind->create(parameters, &made.state, error);
    if (status != SB_OK) return status;
    made.duration = made.kind->duration(made.state);
    made.stroke_end = isfinite(made.duration) ? made.kind->displacement(made.state, made.duration) : 0;
    *paddle = made;
    return SB_OK;
}

/* The return motion is S (1 - 3s^2 + 2s^3), where s is the fraction of return_time that has passed. The paddle is at
   rest at both ends; its largest speed is 1.5 S/return_time. */
double sb_paddle_displacement(const sb_paddle *paddle, double t)
{
    t -= paddle->start;
    if (t <= 0) return 0;
    if (t < paddle->duration) return paddle->kind->displacement(paddle->state, t);
    if (paddle->after == SB_AFTER_STAY) return paddle->stroke_end;
    double s = (t - paddle->duration) / paddle->return_time;
    return s < 1 ? paddle->stroke_end * (1 - s * s * (3 - 2 * s)) : 0;
}

double sb_paddle_celerity(const sb_wavemaker_parameters *parameters, const sb_paddle *paddle)
{
    if (parameters->kind->needs == (SB_WM_HEIGHT | SB_WM_DEPTH)) /* solitary waves */
        return sqrt(parameters->gravity * (parameters->depth + parameters->height));
    if (!(parameters->kind->needs & SB_WM_THEORY)) return 0;
    const sb_wave_facts *facts = parameters->kind->facts(paddle->state);
    return facts->length / facts->period;
}

void sb_paddle_destroy(sb_paddle *paddle)
{
    if (paddle->kind) paddle->kind->destroy(paddle->state);
    *paddle = (sb_paddle){0};
}

sb_band_part *sb_paddle_band(const sb_paddle *paddle, size_t *count)
{
    const size_t most = paddle->kind->facts(paddle->state)->count + 1;
    sb_band_part *band = sb_alloc(most, sizeof *band);
    *count = band ? paddle->kind->band(paddle->state, band, most) : 0;
    return band;
}

sb_status sb_paddle_fit_absorption(const sb_wavemaker_parameters *parameters, sb_paddle *paddle, double distance,
                                   sb_absorbing_filter *filter, sb_error *error)
{
    size_t count;
    sb_band_part *band = sb_paddle_band(paddle, &count);
    if (!band) return sb_fail_memory(error, "an absorbing paddle");
    double near = 0, all = 0; /* weights of the waves that are longer than four times the distance, and of all */
    for (size_t i = 0; i < count; i++) {
        const double k = sb_wave_number(2 * M_PI / band[i].omega, parameters->depth, parameters->gravity);
        all += band[i].weight;
        if (k * distance < M_PI / 2) near += band[i].weight;
    }
    paddle->kind->place(paddle->state, distance);
    *filter = sb_absorbing_filter_of(parameters->motion, band, count, paddle->kind->facts(paddle->state)->slow,
                                     parameters->depth, parameters->gravity, distance);
    sb_free(band);
    if (filter->gain > 0 && isfinite(filter->gain) && near >= 0.5 * all) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "absorb: its water is measured %g m ahead of the paddle, and most of its waves are shorter than "
                   "four times that, expected a finer resolution, longer waves, or absorb: false",
                   distance);
}

double sb_paddle_reflection(const sb_wavemaker_parameters *parameters, const sb_paddle *paddle,
                            const sb_absorbing_filter *filter, double distance)
{
    size_t count;
    double sum = 0, energy = 0;
    sb_band_part *band = sb_paddle_band(paddle, &count);
    if (!band) return (double)NAN;
    for (size_t i = 0; i < count; i++) {
        const double share = sb_absorbing_reflection(filter, parameters->motion, band[i].omega, parameters->depth,
                                                     parameters->gravity, distance);
        sum += band[i].weight * share * share;
        energy += band[i].weight;
    }
    sb_free(band);
    return sqrt(sum / energy);
}
