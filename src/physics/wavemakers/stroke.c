/* A piston that is defined by its stroke and its speed, which are calibrated to the required wave [T19, section 4]. The
   paper does not define the start and the stop; here both are smooth. */
#include "base/memory.h"
#include "physics/wavemakers/wavemaker.h"

#include <math.h>

/* Fraction of the stroke that the acceleration and the deceleration take together. */
static const double ramp_share = 0.2;

typedef struct piston {
    double stroke, speed; /* m, m/s: travel and largest speed */
    double ramp;          /* s, duration of the acceleration, and of the deceleration */
    double duration;      /* s */
} piston;

static sb_status create(const sb_wavemaker_parameters *parameters, void **state, sb_error *error)
{
    piston *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "a piston");
    double time = parameters->stroke / parameters->speed;
    *made = (piston){.stroke = parameters->stroke,
                     .speed = parameters->speed,
                     .ramp = ramp_share * time,
                     .duration = (1 + ramp_share) * time};
    *state = made;
    return SB_OK;
}

/* Travel during the ramp tau: the speed is V sin^2(pi t/(2 tau)), the travel V/2 (t - tau/pi sin(pi t/tau)). */
static double speed_up(const piston *law, double t)
{
    return law->speed / 2 * (t - law->ramp / M_PI * sin(M_PI * t / law->ramp));
}

static double displacement(const void *state, double t)
{
    const piston *law = state;
    if (t <= 0) return 0;
    if (t >= law->duration) return law->stroke;
    if (t < law->ramp) return speed_up(law, t);
    if (t > law->duration - law->ramp) return law->stroke - speed_up(law, law->duration - t);
    return law->speed * (t - law->ramp / 2);
}

static double duration(const void *state)
{
    return ((const piston *)state)->duration;
}

const sb_wavemaker sb_wavemaker_stroke = {
    .name = "stroke",
    .summary = "piston of a given stroke and top speed, smooth start and stop",
    .reference = "Thuillier Le Gac et al. 2019, section 4",
    .needs = SB_WM_STROKE | SB_WM_SPEED,
    .create = create,
    .displacement = displacement,
    .duration = duration,
    .destroy = sb_free,
};
