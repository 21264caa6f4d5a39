#include "physics/absorption/absorbing.h"

#include <math.h>

/* Rate at which the mean of second order follows the waves, over `slow`: 1/10 of their angular frequency. */
static const double MEAN_RATE = 4;

/* Each filter is advanced exactly for an input that is constant over the step. */
static void follow(double *value, double input, double rate, double dt)
{
    *value += (input - *value) * -expm1(-rate * dt);
}

bool sb_absorbing_advance(const sb_absorbing_filter *filter, const sb_absorbing_input *input, double dt,
                          sb_absorbing_state *state)
{
    const double velocity = input->law_speed + state->speed, wave = input->surface - state->low;
    const double second = 0.5 * velocity * velocity / filter->gravity + filter->square * wave * wave;
    follow(&state->mean, second, MEAN_RATE * filter->slow, dt);
    const double beyond = input->surface - input->expected - state->mean;
    follow(&state->low, beyond, filter->slow, dt);
    follow(&state->fast, beyond - state->low, filter->pole, dt);
    state->speed = -filter->gain * state->fast - filter->slow * state->offset;
    double next = state->offset + state->speed * dt;
    const bool stopped = next < input->least || next > input->most;
    if (stopped) {
        next = fmin(fmax(next, input->least), input->most);
        state->speed = (next - state->offset) / dt;
    }
    state->offset = next;
    return stopped;
}
