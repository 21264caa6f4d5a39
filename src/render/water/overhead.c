/* Makes the maps of the water from the sun and from above. */
#include "render/water/overhead.h"

#include <math.h>

/* Copies a map to its texture, which it makes when there is none. */
static void upload(const sb_tops *tops, GLuint *texture)
{
    if (*texture == 0)
        *texture = sb_texture_create(GL_R32F, tops->side, tops->side, GL_RED, GL_FLOAT, tops->top, GL_NEAREST);
    sb_gl.BindTexture(GL_TEXTURE_2D, *texture);
    sb_gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, tops->side, tops->side, 0, GL_RED, GL_FLOAT, tops->top);
}

static sb_status add_reached(sb_overhead *o, const sb_light *light, const sb_frame *frame, const sb_density *density,
                             sb_error *error)
{
    const sb_vec3 shift = sb_sub(frame->origin, light->origin);
    const float *corner = light->ground_frame, scale = corner[2];
    float map[3][4] = {{scale, 0, 0, ((float)shift.x - corner[0]) * scale},
                       {0, scale, 0, ((float)shift.y - corner[1]) * scale},
                       {0, 0, 1, (float)(shift.z + 0.5 * frame->spacing)}};
    const int side = sb_reached_side(light->size, frame->spacing);
    const sb_status status = sb_reached_add(o->reached, side, frame, density, o->flat, map, error);
    if (status == SB_OK && o->uploaded != o->reached->changes) {
        upload(&o->reached->tops, &o->reached_map);
        o->uploaded = o->reached->changes;
    }
    return status;
}

/* Finds the water as seen from the sun; heights are towards the sun. */
static sb_status find_shade(sb_overhead *o, const sb_light *light, const sb_frame *frame, const sb_density *density,
                            sb_error *error)
{
    if (o->shade.side == 0) {
        const int side = light->shadows ? sb_reached_side(light->size, frame->spacing) : 1;
        sb_status status = sb_tops_create(side, &o->shade, error);
        if (status != SB_OK) return status;
        upload(&o->shade, &o->shade_map);
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
    upload(&o->shade, &o->shade_map);
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
    sb_gl.DeleteTextures(1, &overhead->shade_map);
    sb_gl.DeleteTextures(1, &overhead->reached_map);
    sb_tops_free(&overhead->shade);
}

double sb_overhead_scale(const sb_light *light)
{
    const double x = (double)light->to_shadow[2], y = (double)light->to_shadow[6], z = (double)light->to_shadow[10];
    return sqrt(x * x + y * y + z * z);
}
