#include "subject.h"

#include "cases.h"
#include "quantity.h"
#include "runs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Both rows of large buildings: the front row and the row behind it. */
static const char *const buildings[] = {"turbine-1", "turbine-2", "turbine-3", "turbine-4", "turbine-5",
                                        "turbine-6", "reactor-1", "reactor-2", "reactor-3", "reactor-4",
                                        "reactor-5", "reactor-6", NULL};

static const sb_case plant = {.name = "plant",
                              .title = "A 25 m wave at a coastal plant",
                              .scene = "../scenes/plant.yaml",
                              .evaluate = sb_quantities_of};

/* clang-format off */
const sb_subject sb_subjects[] = {
    {.name = "still-water", .title = "Still water in a slice of a tank, 20 s",
     .what = "standard deviation of the force on the tank, relative to the weight; largest pressure error of a layer, "
             "relative to rho g D",
     .of = &sb_case_still_water_flat, .full = {0.1, 0.05, 0.025}, .quick = {0.1, 0.05},
     .errors = {{"force noise", "%", "force on all bodies, standard deviation", NULL},
                {"pressure profile", "%", "pressure profile, worst layer", NULL}}},
    {.name = "column", .title = "Dam-break bore against a square column",
     .what = "difference from the laboratory, digitisation a",
     .of = &sb_case_column, .full = {0.02, 0.01}, .quick = {0.02}, .slow = true,
     .errors = {{"impulse", "%", "impulse 0.32 to 1.3 s, digitisation a", NULL},
                {"peak", "%", "peak force, digitisation a", NULL},
                {"force, RMS", "%", "RMS until 1.3 s, digitisation a", NULL}}},
    {.name = "solitary-wave", .title = "Solitary wave over fifty depths, 2D",
     .what = "difference from Keulegan's height and from the celerity of the exact wave",
     .of = &sb_case_solitary_wave, .full = {0.12, 0.06, 0.03}, .quick = {0.12},
     .errors = {{"wave height", "%", "height loss beyond Keulegan", NULL},
                {"celerity", "%", "celerity", NULL}}},
    {.name = "run-up", .title = "Solitary wave that breaks on a beach, 2D",
     .what = "difference from the laboratory",
     .of = &sb_case_runup_breaking, .full = {0.1, 0.06, 0.03}, .quick = {0.1},
     .errors = {{"run-up", "%", "run-up R/d", NULL}}},
    {.name = "dam-break", .title = "Dam-break front, Koshizuka and Oka, 2D",
     .what = "mean distance of the front from the laboratory's two digitisations, relative to the range",
     .of = &sb_case_front_koshizuka, .full = {0.0146, 0.0073, 0.00365}, .quick = {0.0146}, .slow = true,
     .errors = {{"front, digitisation a", "%", "front, mean distance, digitisation a", NULL},
                {"front, digitisation b", "%", "front, mean distance, digitisation b", NULL}}},
    {.name = "wave-basin", .title = "Regular waves in the basin of Wen et al., 3D, 17 s",
     .what = "difference from Stokes' theory of fifth order with one fitted phase, over the last five periods: root mean "
             "square relative to the range, and height",
     .of = &sb_case_wave_basin, .full = {0.04}, .settings = sb_plain_settings, .slow = true,
     .errors = {{"surface at 6 m", "%", "surface at 6 m", NULL},
                {"height at 6 m", "%", "height at 6 m", NULL},
                {"pressure at half depth", "%", "pressure 0.25 m above the bed", NULL},
                {"u at half depth", "%", "u 0.25 m above the bed", NULL}}},
    {.name = "plant", .title = "A 25 m wave at a coastal plant, 90 s",
     .what = "difference from the run of the default preset at the reference spacing; impulse and peak are horizontal, for "
             "twelve buildings: sum of the differences divided by the sum of the reference values",
     .of = &plant, .full = {8, 5, 4}, .quick = {12}, .full_reference = 2, .quick_reference = 6,
     .settings = sb_plain_settings,
     .errors = {{"impulse", "%", "#, impulse", buildings},
                {"peak", "%", "#, peak", buildings},
                {"crest offshore", "%", "offshore, crest", NULL},
                {"run-up", "%", "between-units, run-up height", NULL}}},
    {.name = NULL},
};
/* clang-format on */

static double value_of(const sb_figures *figures, const char *pattern, const char *body)
{
    char quantity[SB_FIGURE_TEXT];
    snprintf(quantity, sizeof quantity, "%s%s", body, pattern + (body[0] ? 1 : 0));
    const sb_figure *f = sb_figures_find(figures, quantity);
    return f ? f->value : (double)NAN;
}

static double difference_from(const sb_error_measure *m, const sb_figures *figures, const sb_figures *const *references,
                              size_t count)
{
    static const char *const one[] = {"", NULL};
    double differences = 0, sum = 0;
    for (const char *const *body = m->bodies ? m->bodies : one; *body; body++) {
        double reference = 0;
        for (size_t i = 0; i < count; i++) reference += value_of(references[i], m->quantity, *body) / (double)count;
        differences += fabs(value_of(figures, m->quantity, *body) - reference);
        sum += fabs(reference);
    }
    return 100 * differences / sum;
}

double sb_subject_error(const sb_error_measure *measure, const sb_figures *figures, const sb_figures *const *references,
                        size_t reference_count)
{
    if (reference_count) return difference_from(measure, figures, references, reference_count);
    const sb_figure *f = sb_figures_find(figures, measure->quantity);
    return f ? fabs(f->error) : (double)NAN;
}
