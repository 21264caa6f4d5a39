/* Makes the maps of the water from the sun and from above. */
#include "render/overhead.h"

#include <math.h>

enum { SIDE_MAX = 1024 };

/* Cells of about a spacing over the lit box, so that no water falls between them. */
static int side_of(const sb_light *light, double spacing)
{
    const double side = light->size / (1.3 * spacing);
    return side < 8 ? 8 : side > SIDE_MAX ? SIDE_MAX : (int)side;
}

static sb_status add_reached(sb_overhead *o, const sb_light *light, const sb_frame *frame, const sb_density *density,
                             sb_error *error)
{
    if (o->begun && !(frame->status.time != o->reached_time)) return SB_OK;
    if (o->reached.side == 0) {
        sb_status status = sb_tops_create(side_of(light, frame->spacing), &o->reached, error);
        if (status != SB_OK) return status;
    }
    if (o->begun && frame->status.time < o->reached_time) sb_tops_clear(&o->reached);
    o->begun = true;
    o->reached_time = frame->status.time;
    const sb_vec3 shift = sb_sub(frame->origin, light->origin);
    const float *corner = light->ground_frame, scale = corner[2];
    float map[3][4] = {{scale, 0, 0, ((float)shift.x - corner[0]) * scale},
                       {0, scale, 0, ((float)shift.y - corner[1]) * scale},
                       {0, 0, 1, (float)(shift.z + 0.5 * frame->spacing)}};
    sb_status status = SB_OK;
    if (o->flat)
        sb_tops_add(&o->reached, frame, density, 0.14f, map);
    else
        status = sb_tops_add_areas(&o->reached, frame, density, 0.14f, map, error);
    if (status == SB_OK) sb_tops_upload(&o->reached);
    return status;
}

/* Finds the water as seen from the sun; heights are towards the sun. */
static sb_status find_shade(sb_overhead *o, const sb_light *light, const sb_frame *frame, const sb_density *density,
                            sb_error *error)
{
    if (o->shade.side == 0) {
        const int side = light->shadows ? side_of(light, frame->spacing) : 1;
        sb_status status = sb_tops_create(side, &o->shade, error);
        if (status != SB_OK) return status;
    }
    if (!light->shadows) return SB_OK;
    const sb_vec3 shift = sb_sub(frame->origin, light->origin);
    const float *m = light->to_shadow, by[3] = {(float)shift.x, (float)shift.y, (float)shift.z};
    float map[3][4];
    for (int row = 0; row < 3; row++) {
        const float sign = row == 2 ? -1 : 1;
        for (int a = 0; a < 4; a++) map[row][a] = sign * m[4 * a + row];
        for (int a = 0; a < 3; a++) map[row][3] += map[row][a] * by[a];
    }
    sb_tops_clear(&o->shade);
    sb_tops_add(&o->shade, frame, density, 0.35f, map);
    sb_tops_upload(&o->shade);
    return SB_OK;
}

sb_status sb_overhead_update(sb_overhead *overhead, const sb_light *light, const sb_frame *frame,
                             const sb_density *density, bool reaches, sb_error *error)
{
    sb_status status = find_shade(overhead, light, frame, density, error);
    return status == SB_OK && reaches ? add_reached(overhead, light, frame, density, error) : status;
}

void sb_overhead_destroy(sb_overhead *overhead)
{
    sb_tops_destroy(&overhead->shade);
    sb_tops_destroy(&overhead->reached);
}

double sb_overhead_scale(const sb_light *light)
{
    const double x = (double)light->to_shadow[2], y = (double)light->to_shadow[6], z = (double)light->to_shadow[10];
    return sqrt(x * x + y * y + z * z);
}
