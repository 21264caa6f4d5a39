/* How far a paddle moves, and how fast. */
#ifndef SB_PHYSICS_PADDLE_WAY_H
#define SB_PHYSICS_PADDLE_WAY_H

#include "physics/wavemakers/wavemaker.h"

typedef struct sb_paddle_way {
    double least, most;   /* m, of the displacement: at most 0; at least 0 */
    double fastest, when; /* m/s, the greatest speed; s, its scene time */
} sb_paddle_way;

/* The motion until scene time `end`, s. A paddle that starts by a command starts at 0. */
sb_paddle_way sb_paddle_way_until(const sb_paddle *paddle, double end);
/* The motion of a wave train during the run, or within a hundred periods of its start if they end later; of other laws
   during the run. duration: s, of the run. */
sb_paddle_way sb_paddle_way_of(const sb_paddle *paddle, double duration);

#endif
