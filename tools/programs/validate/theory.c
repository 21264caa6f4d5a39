#include "theory.h"

#include <math.h>

double sb_theory_standing_shift(double kh, double steepness)
{
    double w = sqrt(tanh(kh)); /* linear frequency in units of sqrt(g k) */
    double second = (9 * pow(w, -7) - 12 * pow(w, -3) - 3 * w - 2 * pow(w, 5)) / 32;
    return 1 + 0.5 * steepness * steepness * second / w;
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
