/* A side that moves water as a paddle does. The side stands still, and the paddle moves over several cells. Its waves
   pass each place with the speed C of their phase: what the paddle does at X(t) comes to the side at x at
   t + (x - X(t))/C. There the water has the paddle's velocity U, and the surface and the pressure of a wave that goes
   inwards with C: h = C d/(C - U), so that

       dH/dx = -h U'/(C (C - U)),   dP/dx = -h U' ((C - U)^2 - g h)/(C (C - U)),

   with the rate U' at the place. C is that of the law's waves if they keep their form, and otherwise the speed
   U + sqrt(g h) of a simple wave, for which dP/dx = 0. Waves that come back are reflected: their surface and pressure
   have no slope at the side. Where U = U' = 0 the side is a wall. */
#include "offshore/paddle.h"

#include "base/memory.h"

#include <math.h>

struct sb_offshore_paddle {
    sb_paddle paddle;
    double celerity; /* m/s, of waves that keep their form; 0: none */
    double still;    /* m/s, of long waves on still water */
    double gravity, ahead;
};

/* Differences in time are over this part of the time in which a wave crosses a depth. */
static const double DIFFERENCE = 1e-3;
/* Least part of C by which the paddle is slower than its waves. */
static const double SLOWER = 0.1;

sb_status sb_offshore_paddle_create(const sb_offshore_paddle_options *options, sb_offshore_paddle **paddle,
                                    sb_error *error)
{
    sb_offshore_paddle *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "a paddle of the grid");
    const sb_status status = sb_paddle_create(&options->law, &made->paddle, error);
    if (status != SB_OK) {
        sb_free(made);
        return status;
    }
    made->celerity = sb_paddle_celerity(&options->law, &made->paddle);
    made->gravity = options->law.gravity;
    made->still = sqrt(made->gravity * options->depth);
    made->ahead = options->ahead;
    *paddle = made;
    return SB_OK;
}

void sb_offshore_paddle_destroy(sb_offshore_paddle *paddle)
{
    if (!paddle) return;
    sb_paddle_destroy(&paddle->paddle);
    sb_free(paddle);
}

static double difference_of(const sb_offshore_paddle *p)
{
    return DIFFERENCE * p->still / p->gravity;
}

static double speed_at(const sb_offshore_paddle *p, double t)
{
    const double d = difference_of(p);
    return (sb_paddle_displacement(&p->paddle, t + d) - sb_paddle_displacement(&p->paddle, t - d)) / (2 * d);
}

/* Speed of the phase with which the paddle has this speed. */
static double phase_speed(const sb_offshore_paddle *p, double speed)
{
    const double c = p->celerity > 0 ? p->celerity : p->still + 1.5 * speed;
    return fmax(c, (1 + SLOWER) * fabs(speed));
}

/* Time at which what the paddle does at t comes to the side. */
static double arrival_of(const sb_offshore_paddle *p, double t)
{
    return t + (p->ahead - sb_paddle_displacement(&p->paddle, t)) / phase_speed(p, speed_at(p, t));
}

/* The time of the paddle's motion that comes to the side at `time`: by halving, because arrivals increase. */
static double source_of(const sb_offshore_paddle *p, double time)
{
    enum { ROUNDS = 60 };
    const double length = fabs(p->ahead) + fabs(p->paddle.stroke_end) + p->still * p->still / p->gravity;
    double reach = length / p->still;
    while (arrival_of(p, time - reach) > time || arrival_of(p, time + reach) < time) reach *= 2;
    double low = time - reach, high = time + reach;
    for (int k = 0; k < ROUNDS; k++) {
        const double middle = 0.5 * (low + high);
        *(arrival_of(p, middle) > time ? &high : &low) = middle;
    }
    return 0.5 * (low + high);
}

sb_offshore_push sb_offshore_paddle_at(const sb_offshore_paddle *paddle, double time)
{
    const double t = source_of(paddle, time), d = difference_of(paddle);
    const double speed = speed_at(paddle, t), c = phase_speed(paddle, speed);
    const double rate = (speed_at(paddle, t + d) - speed_at(paddle, t - d)) / (2 * d);
    /* A phase stays before the side for longer than at the paddle, which follows it. */
    return (sb_offshore_push){
        .velocity = speed, .rate = rate * c / (c - speed), .phase = c, .form = paddle->celerity > 0};
}

double sb_offshore_push_slope(const sb_offshore_push *push, double h)
{
    return push->rate == 0 ? 0 : -h * push->rate / (push->phase * (push->phase - push->velocity));
}

double sb_offshore_push_pressure(const sb_offshore_push *push, double h, double gravity)
{
    const double slower = push->phase - push->velocity;
    return push->form ? sb_offshore_push_slope(push, h) * (slower * slower - gravity * h) : 0;
}

/* A side's cells: of the first one, from one to the next, and outwards; how many. */
typedef struct border {
    size_t first, step, count;
    ptrdiff_t outwards;
} border;

static border border_of(const sb_offshore *o, int side)
{
    const size_t columns = o->options.columns, rows = o->options.rows;
    const bool along_y = side < SB_OFFSHORE_Y_MIN, upper = side % 2 == 1;
    const size_t across = along_y ? 1 : o->stride, last = (along_y ? columns : rows) - 1;
    return (border){.first = o->origin + (upper ? last * across : 0),
                    .step = along_y ? o->stride : 1,
                    .count = along_y ? rows : columns,
                    .outwards = upper ? (ptrdiff_t)across : -(ptrdiff_t)across};
}

/* A grid with one row has nothing beyond its sides along y. */
static int side_count(const sb_offshore *offshore)
{
    return sb_offshore_flat(offshore) ? SB_OFFSHORE_Y_MIN : SB_OFFSHORE_SIDES;
}

/* The equation has div(grad P / h) at the first cells, which the side's face is a part of. */
void sb_offshore_paddle_system(const sb_offshore *offshore, const sb_offshore_level *level, const double *scale,
                               double *residual)
{
    for (int s = 0; s < side_count(offshore); s++) {
        if (offshore->options.side[s] != SB_OFFSHORE_PADDLE || offshore->push.rate == 0) continue;
        const border b = border_of(offshore, s);
        for (size_t k = 0; k < b.count; k++) {
            const size_t at = b.first + k * b.step;
            const double h = level->h[at], g = offshore->options.gravity;
            if (!(scale[at] > 0)) continue;
            const double flux = sb_offshore_push_pressure(&offshore->push, h, g) / h;
            residual[at] -= scale[at] * flux / offshore->options.cell;
        }
    }
}

void sb_offshore_paddle_beyond(const sb_offshore *offshore, const sb_offshore_level *level, const double *scale,
                               double *pressure)
{
    for (int s = 0; s < side_count(offshore); s++) {
        if (offshore->options.side[s] != SB_OFFSHORE_PADDLE || offshore->push.rate == 0) continue;
        const border b = border_of(offshore, s);
        for (size_t k = 0; k < b.count; k++) {
            const size_t at = b.first + k * b.step;
            if (!(scale[at] > 0)) continue;
            const double rise = sb_offshore_push_pressure(&offshore->push, level->h[at], offshore->options.gravity);
            pressure[(ptrdiff_t)at + b.outwards] -= offshore->options.cell * rise;
        }
    }
}
