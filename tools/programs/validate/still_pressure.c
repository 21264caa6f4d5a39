#include "still_pressure.h"

#include "frames.h"

#include <math.h>

double sb_still_depth(const sb_scene *scene)
{
    return scene->sea.level - scene->bodies[0].min.z;
}

/* Means over particles and files of p - rho g (level - z), in layers one spacing thick. */
enum { LAYERS = 512 };
typedef struct profile {
    const sb_scene *scene;
    double bottom;
    double excess[LAYERS], pressure[LAYERS], height[LAYERS], square;
    size_t count[LAYERS], total;
} profile;

static void add_frame(void *context, const sb_frame *frame)
{
    profile *p = context;
    double weight = p->scene->fluid.density * p->scene->fluid.gravity;
    for (size_t i = 0; i < frame->count; i++) {
        double z = frame->origin.z + (double)frame->position[3 * i + 2];
        double excess = (double)frame->pressure[i] - weight * (p->scene->sea.level - z);
        double layer = floor((z - p->bottom) / p->scene->resolution);
        if (!(layer >= 0 && layer < LAYERS)) continue;
        size_t k = (size_t)layer;
        p->excess[k] += excess;
        p->pressure[k] += (double)frame->pressure[i];
        p->height[k] += z;
        p->count[k]++;
        p->square += excess * excess;
        p->total++;
    }
}

/* A layer with fewer particles consists of single particles above the surface and is ignored. */
static int is_layer(const profile *p, size_t k)
{
    return (double)p->count[k] > 0.004 * (double)p->total;
}

static void read_profile(const sb_case_run *run, profile *p)
{
    *p = (profile){.scene = run->scene, .bottom = run->scene->bodies[0].min.z};
    sb_run_frames(run, 0.5 * run->scene->duration, HUGE_VAL, add_frame, p);
}

static double weight_of(const sb_scene *scene)
{
    return scene->fluid.density * scene->fluid.gravity;
}

static void figure_layers(const sb_case_run *run, sb_figures *figures)
{
    profile p;
    double scale = weight_of(run->scene) * sb_still_depth(run->scene), worst = 0;
    size_t at = 0;
    read_profile(run, &p);
    for (size_t k = 0; k < LAYERS; k++) {
        if (!is_layer(&p, k)) continue;
        double miss = p.excess[k] / (double)p.count[k];
        if (isnan(worst) || fabs(miss) <= fabs(worst)) continue;
        worst = miss;
        at = k;
    }
    sb_figure_below(figures, "pressure profile, worst layer", "%", 100 * fabs(worst) / scale, 1,
                    "relative to rho g D; means over layers one spacing thick and over the particle files of the "
                    "second half; largest error in layer %zu from the floor, %+.1f Pa",
                    at + 1, worst);
    sb_figure_report(figures, "pressure of single particles, RMS error", "%", (double)NAN,
                     100 * sqrt(p.square / (double)p.total) / scale, "relative to rho g D; same files");
}

/* Pressures at the scene's probes, on walls and in the water. */
static void figure_probes(const sb_case_run *run, sb_figures *figures)
{
    const sb_scene *scene = run->scene;
    double weight = weight_of(scene), worst = 0;
    const char *name = "none";
    for (size_t i = 0; i < scene->measure.probe_count; i++) {
        const sb_probe *probe = &scene->measure.probes[i];
        const sb_curve *pressure = sb_run_curve(run, "probes.csv", probe->name, "time_s", "p_Pa");
        double miss =
            sb_curve_mean(pressure, 0.5 * scene->duration, HUGE_VAL) - weight * (scene->sea.level - probe->at.z);
        if (!isnan(worst) && !(fabs(miss) <= fabs(worst))) { /* a probe without a value stays the worst */
            worst = miss;
            name = probe->name;
        }
    }
    sb_figure_below(figures, "pressure at probes, worst", "%", 100 * fabs(worst) / (weight * sb_still_depth(scene)), 1,
                    "relative to rho g D; means over the second half at %zu probes on walls and in the water; largest "
                    "error %+.1f Pa at %s",
                    scene->measure.probe_count, worst, name);
}

void sb_still_figures(const sb_case_run *run, sb_figures *figures)
{
    figure_probes(run, figures);
    figure_layers(run, figures);
}

void sb_still_plot(const sb_case_run *run, sb_plot *plot)
{
    profile p;
    sb_curve *curve = sb_curve_new(run->made);
    double scale = weight_of(run->scene) * sb_still_depth(run->scene);
    read_profile(run, &p);
    for (size_t k = 0; k < LAYERS; k++) {
        double n = (double)p.count[k];
        if (is_layer(&p, k)) sb_curve_add(curve, p.height[k] / n, p.excess[k] / n / scale * 100);
    }
    sb_plot_run(plot, run, curve);
}
