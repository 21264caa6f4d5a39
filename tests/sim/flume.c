#include "sim/flume.h"

void flume_make(tank *t, int dimensions, double dr, sb_vec3 size, bool sleep)
{
    static const sb_wavemaker_parameters law = {.stroke = 0.4, .speed = 0.5, .gravity = 9.81, .after = SB_AFTER_STAY};
    sb_wavemaker_parameters stroke = law;
    stroke.kind = sb_wavemaker_find("stroke");
    tank_make(t, dimensions, dr, size, size.x, SB_FLUME_DEPTH, 0.02);
    tank_add_sheet(t, "paddle", -dr / 2, 0, size.z, sb_vec(1, 0, 0), &stroke);
    t->scene.sea = (sb_sea){.present = true, .level = SB_FLUME_DEPTH};
    t->scene.numerics.settle_steps = 200;
    t->scene.numerics.sleep = sleep;
}
