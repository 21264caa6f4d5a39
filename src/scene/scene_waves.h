/* The waves of a scene, whose period and depth are the defaults of sponges and measurements. */
#ifndef SB_SCENE_WAVES_H
#define SB_SCENE_WAVES_H

#include "scene/scene.h"

typedef struct sb_scene_waves {
    const char *maker, *name; /* what makes them, as messages write it: "" and "paddle", "block " and "sea" */
    double period, depth;     /* s, of a spectrum at its peak; m. 0: there are no waves, or several that differ */
    bool regular;
    const sb_wavemaker_parameters *law; /* of the wave maker, or NULL */
} sb_scene_waves;

/* Returns the waves of a wave maker. Solitary waves and absorbers have none; those of a file have the period of its
   highest one. */
sb_scene_waves sb_waves_of_maker(const sb_wavemaker_use *maker);

/* Returns the waves of wave makers, of the given sea, and of the water at the start. Those that differ by less than
   half a per cent in period and depth are the same. */
sb_scene_waves sb_scene_waves_of(const sb_scene *scene);

/* Length of regular waves, m, and the relative error that it may have; NaN: not known. */
typedef struct sb_flume_length {
    double length, error;
} sb_flume_length;

/* Returns the length that the waves of a wave maker have in a closed flume of that depth (m): of steady waves, or by
   cnoidal theory where these are too long and high to be found. */
sb_flume_length sb_flume_length_of(const sb_wavemaker_parameters *law, double depth);

#endif
