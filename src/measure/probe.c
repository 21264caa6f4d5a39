/* Velocity and pressure at a point by a weighted fit through the particles around it. */
#include "measure/parts.h"

enum { TERMS = 4 };

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

/* 1 and the offset in radii; the horizontal axis that 2D lacks is left out. */
static int basis(const sb_sight *sight, sb_vec3 offset, double radius, double terms[TERMS])
{
    int n = 0;
    terms[n++] = 1;
    terms[n++] = offset.x / radius;
    terms[n++] = offset.z / radius;
    if (sight->scene->dimensions == 3) terms[n++] = offset.y / radius;
    return n;
}

static double share_of(const sb_sight *sight, const sb_fluid_sample *sample, sb_vec3 at,
                       double radius, const double c[TERMS])
{
    double terms[TERMS], share = 0;
    int n = basis(sight, sb_sub(sample->position, at), radius, terms);
    for (int k = 0; k < n; k++) share += c[k] * terms[k];
    return share * sample->density;
}

/* Coefficients c with value = sum_j w_j f_j (c . basis_j): the moving least-squares fit that is
   exact for linear fields, or the Shepard mean where that fit would magnify the particles' noise.
   Extrapolating from two layers to their wall, 1.5 f1 - 0.5 f2, has sum |share| = 2. */
static void fit(const sb_sight *sight, sb_vec3 at, double radius, double c[TERMS])
{
    const sb_cloud *cloud = sight->cloud;
    double moments[TERMS][TERMS] = {0}, total = 0, terms[TERMS], magnified = 0;
    int n = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        double weight = cloud->samples[i].density;
        n = basis(sight, sb_sub(cloud->samples[i].position, at), radius, terms);
        total += weight;
        for (int k = 0; k < n; k++)
            for (int l = 0; l < n; l++) moments[k][l] += weight * terms[k] * terms[l];
    }
    if (solve_first_unit(moments, n, 1e-9 * total, c)) {
        for (size_t i = 0; i < cloud->count; i++)
            magnified += fabs(share_of(sight, &cloud->samples[i], at, radius, c));
        if (magnified <= 2.5) return;
    }
    for (int k = 0; k < TERMS; k++) c[k] = 0;
    c[0] = 1 / total;
}

/* Keeps particles within the radius, their kernel weight going to .density. False: dry. */
static bool weigh(const sb_sight *sight, const sb_probe *probe, double radius)
{
    sb_cloud *cloud = sight->cloud;
    double nearest = radius, spacing = sight->scene->resolution;
    size_t kept = 0;
    for (size_t i = 0; i < cloud->count; i++) {
        sb_fluid_sample sample = cloud->samples[i];
        double distance = sb_norm(sb_sub(sample.position, probe->at));
        if (distance >= radius) continue;
        nearest = distance < nearest ? distance : nearest;
        sample.density = sight->scene->numerics.kernel->shape(distance / radius);
        cloud->samples[kept++] = sample;
    }
    cloud->count = kept;
    /* In a corner of walls the nearest lattice point is 0.87 spacings away, on a wall 0.5..0.87;
       farther off, the probe looks out of the water. One or two particles are a drop. */
    return kept > (size_t)sight->scene->dimensions - 1 && nearest < 1.1 * spacing;
}

sb_status sb_probe_read(const sb_sight *sight, const sb_probe *probe, sb_vec3 *velocity,
                        double *pressure, sb_error *error)
{
    const sb_scene *scene = sight->scene;
    double radius = probe->radius > 0 ? probe->radius : scene->numerics.support * scene->resolution;
    sb_vec3 reach = sb_vec(radius, radius, radius);
    *velocity = sb_vec((double)NAN, (double)NAN, (double)NAN);
    *pressure = (double)NAN;
    sb_status status = sb_cloud_query(sight->cloud, sight->sim, sb_sub(probe->at, reach),
                                      sb_add(probe->at, reach), sight->lag, error);
    if (status != SB_OK || !weigh(sight, probe, radius)) return status;
    double c[TERMS], p = 0;
    sb_vec3 v = {0, 0, 0};
    fit(sight, probe->at, radius, c);
    for (size_t i = 0; i < sight->cloud->count; i++) {
        const sb_fluid_sample *sample = &sight->cloud->samples[i];
        double share = share_of(sight, sample, probe->at, radius, c);
        double height = sample->position.z - probe->at.z;
        v = sb_madd(v, share, sample->velocity);
        /* Hydrostatic correction: the Shepard mean, too, is exact in water at rest. */
        p += share * (sample->pressure + scene->fluid.density * scene->fluid.gravity * height);
    }
    *velocity = v;
    *pressure = p > 0 ? p : 0;
    return SB_OK;
}
