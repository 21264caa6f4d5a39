/* Collects the surface elements of the water. */
#include "render/water/surfels.h"

#include "base/memory.h"
#include "render/camera/lens.h"

/* Radius of a disc in spacings: where particles are alone, and in a surface. */
static const float least_radius = 0.7f, disc_radius = 1.6f;

enum { BLOCK = 8192 };

/* A particle is hidden if the density at a distance of cover_spacings towards the eye is above `dense`. In a
   slice, whose particles lie in a plane, none is hidden. */
static const float dense = 0.68f, cover_spacings = 1.6f;
/* The surface is where the density is this. */
static const float surface_density = 0.5f;
/* A single particle has a density of about 0.04 at its place, a thread of particles 0.1, a layer 0.3. */
static const float drop_density = 0.05f, sheet_density = 0.2f;

/* Finds the particles of a block that may be seen, and writes their indices. */
static size_t choose(const sb_density *density, const sb_frame *frame, const sb_lens *lens, size_t block,
                     uint32_t *chosen)
{
    const size_t end = frame->count < (block + 1) * BLOCK ? frame->count : (block + 1) * BLOCK;
    const float cover = cover_spacings * (float)frame->spacing;
    size_t count = 0;
    for (size_t i = block * BLOCK; i < end; i++) {
        const float *p = frame->position + 3 * i;
        const float to_eye[3] = {lens->eye[0] - p[0], lens->eye[1] - p[1], lens->eye[2] - p[2]};
        if (!sb_density_counts(p) || sb_lens_outside(lens, to_eye) || sb_lens_cut(lens, p)) continue;
        const float step = cover / sqrtf(sb_dot3(to_eye, to_eye));
        if (!density->slice &&
            sb_density_at(density, p[0] + step * to_eye[0], p[1] + step * to_eye[1], p[2] + step * to_eye[2]) > dense)
            continue;
        chosen[block * BLOCK + count++] = (uint32_t)i;
    }
    return count;
}

/* The negative gradient of the density, 1/m. */
static void gradient(const sb_density *density, const float *p, float g[3])
{
    const float d = density->cell, scale = 0.5f / d;
    for (int a = 0; a < 3; a++) {
        float low[3] = {p[0], p[1], p[2]}, high[3] = {p[0], p[1], p[2]};
        low[a] -= d;
        high[a] += d;
        g[a] = scale *
               (sb_density_at(density, low[0], low[1], low[2]) - sb_density_at(density, high[0], high[1], high[2]));
    }
}

/* Moves a particle along the gradient to the surface, and finds the normal there, zero if there is none. Returns the
   gradient's magnitude per spacing. A drop close
   above the surface becomes part of it, but no particle moves into its own layer if that is the only one above the
   ground. Particles of a sheet whose density is nowhere that of the surface stay where they are. */
static float to_surface(const sb_density *density, float spacing, float place[3], float normal[3])
{
    float at[3] = {place[0], place[1], place[2]}, here = 0, length = 0;
    for (int turn = 0; turn < 4; turn++) {
        here = sb_density_at(density, at[0], at[1], at[2]);
        gradient(density, at, normal);
        length = sqrtf(sb_dot3(normal, normal));
        if (length * spacing < 0.04f || fabsf(here - surface_density) < 0.02f) break;
        float step = (here - surface_density) / length;
        const float most = 0.8f * spacing;
        step = step < -most ? -most : step > most ? most : step;
        for (int a = 0; a < 3; a++) at[a] += step * normal[a] / length;
    }
    const float moved =
        (at[0] - place[0]) * normal[0] + (at[1] - place[1]) * normal[1] + (at[2] - place[2]) * normal[2];
    const float deep = length > 0 ? 1.5f * spacing / length : 0;
    const float below =
        sb_density_at(density, at[0] - deep * normal[0], at[1] - deep * normal[1], at[2] - deep * normal[2]);
    if (fabsf(here - surface_density) < 0.15f && (moved > 0 || below > 0.75f))
        for (int a = 0; a < 3; a++) place[a] = at[a];
    gradient(density, place, normal);
    length = sqrtf(sb_dot3(normal, normal));
    if (length * spacing < 0.12f) {
        const float above[3] = {place[0], place[1], place[2] + 0.7f * spacing};
        gradient(density, above, normal);
        length = sqrtf(sb_dot3(normal, normal));
    }
    for (int a = 0; a < 3; a++) normal[a] = length * spacing < 0.01f ? 0 : normal[a] / length;
    return length * spacing;
}

/* The length of water behind a place, m. */
static float thickness(const sb_density *density, const float *place, const float *away, float spacing)
{
    enum { STEPS = 8 };
    const float step = spacing * (float)SB_SURFEL_THICKEST / STEPS;
    float sum = 0;
    for (int k = 0; k < STEPS; k++) {
        const float by = ((float)k + 0.5f) * step;
        const float here =
            sb_density_at(density, place[0] + by * away[0], place[1] + by * away[1], place[2] + by * away[2]);
        sum += here < 1 ? here : 1;
    }
    return sum * step;
}

static float ramp(float low, float high, float x)
{
    const float t = (x - low) / (high - low), s = t < 0 ? 0 : t > 1 ? 1 : t;
    return s * s * (3 - 2 * s);
}

/* Sets the components of a vector along the camera's axes. */
static void along(const sb_lens *lens, const float *v, float out[3])
{
    out[0] = sb_dot3(v, lens->right);
    out[1] = sb_dot3(v, lens->up);
    out[2] = -sb_dot3(v, lens->back);
}

static sb_surfel surfel_of(const sb_density *density, const sb_frame *frame, const sb_lens *lens, size_t i, float value)
{
    const float *p = frame->position + 3 * i, spacing = (float)frame->spacing;
    float place[3] = {p[0], p[1], p[2]}, normal[3] = {0, lens->eye[1] > p[1] ? 1 : -1, 0};
    const float crowd = sb_density_at(density, p[0], p[1], p[2]);
    /* Particles of a slice are a flat picture of their plane. */
    const float slope = density->slice ? 1 : to_surface(density, spacing, place, normal);
    float away[3] = {place[0] - lens->eye[0], place[1] - lens->eye[1], place[2] - lens->eye[2]};
    sb_surfel surfel = {.value = value, .share = ramp(drop_density, sheet_density, crowd)};
    surfel.radius = spacing * (least_radius + (disc_radius - least_radius) * ramp(0.12f, 0.42f, crowd));
    along(lens, away, surfel.place);
    const float distance = sqrtf(sb_dot3(away, away)), inverse = distance > 0 ? 1 / distance : 0;
    for (int a = 0; a < 3; a++) away[a] *= inverse;
    surfel.thickness = density->slice ? (float)SB_SURFEL_THICKEST * spacing : thickness(density, place, away, spacing);
    /* Thin sheets in the air have no clear normal: their elements face the eye. An element that is seen at a very small
       angle is turned to the eye, so that it still covers pixels. */
    const float faced = (1 - ramp(0.2f, 0.45f, crowd)) * (1 - ramp(0.08f, 0.2f, slope));
    for (int a = 0; a < 3; a++) normal[a] = (1 - faced) * normal[a] - faced * away[a];
    const float least = 0.1f, facing = -sb_dot3(normal, away), bend = facing < least ? least - facing : 0;
    for (int a = 0; a < 3; a++) normal[a] -= bend * away[a];
    const float length = sqrtf(sb_dot3(normal, normal));
    for (int a = 0; a < 3; a++) normal[a] = length > 0 ? normal[a] / length : -away[a];
    along(lens, normal, surfel.normal);
    return surfel;
}

static sb_status make_room(sb_surfels *surfels, size_t particles, size_t blocks, sb_error *error)
{
    if (sb_grow((void **)&surfels->chosen, &surfels->chosen_capacity, particles, sizeof *surfels->chosen) != 0 ||
        sb_grow((void **)&surfels->blocks, &surfels->block_capacity, blocks + 1, sizeof *surfels->blocks) != 0)
        return sb_fail_memory(error, "the visible particles");
    return SB_OK;
}

sb_status sb_surfels_collect(sb_surfels *surfels, const sb_frame *frame, const float *values, const sb_ground *ground,
                             const sb_view *view, int threads, sb_error *error)
{
    surfels->count = 0;
    const size_t blocks = (frame->count + BLOCK - 1) / BLOCK;
    sb_status status = make_room(surfels, frame->count, blocks, error);
    if (status == SB_OK) status = sb_density_build(&surfels->density, frame, ground, threads, error);
    if (status != SB_OK) return status;
    const sb_lens lens = sb_lens_of(view, frame->origin, 2 * frame->spacing);
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (size_t b = 0; b < blocks; b++)
        surfels->blocks[b] = choose(&surfels->density, frame, &lens, b, surfels->chosen);
    size_t total = 0;
    for (size_t b = 0; b < blocks; b++) {
        const size_t count = surfels->blocks[b];
        surfels->blocks[b] = total;
        total += count;
    }
    surfels->blocks[blocks] = total;
    if (sb_grow((void **)&surfels->list, &surfels->capacity, total, sizeof *surfels->list) != 0)
        return sb_fail_memory(error, "the visible particles");
#pragma omp parallel for num_threads(threads) schedule(dynamic)
    for (size_t b = 0; b < blocks; b++)
        for (size_t k = surfels->blocks[b]; k < surfels->blocks[b + 1]; k++) {
            const size_t i = surfels->chosen[b * BLOCK + k - surfels->blocks[b]];
            surfels->list[k] = surfel_of(&surfels->density, frame, &lens, i, values[i]);
        }
    surfels->count = total;
    return SB_OK;
}

void sb_surfels_free(sb_surfels *surfels)
{
    sb_free(surfels->list);
    sb_free(surfels->chosen);
    sb_free(surfels->blocks);
    sb_density_free(&surfels->density);
    *surfels = (sb_surfels){0};
}
