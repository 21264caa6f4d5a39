/* Incident and reflected waves from gauges in a line: sums of a fit per gauge grow with each row, and are solved and
   split at the end of a window. */
#include "base/memory.h"
#include "measure/state.h"
#include "physics/records/reflection.h"

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
    for (size_t i = 0; i < settings->reflection_count; i++) {
        const sb_reflection_set *set = &settings->reflections[i];
        split_state *state = &measure->splits[i];
        state->from = state->last = set->start;
        state->window = sb_alloc(sums_of(set), sizeof(double));
        state->whole = sb_alloc(sums_of(set), sizeof(double));
        if (!state->window || !state->whole) return sb_fail_memory(error, "measure.reflections");
    }
    return SB_OK;
}

void sb_reflections_destroy(sb_measure *measure)
{
    for (size_t i = 0; measure->splits && i < measure->scene->measure.reflection_count; i++) {
        sb_free(measure->splits[i].window);
        sb_free(measure->splits[i].whole);
    }
    sb_free(measure->splits);
    sb_free(measure->split_rows);
}

size_t sb_reflections_bytes(const sb_measure *measure)
{
    size_t bytes = measure->split_count * sizeof *measure->split_rows;
    for (size_t i = 0; i < measure->scene->measure.reflection_count; i++)
        bytes += sizeof *measure->splits + 2 * sums_of(&measure->scene->measure.reflections[i]) * sizeof(double);
    return bytes;
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
static size_t fit_gauges(const sb_measure *measure, const sb_reflection_set *set, const double *sums, scratch *s)
{
    const size_t n = (size_t)set->harmonics, size = sb_harmonics_size(set->harmonics);
    size_t fitted = 0;
    for (size_t g = 0; g < set->gauge_count; g++) {
        if (!sb_harmonics_solve(sums + g * size, set->harmonics, s->sums, s->cosines + fitted * n,
                                s->sines + fitted * n))
            continue;
        s->places[fitted++] = sb_reflection_place(measure->scene, set, g);
    }
    return fitted;
}

/* Splits a harmonic, whose components at the fitted gauges are in `s`. first, number: wave numbers of a free wave of
   the first harmonic and of this one, 1/m. */
static sb_split split_one(const sb_reflection_set *set, size_t harmonic, const scratch *s, size_t fitted, double first,
                          double number)
{
    const double none = (double)NAN;
    const bool bound = set->bound && harmonic > 1;
    if (fitted < (bound ? 4 : 2)) return (sb_split){none, none, none, none, none, none};
    if (bound) return sb_split_bound_of(s->places, s->cosine, s->sine, fitted, number, (double)harmonic * first);
    return sb_split_of(s->places, s->cosine, s->sine, fitted, number);
}

/* Fits the gauges by their sums, and splits each harmonic. rows: one per harmonic. */
static sb_status split_all(const sb_measure *measure, size_t index, const double *sums, double from, double time,
                           sb_reflection_record *rows, sb_error *error)
{
    const sb_reflection_set *set = &measure->scene->measure.reflections[index];
    scratch s = {0};
    if (!make_scratch(set, &s)) {
        free_scratch(&s);
        return sb_fail_memory(error, "measure.reflections");
    }
    const size_t fitted = fit_gauges(measure, set, sums, &s), n = (size_t)set->harmonics;
    const double first = sb_reflection_number(measure->scene, set, 1);
    for (size_t h = 0; h < n; h++) {
        const double period = set->period / (double)(h + 1);
        const double number = sb_reflection_number(measure->scene, set, (int)h + 1);
        for (size_t g = 0; g < fitted; g++) {
            s.cosine[g] = s.cosines[g * n + h];
            s.sine[g] = s.sines[g * n + h];
        }
        const sb_split split = split_one(set, h + 1, &s, fitted, first, number);
        rows[h] = (sb_reflection_record){.set = index,
                                         .harmonic = h + 1,
                                         .from = from,
                                         .time = time,
                                         .period = period,
                                         .wavelength = 2 * M_PI / number,
                                         .incident = split.incident,
                                         .reflected = split.reflected,
                                         .misfit = split.misfit,
                                         .separation = split.separation,
                                         .bound_incident = split.bound_incident,
                                         .bound_reflected = split.bound_reflected};
    }
    free_scratch(&s);
    return SB_OK;
}

sb_status sb_reflections_add(sb_measure *measure, size_t index, const sb_gauge_record *gauges, double time,
                             const sb_reflection_record **rows, sb_error *error)
{
    const sb_scene *scene = measure->scene;
    const sb_reflection_set *set = &scene->measure.reflections[index];
    split_state *state = &measure->splits[index];
    const double slack = 1e-9 * measure->interval, omega = 2 * M_PI / set->period;
    *rows = NULL;
    if (time < state->from - slack) return SB_OK;
    const size_t size = sb_harmonics_size(set->harmonics);
    for (size_t g = 0; g < set->gauge_count; g++) {
        const double z = gauges[sb_scene_gauge(scene, set->gauges[g].name)].z;
        if (isnan(z)) continue;
        sb_harmonics_add(state->window + g * size, set->harmonics, omega, time, z);
        sb_harmonics_add(state->whole + g * size, set->harmonics, omega, time, z);
    }
    state->last = time;
    if (time < state->from + set->window - slack) return SB_OK;
    sb_status status = split_all(measure, index, state->window, state->from, time, measure->split_rows, error);
    *rows = measure->split_rows;
    state->from += set->window;
    for (size_t i = 0; i < sums_of(set); i++) state->window[i] = 0;
    return status;
}

sb_status sb_measure_reflections(sb_measure *measure, const sb_reflection_record **rows, size_t *count, sb_error *error)
{
    sb_status status = SB_OK;
    *rows = measure->split_rows;
    *count = 0;
    for (size_t i = 0; status == SB_OK && i < measure->scene->measure.reflection_count; i++) {
        const sb_reflection_set *set = &measure->scene->measure.reflections[i];
        const split_state *state = &measure->splits[i];
        if (state->last - set->start < SB_LEAST_PERIODS * set->period) continue; /* harmonics cannot be distinguished */
        status = split_all(measure, i, state->whole, set->start, state->last, measure->split_rows + *count, error);
        *count += (size_t)set->harmonics;
    }
    if (status != SB_OK) *count = 0;
    return status;
}

void sb_reflections_save(const sb_measure *measure, sb_archive_out *out)
{
    sb_put_count(out, measure->scene->measure.reflection_count);
    for (size_t i = 0; i < measure->scene->measure.reflection_count; i++) {
        const size_t count = sums_of(&measure->scene->measure.reflections[i]);
        const split_state *state = &measure->splits[i];
        sb_put_real(out, state->from);
        sb_put_real(out, state->last);
        sb_put_list(out, state->window, count, sizeof(double));
        sb_put_list(out, state->whole, count, sizeof(double));
    }
}

void sb_reflections_load(sb_measure *measure, sb_archive_in *in)
{
    const size_t sets = measure->scene->measure.reflection_count;
    if (sb_take_count(in, SIZE_MAX) != sets)
        sb_archive_refuse(in, "a different number of reflections, expected %zu", sets);
    for (size_t i = 0; i < sets; i++) {
        const size_t count = sums_of(&measure->scene->measure.reflections[i]);
        split_state *state = &measure->splits[i];
        state->from = sb_take_real(in);
        state->last = sb_take_real(in);
        sb_take_list(in, state->window, count, sizeof(double));
        sb_take_list(in, state->whole, count, sizeof(double));
    }
}
