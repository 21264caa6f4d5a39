#include "theory.h"

#include <math.h>

double sb_theory_lattice_share(const sb_kernel *kernel, int dimension, double support)
{
    double sum = 0;
    int range = (int)ceil(support), layers = dimension == 3 ? range : 0;
    for (int i = -range; i <= range; i++)
        for (int j = -range; j <= range; j++)
            for (int k = -layers; k <= layers; k++) {
                double r = sqrt((double)(i * i + j * j + k * k));
                if (r == 0 || r >= support) continue;
                double slope = -sb_kernel_slope(kernel, dimension, support, r);
                sum += r * r * r * slope / (r * r + 0.01 * support * support);
            }
    return sum / dimension;
}

double sb_theory_viscosity(const sb_scene *scene, double depth)
{
    const sb_numerics *n = &scene->numerics;
    double h = n->support * scene->resolution;
    double sound = n->sound_speed > 0 ? n->sound_speed : 10 * sqrt(scene->fluid.gravity * depth);
    double artificial = 0.5 * n->artificial_viscosity * h * sound / (2 * (scene->dimensions + 2));
    return sb_theory_lattice_share(n->kernel, scene->dimensions, n->support) * (artificial + scene->fluid.viscosity);
}

double sb_theory_standing_shift(double kh, double steepness)
{
    double w = sqrt(tanh(kh)); /* linear frequency in units of sqrt(g k) */
    double second = (9 * pow(w, -7) - 12 * pow(w, -3) - 3 * w - 2 * pow(w, 5)) / 32;
    return 1 + 0.5 * steepness * steepness * second / w;
}

double sb_theory_decay(double viscosity, double k)
{
    return 2 * viscosity * k * k;
}

sb_cylinder_load sb_theory_cylinder(double height, double number, double depth, double radius, double density,
                                    double gravity)
{
    const double ka = number * radius, kd = number * depth;
    const double j = j0(ka) - j1(ka) / ka, y = y0(ka) - y1(ka) / ka; /* derivatives of J1 and Y1 */
    const double scale = 2 * density * gravity * height / (number * number * hypot(j, y));
    return (sb_cylinder_load){.force = scale * tanh(kd),
                              .moment = scale / number * (kd * sinh(kd) - cosh(kd) + 1) / cosh(kd),
                              .lead = atan2(y, j)};
}
