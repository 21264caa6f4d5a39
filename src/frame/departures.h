/* The particles that left the domain. */
#ifndef SB_FRAME_DEPARTURES_H
#define SB_FRAME_DEPARTURES_H

#include "base/vec.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Particles that left the domain: their number per side, open or wall, and the first few of them, in the order of the
   steps. Particles that left during settling are included. */
enum { SB_DEPARTURES = 8 };
typedef struct sb_departure {
    double time;      /* s */
    sb_vec3 position; /* m, the first position outside */
    double speed;     /* m/s */
    uint32_t particle;
    int side;
    bool lost; /* through a wall side */
} sb_departure;
typedef struct sb_departures {
    uint64_t by_side[SB_SIDES];
    size_t count;
    sb_departure first[SB_DEPARTURES];
} sb_departures;

#endif
