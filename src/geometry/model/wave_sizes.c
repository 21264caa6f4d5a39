/* Warns of waves that are too low or too short for the spacing, and of linear waves that are too long for their theory.
 */
#include "base/memory.h"
#include "base/per_cent.h"
#include "geometry/model/parts.h"
#include "physics/wavemakers/wavemaker.h"
#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/regular_wave.h"

#include <math.h>
#include <stdio.h>

/* In spacings. A periodic wave of 10 spacings loses a fifth of its height per period, one of 20 spacings 8 % and one of
   40 spacings 1 % (2D, water of 20 spacings). */
enum { HEIGHT_MIN = 5, LENGTH_MIN = 20 };

static sb_status check_height(const char *what, const char *name, double height, sb_model *model, sb_error *error)
{
    if (!(height > 0) || height >= HEIGHT_MIN * model->spacing) return SB_OK;
    return sb_model_warn(
        model, error, "%s%s%s%s: a wave height of %g m is %.2g times the particle spacing: expected %d times or more",
        what, name ? " \"" : "", name ? name : "", name ? "\"" : "", height, height / model->spacing, HEIGHT_MIN);
}

/* Linear waves that are summed; a single wave that is high enough for the spacing and does not break is long enough. */
typedef struct sum {
    size_t count, shorter, shortest; /* waves; those that are too short; the shortest one */
    double least;                    /* m, its length */
    sb_sum_height way[2];            /* of those that travel together */
} sum;

static void add_wave(sum *of, double amplitude, double length, int way, double spacing)
{
    if (of->count == 0 || length < of->least) {
        of->least = length;
        of->shortest = of->count;
    }
    of->shorter += length < LENGTH_MIN * spacing;
    of->count++;
    sb_sum_height_add(&of->way[way], amplitude, 2 * M_PI / length);
}

static sb_status warn_of_lengths(const sum *of, const char *key, sb_model *model, sb_error *error)
{
    char more[60] = "";
    if (of->shorter == 0) return SB_OK;
    if (of->shorter > 1)
        snprintf(more, sizeof more, ", and %zu other%s also short", of->shorter - 1, of->shorter > 2 ? "s are" : " is");
    return sb_model_warn(
        model, error,
        "%s[%zu]: its wavelength of %.3g m is %.2g times the particle spacing%s: such waves fade soon; "
        "expected %d times or more",
        key, of->shortest, of->least, of->least / model->spacing, more, LENGTH_MIN);
}

static double ursell_of(double height, double length, double depth)
{
    return height * length * length / (depth * depth * depth);
}

/* Linear waves that are too long for their theory. come: the waves that it does not have. */
static sb_status check_ursell(const char *key, double ursell, const char *come, sb_model *model, sb_error *error)
{
    if (ursell < SB_URSELL_LIMIT) return SB_OK;
    return sb_model_warn(model, error,
                         "%s: the waves are linear, but H L^2/d^3 = %.4g is above %.3g: %s will come with them; "
                         "expected lower or shorter waves, or deeper water",
                         key, ursell, SB_URSELL_LIMIT, come);
}

static sb_status check_sum(const sum *of, const char *key, double depth, sb_model *model, sb_error *error)
{
    double most = 0;
    const sb_status status = warn_of_lengths(of, key, model, error);
    if (status != SB_OK) return status;
    for (int i = 0; i < 2; i++) {
        const sb_sum_height *way = &of->way[i];
        if (way->highest > 0) most = fmax(most, ursell_of(sb_sum_height_of(way), 2 * M_PI / way->number, depth));
    }
    return check_ursell(key, most, "free long waves and free waves of twice the frequency", model, error);
}

static sb_status check_linear(const sb_initial_wave *wave, sb_model *model, sb_error *error)
{
    if (wave->kind != SB_INITIAL_REGULAR || wave->stokes.order != 1) return SB_OK;
    return check_ursell("water.wave.order", ursell_of(wave->height, wave->wavelength, wave->depth),
                        "free waves of twice the frequency", model, error);
}

static sb_status check_initial(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const sb_initial_wave *wave = &scene->wave;
    sum found = {0};
    if (wave->kind == SB_INITIAL_NONE) return SB_OK;
    for (size_t c = 0; wave->kind == SB_INITIAL_COMPONENTS && c < wave->component_count; c++) {
        const sb_initial_component *part = &wave->components[c];
        add_wave(&found, part->amplitude, part->wavelength, part->direction < 0, model->spacing);
    }
    /* the height of a standing wave is given by its amplitude */
    const double height = wave->kind == SB_INITIAL_STANDING ? 2 * wave->height : wave->height;
    sb_status status = check_height("initial wave", NULL, height, model, error);
    if (status == SB_OK) status = check_linear(wave, model, error);
    return status == SB_OK ? check_sum(&found, "water.wave.components", wave->depth, model, error) : status;
}

static sb_status check_given(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const sb_given_sea *given = &scene->given;
    sum found = {0};
    if (given->source != SB_GIVEN_THEORY) return SB_OK;
    for (size_t c = 0; c < given->component_count; c++) {
        const sb_given_component *wave = &given->components[c];
        const double length = 2 * M_PI / sb_wave_number(wave->period, given->depth, scene->fluid.gravity);
        const double amplitude = sb_is_tide(length, given->depth) ? 0 : wave->amplitude;
        add_wave(&found, amplitude, length, 0, model->spacing);
    }
    const double height = given->wave == SB_GIVEN_COMPONENTS ? sb_sum_height_of(&found.way[0]) : given->height;
    const sb_status status = check_height("sea", NULL, height, model, error);
    return status == SB_OK ? check_sum(&found, "sea.components", given->depth, model, error) : status;
}

/* Share of the energy of a paddle's waves that may be in short ones: the tail of a spectrum. */
static const double TAIL = 0.1;

/* The lengths of the waves of a paddle that makes a sum of them. */
static sb_status check_band(const sb_wavemaker_use *maker, const sb_paddle *paddle, sb_model *model, sb_error *error)
{
    const sb_wavemaker_parameters *law = &maker->law;
    char part[32];
    size_t count;
    sb_band_part *band = sb_paddle_band(paddle, &count);
    if (!band) return sb_fail_memory(error, "a wave maker");
    double all = 0, lost = 0;
    for (size_t i = 0; i < count; i++) {
        const double length = 2 * M_PI / sb_wave_number(2 * M_PI / band[i].omega, law->depth, law->gravity);
        all += band[i].weight;
        if (length < LENGTH_MIN * model->spacing) lost += band[i].weight;
    }
    sb_free(band);
    if (count < 2 || !(lost > TAIL * all)) return SB_OK;
    return sb_model_warn(model, error,
                         "wave maker \"%s\": %s of the energy of its waves is in lengths below %g m, %d particle "
                         "spacings: such waves fade soon; expected a finer resolution or longer waves",
                         maker->name, sb_per_cent(lost / all, part), LENGTH_MIN * model->spacing, LENGTH_MIN);
}

static sb_status check_maker(const sb_wavemaker_use *maker, sb_model *model, sb_error *error)
{
    const sb_wavemaker_parameters *law = &maker->law;
    sb_paddle paddle = {0};
    if (!law->kind->facts || sb_paddle_create(law, &paddle, NULL) != SB_OK)
        return check_height("wave maker", maker->name, law->height, model, error);
    /* the significant height of a file's waves; 0: it makes none */
    const double height = law->height > 0 ? law->height : law->kind->facts(paddle.state)->height;
    sb_status status = check_height("wave maker", maker->name, height, model, error);
    if (status == SB_OK) status = check_band(maker, &paddle, model, error);
    sb_paddle_destroy(&paddle);
    return status;
}

sb_status sb_model_warn_wave_sizes(const sb_scene *scene, sb_model *model, sb_error *error)
{
    sb_status status = check_initial(scene, model, error);
    if (status == SB_OK) status = check_given(scene, model, error);
    for (size_t i = 0; i < scene->wavemaker_count && status == SB_OK; ++i)
        status = check_maker(&scene->wavemakers[i], model, error);
    return status;
}
