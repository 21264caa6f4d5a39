#include "reference/reference.h"

#include "base/memory.h"

#include <math.h>

enum { IMAGES = 27 };

/* Finds the position itself, then its images one period away along each periodic axis. */
static int find_images(const sb_reference_cloud *cloud, sb_vec3 at, sb_vec3 image[IMAGES])
{
    int count = 0;
    image[count++] = at;
    const double period[3] = {cloud->period.x, cloud->period.y, cloud->period.z};
    for (int axis = 0; axis < 3; axis++) {
        int before = count;
        for (int k = 0; k < before && period[axis] > 0; k++)
            for (int way = -1; way <= 1; way += 2) {
                double by = way * period[axis];
                image[count++] = sb_add(image[k], sb_vec(axis == 0 ? by : 0, axis == 1 ? by : 0, axis == 2 ? by : 0));
            }
    }
    return count;
}

void sb_reference_psi(const sb_reference_cloud *cloud, double gamma, bool curved, double *psi)
{
    for (size_t b = 0; b < cloud->wall_count; b++) {
        double sum = 0, bend = 0;
        for (size_t k = 0; k < cloud->wall_count; k++) {
            sb_vec3 image[IMAGES];
            int images = find_images(cloud, cloud->wall_position[k], image);
            for (int m = 0; m < images; m++) {
                const sb_vec3 offset = sb_sub(image[m], cloud->wall_position[b]);
                const double w = sb_kernel_value(cloud->kernel, cloud->dimension, cloud->h, sb_norm(offset));
                sum += w;
                if (curved && sb_dot(cloud->wall_normal[k], cloud->wall_normal[b]) > -0.1)
                    bend += w * sb_dot(offset, cloud->wall_normal[b]) / cloud->h;
            }
        }
        psi[b] = gamma * cloud->rest_density / sum * (1 + 8 * bend / sum * fabs(bend / sum));
    }
}

/* Appends the pair of i with a point x if they are closer than h. */
static int add_pair(const sb_reference_cloud *cloud, size_t i, size_t other, sb_vec3 x, sb_reference_pair **pairs,
                    size_t *count, size_t *capacity)
{
    sb_vec3 offset = sb_sub(cloud->position[i], x);
    double r = sb_norm(offset);
    if (r >= cloud->h) return 0;
    if (sb_grow((void **)pairs, capacity, *count + 1, sizeof **pairs) != 0) return -1;
    double slope = sb_kernel_slope(cloud->kernel, cloud->dimension, cloud->h, r);
    (*pairs)[(*count)++] = (sb_reference_pair){
        .other = other,
        .offset = offset,
        .w = sb_kernel_value(cloud->kernel, cloud->dimension, cloud->h, r),
        .gradient = sb_scale(offset, r > 0 ? slope / r : 0),
    };
    return 0;
}

int sb_reference_create(const sb_reference_cloud *cloud, sb_reference *reference)
{
    sb_reference made = {.cloud = *cloud};
    size_t n = cloud->fluid_count, fluid = 0, fluid_room = 0, wall = 0, wall_room = 0;
    made.mass = cloud->rest_density * pow(cloud->spacing, cloud->dimension);
    made.fluid_start = sb_alloc(n + 1, sizeof(size_t));
    made.wall_start = sb_alloc(n + 1, sizeof(size_t));
    int status = made.fluid_start && made.wall_start ? 0 : -1;
    sb_vec3 image[IMAGES];
    for (size_t i = 0; i < n && status == 0; i++) {
        for (size_t j = 0; j < n && status == 0; j++) {
            int images = find_images(cloud, cloud->position[j], image);
            for (int m = j == i; m < images && status == 0; m++)
                status = add_pair(cloud, i, j, image[m], &made.fluid, &fluid, &fluid_room);
        }
        for (size_t b = 0; b < cloud->wall_count && status == 0; b++) {
            int images = find_images(cloud, cloud->wall_position[b], image);
            for (int m = 0; m < images && status == 0; m++)
                status = add_pair(cloud, i, b, image[m], &made.wall, &wall, &wall_room);
        }
        made.fluid_start[i + 1] = fluid;
        made.wall_start[i + 1] = wall;
    }
    if (status != 0)
        sb_reference_destroy(&made);
    else
        *reference = made;
    return status;
}

void sb_reference_destroy(sb_reference *reference)
{
    sb_free(reference->fluid);
    sb_free(reference->wall);
    sb_free(reference->fluid_start);
    sb_free(reference->wall_start);
    *reference = (sb_reference){0};
}

void sb_reference_density(const sb_reference *reference, double *rho)
{
    const sb_reference_cloud *c = &reference->cloud;
    double self = sb_kernel_value(c->kernel, c->dimension, c->h, 0);
    for (size_t i = 0; i < c->fluid_count; i++) {
        rho[i] = reference->mass * self;
        for (size_t k = reference->fluid_start[i]; k < reference->fluid_start[i + 1]; k++)
            rho[i] += reference->mass * reference->fluid[k].w;
        for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++)
            rho[i] += c->psi[reference->wall[k].other] * reference->wall[k].w;
    }
}

/* Pi = -nu min(v.x, 0)/(r^2 + 0.01 h^2): acts only on pairs that approach each other. */
static double switched_viscosity(double nu, sb_vec3 velocity, sb_vec3 offset, double h)
{
    double approach = sb_dot(velocity, offset);
    return approach < 0 ? -nu * approach / (sb_dot(offset, offset) + 0.01 * h * h) : 0;
}

void sb_reference_viscosity(const sb_reference *reference, const double *rho, sb_vec3 *acceleration)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++)
        for (size_t k = reference->fluid_start[i]; k < reference->fluid_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->fluid[k];
            size_t j = pair->other;
            double nu = 2 * c->artificial_viscosity * c->h * c->sound_speed / (rho[i] + rho[j]);
            double pi = switched_viscosity(nu, sb_sub(c->velocity[i], c->velocity[j]), pair->offset, c->h);
            acceleration[i] = sb_madd(acceleration[i], -reference->mass * pi, pair->gradient);
        }
}

static void add_force(const sb_reference *reference, size_t b, double size, sb_vec3 gradient, const sb_vec3 *center,
                      sb_vec3 *force, sb_vec3 *torque)
{
    uint32_t body = reference->cloud.body[b];
    sb_vec3 arm = sb_sub(reference->cloud.wall_position[b], center[body]);
    sb_vec3 part = sb_scale(gradient, size);
    force[body] = sb_add(force[body], part);
    torque[body] = sb_add(torque[body], sb_cross(arm, part));
}

void sb_reference_friction(const sb_reference *reference, const double *rho, sb_vec3 *acceleration,
                           const sb_vec3 *center, sb_vec3 *force, sb_vec3 *torque)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++)
        for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->wall[k];
            size_t b = pair->other;
            double nu = c->wall_friction * c->h * c->sound_speed / (2 * rho[i]);
            double pi = switched_viscosity(nu, sb_sub(c->velocity[i], c->wall_velocity[b]), pair->offset, c->h);
            acceleration[i] = sb_madd(acceleration[i], -c->psi[b] * pi, pair->gradient);
            if (force) add_force(reference, b, reference->mass * c->psi[b] * pi, pair->gradient, center, force, torque);
        }
}

void sb_reference_shear(const sb_reference *reference, double nu, double offset, sb_vec3 *acceleration,
                        const sb_vec3 *center, sb_vec3 *force, sb_vec3 *torque)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++)
        for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->wall[k];
            const size_t b = pair->other;
            const sb_vec3 n = c->wall_normal[b], relative = sb_sub(c->velocity[i], c->wall_velocity[b]);
            const sb_vec3 along = sb_madd(relative, -sb_dot(relative, n), n);
            const double height = sb_dot(pair->offset, n), u = sb_norm(along);
            if (!(height > 0 && u > 0)) continue;
            const double y = fmax(height - offset, 0.25 * c->spacing), reynolds = u * y / nu;
            const double law = fmax(1 / reynolds, 0.0246 * pow(reynolds, -0.25));
            const double size = law * u * c->psi[b] * sb_dot(pair->gradient, n) / c->rest_density;
            acceleration[i] = sb_madd(acceleration[i], size, along);
            if (force) add_force(reference, b, -reference->mass * size, along, center, force, torque);
        }
}

void sb_reference_pressure_forces(const sb_reference *reference, const double *q, const sb_vec3 *center, sb_vec3 *force,
                                  sb_vec3 *torque)
{
    const sb_reference_cloud *c = &reference->cloud;
    for (size_t i = 0; i < c->fluid_count; i++)
        for (size_t k = reference->wall_start[i]; k < reference->wall_start[i + 1]; k++) {
            const sb_reference_pair *pair = &reference->wall[k];
            add_force(reference, pair->other, reference->mass * c->psi[pair->other] * q[i], pair->gradient, center,
                      force, torque);
        }
}
