#include "sim/state/lattice.h"

#include <math.h>

enum { WAVES = 12 }; /* wave vectors per axis of the first zone's half */

/* Neighbours of the origin: positions in spacings, gradients of W without its normalisation. */
typedef struct star {
    size_t count;
    sb_vec3 place[1000], gradient[1000];
    double squares; /* sum |gradient|^2 */
} star;

static void make_star(const sb_scene *scene, star *s)
{
    const double support = scene->numerics.support;
    const int radius = (int)ceil(support), depth = scene->dimensions == 2 ? 0 : radius;
    s->count = 0;
    s->squares = 0;
    for (int x = -radius; x <= radius; x++)
        for (int y = -depth; y <= depth; y++)
            for (int z = -radius; z <= radius; z++) {
                const double r = sqrt((double)(x * x + y * y + z * z));
                if (!(r > 0 && r < support)) continue;
                const double slope = scene->numerics.kernel->slope(r / support) / r;
                s->place[s->count] = sb_vec(x, y, z);
                s->gradient[s->count] = sb_scale(sb_vec(x, y, z), slope);
                s->squares += slope * slope * r * r;
                s->count++;
            }
}

double sb_lattice_diagonal(const sb_scene *scene, double mass)
{
    double sum = 0, dr = scene->resolution, h = scene->numerics.support * dr;
    int radius = (int)ceil(scene->numerics.support), depth = scene->dimensions == 2 ? 0 : radius;
    for (int x = -radius; x <= radius; x++)
        for (int y = -depth; y <= depth; y++)
            for (int z = -radius; z <= radius; z++) {
                double r = dr * sqrt((double)(x * x + y * y + z * z));
                double slope = r > 0 ? sb_kernel_slope(scene->numerics.kernel, scene->dimensions, h, r) : 0;
                sum += mass * mass * slope * slope;
            }
    return sum;
}

double sb_lattice_slopes(const sb_scene *scene, double mass)
{
    const double dr = scene->resolution, h = scene->numerics.support * dr;
    double sum = 0;
    star s;
    make_star(scene, &s);
    for (size_t j = 0; j < s.count; j++) {
        const double r = dr * sb_norm(s.place[j]);
        sum += mass * fabs(sb_kernel_slope(scene->numerics.kernel, scene->dimensions, h, r)) / r;
    }
    return sum;
}

static double response(const star *s, sb_vec3 k)
{
    sb_vec3 g = {0};
    for (size_t j = 0; j < s->count; j++) g = sb_madd(g, sin(sb_dot(k, s->place[j])), s->gradient[j]);
    return s->squares > 0 ? sb_dot(g, g) / s->squares : 0;
}

double sb_lattice_spectrum(const sb_scene *scene)
{
    static const double pi = 3.14159265358979323846;
    star s;
    double largest = 0;
    make_star(scene, &s);
    for (int x = 0; x <= WAVES; x++) /* the rest follows by symmetry */
        for (int y = 0; y <= (scene->dimensions == 2 ? 0 : x); y++)
            for (int z = 0; z <= (scene->dimensions == 2 ? x : y); z++)
                largest = fmax(largest, response(&s, sb_scale(sb_vec(x, y, z), pi / WAVES)));
    return largest;
}

/* Over the layers up to `top`: the sum of V W, and the vertical component of the sum of h V grad W. */
static void half_space(const sb_scene *scene, int top, double *density, double *slope)
{
    const int dimension = scene->dimensions;
    const double support = scene->numerics.support;
    const int radius = (int)ceil(support), depth = dimension == 2 ? 0 : radius;
    *density = *slope = 0;
    for (int x = -radius; x <= radius; x++)
        for (int y = -depth; y <= depth; y++)
            for (int z = -radius; z <= top; z++) {
                const double r = sqrt((double)(x * x + y * y + z * z));
                *density += sb_kernel_value(scene->numerics.kernel, dimension, support, r);
                if (r > 0) *slope += support * sb_kernel_slope(scene->numerics.kernel, dimension, support, r) * z / r;
            }
}

double sb_lattice_density(const sb_scene *scene)
{
    double density, slope;
    half_space(scene, (int)ceil(scene->numerics.support), &density, &slope);
    return density;
}

double sb_lattice_truncation(const sb_scene *scene)
{
    double density, slope;
    half_space(scene, 0, &density, &slope);
    return (sb_lattice_density(scene) - density) / (slope * slope);
}
