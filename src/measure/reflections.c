/* Incident and reflected waves from gauges in a line: sums of a fit per gauge grow with each row, and are solved and
   split at the end of a window. */
#include "base/memory.h"
#include "measure/state.h"
#include "physics/dispersion.h"
#include "physics/reflection.h"

static size_t sums_of(const sb_reflection_set *set)
{
    return set->gauge_count * sb_harmonics_size(set->harmonics);
}

sb_status sb_reflections_create(sb_measure *measure, sb_error *error)
{
    const sb_measure_settings *settings = &measure->scene->measure;
    if (!settings->reflection_count) return SB_OK;
    for (size_t i = 0; i < settings->reflection_count; i++)
        measure->split_count += (size_t)settings->reflections[i].harmonics;
    measure->splits = sb_alloc(settings->reflection_count, sizeof *measure->splits);
    measure->split_rows = sb_alloc(measure->split_count, sizeof *measure->split_rows);
    if (!measure->splits || !measure->split_rows) return sb_fail_memory(error, "measure.reflections");
    sb_reflection_record *rows = measure->split_rows;
    for (size_t i = 0; i < settings->reflection_count; i++) {
        const sb_reflection_set *set = &settings->reflections[i];
        split_state *state = &measure->splits[i];
        state->from = set->start;
        state->sums = sb_alloc(sums_of(set), sizeof(double));
        state->latest = rows;
        rows += set->harmonics;
        if (!state->sums) return sb_fail_memory(error, "measure.reflections");
    }
    return SB_OK;
}

void sb_reflections_destroy(sb_measure *measure)
{
    for (size_t i = 0; measure->splits && i < measure->scene->measure.reflection_count; i++)
        sb_free(measure->splits[i].sums);
    sb_free(measure->splits);
    sb_free(measure->split_rows);
}

/* Memory for the solution of one window. */
typedef struct scratch {
    double *sums, *places, *cosines, *sines; /* the last two: gauges times harmonics */
    double *cosine, *sine;                   /* of one harmonic */
} scratch;

static void free_scratch(scratch *s)
{
    sb_free(s->sums);
    sb_free(s->places);
    sb_free(s->cosines);
    sb_free(s->sines);
    sb_free(s->cosine);
    sb_free(s->sine);
}

static bool make_scratch(const sb_reflection_set *set, scratch *s)
{
    const size_t all = set->gauge_count * (size_t)set->harmonics;
    s->sums = sb_alloc(sb_harmonics_size(set->harmonics), sizeof(double));
    s->places = sb_alloc(set->gauge_count, sizeof(double));
    s->cosines = sb_alloc(all, sizeof(double));
    s->sines = sb_alloc(all, sizeof(double));
    s->cosine = sb_alloc(set->gauge_count, sizeof(double));
    s->sine = sb_alloc(set->gauge_count, sizeof(double));
    return s->sums && s->places && s->cosines && s->sines && s->cosine && s->sine;
}

/* Fits the gauges. A gauge that was dry too long to be fitted is left out; returns the number of the others. */
static size_t fit_gauges(const sb_measure *measure, const sb_reflection_set *set, const split_state *state, scratch *s)
{
    const size_t n = (size_t)set->harmonics, size = sb_harmonics_size(set->harmonics);
    size_t fitted = 0;
    for (size_t g = 0; g < set->gauge_count; g++) {
        if (!sb_harmonics_solve(state->sums + g * size, set->harmonics, s->sums, s->cosines + fitted * n,
                                s->sines + fitted * n))
            continue;
        s->places[fitted++] = sb_reflection_place(measure->scene, set, g);
    }
    return fitted;
}

static sb_status finish_window(sb_measure *measure, size_t index, double time, sb_error *error)
{
    const sb_reflection_set *set = &measure->scene->measure.reflections[index];
    split_state *state = &measure->splits[index];
    scratch s = {0};
    if (!make_scratch(set, &s)) {
        free_scratch(&s);
        return sb_fail_memory(error, "measure.reflections");
    }
    const size_t fitted = fit_gauges(measure, set, state, &s), n = (size_t)set->harmonics;
    for (size_t h = 0; h < n; h++) {
        const double period = set->period / (double)(h + 1);
        const double number = sb_wave_number(period, set->depth, measure->scene->fluid.gravity);
        for (size_t g = 0; g < fitted; g++) {
            s.cosine[g] = s.cosines[g * n + h];
            s.sine[g] = s.sines[g * n + h];
        }
        const double none = (double)NAN;
        const sb_split split =
            fitted < 2 ? (sb_split){none, none, none, none} : sb_split_of(s.places, s.cosine, s.sine, fitted, number);
        state->latest[h] = (sb_reflection_record){.set = index,
                                                  .harmonic = h + 1,
                                                  .from = state->from,
                                                  .time = time,
                                                  .period = period,
                                                  .wavelength = 2 * M_PI / number,
                                                  .incident = split.incident,
                                                  .reflected = split.reflected,
                                                  .misfit = split.misfit,
                                                  .separation = split.separation};
    }
    free_scratch(&s);
    return SB_OK;
}

sb_status sb_reflections_add(sb_measure *measure, size_t index, const sb_gauge_record *gauges, double time,
                             bool *finished, sb_error *error)
{
    const sb_scene *scene = measure->scene;
    const sb_reflection_set *set = &scene->measure.reflections[index];
    split_state *state = &measure->splits[index];
    const double slack = 1e-9 * measure->interval;
    *finished = false;
    if (time < state->from - slack) return SB_OK;
    const size_t size = sb_harmonics_size(set->harmonics);
    for (size_t g = 0; g < set->gauge_count; g++) {
        const double z = gauges[sb_scene_gauge(scene, set->gauges[g].name)].z;
        if (!isnan(z)) sb_harmonics_add(state->sums + g * size, set->harmonics, 2 * M_PI / set->period, time, z);
    }
    /* Without windows the last row of the run ends it; a run that is made longer later goes on. */
    *finished = set->window > 0 ? time >= state->from + set->window - slack
                                : time + measure->interval > scene->duration + slack;
    if (!*finished) return SB_OK;
    sb_status status = finish_window(measure, index, time, error);
    if (set->window > 0) {
        state->from += set->window;
        for (size_t i = 0; i < sums_of(set); i++) state->sums[i] = 0;
    }
    return status;
}

const sb_reflection_record *sb_measure_reflections(const sb_measure *measure, size_t *count)
{
    *count = measure->split_count;
    return measure->split_rows;
}

void sb_reflections_save(const sb_measure *measure, sb_archive_out *out)
{
    sb_put_count(out, measure->scene->measure.reflection_count);
    for (size_t i = 0; i < measure->scene->measure.reflection_count; i++) {
        const sb_reflection_set *set = &measure->scene->measure.reflections[i];
        const split_state *state = &measure->splits[i];
        sb_put_real(out, state->from);
        sb_put_list(out, state->sums, sums_of(set), sizeof(double));
        for (int h = 0; h < set->harmonics; h++) {
            const sb_reflection_record *last = &state->latest[h];
            const double values[] = {last->from,     last->time,      last->period, last->wavelength,
                                     last->incident, last->reflected, last->misfit, last->separation};
            sb_put_list(out, values, sizeof values / sizeof *values, sizeof *values);
        }
    }
}

void sb_reflections_load(sb_measure *measure, sb_archive_in *in)
{
    const size_t count = measure->scene->measure.reflection_count;
    if (sb_take_count(in, SIZE_MAX) != count)
        sb_archive_refuse(in, "a different number of reflections, expected %zu", count);
    for (size_t i = 0; i < count; i++) {
        const sb_reflection_set *set = &measure->scene->measure.reflections[i];
        split_state *state = &measure->splits[i];
        state->from = sb_take_real(in);
        sb_take_list(in, state->sums, sums_of(set), sizeof(double));
        for (int h = 0; h < set->harmonics; h++) {
            double v[8] = {0};
            sb_take_list(in, v, sizeof v / sizeof *v, sizeof *v);
            state->latest[h] = (sb_reflection_record){.set = i,
                                                      .harmonic = (size_t)h + 1,
                                                      .from = v[0],
                                                      .time = v[1],
                                                      .period = v[2],
                                                      .wavelength = v[3],
                                                      .incident = v[4],
                                                      .reflected = v[5],
                                                      .misfit = v[6],
                                                      .separation = v[7]};
        }
    }
}
