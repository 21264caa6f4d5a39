/* Fronts of dam breaks on a dry bed: four experiments with different geometries. */
#include "cases.h"

#include <math.h>
#include <stdio.h>

#define NONE ((double)NAN)

typedef struct experiment {
    const char *table;
    const char *sets[3]; /* digitisations in the table, ended by NULL; "": the table has no sets */
    double depth;        /* m, initial height of the water column */
    double last;         /* s; the comparison ends before the measured front meets a wall */
    bool lag;            /* whether the clock is shifted */
    double limit;        /* target: mean distance in % of the range */
} experiment;

/* Cases run with 20, 40 and 80 particles in the depth. */
static const experiment etsin = {"dambreak-front/etsin.csv", {"", NULL}, 0.3, 0.44, true, 3};
static const experiment martin_moyce = {"dambreak-front/martin-moyce.csv", {"a", "b", NULL}, 0.114, 0.32, false, 8};
static const experiment martin_moyce_small = {
    "dambreak-front/martin-moyce-small.csv", {"", NULL}, 0.05715, 0.21, false, 8};
static const experiment koshizuka = {"dambreak-front/koshizuka.csv", {"a", "b", NULL}, 0.292, 0.28, false, 8};

static sb_curve *measured(const sb_case_run *run, const experiment *e, const char *set)
{
    return sb_reference_curve(run, e->table, *set ? set : NULL, "time_s", "front_m");
}

static sb_curve *simulated(const sb_case_run *run)
{
    return sb_run_curve(run, "runup.csv", "floor", "time_s", "front_m");
}

/* Distances between two fronts at the measured times, and the range of the measured one. */
typedef struct distance {
    double mean, largest, range;
} distance;

static distance distance_of(const sb_curve *front, const sb_curve *reference, double last)
{
    distance d = {0, 0, 0};
    size_t count = 0;
    for (size_t i = 0; i < reference->count; i++) {
        double t = reference->x[i], gap = fabs(sb_curve_at(front, t) - reference->y[i]);
        if (t > last || isnan(gap)) continue;
        d.mean += gap;
        d.largest = fmax(d.largest, gap);
        d.range = fmax(d.range, reference->y[i]);
        count++;
    }
    d.mean = count ? d.mean / (double)count : NONE;
    return d;
}

/* Name of a figure of a digitisation. */
static const char *name_of(char text[SB_FIGURE_TEXT], const char *quantity, const char *set)
{
    snprintf(text, SB_FIGURE_TEXT, "%s%s%s", quantity, *set ? ", digitisation " : "", set);
    return text;
}

/* The shift with which both fronts pass one depth from the gate at the same time. */
static double lag_of(const experiment *e, const sb_curve *front, const sb_curve *reference)
{
    return sb_curve_onset(reference, e->depth, 0) - sb_curve_onset(front, e->depth, 0);
}

/* If figures are judged without the shift, the mean distance with it is reported. */
static void evaluate_set(const sb_case_run *run, const experiment *e, const char *set, sb_figures *figures)
{
    char name[SB_FIGURE_TEXT];
    const sb_curve *reference = measured(run, e, set);
    sb_curve *front = simulated(run);
    const double lag = lag_of(e, front, reference);
    if (e->lag) sb_curve_map(front, 1, lag, 1, 0);
    distance d = distance_of(front, reference, e->last);
    sb_figure_below(figures, name_of(name, "front, mean distance", set), "%", 100 * d.mean / d.range, e->limit,
                    "mean |dx| at the measured times until %g s, in %% of the range %.3f m", e->last, d.range);
    sb_figure_report(figures, name_of(name, "front, largest distance", set), "%", NONE, 100 * d.largest / d.range,
                     "at the same times");
    sb_figure_report(figures, name_of(name, "shift of the clock", set), "s", NONE, lag,
                     "with this shift both fronts pass %g m at the same time; %s", e->depth,
                     e->lag ? "applied" : "not applied");
    if (e->lag) return;
    sb_curve_map(front, 1, lag, 1, 0);
    d = distance_of(front, reference, e->last);
    sb_figure_report(figures, name_of(name, "front, mean distance if shifted", set), "%", NONE, 100 * d.mean / d.range,
                     "with that shift");
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    const experiment *e = run->of->what;
    for (int k = 0; e->sets[k]; k++) evaluate_set(run, e, e->sets[k], figures);
}

/* The clock is shifted as in the figures. */
static void draw(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    const experiment *e = runs[0].of->what;
    sb_plot_panel(plot, "Front of the water", "time [s]", "distance from the gate [m]");
    sb_plot_range(plot, 0, 1.1 * e->last, 0, NONE);
    for (int k = 0; e->sets[k]; k++) {
        char label[SB_FIGURE_TEXT];
        sb_plot_curve(plot, SB_PLOT_POINTS, name_of(label, "measured", e->sets[k]), measured(&runs[0], e, e->sets[k]));
    }
    for (size_t i = 0; i < count; i++) {
        sb_curve *front = simulated(&runs[i]);
        if (e->lag) sb_curve_map(front, 1, lag_of(e, front, measured(&runs[i], e, e->sets[0])), 1, 0);
        sb_plot_run(plot, &runs[i], front);
    }
}

const sb_case sb_case_front_etsin = {
    .name = "dambreak-front-etsin",
    .title = "Dam-break front, ETSIN (column 0.60 m by 0.30 m)",
    .targets = "front: mean distance within 3 % of the range, after one time shift",
    .method =
        "The front is the foremost connected water along the floor of a vertical slice, half a spacing before its "
        "last\nparticle, every 2 ms; no filter. The error is the mean of the distances at the measured times, in "
        "percent of the measured\nrange. The measured times are every 20 ms until 0.44 s. The measured front meets "
        "the wall at 0.453 s; the simulated tank is\nlonger. The clock of the experiment is known to be wrong by "
        "about 0.02 s. One shift makes both fronts pass the point\none depth (0.30 m) from the gate at the same "
        "time. Walls are smooth; the gate disappears at t = 0.",
    .scene = "dambreak-front/etsin.yaml",
    .headline = "front, mean distance",
    .full = {{.resolution = 0.015, .paper = true, .wen = true},
             {.resolution = 0.0075, .paper = true, .wen = true},
             {.resolution = 0.00375, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.0075, .judged = true}},
    .what = &etsin,
    .evaluate = evaluate,
    .plot = draw};

const sb_case sb_case_front_martin_moyce = {
    .name = "dambreak-front-martin-moyce",
    .title = "Dam-break front, Martin and Moyce (column 0.057 m by 0.114 m)",
    .targets = "front: mean distance within 8 % of the range, for both digitisations",
    .method = "As for ETSIN, without a shift of the clock: mean distance at the measured points until 0.32 s.",
    .scene = "dambreak-front/martin-moyce.yaml",
    .headline = "front, mean distance, digitisation a",
    .full = {{.resolution = 0.0057, .paper = true},
             {.resolution = 0.00285, .paper = true},
             {.resolution = 0.001425, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.00285, .judged = true}},
    .what = &martin_moyce,
    .evaluate = evaluate,
    .plot = draw};

const sb_case sb_case_front_martin_moyce_small = {
    .name = "dambreak-front-martin-moyce-small",
    .title = "Dam-break front, Martin and Moyce (column 0.029 m by 0.057 m)",
    .targets = "front: mean distance within 8 % of the range",
    .method = "As for ETSIN, without a shift of the clock: mean distance at all measured points.",
    .scene = "dambreak-front/martin-moyce-small.yaml",
    .headline = "front, mean distance",
    .full = {{.resolution = 0.0028575, .paper = true},
             {.resolution = 0.00142875, .paper = true},
             {.resolution = 0.000714375, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.00142875, .judged = true}},
    .what = &martin_moyce_small,
    .evaluate = evaluate,
    .plot = draw};

const sb_case sb_case_front_koshizuka = {
    .name = "dambreak-front-koshizuka",
    .title = "Dam-break front, Koshizuka and Oka (column 0.146 m by 0.292 m)",
    .targets = "front: mean distance within 8 % of the range, for both digitisations",
    .method = "As for ETSIN, without a shift of the clock: mean distance at the measured points until 0.28 s.",
    .scene = "dambreak-front/koshizuka.yaml",
    .headline = "front, mean distance, digitisation a",
    .full = {{.resolution = 0.0146, .paper = true, .wen = true},
             {.resolution = 0.0073, .paper = true, .wen = true},
             {.resolution = 0.00365, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.0073, .judged = true}},
    .what = &koshizuka,
    .evaluate = evaluate,
    .plot = draw};

#define GATE                                                                                                           \
    "The same tank with a gate that opens upwards at 2 m/s, a speed that laboratories use (0.2 to 2.5 m/s: "           \
    "J. Mar. Sci. Eng. 9\n(2021) 67). The speed in this experiment is not known. docs/missed-targets.md has other "    \
    "speeds."

const sb_case sb_case_front_etsin_gate = {
    .name = "dambreak-front-etsin-gate",
    .title = "Dam-break front, ETSIN, with a gate",
    .targets = "front: mean distance within 3 % of the range, after one time shift",
    .method = GATE,
    .scene = "dambreak-front/etsin-gate.yaml",
    .headline = "front, mean distance",
    .full = {{.resolution = 0.015}, {.resolution = 0.0075}, {.resolution = 0.00375, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.0075, .judged = true}},
    .what = &etsin,
    .evaluate = evaluate,
    .plot = draw};

const sb_case sb_case_front_koshizuka_gate = {
    .name = "dambreak-front-koshizuka-gate",
    .title = "Dam-break front, Koshizuka and Oka, with a gate",
    .targets = "front: mean distance within 8 % of the range, for both digitisations",
    .method = GATE,
    .scene = "dambreak-front/koshizuka-gate.yaml",
    .headline = "front, mean distance, digitisation a",
    .full = {{.resolution = 0.0146}, {.resolution = 0.0073}, {.resolution = 0.00365, .judged = true, .seeds = 3}},
    .quick = {{.resolution = 0.0073, .judged = true}},
    .what = &koshizuka,
    .evaluate = evaluate,
    .plot = draw};
