/* A dam gate that is pulled at constant speed over its stroke, as the weight-driven gates of experiments are after
   their first millimetres. The start may be sudden because the gate does not push water. */
#include "base/memory.h"
#include "physics/wavemakers/wavemaker.h"

typedef struct gate {
    double stroke, speed; /* m, m/s */
} gate;

static sb_status create(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    gate *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "a dam gate");
    *made = (gate){.stroke = parameters->stroke, .speed = parameters->speed};
    *state = made;
    return SB_OK;
}

static double displacement(const void *state, double t)
{
    const gate *law = state;
    double x = law->speed * t;
    return t <= 0 ? 0 : x < law->stroke ? x : law->stroke;
}

static double duration(const void *state)
{
    const gate *law = state;
    return law->stroke / law->speed;
}

const sb_wavemaker sb_wavemaker_gate = {
    .name = "gate",
    .summary = "dam gate pulled at constant speed over its stroke",
    .reference = "prescribed motion without a wave theory",
    .needs = SB_WM_STROKE | SB_WM_SPEED,
    .create = create,
    .displacement = displacement,
    .duration = duration,
    .destroy = sb_free,
};
