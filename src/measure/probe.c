/* Velocity and pressure at a point, by a weighted fit to the particles around it. */
#include "measure/parts.h"
#include "measure/patch.h"

enum { TERMS = 4 };

#define WIDENED 1.5 /* factor on the radius where the first layer at a wall is ignored */

/* Solves A x = e0 (A symmetric, n x n) by elimination; false when a pivot falls below `least`. */
static bool solve_first_unit(double a[TERMS][TERMS], int n, double least, double x[TERMS])
{
    for (int i = 0; i < n; i++) x[i] = i == 0;
    for (int k = 0; k < n; k++) {
        if (!(a[k][k] > least)) return false;
        for (int i = k + 1; i < n; i++) {
            double factor = a[i][k] / a[k][k];
            for (int j = k; j < n; j++) a[i][j] -= factor * a[k][j];
            x[i] -= factor * x[k];
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int j = k + 1; j < n; j++) x[k] -= a[k][j] * x[j];
        x[k] /= a[k][k];
    }
    return true;
}

/* The basis functions: 1 and the offset in radii along each axis; in 2D without y. Returns their number. */
static int basis(const sb_measure_view *view, sb_vec3 offset, double radius, double terms[TERMS])
{
    int n = 0;
    terms[n++] = 1;
    terms[n++] = offset.x / radius;
    terms[n++] = offset.z / radius;
    if (view->scene->dimensions == 3) terms[n++] = offset.y / radius;
    return n;
}

static double coefficient_of(const sb_measure_view *view, const sb_fluid_sample *sample, sb_vec3 at, double radius,
                             const double c[TERMS])
{
    double terms[TERMS], sum = 0;
    int n = basis(view, sb_sub(sample->position, at), radius, terms);
    for (int k = 0; k < n; k++) sum += c[k] * terms[k];
    return sum * sample->density;
}

/* Finds the coefficients c with value = sum_j w_j f_j (c . basis_j). If `linear`, they are those of the moving
   least-squares fit, which is exact for linear fields. Otherwise, or where that fit would amplify the particles' noise,
   they give the Shepard mean. The amplification is the sum of the absolute coefficients of all particles; an
   extrapolation from two layers to their wall, 1.5 f1 - 0.5 f2, has 2. */
static void fit(const sb_measure_view *view, sb_vec3 at, double radius, bool linear, double c[TERMS])
{
    const sb_cloud *cloud = view->cloud;
    double moments[TERMS][TERMS] = {0}, total = 0, terms[TERMS], amplification = 0;
    int n = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        double weight = cloud->samples[i].density;
        n = basis(view, sb_sub(cloud->samples[i].position, at), radius, terms);
        total += weight;
        for (int k = 0; k < n; k++)
            for (int l = 0; l < n; l++) moments[k][l] += weight * terms[k] * terms[l];
    }
    if (linear && solve_first_unit(moments, n, 1e-9 * total, c)) {
        for (size_t i = 0; i < cloud->count; i++)
            amplification += fabs(coefficient_of(view, &cloud->samples[i], at, radius, c));
        if (amplification <= 2.5) return;
    }
    for (int k = 0; k < TERMS; k++) c[k] = 0;
    c[0] = 1 / total;
}

/* Keeps the particles within the radius and stores their kernel weight in .density. False: the probe is dry. */
static bool weigh(const sb_measure_view *view, const sb_probe *probe, const sb_patch *patch, double radius)
{
    sb_cloud *cloud = view->cloud;
    const sb_vec3 wetness_point = sb_patch_wetness_point(patch);
    double nearest = radius, spacing = view->scene->resolution;
    size_t kept = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        sb_fluid_sample sample = cloud->samples[i];
        double distance = sb_norm(sb_sub(sample.position, probe->at));
        if (distance >= radius) continue;
        nearest = fmin(nearest, sb_norm(sb_sub(sample.position, wetness_point)));
        sample.density = view->scene->numerics.kernel->shape(distance / radius);
        cloud->samples[kept++] = sample;
    }
    cloud->count = kept;
    /* In a corner of walls the nearest lattice point is 0.87 spacings away from the probe, on a wall 0.5..0.87, and
       less from the wetness point. If the nearest particle is farther away, the probe is out of the water. One or two
       particles are a drop. */
    return kept > (size_t)view->scene->dimensions - 1 && nearest < 1.1 * spacing;
}

/* The velocity by the linear fit. */
static sb_vec3 velocity_at(const sb_measure_view *view, sb_vec3 at, double radius)
{
    double c[TERMS];
    sb_vec3 v = {0, 0, 0};
    fit(view, at, radius, true, c);
    for (size_t i = 0; i < view->cloud->count; i++) {
        const sb_fluid_sample *sample = &view->cloud->samples[i];
        v = sb_madd(v, coefficient_of(view, sample, at, radius, c), sample->velocity);
    }
    return v;
}

/* Removes the first layer at a wall from the cloud; false when there was none. */
static bool drop_first_layer(sb_cloud *cloud, const sb_patch *patch)
{
    size_t kept = 0, before = cloud->count;
    for (size_t i = 0; i < before; i++)
        if (!sb_patch_first_layer(patch, cloud->samples[i].position)) cloud->samples[kept++] = cloud->samples[i];
    cloud->count = kept;
    return kept < before;
}

static double pressure_at(const sb_measure_view *view, sb_vec3 at, double radius, bool linear)
{
    double c[TERMS], p = 0, weight = view->scene->fluid.density * view->scene->fluid.gravity;
    fit(view, at, radius, linear, c);
    for (size_t i = 0; i < view->cloud->count; i++) {
        const sb_fluid_sample *sample = &view->cloud->samples[i];
        /* With this hydrostatic correction the Shepard mean, too, is exact in water at rest. */
        double here = sample->pressure + weight * (sample->position.z - at.z);
        p += coefficient_of(view, sample, at, radius, c) * here;
    }
    return p > 0 ? p : 0;
}

static sb_status query_around(const sb_measure_view *view, sb_vec3 at, double radius, sb_error *error)
{
    sb_vec3 half = sb_vec(radius, radius, radius);
    return sb_cloud_query(view->cloud, view->sim, sb_sub(at, half), sb_add(at, half), view->lag, error);
}

/* Near a wall the first layer is ignored, the radius is larger to include the remaining layers, and the fit is the
   mean: the second layer's pressure is too low, and a linear fit would extrapolate that (at rest, in the second layer:
   mean -5 % in 3D and -12 % in 2D, linear -9 % and -29 %). In a film of only one layer, that layer is used. */
static sb_status read_pressure(const sb_measure_view *view, const sb_probe *probe, const sb_patch *patch, double radius,
                               double *pressure, sb_error *error)
{
    if (drop_first_layer(view->cloud, patch)) {
        double far = WIDENED * radius;
        sb_status status = query_around(view, probe->at, far, error);
        if (status != SB_OK) return status;
        bool wet = weigh(view, probe, patch, far);
        drop_first_layer(view->cloud, patch);
        if (wet && view->cloud->count > (size_t)view->scene->dimensions) {
            *pressure = pressure_at(view, probe->at, far, false);
            return SB_OK;
        }
        status = query_around(view, probe->at, radius, error);
        if (status != SB_OK || !weigh(view, probe, patch, radius)) return status;
    }
    *pressure = pressure_at(view, probe->at, radius, true);
    return SB_OK;
}

sb_status sb_probe_read(const sb_measure_view *view, const sb_probe *probe, const sb_patch *patch, sb_vec3 *velocity,
                        double *pressure, sb_error *error)
{
    const sb_scene *scene = view->scene;
    const double mean = *pressure;
    double radius = probe->radius > 0 ? probe->radius : scene->numerics.support * scene->resolution;
    *velocity = sb_vec((double)NAN, (double)NAN, (double)NAN);
    *pressure = (double)NAN;
    sb_status status = query_around(view, probe->at, radius, error);
    if (status != SB_OK) return status;
    const bool wet = weigh(view, probe, patch, radius), pressed = mean != 0 && !isnan(mean);
    if (!wet && !pressed) return SB_OK;
    if (view->cloud->count > 0) *velocity = velocity_at(view, probe->at, radius);
    *pressure = mean;
    return isnan(mean) ? read_pressure(view, probe, patch, radius, pressure, error) : SB_OK;
}
