/* Heights at which waves on constant depth break. */
#include "physics/waves/breaking.h"

#include <math.h>

double sb_breaking_height(double number, double depth)
{
    const double s = number * depth / (2 * M_PI); /* depth over length */
    const double above = 0.0077829 + s * (0.0095721 + s * 0.141063);
    const double below = 0.0093407 + s * (0.0317567 + s * (0.0788340 + s));
    return fmin(above / below, SB_SOLITARY_HIGHEST) * depth;
}

bool sb_is_tide(double length, double depth)
{
    return length > 1000 * depth;
}

double sb_breaking_shown(double most)
{
    const double unit = most > 0 ? pow(10, floor(log10(most)) - 2) : 1;
    return floor(most / unit * (1 + 1e-12)) * unit;
}

void sb_sum_height_add(sb_sum_height *all, double amplitude, double number)
{
    all->square += amplitude * amplitude;
    all->sum += amplitude;
    if (amplitude > all->highest || (amplitude == all->highest && number < all->number)) all->number = number;
    all->highest = fmax(all->highest, amplitude);
}

double sb_sum_height_of(const sb_sum_height *all)
{
    return fmin(sqrt(8 * all->square), 2 * all->sum);
}

sb_status sb_sum_height_check(const sb_sum_height *all, double depth, sb_error *error)
{
    const double height = sb_sum_height_of(all);
    if (!(all->highest > 0)) return SB_OK;
    const double most = sb_breaking_height(all->number, depth);
    if (height <= most) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT,
                   "the waves together have a significant height of %.3g m and break: the highest is %.3g m long on %g "
                   "m, expected a significant height of at most %.3g m",
                   height, 2 * M_PI / all->number, depth, sb_breaking_shown(most));
}
