/* Warns of waves that are too low or too short for the spacing. */
#include "geometry/model/parts.h"
#include "physics/dispersion.h"
#include "physics/wavemaker.h"

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

/* The wavelengths of a sum; a single wave that is high enough for the spacing and does not break is long enough. */
typedef struct lengths {
    size_t count, shorter, shortest; /* waves; those that are too short; the shortest one */
    double least;                    /* m, its length */
} lengths;

static void add_length(lengths *of, double length, double spacing)
{
    if (of->count == 0 || length < of->least) {
        of->least = length;
        of->shortest = of->count;
    }
    of->shorter += length < LENGTH_MIN * spacing;
    of->count++;
}

static sb_status warn_of_lengths(const lengths *of, const char *key, sb_model *model, sb_error *error)
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

static sb_status check_initial(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const sb_initial_wave *wave = &scene->wave;
    lengths found = {0};
    if (wave->kind == SB_INITIAL_NONE) return SB_OK;
    for (size_t c = 0; wave->kind == SB_INITIAL_COMPONENTS && c < wave->component_count; c++)
        add_length(&found, wave->components[c].wavelength, model->spacing);
    /* the height of a standing wave is given by its amplitude */
    const double height = wave->kind == SB_INITIAL_STANDING ? 2 * wave->height : wave->height;
    const sb_status status = check_height("initial wave", NULL, height, model, error);
    return status == SB_OK ? warn_of_lengths(&found, "water.wave.components", model, error) : status;
}

static sb_status check_given(const sb_scene *scene, sb_model *model, sb_error *error)
{
    const sb_given_sea *given = &scene->given;
    lengths found = {0};
    double variance = 0;
    if (given->source != SB_GIVEN_THEORY) return SB_OK;
    for (size_t c = 0; c < given->component_count; c++) {
        const sb_given_component *wave = &given->components[c];
        variance += 0.5 * wave->amplitude * wave->amplitude;
        add_length(&found, 2 * M_PI / sb_wave_number(wave->period, given->depth, scene->fluid.gravity), model->spacing);
    }
    const double height = given->wave == SB_GIVEN_COMPONENTS ? 4 * sqrt(variance) : given->height;
    const sb_status status = check_height("sea", NULL, height, model, error);
    return status == SB_OK ? warn_of_lengths(&found, "sea.components", model, error) : status;
}

/* Height of the waves of a wave maker, m: that of the scene, or the significant one of its file; 0: it makes none. */
static double height_of(const sb_wavemaker_parameters *law)
{
    sb_paddle paddle = {0};
    if (law->height > 0 || !law->kind->facts || sb_paddle_create(law, &paddle, NULL) != SB_OK) return law->height;
    const double height = law->kind->facts(paddle.state)->height;
    sb_paddle_destroy(&paddle);
    return height;
}

sb_status sb_model_warn_wave_sizes(const sb_scene *scene, sb_model *model, sb_error *error)
{
    sb_status status = check_initial(scene, model, error);
    if (status == SB_OK) status = check_given(scene, model, error);
    for (size_t i = 0; i < scene->wavemaker_count && status == SB_OK; ++i)
        status =
            check_height("wave maker", scene->wavemakers[i].name, height_of(&scene->wavemakers[i].law), model, error);
    return status;
}
