/* Rotations of places about the axes, as the scene states them for bodies. */
#ifndef SB_BASE_TURN_H
#define SB_BASE_TURN_H

#include "base/vec.h"

typedef struct sb_turn {
    double cosine[3], sine[3]; /* about x, y, z */
} sb_turn;

/* degrees: about x, then y, then z. Exact for multiples of 90 degrees, so that the faces of turned boxes stay parallel
   to the axes. */
static inline sb_turn sb_turn_of(sb_vec3 degrees)
{
    static const double cosines[4] = {1, 0, -1, 0}, sines[4] = {0, 1, 0, -1};
    sb_turn turn;
    for (int axis = 0; axis < 3; ++axis) {
        const double angle = sb_component(degrees, axis), quarters = angle / 90;
        if (quarters == floor(quarters)) {
            const int i = (int)(quarters - 4 * floor(quarters / 4));
            turn.cosine[axis] = cosines[i];
            turn.sine[axis] = sines[i];
        } else {
            turn.cosine[axis] = cos(angle * M_PI / 180);
            turn.sine[axis] = sin(angle * M_PI / 180);
        }
    }
    return turn;
}

static inline sb_vec3 sb_turned(const sb_turn *t, sb_vec3 p)
{
    p = sb_vec(p.x, t->cosine[0] * p.y - t->sine[0] * p.z, t->sine[0] * p.y + t->cosine[0] * p.z);
    p = sb_vec(t->cosine[1] * p.x + t->sine[1] * p.z, p.y, t->cosine[1] * p.z - t->sine[1] * p.x);
    return sb_vec(t->cosine[2] * p.x - t->sine[2] * p.y, t->sine[2] * p.x + t->cosine[2] * p.y, p.z);
}

#endif
