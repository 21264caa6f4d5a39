#include "app/check/waves.h"

#include "app/check/zones.h"
#include "base/memory.h"
#include "base/per_cent.h"
#include "physics/wavemakers/paddle_way.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/steady_wave.h"
#include "sim/sim.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef void visit_train(void *context, const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle);

/* Calls visit for each wave maker that makes a wave train, or one that makes a solitary wave. The scene has been read,
   so that all of them can be made. */
static size_t visit_makers(const sb_scene *scene, bool solitary, visit_train *visit, void *context)
{
    size_t count = 0;
    for (size_t w = 0; w < scene->wavemaker_count; w++) {
        const sb_wavemaker_use *maker = &scene->wavemakers[w];
        const sb_wavemaker *kind = maker->law.kind;
        const bool wanted = solitary ? !kind->facts && (kind->needs & SB_WM_HEIGHT) : kind->facts != NULL;
        sb_paddle paddle = {0};
        if (!wanted || sb_paddle_create(&maker->law, &paddle, NULL) != SB_OK) continue;
        if (visit) visit(context, scene, maker, &paddle);
        sb_paddle_destroy(&paddle);
        count++;
    }
    return count;
}

/* Of the paddle, m: from the farthest place behind to the farthest ahead. */
static double travel_of(const sb_scene *scene, const sb_paddle *paddle)
{
    const sb_paddle_way way = sb_paddle_way_of(paddle, scene->duration);
    return way.most - way.least;
}

/* Mean periods of a spectrum by its moments, s. */
typedef struct mean_periods {
    double crossing, energy; /* T_m02; T_m-1,0 */
    size_t count;            /* of waves; 0: no spectrum */
} mean_periods;

/* Amplitudes of a group that focuses are in proportion to the energies of its spectrum. */
static mean_periods mean_periods_of(const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    mean_periods found = {0};
    double zeroth = 0, second = 0, inverse = 0;
    if (paddle->kind->facts(paddle->state)->repeats) return found;
    sb_band_part *band = sb_paddle_band(paddle, &found.count);
    for (size_t i = 0; band && i < found.count; i++) {
        const double energy = maker->law.kind->needs & SB_WM_FOCUS ? sqrt(band[i].weight) : band[i].weight;
        zeroth += energy;
        second += energy * band[i].omega * band[i].omega;
        inverse += energy / band[i].omega;
    }
    if (!(zeroth > 0)) found.count = 0;
    found.crossing = 2 * M_PI * sqrt(zeroth / second);
    found.energy = 2 * M_PI * inverse / zeroth;
    sb_free(band);
    return found;
}

/* Reflection of an absorbing paddle by linear theory; NaN: it does not absorb. */
typedef struct reflection {
    double peak, all; /* at the period of the waves, at the peak; of all waves, by their energy */
} reflection;

static reflection paddle_reflection(const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    sb_paddle own = *paddle;
    sb_absorbing_filter filter;
    const double distance = SB_ABSORB_DISTANCE * scene->resolution;
    if (!maker->law.absorb || sb_paddle_fit_absorption(&maker->law, &own, distance, &filter, NULL) != SB_OK)
        return (reflection){(double)NAN, (double)NAN};
    return (reflection){
        .peak =
            sb_absorbing_reflection(&filter, maker->law.motion, 2 * M_PI / paddle->kind->facts(paddle->state)->period,
                                    maker->law.depth, scene->fluid.gravity, distance),
        .all = sb_paddle_reflection(&maker->law, &own, &filter, distance),
    };
}

/* Height of the waves over the full stroke; that of a cnoidal wave's paddle is its travel. */
static double height_over_stroke(const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    const sb_wave_facts *f = paddle->kind->facts(paddle->state);
    if (f->height > 0 && f->count == 0) return f->height / travel_of(scene, paddle);
    return sb_paddle_gain(maker->law.motion, f->number, f->depth);
}

static void print_parts(const sb_scene *scene, const sb_wavemaker_use *maker, double gain)
{
    sb_plate_row row;
    if (sb_scene_plates(scene, maker, &row) == 0) return;
    if (row.axis == 2) {
        printf("    flap about z = %.4g m in %zu rows; height over stroke %.4g\n", row.from, row.count, gain);
        return;
    }
    printf("    %zu push-plates of %.4g m along %c, %.3g spacings each", row.count,
           (row.to - row.from) / (double)row.count, row.axis == 0 ? 'x' : 'y',
           (row.to - row.from) / (double)row.count / scene->resolution);
    if (row.levels > 1) printf("; %zu above each other read the same surface and move as one", row.levels);
    printf("\n");
}

static void print_absorption(const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    const reflection predicted = paddle_reflection(scene, maker, paddle);
    if (isnan(predicted.peak)) return;
    const sb_wave_facts *facts = paddle->kind->facts(paddle->state);
    char text[32], all[32], more[64] = "";
    if (!facts->repeats && facts->count > 0)
        snprintf(more, sizeof more, ", of all its waves %s", sb_per_cent(predicted.all, all));
    printf("    absorbs within %.3g m of its law; predicted reflection at %.4g s %s%s; forgets levels in %.3g s\n",
           maker->law.reach, facts->period, sb_per_cent(predicted.peak, text), more, 1 / facts->slow);
}

/* Length of the steady wave of the same height and period in a closed flume, m: what gauges measure of high waves,
   which are longer than linear ones. NaN: no regular waves, or not known. */
static double steady_length(const sb_scene *scene, const sb_wavemaker_use *maker, const sb_wave_facts *f)
{
    sb_steady_wave wave;
    if (strcmp(maker->law.kind->name, "regular") != 0) return (double)NAN;
    const bool found = sb_steady_wave_of(f->height, f->period, f->depth, scene->fluid.gravity, &wave);
    return found ? wave.length : (double)NAN;
}

static void print_train(void *context, const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    (void)context;
    const sb_wave_facts *f = paddle->kind->facts(paddle->state);
    const double spacing = scene->resolution;
    if (!(f->height > 0)) {
        printf("  absorber %s: waves of %.4g s on %g m, wavelength %.4g m\n", maker->name, f->period, f->depth,
               f->length);
        print_absorption(scene, maker, paddle);
        print_parts(scene, maker, 0);
        return;
    }
    char steady[64] = "";
    const double length = steady_length(scene, maker, f);
    if (!isnan(length)) snprintf(steady, sizeof steady, ", %.4g m as a steady wave", length);
    printf("  waves of %s: %s, %s\n"
           "    %s %.4g m, period %.4g s%s, depth %g m, wavelength %.4g m%s\n"
           "    kd %.3g, steepness H/L %.3g, Ursell number H L^2/d^3 %.3g\n"
           "    %.3g particles per height, %.3g per wavelength; travel of the paddle %.3g m\n",
           maker->name, maker->law.kind->name, f->theory, f->height_name, f->height, f->period,
           f->count > 2 ? " at the peak" : "", f->depth, f->length, steady, f->number * f->depth, f->height / f->length,
           f->ursell, f->height / spacing, f->length / spacing, travel_of(scene, paddle));
    const mean_periods mean = mean_periods_of(maker, paddle);
    if (mean.count > 0)
        printf("    %zu linear waves; mean periods T_m02 %.4g s, T_m-1,0 %.4g s\n", mean.count, mean.crossing,
               mean.energy);
    print_absorption(scene, maker, paddle);
    print_parts(scene, maker, height_over_stroke(scene, maker, paddle));
}

/* A solitary wave, which is no wave train. */
static void print_solitary(void *context, const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    (void)context;
    const sb_wavemaker_parameters *law = &maker->law;
    printf("  wave of %s: solitary, %s\n"
           "    height %.4g m, depth %g m, H/d %.3g, speed %.4g m/s\n"
           "    %.3g particles per height; travel of the paddle %.3g m in %.3g s\n",
           maker->name, law->kind->name, law->height, law->depth, law->height / law->depth,
           sb_paddle_celerity(law, paddle), law->height / scene->resolution, travel_of(scene, paddle),
           paddle->duration);
}

static double viscosity_of(const sb_scene *scene, const sb_model *model, const sb_sponge *sponge)
{
    return sb_zone_viscosity(scene, sponge, sb_sim_sound_speed(scene, model));
}

/* Reflected over incident amplitude by linear theory. */
static double reflection_of(const sb_scene *scene, const sb_model *model, const sb_sponge *sponge)
{
    return sb_zone_reflection(scene, sponge, sponge->period, sb_sim_sound_speed(scene, model));
}

static double wavelength_of(const sb_scene *scene, const sb_sponge *sponge)
{
    return 2 * M_PI / sb_wave_number(sponge->period, sponge->depth, scene->fluid.gravity);
}

static const char *const order_names[] = {"linear", "second-order Stokes", "fifth-order Stokes"};

static void print_initial(const sb_scene *scene)
{
    const sb_initial_wave *wave = &scene->wave;
    const double spacing = scene->resolution, d = wave->depth;
    if (wave->kind == SB_INITIAL_REGULAR) {
        const sb_stokes *s = &wave->stokes;
        printf("  waves at the start: regular, %s\n"
               "    height %.4g m, wavelength %.4g m, depth %g m, period %.4g s, speed %.4g m/s\n"
               "    kd %.3g, steepness H/L %.3g, Ursell number H L^2/d^3 %.3g\n"
               "    %.3g particles per height, %.3g per wavelength\n",
               order_names[wave->order], s->height, s->length, d, s->length / s->celerity, s->celerity, s->number * d,
               s->height / s->length, s->height * s->length * s->length / (d * d * d), s->height / spacing,
               s->length / spacing);
    }
    if (wave->kind == SB_INITIAL_COMPONENTS)
        printf("  waves at the start: a sum of %zu linear waves on %g m, amplitudes together %.4g m\n",
               wave->component_count, d, sb_initial_crest(wave));
}

static void put_initial(const sb_scene *scene, sb_json *json)
{
    const sb_initial_wave *wave = &scene->wave;
    const sb_stokes *s = &wave->stokes;
    if (wave->kind != SB_INITIAL_REGULAR) return;
    sb_json_open(json, "initial_wave", '{');
    sb_json_text(json, "theory", order_names[wave->order]);
    sb_json_number(json, "height_m", s->height);
    sb_json_number(json, "wavelength_m", s->length);
    sb_json_number(json, "period_s", s->length / s->celerity);
    sb_json_number(json, "speed_m_s", s->celerity);
    sb_json_number(json, "kd", s->number * wave->depth);
    sb_json_close(json);
}

void sb_check_waves_text(const sb_scene *scene, const sb_model *model)
{
    print_initial(scene);
    visit_makers(scene, true, print_solitary, NULL);
    visit_makers(scene, false, print_train, NULL);
    for (size_t s = 0; s < scene->sponge_count; s++) {
        const sb_sponge *sponge = &scene->sponges[s];
        const bool viscous = sponge->kind == SB_SPONGE_VISCOUS;
        char text[32];
        printf("  sponge %s: %.3g m, %.3g times the wavelength of %.4g m, %s %.3g %s; predicted reflection %s\n",
               sponge->name, sponge->length, sponge->length / wavelength_of(scene, sponge),
               wavelength_of(scene, sponge), viscous ? "viscosity" : "strength",
               viscous ? viscosity_of(scene, model, sponge) : sponge->strength, viscous ? "m^2/s" : "1/s",
               sb_per_cent(reflection_of(scene, model, sponge), text));
    }
}

static void put_train(void *context, const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    sb_json *json = context;
    const sb_wave_facts *f = paddle->kind->facts(paddle->state);
    sb_json_open(json, NULL, '{');
    sb_json_text(json, "wavemaker", maker->name);
    sb_json_text(json, "kind", maker->law.kind->name);
    sb_json_text(json, "theory", f->theory);
    sb_json_number(json, "height_m", f->height);
    sb_json_number(json, "period_s", f->period);
    sb_json_number(json, "wavelength_m", f->length);
    const double steady = steady_length(scene, maker, f);
    if (!isnan(steady)) sb_json_number(json, "steady_wavelength_m", steady);
    sb_json_number(json, "kd", f->number * f->depth);
    sb_json_number(json, "steepness", f->height / f->length);
    sb_json_number(json, "ursell", f->ursell);
    sb_json_number(json, "particles_per_height", f->height / scene->resolution);
    sb_json_number(json, "particles_per_wavelength", f->length / scene->resolution);
    sb_json_number(json, "travel_m", travel_of(scene, paddle));
    const mean_periods mean = mean_periods_of(maker, paddle);
    if (mean.count > 0) {
        sb_json_count(json, "components", mean.count);
        sb_json_number(json, "t_m02_s", mean.crossing);
        sb_json_number(json, "t_m_10_s", mean.energy);
    }
    if (maker->law.absorb) {
        const reflection predicted = paddle_reflection(scene, maker, paddle);
        sb_json_number(json, "predicted_reflection", predicted.peak);
        sb_json_number(json, "predicted_reflection_of_all", predicted.all);
    }
    sb_plate_row row;
    if (sb_scene_plates(scene, maker, &row) > 0) sb_json_count(json, row.axis == 2 ? "flap_rows" : "plates", row.count);
    sb_json_number(json, "height_over_stroke", height_over_stroke(scene, maker, paddle));
    sb_json_close(json);
}

static void put_solitary(void *context, const sb_scene *scene, const sb_wavemaker_use *maker, const sb_paddle *paddle)
{
    sb_json *json = context;
    const sb_wavemaker_parameters *law = &maker->law;
    sb_json_open(json, NULL, '{');
    sb_json_text(json, "wavemaker", maker->name);
    sb_json_text(json, "kind", law->kind->name);
    sb_json_number(json, "height_m", law->height);
    sb_json_number(json, "height_over_depth", law->height / law->depth);
    sb_json_number(json, "speed_m_s", sb_paddle_celerity(law, paddle));
    sb_json_number(json, "particles_per_height", law->height / scene->resolution);
    sb_json_number(json, "travel_m", travel_of(scene, paddle));
    sb_json_number(json, "duration_s", paddle->duration);
    sb_json_close(json);
}

static void put_makers(const sb_scene *scene, bool solitary, const char *name, visit_train *put, sb_json *json)
{
    if (visit_makers(scene, solitary, NULL, NULL) == 0) return;
    sb_json_open(json, name, '[');
    visit_makers(scene, solitary, put, json);
    sb_json_close(json);
}

void sb_check_waves_json(const sb_scene *scene, const sb_model *model, sb_json *json)
{
    put_initial(scene, json);
    put_makers(scene, true, "solitary_waves", put_solitary, json);
    put_makers(scene, false, "waves", put_train, json);
    if (scene->sponge_count == 0) return;
    sb_json_open(json, "sponges", '[');
    for (size_t s = 0; s < scene->sponge_count; s++) {
        sb_json_open(json, NULL, '{');
        sb_json_text(json, "name", scene->sponges[s].name);
        sb_json_number(json, "wavelength_m", wavelength_of(scene, &scene->sponges[s]));
        if (scene->sponges[s].kind == SB_SPONGE_VISCOUS)
            sb_json_number(json, "viscosity_m2_s", viscosity_of(scene, model, &scene->sponges[s]));
        else
            sb_json_number(json, "strength_per_s", scene->sponges[s].strength);
        sb_json_number(json, "predicted_reflection", reflection_of(scene, model, &scene->sponges[s]));
        sb_json_close(json);
    }
    sb_json_close(json);
}
