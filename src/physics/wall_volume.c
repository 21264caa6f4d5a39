#include "physics/wall_volume.h"

#include <math.h>

/* From the same demand as gamma, beside edges of 90 degrees: least squares give 2 to 10 at convex ones and 9 to 22 at
   concave ones, over lattices laid along the walls and turned at random; round walls down to 3 spacings agree. */
static const double BEND = 8;

/* Sums over a square lattice of a plane's places (a row in 2D), `step` spacings from each other, `apart` from a place
   over one of them (at: 0) or over the middle between them (0.5): of W, or of the part of grad W across the plane. */
static double over_plane(const sb_kernel *kernel, int dimension, double support, double step, double apart, double at,
                         int slope)
{
    const int reach = (int)ceil(support / step), depth = dimension == 2 ? 0 : reach;
    const double aside = dimension == 2 ? 0 : at;
    double sum = 0;
    for (int x = -reach; x <= reach; x++)
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
        double water = 0; /* a full lattice has none: what the layers above have, those missing below had */
        for (int other = k + 1; other <= layers; other++)
            water += over_plane(kernel, dimension, support, 1, other, 0, 1);
        product += wall * 2 * water;
        square += wall * wall;
    }
    return square > 0 ? product / square : 1;
}

double sb_wall_bend(double bulge)
{
    return 1 + BEND * bulge * fabs(bulge);
}
