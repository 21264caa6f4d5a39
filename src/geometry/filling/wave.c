/* Measures an initial solitary wave above the still-water level, and how much of it the water contains. */
#include "geometry/filling/parts.h"

/* Fractions of the wave's height. Where the wave is lower than `faint`, its width is not measured. Where it is lower
   than `vanishing`, its volume is not summed. */
static const double faint = 0.01, vanishing = 1e-6;
/* Fraction of the wave's volume that may lie beyond each of its two ends. */
static const double tail = 0.005;
enum { STEPS_MAX = 1000000 };

/* Height of the wave above the still-water level at a distance from the crest, limited by the domain's top. */
static double rise_at(const sb_columns *c, double distance)
{
    return fmin(sb_columns_surface(c, c->scene->wave.position + distance), c->top) - c->level;
}

/* Measures the area of the whole wave in the plane x-z, and the distance from the crest to its ends. */
static void measure_whole(const sb_columns *c, sb_wave_room *room)
{
    const double least = vanishing * c->scene->wave.height;
    int steps = 0;
    double half = 0.5 * rise_at(c, 0) * c->spacing, sum;
    for (int k = 1; k < STEPS_MAX && rise_at(c, k * c->spacing) > least; ++k) {
        half += rise_at(c, k * c->spacing) * c->spacing;
        steps = k;
    }
    room->area = 2 * half;
    for (sum = 0; steps > 0 && sum < tail * room->area; --steps) sum += rise_at(c, steps * c->spacing) * c->spacing;
    room->extent = (steps + 1) * c->spacing;
}

void sb_columns_wave(const sb_columns *c, sb_wave_room *room)
{
    const sb_initial_wave *wave = &c->scene->wave;
    if (!c->waves || wave->kind != SB_INITIAL_SOLITARY || c->nx == 0 || c->level >= c->top) return;
    const double across = c->scene->dimensions == 2 ? 1 : c->dy;
    if (!(room->area > 0)) measure_whole(c, room);
    for (int64_t i = 0; i < c->nx; ++i) {
        const double x = sb_columns_center(c, i, 0, 0).x;
        double width = 0;
        for (int64_t j = 0; j < c->ny; ++j) {
            bool wet = false;
            const size_t column = (size_t)(j * c->nx + i);
            for (size_t r = c->begin[column]; r < c->begin[column + 1]; ++r) {
                const sb_run *run = c->runs + r;
                if (!run->wet) continue;
                wet = wet || run->low < c->level;
                room->held += fmax(run->high - fmax(run->low, c->level), 0) * c->dx * across;
            }
            width += wet ? across : 0;
        }
        if (!(width > 0)) continue;
        room->low = room->wet ? fmin(room->low, x - 0.5 * c->dx) : x - 0.5 * c->dx;
        room->high = room->wet ? fmax(room->high, x + 0.5 * c->dx) : x + 0.5 * c->dx;
        room->wet = true;
        if (rise_at(c, x - wave->position) > faint * wave->height) room->width = fmax(room->width, width);
    }
}
