/* Cuts the drawn water at the domain's sides. */
#include "render/water/sides.h"

#include "base/memory.h"
#include "render/camera/lens.h"

#include <string.h>

/* Particles within this distance of a side, in cells of the density, give the cut its values. */
static const float reach = 1;
/* Discs end this far beyond a side, in spacings: before a cut farther, because discs and cut do not end at exactly the
   same height, and a gap between them would be seen. */
static const float beyond = 0.05f, beyond_cut = 0.3f;
/* Water is where the density is this, as for the surface, and below the height of bodies (at their foot, or below a
   bridge) where the particles fill this much of the side. */
static const float surface_density = 0.5f, filled = 0.5f;

/* A side that the eye sees: the nodes of the density's grid, projected to it. */
struct face {
    bool seen;
    int axis, along; /* of its normal, and the other horizontal one */
    float at;        /* m, relative to the frame's origin */
    float normal[3]; /* unit, outwards */
    float *node;     /* 2 per node: along, then up */
};

struct cut {
    const sb_density *density;
    const sb_frame *frame;
    const sb_ground *ground;
    sb_lens lens;
    struct face faces[4]; /* x min, x max, y min, y max */
    float full;           /* weight of a node within water */
};

static sb_status lay_faces(sb_sides *sides, struct cut *cut, sb_error *error)
{
    const sb_density *d = cut->density;
    size_t total = 0, first[4];
    for (int f = 0; f < 4; f++) {
        const int axis = f / 2, along = 1 - axis;
        const float at = f & 1 ? d->side_max[axis] : d->side_min[axis], sign = f & 1 ? 1 : -1;
        struct face *face = &cut->faces[f];
        *face = (struct face){.seen = (cut->lens.eye[axis] - at) * sign > 0, .axis = axis, .along = along, .at = at};
        face->normal[axis] = sign;
        first[f] = total;
        if (face->seen) total += 2 * d->n[along] * d->n[2];
    }
    if (total == 0) return SB_OK;
    if (sb_grow((void **)&sides->node, &sides->capacity, total, sizeof *sides->node) != 0)
        return sb_fail_memory(error, "the water at the sides of a picture");
    memset(sides->node, 0, total * sizeof *sides->node);
    for (int f = 0; f < 4; f++) cut->faces[f].node = sides->node + first[f];
    return SB_OK;
}

/* Finds the lowest of the four nodes around a place of a face, and the place within their cell. False: outside. */
static bool locate(const sb_density *density, const struct face *face, const float *p, size_t *node, float share[2])
{
    const int axes[2] = {face->along, 2};
    size_t low[2];
    for (int k = 0; k < 2; k++) {
        const float at = (p[axes[k]] - density->min[axes[k]]) * density->inverse;
        if (!(at >= 0 && at < (float)(density->n[axes[k]] - 1))) return false;
        low[k] = (size_t)at;
        share[k] = at - (float)low[k];
    }
    *node = low[1] * density->n[face->along] + low[0];
    return true;
}

/* The weights of the four nodes, whose numbers are `node` and those of next. */
static void weigh(const sb_density *density, const struct face *face, const float share[2], size_t next[4], float w[4])
{
    const size_t row = density->n[face->along];
    const size_t steps[4] = {0, 1, row, row + 1};
    for (int c = 0; c < 4; c++) {
        next[c] = steps[c];
        w[c] = (c & 1 ? share[0] : 1 - share[0]) * (c & 2 ? share[1] : 1 - share[1]);
    }
}

/* Adds the particles near the faces to these, in their order. */
static void collect(struct cut *cut, const float *values)
{
    const sb_density *d = cut->density;
    const float range = reach * d->cell;
    for (size_t i = 0; i < cut->frame->count; i++) {
        const float *p = cut->frame->position + 3 * i;
        for (int f = 0; f < 4; f++) {
            const struct face *face = &cut->faces[f];
            const float off = fabsf(p[face->axis] - face->at);
            size_t at, next[4];
            float share[2], w[4];
            if (!face->seen || !(off < range) || !locate(d, face, p, &at, share)) continue;
            weigh(d, face, share, next, w);
            for (int c = 0; c < 4; c++) {
                float *node = face->node + 2 * (at + next[c]);
                const float part = w[c] * (1 - off / range);
                node[0] += part;
                node[1] += part * values[i];
            }
        }
    }
}

/* Divides the weights by those of a domain full of water, so that they are the share of a face that is filled. */
static void normalise(const struct cut *cut)
{
    const sb_density *d = cut->density;
    for (int f = 0; f < 4; f++) {
        const struct face *face = &cut->faces[f];
        const size_t columns = face->seen ? d->n[face->along] : 0;
        for (size_t k = 0; k < d->n[2]; k++)
            for (size_t i = 0; i < columns; i++) {
                const float share = sb_density_share(d, face->along, i) * sb_density_share(d, 2, k);
                float *node = face->node + 2 * (k * columns + i);
                for (int c = 0; c < 2; c++) node[c] /= cut->full * (share > 0.06f ? share : 0.06f);
            }
    }
}

/* Whether water stands at a place of a face, and the value there. */
static bool is_water(const struct cut *cut, const struct face *face, const float *p, float *value)
{
    const sb_density *d = cut->density;
    size_t at, next[4];
    float share[2], w[4], weight = 0, sum = 0;
    if (sb_density_at(d, p[0], p[1], p[2]) < surface_density || sb_lens_cut(&cut->lens, p)) return false;
    if (!locate(d, face, p, &at, share)) return false;
    weigh(d, face, share, next, w);
    for (int c = 0; c < 4; c++) {
        weight += w[c] * face->node[2 * (at + next[c])];
        sum += w[c] * face->node[2 * (at + next[c]) + 1];
    }
    if (!(weight > 0.01f)) return false;
    *value = sum / weight;
    const sb_vec3 origin = cut->frame->origin;
    const double z = (double)p[2] + origin.z;
    if (z < cut->ground->floor_level) return false;
    return z >= sb_ground_height(cut->ground, (double)p[0] + origin.x, (double)p[1] + origin.y) || weight >= filled;
}

/* Finds the face through which a ray enters the domain, and the depth there; NULL: none. */
static const struct face *entry(const struct cut *cut, const float direction[3], float *depth)
{
    const sb_density *d = cut->density;
    float in = cut->lens.near, out = HUGE_VALF;
    const struct face *face = NULL;
    for (int a = 0; a < 2; a++) {
        const bool rises = direction[a] > 0;
        const float from = (rises ? d->side_min[a] : d->side_max[a]) - cut->lens.eye[a];
        const float to = (rises ? d->side_max[a] : d->side_min[a]) - cut->lens.eye[a];
        if (fabsf(direction[a]) < 1e-9f) {
            if ((d->side_min[a] - cut->lens.eye[a]) * (d->side_max[a] - cut->lens.eye[a]) > 0) return NULL;
            continue;
        }
        if (from / direction[a] > in) {
            in = from / direction[a];
            face = &cut->faces[2 * a + (rises ? 0 : 1)];
        }
        out = fminf(out, to / direction[a]);
    }
    *depth = in;
    return in < out ? face : NULL;
}

/* Whether a place is beyond a side. first: of the face through which the ray enters. */
static bool is_beyond(const struct cut *cut, const float *direction, float depth, float first)
{
    const sb_density *d = cut->density;
    const float room = (depth < first ? beyond_cut : beyond) * (float)cut->frame->spacing;
    for (int a = 0; a < 2; a++) {
        const float x = cut->lens.eye[a] + depth * direction[a];
        if (x < d->side_min[a] - room || x > d->side_max[a] + room) return true;
    }
    return false;
}

static void cut_pixel(const struct cut *cut, const float direction[3], float *surface, float *cover)
{
    float depth = 0, value = 0;
    const struct face *face = entry(cut, direction, &depth);
    if (surface[0] > 0 && is_beyond(cut, direction, surface[0], face ? depth : 0)) surface[0] = cover[0] = cover[1] = 0;
    if (!face || !face->seen) return;
    float p[3];
    for (int a = 0; a < 3; a++) p[a] = cut->lens.eye[a] + depth * direction[a];
    p[face->axis] = face->at;
    if (!is_water(cut, face, p, &value)) return;
    surface[0] = depth;
    surface[1] = value;
    surface[2] = sb_dot3(face->normal, cut->lens.right);
    surface[3] = sb_dot3(face->normal, cut->lens.up);
    cover[0] = 1;
    cover[1] = (float)(SB_SURFEL_THICKEST * cut->frame->spacing);
    cover[2] = cover[3] = 0;
}

sb_status sb_sides_draw(sb_sides *sides, sb_splat *splat, const sb_density *density, const sb_frame *frame,
                        const float *values, const sb_ground *ground, const sb_view *view, int threads, sb_error *error)
{
    if (!density->sided || density->slice || density->n[0] < 2) return SB_OK;
    struct cut cut = {.density = density, .frame = frame, .ground = ground, .lens = sb_lens_of(view, frame->origin, 0)};
    const double ratio = (double)density->cell / frame->spacing;
    cut.full = (float)(0.5 * (double)reach * ratio * ratio * ratio);
    sb_status status = lay_faces(sides, &cut, error);
    if (status != SB_OK) return status;
    collect(&cut, values);
    normalise(&cut);
    const float step = (float)(2 * view->tangent / splat->height);
    const float left = -0.5f * step * (float)splat->width, bottom = -0.5f * step * (float)splat->height;
#pragma omp parallel for num_threads(threads) schedule(static)
    for (int y = 0; y < splat->height; y++)
        for (int x = 0; x < splat->width; x++) {
            const size_t at = 4 * ((size_t)y * (size_t)splat->width + (size_t)x);
            const float right = left + ((float)x + 0.5f) * step, up = bottom + ((float)y + 0.5f) * step;
            float direction[3];
            for (int a = 0; a < 3; a++)
                direction[a] = right * cut.lens.right[a] + up * cut.lens.up[a] - cut.lens.back[a];
            cut_pixel(&cut, direction, splat->surface + at, splat->cover + at);
        }
    return SB_OK;
}

void sb_sides_free(sb_sides *sides)
{
    sb_free(sides->node);
    *sides = (sb_sides){0};
}
