#include "physics/wavemakers/paddle_third.h"

#include <math.h>

/* Found at half of the height up to which waves of second order are valid, or at H/L = 0.040 to 0.045. */
static const struct {
    double kd, loss;
} found[] = {{0.3, 172}, {0.4, 54},   {0.5, 20.5}, {0.6, 9.0}, {0.7, 5.0}, {0.85, 2.85}, {1, 2.05},
             {1.2, 1.6}, {1.5, 1.43}, {2, 1.49},   {3, 1.71},  {5, 2.03},  {8, 2.4}};
enum { FOUND = sizeof found / sizeof *found };

double sb_paddle_third_loss(double kd)
{
    int i = 1;
    if (kd >= found[FOUND - 1].kd) return found[FOUND - 1].loss;
    while (kd > found[i].kd) i++;
    const double part = log(kd / found[i - 1].kd) / log(found[i].kd / found[i - 1].kd);
    return found[i - 1].loss * pow(found[i].loss / found[i - 1].loss, part);
}

double sb_paddle_third_amplitude(double first, double number, double depth, bool *steep)
{
    /* a - g k^2 a^3 = first, as a series in g (k first)^2; above 4/27 it has no solution. */
    static const double most = 4.0 / 27;
    const double all = sb_paddle_third_loss(number * depth) * pow(number * first, 2), lost = fmin(all, most);
    if (steep) *steep = all > most;
    return first * (1 + lost + 3 * lost * lost);
}
