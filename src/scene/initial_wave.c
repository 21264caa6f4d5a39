/* The wave on the water at the start. */
#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"
#include "scene/reader.h"

#include <math.h>

/* Relative difference between the length of a periodic domain and whole wavelengths that is accepted. */
static const double WHOLE = 1e-6;

static double sign_of(int direction)
{
    return direction < 0 ? -1 : 1;
}

static double phase_of(const sb_initial_component *c, double ahead)
{
    return 2 * M_PI * remainder(sign_of(c->direction) * ahead / c->wavelength, 1) + M_PI / 180 * c->phase;
}

double sb_initial_elevation(const sb_initial_wave *wave, double gravity, double ahead)
{
    const sb_solitary solitary = {wave->height, wave->depth, gravity, wave->theory};
    double sum = 0;
    switch (wave->kind) {
    case SB_INITIAL_NONE:
        break;
    case SB_INITIAL_SOLITARY:
        return sb_solitary_elevation(&solitary, wave->direction < 0 ? -ahead : ahead);
    case SB_INITIAL_STANDING:
        return sb_standing_elevation(wave->height, wave->wavelength, ahead);
    case SB_INITIAL_REGULAR:
        return sb_stokes_elevation(&wave->stokes, sign_of(wave->direction) * ahead);
    case SB_INITIAL_COMPONENTS:
        for (size_t i = 0; i < wave->component_count; i++)
            sum += wave->components[i].amplitude * cos(phase_of(&wave->components[i], ahead));
        break;
    }
    return sum;
}

static void add_component(const sb_initial_component *c, double depth, double gravity, double ahead, double z,
                          double *u, double *w)
{
    const double k = 2 * M_PI / c->wavelength, omega = sqrt(gravity * k * tanh(k * depth));
    const double phase = phase_of(c, ahead), speed = c->amplitude * omega;
    z = fmin(fmax(z, 0), depth);
    *u += sign_of(c->direction) * speed * sb_cosh_over_sinh(k, z, depth) * cos(phase);
    *w += speed * sb_sinh_over_sinh(k, z, depth) * sin(phase);
}

void sb_initial_velocity(const sb_initial_wave *wave, double gravity, double ahead, double z, double *u, double *w)
{
    const sb_solitary solitary = {wave->height, wave->depth, gravity, wave->theory};
    const double sign = sign_of(wave->direction);
    *u = *w = 0;
    switch (wave->kind) {
    case SB_INITIAL_NONE:
    case SB_INITIAL_STANDING:
        return;
    case SB_INITIAL_SOLITARY:
        sb_solitary_velocity(&solitary, sign * ahead, fmax(z, 0), u, w);
        break;
    case SB_INITIAL_REGULAR:
        sb_stokes_velocity(&wave->stokes, sign * ahead, z, u, w);
        break;
    case SB_INITIAL_COMPONENTS:
        for (size_t i = 0; i < wave->component_count; i++)
            add_component(&wave->components[i], wave->depth, gravity, ahead, z, u, w);
        return;
    }
    *u *= sign;
}

double sb_initial_crest(const sb_initial_wave *wave)
{
    double sum = 0;
    if (wave->kind == SB_INITIAL_REGULAR) return sb_stokes_elevation(&wave->stokes, 0);
    if (wave->kind != SB_INITIAL_COMPONENTS) return wave->height;
    for (size_t i = 0; i < wave->component_count; i++) sum += wave->components[i].amplitude;
    return sum;
}

sb_status sb_initial_wave_fits(sb_reader *reader, const sb_yaml *map, const char *key, double length, const char *place,
                               double extent)
{
    const double waves = fmax(round(extent / length), 1);
    if (fabs(extent - waves * length) <= WHOLE * extent) return SB_OK;
    return sb_reader_fail(reader, map, key,
                          "a wavelength of %.10g m does not fit the periodic %s of %g m a whole number of times, "
                          "expected for example %.10g m",
                          length, place, extent, extent / waves);
}

static sb_status check_fit(sb_reader *reader, const sb_yaml *map, const char *key, double length)
{
    const sb_domain *domain = &reader->scene->domain;
    if (!sb_scene_repeats(reader->scene, 0)) return SB_OK;
    return sb_initial_wave_fits(reader, map, key, length, "domain", domain->max.x - domain->min.x);
}

static sb_status check_length(sb_reader *reader, const sb_yaml *map, const char *key, double length)
{
    if (length < 4 * reader->scene->resolution)
        return sb_reader_fail(reader, map, key, "a wavelength of %g m is too short, expected at least 4 spacings, %g m",
                              length, 4 * reader->scene->resolution);
    return check_fit(reader, map, key, length);
}

/* Refuses components that break, each alone, or those of one direction together. Waves that meet do not break at that
   height: two equal ones make a standing wave, which is higher. */
static sb_status check_breaking(sb_reader *reader, const sb_yaml *map, const sb_initial_wave *wave)
{
    sb_sum_height forward = {0}, backward = {0};
    sb_error why = {0};
    for (size_t i = 0; i < wave->component_count; i++) {
        const sb_initial_component *c = &wave->components[i];
        const double number = 2 * M_PI / c->wavelength, most = sb_breaking_height(number, wave->depth);
        if (2 * c->amplitude > most)
            return sb_reader_fail(
                reader, map, "components",
                "item %zu with an amplitude of %g m and a wavelength of %g m on %g m breaks, expected "
                "an amplitude of at most %.3g m",
                i, c->amplitude, c->wavelength, wave->depth, sb_breaking_shown(0.5 * most));
        sb_sum_height_add(c->direction < 0 ? &backward : &forward, c->amplitude, number);
    }
    if (sb_sum_height_check(&forward, wave->depth, &why) == SB_OK &&
        sb_sum_height_check(&backward, wave->depth, &why) == SB_OK)
        return SB_OK;
    return sb_reader_fail(reader, map, "components", "%s", why.text);
}

sb_status sb_initial_wave_finish(sb_reader *reader, const sb_yaml *map, sb_initial_wave *wave)
{
    static const int orders[] = {1, 2, 5};
    sb_error why = {0};
    if (wave->kind == SB_INITIAL_REGULAR) {
        if (wave->direction == 0)
            return sb_reader_fail(reader, map, "direction", "0 is not a direction, expected 1 or -1");
        const bool timed = wave->period > 0;
        const double gravity = reader->scene->fluid.gravity;
        const int order = orders[wave->order];
        const sb_status status =
            timed ? sb_stokes_of_period(order, wave->height, wave->period, wave->depth, gravity, &wave->stokes, &why)
                  : sb_stokes_create(order, wave->height, wave->wavelength, wave->depth, gravity, &wave->stokes, &why);
        if (status != SB_OK) return sb_reader_fail(reader, map, timed ? "period" : NULL, "%s", why.text);
        wave->wavelength = wave->stokes.length;
        wave->period = 0; /* the wavelength says it all: what is written and read again is the same */
        return check_length(reader, map, timed ? "period" : "wavelength", wave->wavelength);
    }
    /* for the wave of offshore, see table_offshore.c */
    if (wave->kind == SB_INITIAL_STANDING && wave == &reader->scene->wave)
        return check_fit(reader, map, "wavelength", wave->wavelength);
    if (wave->kind != SB_INITIAL_COMPONENTS) return SB_OK;
    if (wave->component_count == 0)
        return sb_reader_fail(reader, map, "components", "has no item, expected at least one");
    for (size_t i = 0; i < wave->component_count; i++) {
        const sb_initial_component *c = &wave->components[i];
        if (c->direction == 0)
            return sb_reader_fail(reader, map, "components", "item %zu has the direction 0, expected 1 or -1", i);
        sb_status status = check_length(reader, map, "components", c->wavelength);
        if (status != SB_OK) return status;
        wave->height = fmax(wave->height, 2 * c->amplitude);
    }
    return check_breaking(reader, map, wave);
}
