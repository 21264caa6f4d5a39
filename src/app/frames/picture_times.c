#include "app/frames/picture_times.h"

#include "frame/frame.h"

#include <math.h>

static double film_time(const sb_picture_times *times)
{
    return times->render->interval > 0 ? times->film : (double)INFINITY;
}

static double still_time(const sb_picture_times *times)
{
    return times->still < times->render->still_count ? times->render->stills[times->still].time : (double)INFINITY;
}

double sb_picture_times_next(const sb_picture_times *times)
{
    return times->render->camera_count > 0 ? fmin(film_time(times), still_time(times)) : (double)INFINITY;
}

/* Multiples of the interval are rounded: one that is this close to a time is that time. */
static const double ROUNDING = 1e-9;

unsigned sb_picture_times_take(sb_picture_times *times)
{
    const double time = sb_picture_times_next(times), interval = times->render->interval;
    unsigned drawn = 0;
    if (still_time(times) <= time) {
        drawn |= SB_FRAME_STILL;
        times->still++;
    }
    if (film_time(times) <= time) {
        drawn |= SB_FRAME_FILM;
        times->film = interval * (floor(time / interval + ROUNDING) + 1);
    }
    return drawn;
}
