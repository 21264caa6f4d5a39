#include "channel.h"

#include <math.h>

enum { CELLS = 120 };

/* Surface at the centres of cells, and discharge at their faces, half a step later. */
typedef struct water {
    double eta[CELLS], q[CELLS + 1], bed[CELLS];
    double level, gravity, cell;
} water;

static double depth(const water *w, int i)
{
    return w->level + w->eta[i] - w->bed[i];
}

/* Discharge through x = 0: u + 2 sqrt(g h) of the wave that comes in, u - 2 sqrt(g h) of the water inside. */
static double discharge_in(const water *w, const sb_channel *channel, double t)
{
    const double still = w->level - w->bed[0], within = depth(w, 0);
    const double given = still + sb_curve_at(channel->surface, t);
    const double in = sb_curve_at(channel->velocity, t) + 2 * sqrt(w->gravity * given);
    const double out = w->q[1] / within - 2 * sqrt(w->gravity * within);
    const double c = 0.25 * (in - out);
    return 0.5 * (in + out) * c * c / w->gravity;
}

static void step(water *w, const sb_channel *channel, double t, double dt)
{
    double flux[CELLS];
    for (int i = 0; i < CELLS; i++) {
        const double middle = 0.5 * (w->q[i] + w->q[i + 1]);
        flux[i] = middle * middle / depth(w, i);
    }
    for (int i = 1; i < CELLS; i++) {
        const double h = 0.5 * (depth(w, i - 1) + depth(w, i));
        w->q[i] -= dt / w->cell * (w->gravity * h * (w->eta[i] - w->eta[i - 1]) + flux[i] - flux[i - 1]);
    }
    w->q[0] = discharge_in(w, channel, t);
    w->q[CELLS] = 0;
    for (int i = 0; i < CELLS; i++) w->eta[i] -= dt / w->cell * (w->q[i + 1] - w->q[i]);
}

static double volume_of(const water *w)
{
    double sum = 0;
    for (int i = 0; i < CELLS; i++) sum += w->eta[i];
    return sum * w->cell;
}

static double surface_at(const water *w, double x)
{
    const double place = fmin(fmax(x / w->cell - 0.5, 0), CELLS - 1.001);
    const int i = (int)place;
    return w->eta[i] + (place - i) * (w->eta[i + 1] - w->eta[i]);
}

void sb_channel_solve(const sb_channel *channel, double duration, double interval, double x, sb_curve *eta,
                      sb_curve *volume)
{
    water w = {.level = channel->level, .gravity = channel->gravity, .cell = channel->length / CELLS};
    double deepest = 0, next = 0, t = 0;
    for (int i = 0; i < CELLS; i++) {
        w.bed[i] = channel->bed((i + 0.5) * w.cell);
        deepest = fmax(deepest, channel->level - w.bed[i]);
    }
    const double dt = 0.4 * w.cell / sqrt(2 * channel->gravity * deepest);
    for (; t < duration; t += dt) {
        if (t >= next) {
            sb_curve_add(eta, t, surface_at(&w, x));
            sb_curve_add(volume, t, volume_of(&w));
            next += interval;
        }
        step(&w, channel, t, dt);
    }
}
