/* All terms of the law but the lag are even in the frequency. The phase at the boundary is therefore that of the
   denominator, 1 - inertia omega^2 + i lag omega, and the amplitude follows from the lead: both are right at one
   frequency, and lag = distance/sqrt(g h) makes them right for long waves. */
#include "physics/absorption/outgoing.h"

#include <math.h>

/* k h of the wave whose frequency is sqrt(g/h): x tanh x = 1. */
static const double UNIT = 1.19967864;

/* Mean of a wave over the weight 1 + cos(pi s / distance). */
static double weighted(double phase)
{
    return sin(phase) / phase / (1 - phase * phase / (M_PI * M_PI));
}

sb_outgoing_law sb_outgoing_law_make(double depth, double distance, double late, double gravity)
{
    const double crossing = sqrt(depth / gravity), far = distance / depth, lag = far - late / crossing;
    const double kh = fmin(UNIT, 1 / far), square = kh * tanh(kh), omega = sqrt(square);
    const double phase = kh * far - omega * late / crossing;
    /* u over r for the wave that leaves: u = (c/h) eta, r = u + sqrt(g/h) eta. */
    const double share = omega / (omega + kh) / weighted(kh * far);
    const double inertia = (1 - lag * omega / tan(phase)) / square;
    const double lead = fmax((1 - 2 * share * lag * omega / sin(phase)) / square, 0);
    return (sb_outgoing_law){lag * crossing, inertia * crossing * crossing, lead * crossing * crossing};
}
