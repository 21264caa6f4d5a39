#include "stresses.h"

#include <stddef.h>

const sb_stress *const sb_stresses[] = {
    &sb_stress_still,   &sb_stress_plates,   &sb_stress_drop,
    &sb_stress_jet,     &sb_stress_flume,    &sb_stress_film,
    &sb_stress_frame,   &sb_stress_steps,    &sb_stress_tolerances,
    &sb_stress_start,   &sb_stress_sampling, &sb_stress_meshes,
    &sb_stress_paddles, &sb_stress_immersed, &sb_stress_leaving,
    &sb_stress_ends,    &sb_stress_keys,     NULL,
};
