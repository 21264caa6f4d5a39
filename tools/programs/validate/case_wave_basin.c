/* The basin of Wen et al.: surface, pressures and velocities beside a Stokes wave of fifth order with one fitted phase.
 */
#include "cases.h"
#include "wave_fit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WINDOW = 5, STEPS = 60 }; /* periods, the last ones of the run; points of a plotted period */

/* The wave of theory in place and time. */
typedef struct theory {
    sb_stokes wave;
    double current, speed;          /* m/s: return current; of the crests over the ground */
    double crest, place;            /* s, m: a crest passes `place` at `crest` */
    double depth, gravity, density; /* m, m/s^2, kg/m^3 */
    double period, first, last;     /* s; the window */
    double bernoulli;               /* m^2/s^2: p/rho + g z + q^2/2 beside the moving crest */
} theory;

static double ahead_of(const theory *s, double x, double t)
{
    return x - s->place - s->speed * (t - s->crest);
}

static double elevation(const theory *s, const sb_vec3 *at, double t)
{
    return sb_stokes_elevation(&s->wave, ahead_of(s, at->x, t));
}

static double along(const theory *s, const sb_vec3 *at, double t)
{
    double u, w;
    sb_stokes_velocity(&s->wave, ahead_of(s, at->x, t), at->z, &u, &w);
    return u + s->current;
}

static double upward(const theory *s, const sb_vec3 *at, double t)
{
    double u, w;
    sb_stokes_velocity(&s->wave, ahead_of(s, at->x, t), at->z, &u, &w);
    return w;
}

/* Bernoulli's equation in the frame of the wave, where the flow is steady. */
static double pressure(const theory *s, const sb_vec3 *at, double t)
{
    double u, w;
    sb_stokes_velocity(&s->wave, ahead_of(s, at->x, t), at->z, &u, &w);
    const double relative = u - s->wave.celerity;
    return s->density * (s->bernoulli - s->gravity * at->z - 0.5 * (relative * relative + w * w));
}

/* One quantity that is compared: a gauge or a column of a probe. */
typedef struct compared {
    const char *quantity, *place, *column, *unit;
    bool gauge;
    double (*of)(const theory *s, const sb_vec3 *at, double t);
} compared;

static const compared all[] = {{"surface at 3 m", "near", "eta_m", "m", true, elevation},
                               {"surface at 6 m", "middle", "eta_m", "m", true, elevation},
                               {"pressure 0.1 m above the bed", "low", "p_Pa", "Pa", false, pressure},
                               {"pressure 0.25 m above the bed", "half", "p_Pa", "Pa", false, pressure},
                               {"pressure 0.4 m above the bed", "high", "p_Pa", "Pa", false, pressure},
                               {"u 0.1 m above the bed", "low", "u_m_s", "m/s", false, along},
                               {"u 0.25 m above the bed", "half", "u_m_s", "m/s", false, along},
                               {"u 0.4 m above the bed", "high", "u_m_s", "m/s", false, along},
                               {"w 0.1 m above the bed", "low", "w_m_s", "m/s", false, upward},
                               {"w 0.25 m above the bed", "half", "w_m_s", "m/s", false, upward},
                               {"w 0.4 m above the bed", "high", "w_m_s", "m/s", false, upward}};
enum { COMPARED = sizeof all / sizeof *all };

static sb_vec3 place_of(const sb_scene *scene, const compared *c)
{
    const sb_measure_settings *m = &scene->measure;
    for (size_t g = 0; c->gauge && g < m->gauge_count; g++)
        if (strcmp(m->gauges[g].name, c->place) == 0) return (sb_vec3){m->gauges[g].x, m->gauges[g].y, 0};
    for (size_t p = 0; !c->gauge && p < m->probe_count; p++)
        if (strcmp(m->probes[p].name, c->place) == 0) return m->probes[p].at;
    return (sb_vec3){0, 0, 0};
}

static sb_curve *simulated(const sb_case_run *run, const compared *c)
{
    return sb_run_curve(run, c->gauge ? "gauges.csv" : "probes.csv", c->place, "time_s", c->column);
}

static sb_curve *expected(const sb_case_run *run, const theory *s, const compared *c)
{
    const sb_vec3 at = place_of(run->scene, c);
    sb_curve *curve = sb_curve_new(run->made);
    const int points = WINDOW * STEPS;
    for (int i = 0; i <= points; i++) {
        const double t = s->first + (s->last - s->first) * i / points;
        sb_curve_add(curve, t, c->of(s, &at, t));
    }
    return curve;
}

/* The crest's time is that of the first harmonic at the middle gauge; nothing else is fitted. */
static bool find_theory(const sb_case_run *run, theory *s)
{
    const sb_scene *scene = run->scene;
    const sb_wavemaker_parameters *law = &scene->wavemakers[0].law;
    *s = (theory){.depth = law->depth,
                  .gravity = scene->fluid.gravity,
                  .density = scene->fluid.density,
                  .period = law->period,
                  .first = scene->duration - WINDOW * law->period,
                  .last = scene->duration,
                  .place = place_of(scene, &all[1]).x};
    const sb_wave_fit fit = sb_wave_fit_of(simulated(run, &all[1]), law->period, s->first, s->last);
    if (!sb_wave_fit_stokes(law->height, law->period, law->depth, s->gravity, &s->wave, &s->current)) return false;
    s->speed = s->wave.celerity + s->current;
    s->crest = fit.phase[0] * law->period / (2 * M_PI);
    double u, w;
    const double top = s->depth + sb_stokes_elevation(&s->wave, 0);
    sb_stokes_velocity(&s->wave, 0, top, &u, &w);
    s->bernoulli = s->gravity * top + 0.5 * (u - s->wave.celerity) * (u - s->wave.celerity);
    return true;
}

static double range_of(const sb_curve *curve)
{
    return sb_curve_y(curve, sb_curve_highest(curve, -HUGE_VAL, HUGE_VAL)) -
           sb_curve_y(curve, sb_curve_lowest(curve, -HUGE_VAL, HUGE_VAL));
}

static double height_at(const sb_case_run *run, const theory *s, const char *gauge)
{
    return sb_wave_fit_height(sb_wave_fit_gauge(run, gauge), s->period, s->first, s->last);
}

static void figure_heights(const sb_case_run *run, const theory *s, sb_figures *figures)
{
    const double aim = run->scene->wavemakers[0].law.height;
    static const char *const across[] = {"middle-left", "middle", "middle-right"};
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int i = 0; i < 3; i++) {
        const double height = height_at(run, s, across[i]);
        low = fmin(low, height);
        high = fmax(high, height);
    }
    sb_figure_share(figures, "height at 3 m", "m", aim, height_at(run, s, "near"), aim, 3,
                    "mean of crest minus trough over the last five periods");
    sb_figure_share(figures, "height at 6 m", "m", aim, height_at(run, s, "middle"), aim, 3, "the same");
    sb_figure_report(figures, "height at 6 m, range across the basin", "m", (double)NAN, high - low,
                     "of three gauges at 0.4, 1 and 1.6 m");
    sb_figure_report(figures, "mean level at 6 m", "mm", (double)NAN,
                     1e3 * sb_wave_fit_of(simulated(run, &all[1]), s->period, s->first, s->last).mean,
                     "theory has 0: the long wave of the start changes the level by millimetres");
    sb_figure_report(figures, "height in the sponge over that aimed at", "", (double)NAN,
                     height_at(run, s, "sponge") / aim, "2.5 m behind its beginning");
}

static void evaluate(const sb_case_run *run, sb_figures *figures)
{
    theory s;
    if (!find_theory(run, &s)) {
        if (run->error->status == SB_OK) sb_fail(run->error, SB_FAILED, "no Stokes wave of this height and period");
        return;
    }
    figure_heights(run, &s, figures);
    for (size_t k = 0; k < COMPARED; k++) {
        const sb_curve *reference = expected(run, &s, &all[k]), *own = simulated(run, &all[k]);
        const double range = range_of(reference);
        sb_figure_below(figures, all[k].quantity, "%",
                        100 * sb_curve_rms_difference(reference, own, s.first, s.last) / range, 5,
                        "RMS difference over the range of theory, %.4g %s", range, all[k].unit);
    }
    sb_figure_report(
        figures, "run time", "h", (double)NAN, run->wall / 3600,
        "Wen et al.: about 2 days on 64 processors, 1.5 million particles; return current of theory %.3g m/s",
        s.current);
}

static void plot(const sb_case_run *runs, size_t count, sb_plot *plot)
{
    static const size_t shown[] = {1, 3, 6, 9};
    for (size_t k = 0; k < sizeof shown / sizeof *shown; k++) {
        const compared *c = &all[shown[k]];
        theory s;
        if (!find_theory(&runs[count - 1], &s)) return;
        sb_plot_panel(plot, c->quantity, "time (s)", c->unit);
        sb_plot_range(plot, s.first, s.last, (double)NAN, (double)NAN);
        sb_plot_curve(plot, SB_PLOT_REFERENCE, "Stokes, fifth order", expected(&runs[count - 1], &s, c));
        for (size_t i = 0; i < count; i++) sb_plot_run(plot, &runs[i], simulated(&runs[i], c));
    }
}

static const char *const plain[] = {"render.interval=0", NULL};
static const char *const papers_plates[] = {"render.interval=0", "wavemakers.waves.plates.width=0.1", NULL};
/* A slab of 0.4 m. */
static const char *const slab[] = {
    "render.interval=0",
    "domain.max=[12, 0.4, 0.8]",
    "bodies.paddle.max=[0, 0.4, 0.78]",
    "measure.gauges=[{name: near-left, x: 3, y: 0.3}, {name: near, x: 3, y: 0.2}, {name: near-right, x: 3, y: 0.1}, "
    "{name: middle-left, x: 6, y: 0.3}, {name: middle, x: 6, y: 0.2}, {name: middle-right, x: 6, y: 0.1}, "
    "{name: sponge, x: 11.5, y: 0.2}]",
    "measure.probes=[{name: low, at: [6, 0.2, 0.1]}, {name: half, at: [6, 0.2, 0.25]}, {name: high, at: [6, 0.2, "
    "0.4]}]",
    "water.seed=[1, 0.2, 0.25]",
    NULL};

const sb_case sb_case_wave_basin = {
    .name = "wave-basin",
    .title = "The wave basin of Wen et al., H 0.12 m, T 1.2 s, 0.5 m of water",
    .targets = "height: within 3 %; surface, pressure and velocity: RMS difference at most 5 % of the range",
    .method =
        "Reference: Stokes' theory of fifth order (Fenton 1985) with the return current of a closed basin; pressures "
        "by "
        "Bernoulli's\nequation. One phase is fitted for all: that of the first harmonic of the surface at 6 m. The "
        "last "
        "five periods of 17 s count; no\nfilter. The basin is that of Wen et al., section 4: 12 m by 2 m, periodic "
        "across, push-plates of 0.1 m (0.2 m at 4 cm and in the quick form), a sponge of 3 m. The\npaper's places of "
        "measurement are not in its text; ours "
        "are "
        "at 3, 6 and 11.5 m. The quick form is a slab of 0.4 m.",
    .scene = "../scenes/wave-basin.yaml",
    .headline = "height at 6 m",
    .full = {{.resolution = 0.04, .settings = plain}, {.resolution = 0.02, .judged = true, .settings = papers_plates}},
    .quick = {{.resolution = 0.05, .judged = true, .settings = slab}},
    .evaluate = evaluate,
    .plot = plot};
