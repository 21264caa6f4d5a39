/* Sums of linear waves. */
#include "physics/waves/wave_sum.h"

#include "physics/waves/dispersion.h"

#include <math.h>

void sb_wave_component_prepare(sb_wave_component *wave, double depth, double gravity)
{
    wave->omega = 2 * M_PI / wave->period;
    wave->number = sb_wave_number(wave->period, depth, gravity);
    wave->along[0] = cos(wave->direction);
    wave->along[1] = sin(wave->direction);
}

void sb_wave_sum_at(const sb_wave_component *waves, size_t count, double depth, double t, double x, double y, double z,
                    sb_wave_sum *sum)
{
    *sum = (sb_wave_sum){0};
    z = fmin(fmax(z, 0), depth);
    for (size_t i = 0; i < count; i++) {
        const sb_wave_component *wave = &waves[i];
        const double omega = wave->omega, distance = x * wave->along[0] + y * wave->along[1];
        const double theta =
            wave->number * distance - 2 * M_PI * remainder(t, wave->period) / wave->period + wave->phase;
        const double c = cos(theta), s = sin(theta), speed = wave->amplitude * omega;
        const double u = speed * sb_cosh_over_sinh(wave->number, z, depth);
        const double w = speed * sb_sinh_over_sinh(wave->number, z, depth);
        sum->elevation += wave->amplitude * c;
        for (int axis = 0; axis < 2; axis++) {
            sum->velocity[axis] += u * c * wave->along[axis];
            sum->velocity_rate[axis] += omega * u * s * wave->along[axis];
        }
        sum->velocity[2] += w * s;
        sum->velocity_rate[2] -= omega * w * c;
    }
}

double sb_wave_sum_crest(const sb_wave_component *waves, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) sum += waves[i].amplitude;
    return sum;
}

double sb_wave_sum_speed(const sb_wave_component *waves, size_t count, double depth)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += waves[i].amplitude * waves[i].omega * sb_cosh_over_sinh(waves[i].number, depth, depth);
    return sum;
}
