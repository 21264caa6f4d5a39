#include "physics/wavemakers/paddle_way.h"

#include <math.h>

/* Samples per period of a train, at its peak, and of any motion at least; sines and periods that are computed at most.
   Fewer samples of a sum of many waves still come near its extremes. */
enum { PER_PERIOD = 40, LEAST = 2000, MOST = 5000000, PERIODS = 100 };

/* Time from the start until all of a law's motion is known, s: a regular wave repeats. */
static double length_of(const sb_paddle *paddle, const sb_wave_facts *facts)
{
    const double end = paddle->duration + (paddle->after == SB_AFTER_RETURN ? paddle->return_time : 0);
    return facts && facts->repeats ? fmin(end, facts->ramp + facts->period) : end;
}

static double samples_of(const sb_wave_facts *facts, double length)
{
    if (!facts) return LEAST;
    return fmax(fmin(length / facts->period * PER_PERIOD, MOST / (double)(facts->count + 1)), LEAST);
}

sb_paddle_way sb_paddle_way_until(const sb_paddle *paddle, double end)
{
    const sb_wave_facts *facts = paddle->kind->facts ? paddle->kind->facts(paddle->state) : NULL;
    sb_paddle law = *paddle;
    sb_paddle_way way = {0};
    double before = 0;
    if (isinf(law.start)) law.start = 0;
    const double length = fmin(length_of(&law, facts), fmax(end - law.start, 0));
    const double samples = ceil(samples_of(facts, length)), step = length / samples;
    for (double k = 1; k <= samples && step > 0; k++) {
        const double now = sb_paddle_displacement(&law, law.start + k * step), speed = fabs(now - before) / step;
        way.when = speed > way.fastest ? law.start + (k - 1) * step : way.when;
        way.fastest = fmax(way.fastest, speed);
        way.least = fmin(way.least, now);
        way.most = fmax(way.most, now);
        before = now;
    }
    return way;
}

sb_paddle_way sb_paddle_way_of(const sb_paddle *paddle, double duration)
{
    const sb_wave_facts *facts = paddle->kind->facts ? paddle->kind->facts(paddle->state) : NULL;
    const double start = isinf(paddle->start) ? 0 : paddle->start;
    return sb_paddle_way_until(paddle, facts ? fmax(duration, start + PERIODS * facts->period) : duration);
}
