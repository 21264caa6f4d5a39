#include "reference/reference.h"

#include <math.h>
#include <stdbool.h>

/* Sums over one particle's neighbours, weighted by -m W'/r: velocity differences times offsets, and offsets times
   offsets. */
typedef struct fit {
    double velocity[3][3], place[3][3];
} fit;

static fit make_fit(const sb_reference *reference, size_t i)
{
    const sb_reference_cloud *c = &reference->cloud;
    fit f = {0};
    for (size_t k = reference->fluid_start[i]; k < reference->fluid_start[i + 1]; k++) {
        const sb_reference_pair *pair = &reference->fluid[k];
        sb_vec3 difference = sb_sub(c->velocity[i], c->velocity[pair->other]);
        const double v[3] = {difference.x, difference.y, difference.z};
        const double x[3] = {pair->offset.x, pair->offset.y, pair->offset.z};
        const double g[3] = {pair->gradient.x, pair->gradient.y, pair->gradient.z};
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                f.velocity[a][b] -= reference->mass * v[a] * g[b];
                f.place[a][b] -= reference->mass * x[a] * g[b];
            }
    }
    return f;
}

/* Solves m x = rhs over the given axes by Gaussian elimination with pivots. Returns the determinant. */
static double solve(double m[3][3], const int *axis, int count, const double rhs[3], double x[3])
{
    double rows[3][4], determinant = 1;
    for (int a = 0; a < count; a++) {
        for (int b = 0; b < count; b++) rows[a][b] = m[axis[a]][axis[b]];
        rows[a][count] = rhs[axis[a]];
    }
    for (int a = 0; a < count; a++) {
        int best = a;
        for (int r = a + 1; r < count; r++)
            if (fabs(rows[r][a]) > fabs(rows[best][a])) best = r;
        determinant *= best == a ? rows[best][a] : -rows[best][a];
        for (int b = 0; b <= count; b++) {
            double kept = rows[a][b];
            rows[a][b] = rows[best][b];
            rows[best][b] = kept;
        }
        for (int r = a + 1; r < count; r++)
            for (int b = count; b >= a; b--) rows[r][b] -= rows[r][a] / rows[a][a] * rows[a][b];
    }
    for (int a = count - 1; a >= 0; a--) {
        double sum = rows[a][count];
        for (int b = a + 1; b < count; b++) sum -= rows[a][b] * x[axis[b]];
        x[axis[a]] = sum / rows[a][a];
    }
    return determinant;
}

/* |S| = sqrt(2 S:S) */
static double strain_rate(const sb_reference *reference, size_t i, double rho, double thinnest)
{
    const bool flat = reference->cloud.dimension == 2;
    const int axis[3] = {0, flat ? 2 : 1, 2}, count = flat ? 2 : 3;
    fit f = make_fit(reference, i);
    double gradient[3][3] = {{0}}, determinant = 0, square = 0;
    for (int a = 0; a < 3; a++) determinant = solve(f.place, axis, count, f.velocity[a], gradient[a]);
    double mean = (f.place[0][0] + f.place[1][1] + f.place[2][2]) / count;
    bool corrected = determinant / pow(mean, count) > thinnest;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            if (!corrected) gradient[a][b] = f.velocity[a][b] / rho;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) square += pow(gradient[a][b] + gradient[b][a], 2) / 4;
    return sqrt(2 * square);
}

static double wall_distance(const sb_reference *reference, size_t i, double offset)
{
    const sb_reference_cloud *c = &reference->cloud;
    double nearest = (double)INFINITY, distance = (double)INFINITY;
    for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++) {
        const sb_reference_pair *pair = &reference->wall[k];
        double r = sb_norm(pair->offset);
        if (r >= nearest) continue;
        sb_vec3 normal = c->wall_normal ? c->wall_normal[pair->other] : sb_vec(0, 0, 0);
        nearest = r;
        distance = sb_norm(normal) > 0 ? fabs(sb_dot(pair->offset, normal)) : r;
    }
    return fmax(distance - offset, 0);
}

void sb_reference_eddy(const sb_reference *reference, const double *rho, double smagorinsky, double offset,
                       double thinnest, double *eddy)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++) {
        double length = fmin(smagorinsky * c->spacing, 0.4 * wall_distance(reference, i, offset));
        eddy[i] = length * length * strain_rate(reference, i, rho[i], thinnest);
    }
}

void sb_reference_unswitched(const sb_reference *reference, const double *rho, double nu, const double *eddy,
                             sb_vec3 *acceleration)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++)
        for (size_t k = reference->fluid_start[i]; k < reference->fluid_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->fluid[k];
            size_t j = pair->other;
            double mean = nu + (eddy ? 0.5 * (eddy[i] + eddy[j]) : 0);
            double approach = sb_dot(sb_sub(c->velocity[i], c->velocity[j]), pair->offset);
            double size = reference->mass * 4 * (c->dimension + 2) * mean * approach /
                          ((rho[i] + rho[j]) * (sb_dot(pair->offset, pair->offset) + 0.01 * c->h * c->h));
            acceleration[i] = sb_madd(acceleration[i], size, pair->gradient);
        }
}
