/* Given water from wave theory. */
#include "base/memory.h"
#include "physics/waves/regular_wave.h"
#include "physics/waves/solitary_exact.h"
#include "physics/waves/wave_sum.h"
#include "sea/parts.h"

#include <math.h>
#include <stdio.h>

static const double DEGREE = M_PI / 180;

typedef struct theory {
    sb_given_wave kind;
    double level, depth, ramp;
    double origin[2], along[2];
    double lead; /* m, distance of a solitary wave's crest from the origin at the start */
    double celerity;
    sb_solitary solitary;
    sb_solitary_exact *exact; /* NULL: the wave is `solitary` */
    sb_regular_wave regular;
    size_t count;
    sb_wave_component *components;
} theory;

/* Elevation at the front of a solitary wave, over its height, with which it stands at the origin at the start. */
static const double FRONT = 1e-4;

static double solitary_elevation(const theory *sea, double ahead)
{
    return sea->exact ? sb_solitary_exact_elevation(sea->exact, ahead) : sb_solitary_elevation(&sea->solitary, ahead);
}

static void solitary_motion(const theory *sea, double ahead, double z, sb_wave_motion *motion)
{
    if (sea->exact)
        sb_solitary_exact_motion(sea->exact, ahead, z, motion);
    else
        sb_solitary_motion(&sea->solitary, ahead, fmin(z, sea->depth + sb_solitary_elevation(&sea->solitary, ahead)),
                           motion);
}

static double lead_of(const theory *sea)
{
    const double front = FRONT * sea->solitary.height;
    double near = 0, far = sea->depth;
    while (solitary_elevation(sea, far) > front) far *= 2;
    for (int i = 0; i < 100; i++) {
        const double middle = 0.5 * (near + far);
        if (solitary_elevation(sea, middle) > front)
            near = middle;
        else
            far = middle;
    }
    return far;
}

static sb_status make_solitary(theory *made, const sb_given_sea *given, double gravity, sb_error *error)
{
    const sb_solitary_theory series =
        given->theory == SB_GIVEN_BOUSSINESQ ? SB_SOLITARY_BOUSSINESQ : SB_SOLITARY_THIRD_ORDER;
    made->solitary = (sb_solitary){given->height, given->depth, gravity, series};
    made->celerity = sb_solitary_celerity(&made->solitary);
    if (given->theory == SB_GIVEN_EXACT) {
        const sb_status status = sb_solitary_exact_create(given->height, given->depth, gravity, &made->exact, error);
        if (status != SB_OK) return status;
        made->celerity = sb_solitary_exact_celerity(made->exact);
    }
    made->lead = lead_of(made);
    return SB_OK;
}

static sb_status make_components(theory *made, const sb_given_sea *given, double gravity, sb_error *error)
{
    made->components = sb_alloc(given->component_count, sizeof *made->components);
    if (!made->components) return sb_fail_memory(error, "sea.components");
    made->count = given->component_count;
    for (size_t i = 0; i < made->count; i++) {
        const sb_given_component *from = &given->components[i];
        made->components[i] = (sb_wave_component){.amplitude = from->amplitude,
                                                  .period = from->period,
                                                  .direction = DEGREE * from->direction,
                                                  .phase = DEGREE * from->phase};
        sb_wave_component_prepare(&made->components[i], given->depth, gravity);
    }
    return SB_OK;
}

static void describe(const theory *made, const sb_given_sea *given, sb_sea_notes *notes)
{
    static const char *const orders[] = {"", "linear", "second order", "cnoidal"};
    const sb_regular_wave *wave = &made->regular;
    if (made->kind == SB_GIVEN_SOLITARY)
        snprintf(notes->about, sizeof notes->about,
                 "a solitary wave of %g m on %g m; its crest passes (%g, %g) at %.4g s", given->height, given->depth,
                 made->origin[0], made->origin[1], given->start + made->lead / made->celerity);
    else if (made->kind == SB_GIVEN_REGULAR)
        snprintf(notes->about, sizeof notes->about,
                 "regular waves of %g m and %g s on %g m, %s: length %.4g m, H L^2/d^3 = %.3g", given->height,
                 given->period, given->depth, orders[wave->order], wave->length, wave->ursell);
    else
        snprintf(notes->about, sizeof notes->about, "a sum of %zu linear waves on %g m, amplitudes together %.4g m",
                 made->count, given->depth, sb_wave_sum_crest(made->components, made->count));
    if (made->kind != SB_GIVEN_REGULAR || wave->order != SB_WAVE_LINEAR) return;
    if (wave->ursell >= SB_URSELL_LIMIT)
        snprintf(notes->warning, sizeof notes->warning,
                 "sea.order: linear waves of %g m and %.4g m length on %g m are long: H L^2/d^3 = %.4g is above %.3g, "
                 "and they change on their way; expected order: auto, which gives cnoidal waves",
                 wave->height, wave->length, wave->depth, wave->ursell, SB_URSELL_LIMIT);
    else if (wave->height > 0.02 * wave->length)
        snprintf(notes->warning, sizeof notes->warning,
                 "sea.order: linear waves of %g m and %.4g m length are steep: free second harmonics arise, expected "
                 "order: auto",
                 wave->height, wave->length);
}

static void destroy(void *state)
{
    theory *sea = state;
    if (sea) {
        sb_free(sea->components);
        sb_solitary_exact_destroy(sea->exact);
    }
    sb_free(sea);
}

static sb_status create(const sb_scene *scene, const sb_offshore_start *grid, void **state, sb_sea_notes *notes,
                        sb_error *error)
{
    (void)grid;
    const sb_given_sea *given = &scene->given;
    theory *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "sea");
    const double gravity = scene->fluid.gravity;
    *made = (theory){.kind = given->wave,
                     .level = given->level,
                     .depth = given->depth,
                     .ramp = given->ramp,
                     .origin = {given->origin[0], given->origin[1]},
                     .along = {cos(DEGREE * given->direction), sin(DEGREE * given->direction)}};
    sb_status status = SB_OK;
    if (made->kind == SB_GIVEN_SOLITARY) {
        status = make_solitary(made, given, gravity, error);
    } else if (made->kind == SB_GIVEN_REGULAR) {
        status = sb_regular_wave_create(given->order, given->height, given->period, given->depth, gravity,
                                        &made->regular, error);
    } else {
        status = make_components(made, given, gravity, error);
    }
    if (status != SB_OK) {
        destroy(made);
        return status;
    }
    describe(made, given, notes);
    *state = made;
    return SB_OK;
}

/* Heights above the bed are stretched where its depth is not that of the theory, so that no water crosses the bed. */
static void wave_at(const theory *sea, double t, double x, double y, double z, double stretch, sb_wave_sum *sum)
{
    const double s = x * sea->along[0] + y * sea->along[1];
    sb_wave_motion motion;
    if (sea->kind == SB_GIVEN_COMPONENTS) {
        sb_wave_sum_at(sea->components, sea->count, sea->depth, t, x, y, z, sum);
    } else {
        if (sea->kind == SB_GIVEN_SOLITARY) {
            const double ahead = s + sea->lead - sea->celerity * t;
            solitary_motion(sea, ahead, z, &motion);
        } else {
            sb_regular_wave_at(&sea->regular, s, t, z, &motion);
        }
        *sum = (sb_wave_sum){
            .elevation = motion.elevation,
            .velocity = {motion.u * sea->along[0], motion.u * sea->along[1], motion.w},
            .velocity_rate = {motion.u_rate * sea->along[0], motion.u_rate * sea->along[1], motion.w_rate},
        };
    }
    sum->velocity[2] *= stretch;
    sum->velocity_rate[2] *= stretch;
}

static void at(const void *state, double t, double x, double y, double z, double bed, sb_sea_point *out)
{
    const theory *sea = state;
    if (sea->ramp > 0 && t <= 0) return;
    const double still = sea->level - bed, stretch = fmax(still, 0) / sea->depth;
    const double height = stretch > 0 ? fmax(z - bed, 0) / stretch : 0;
    sb_wave_sum sum;
    wave_at(sea, t, x - sea->origin[0], y - sea->origin[1], height, stretch, &sum);
    double grown = 1, rate = 0;
    if (sea->ramp > 0 && t < sea->ramp) {
        const double part = t / sea->ramp;
        grown = part * part * (3 - 2 * part);
        rate = 6 * part * (1 - part) / sea->ramp;
    }
    out->surface = sea->level + grown * sum.elevation;
    for (int axis = 0; axis < 3; axis++) {
        out->velocity[axis] = grown * sum.velocity[axis];
        out->acceleration[axis] = grown * sum.velocity_rate[axis] + rate * sum.velocity[axis];
    }
    /* The surface also moves because the wave grows. */
    out->velocity[2] += rate * sum.elevation * sb_sea_fraction(z, bed, out->surface);
}

static double greatest_surface(const void *state)
{
    const theory *sea = state;
    return sea->level + (sea->kind == SB_GIVEN_SOLITARY  ? sea->solitary.height
                         : sea->kind == SB_GIVEN_REGULAR ? sb_regular_wave_crest(&sea->regular)
                                                         : sb_wave_sum_crest(sea->components, sea->count));
}

static double greatest_speed(const void *state)
{
    const theory *sea = state;
    if (sea->kind == SB_GIVEN_REGULAR) return sb_regular_wave_speed(&sea->regular);
    if (sea->kind == SB_GIVEN_COMPONENTS) return sb_wave_sum_speed(sea->components, sea->count, sea->depth);
    double speed = 0;
    for (int i = 0; i < 256; i++) {
        const double ahead = sea->lead * i / 256;
        sb_wave_motion motion;
        solitary_motion(sea, ahead, sea->depth + solitary_elevation(sea, ahead), &motion);
        speed = fmax(speed, hypot(motion.u, motion.w));
    }
    return speed;
}

const sb_sea_form sb_sea_form_theory = {create, at, greatest_surface, greatest_speed, destroy, NULL, NULL};
