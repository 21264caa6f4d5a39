/* The pressure problem: source, operator A = -dt^2 G^T G and its diagonal. */
#include "reference/reference.h"

#include <math.h>

void sb_reference_divergence(const sb_reference *reference, const sb_vec3 *velocity, int moving, double *divergence)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++) {
        divergence[i] = 0;
        for (size_t k = reference->fluid_start[i]; k < reference->fluid_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->fluid[k];
            sb_vec3 relative = sb_sub(velocity[i], velocity[pair->other]);
            divergence[i] += reference->mass * sb_dot(relative, pair->gradient);
        }
        for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->wall[k];
            sb_vec3 wall = moving ? c->wall_velocity[pair->other] : sb_vec(0, 0, 0);
            sb_vec3 relative = sb_sub(velocity[i], wall);
            divergence[i] += c->psi[pair->other] * sb_dot(relative, pair->gradient);
        }
    }
}

void sb_reference_source(const sb_reference *reference, const double *rho, const sb_vec3 *predicted, double beta,
                         double *source)
{
    const sb_reference_cloud *c = &reference->cloud;
    sb_reference_divergence(reference, predicted, 1, source);
    for (size_t i = 0; i < c->fluid_count; i++)
        source[i] = beta * (c->rest_density - rho[i]) - c->time_step * source[i];
}

void sb_reference_pressure_acceleration(const sb_reference *reference, const double *q, sb_vec3 *acceleration)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++) {
        sb_vec3 a = {0, 0, 0};
        for (size_t k = reference->fluid_start[i]; k < reference->fluid_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->fluid[k];
            a = sb_madd(a, -reference->mass * (q[i] + q[pair->other]), pair->gradient);
        }
        for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->wall[k];
            a = sb_madd(a, -c->psi[pair->other] * q[i], pair->gradient);
        }
        acceleration[i] = a;
    }
}

void sb_reference_apply(const sb_reference *reference, const double *q, sb_vec3 *acceleration, double *product)
{
    double square = reference->cloud.time_step * reference->cloud.time_step;
    sb_reference_pressure_acceleration(reference, q, acceleration);
    sb_reference_divergence(reference, acceleration, 0, product);
    for (size_t i = 0; i < reference->cloud.fluid_count; i++) product[i] *= square;
}

void sb_reference_diagonal(const sb_reference *reference, double *diagonal)
{
    const sb_reference_cloud *c = &reference->cloud;
    double m = reference->mass;
    for (size_t i = 0; i < c->fluid_count; i++) {
        sb_vec3 sum = {0, 0, 0};
        double squares = 0;
        for (size_t k = reference->fluid_start[i]; k < reference->fluid_start[i + 1]; k++) {
            sb_vec3 gradient = reference->fluid[k].gradient;
            sum = sb_madd(sum, m, gradient);
            squares += m * m * sb_dot(gradient, gradient);
        }
        for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++)
            sum = sb_madd(sum, c->psi[reference->wall[k].other], reference->wall[k].gradient);
        diagonal[i] = -c->time_step * c->time_step * (sb_dot(sum, sum) + squares);
    }
}

double sb_reference_lattice_diagonal(const sb_reference_cloud *cloud)
{
    double m = cloud->rest_density * pow(cloud->spacing, cloud->dimension), squares = 0;
    int radius = (int)ceil(cloud->h / cloud->spacing), across = cloud->dimension == 3 ? radius : 0;
    for (int i = -radius; i <= radius; i++)
        for (int j = -across; j <= across; j++)
            for (int k = -radius; k <= radius; k++) {
                double r = cloud->spacing * sqrt(i * i + j * j + k * k);
                double slope = sb_kernel_slope(cloud->kernel, cloud->dimension, cloud->h, r);
                squares += slope * slope;
            }
    return -cloud->time_step * cloud->time_step * m * m * squares;
}
