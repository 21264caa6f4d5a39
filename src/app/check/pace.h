/* How fast the simulation steps on this machine. */
#ifndef SB_APP_PACE_H
#define SB_APP_PACE_H

#include "base/status.h"
#include "scene/scene.h"

/* Times some steps of a small tank with the scene's spacing, fluid and numerics, each of as many solver sweeps as a
   wave usually takes, with the present number of threads. *seconds: per step and fluid particle. Takes a few tenths of
   a second. Fails where the tank cannot be made or diverges. */
sb_status sb_pace_measure(const sb_scene *scene, double *seconds, sb_error *error);

#endif
