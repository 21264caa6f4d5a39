/* Computes the factors gamma and curvature_factor of the wall volume. */
#include "physics/kernels/wall_volume.h"

#include <math.h>

/* Fitted to the same balance as gamma, at edges of 90 degrees: least squares give 2 to 10 at convex edges and 9 to 22
   at concave edges, for lattices that are aligned with the walls or turned at random. Round walls with radii down to 3
   spacings give similar values. */
static const double CURVATURE_COEFFICIENT = 8;

/* Sums W (slope: 0), or the component of grad W normal to the plane (slope: 1), over the points of a square lattice in
   a plane (a row in 2D) whose spacing is `step`. The sum is taken at the distance `apart` from the plane, above a
   lattice point (at: 0) or above the middle between lattice points (at: 0.5). Lengths are in particle spacings. */
static double over_plane(const sb_kernel *kernel, int dimension, double support, double step, double apart, double at,
                         int slope)
{
    const int radius = (int)ceil(support / step), depth = dimension == 2 ? 0 : radius;
    const double aside = dimension == 2 ? 0 : at;
    double sum = 0;
    for (int x = -radius; x <= radius; x++)
        for (int y = -depth; y <= depth; y++) {
            const double dx = step * (x + at), dy = step * (y + aside), r = sqrt(apart * apart + dx * dx + dy * dy);
            if (!slope)
                sum += sb_kernel_value(kernel, dimension, support, r);
            else if (r > 0)
                sum += sb_kernel_slope(kernel, dimension, support, r) * apart / r;
        }
    return sum;
}

double sb_wall_gamma(const sb_kernel *kernel, int dimension, double support, double offset, double spacing)
{
    const double own = over_plane(kernel, dimension, support, spacing, 0, 0, 0);
    const int layers = (int)ceil(support);
    double product = 0, square = 0;
    for (int k = 0; k < layers; k++) {
        const double wall = over_plane(kernel, dimension, support, spacing, k + 0.5 + offset, 0.5, 1) / own;
        /* On a full lattice the sum is 0, so the layers above contribute as much as the missing layers below would. */
        double water = 0;
        for (int other = k + 1; other <= layers; other++)
            water += over_plane(kernel, dimension, support, 1, other, 0, 1);
        product += wall * 2 * water;
        square += wall * wall;
    }
    return square > 0 ? product / square : 1;
}

double sb_wall_curvature_factor(double curvature)
{
    return 1 + CURVATURE_COEFFICIENT * curvature * fabs(curvature);
}
