/* Groups of particles and the records around them. A group is the content of one block of 2 x 2 x 2 cells. These
   particles follow one another on the Z-curve and share most of their neighbours. A pass copies the records around the
   group into one contiguous array. The neighbour lists of the group hold 16-bit places in that array
   (docs/decisions/0007). */
#ifndef SB_SIM_AROUND_H
#define SB_SIM_AROUND_H

#include "sim/simulation.h"

#include <string.h>

enum {
    SB_AROUND_MAX = 16383, /* records around a group: four times the index must fit 16 bits; 1000 are normal */
    SB_PLACE_STEP = 4      /* a place in a list is the index in the copy times this */
};

/* Two records side by side. */
typedef uint32_t sb_two_records __attribute__((vector_size(32), aligned(16)));
typedef int32_t sb_two_offsets __attribute__((vector_size(32)));
typedef float sb_two_values __attribute__((vector_size(32), aligned(16)));

/* A record as an offset (quanta, exact) from a corner, with the carried value in the last lane. */
SB_INLINE sb_f4 sb_offset_carrying(sb_record record, sb_record corner)
{
    return __builtin_shufflevector(sb_offset(record, corner), (sb_f4)record, 0, 1, 2, 7);
}

/* The same for two records; corner: the corner twice. A macro, because the way of passing such vectors depends on the
   instruction set. */
#define SB_OFFSETS_CARRYING(records, corner)                                                                           \
    __builtin_shufflevector(__builtin_convertvector((sb_two_offsets)((records) - (corner)), sb_two_values),            \
                            (sb_two_values)(records), 0, 1, 2, 11, 4, 5, 6, 15)

/* A position reflected by a plane; the last lane does not change. */
SB_INLINE sb_f4 sb_reflect(sb_f4 plane, sb_f4 at)
{
    const float twice = 2 * (sb_sum3(plane * at) - plane[3]);
    return at - plane * (sb_f4){twice, twice, twice, 0};
}

/* A vector reflected by a plane. */
SB_INLINE sb_f4 sb_reflect_vector(sb_f4 plane, sb_f4 v)
{
    const float twice = 2 * sb_sum3(plane * v);
    return v - plane * (sb_f4){twice, twice, twice, 0};
}

/* A symmetric tensor T without trace reflected by a plane, R T R: xx is the last lane of *at, and *rest is yy, xy, xz,
   yz. In 2D yy = 0. */
SB_INLINE void sb_reflect_tensor(sb_f4 plane, sb_f4 *at, sb_f4 *rest)
{
    const sb_f4 n = plane, t = *rest;
    const float xx = (*at)[3], zz = -xx - t[0];
    const sb_f4 through = {xx * n[0] + t[1] * n[1] + t[2] * n[2], t[1] * n[0] + t[0] * n[1] + t[3] * n[2],
                           t[2] * n[0] + t[3] * n[1] + zz * n[2], 0}; /* T n */
    const float normal = sb_sum3(n * through);
    /* T' = T - 2 (n (x) Tn + Tn (x) n) + 4 (n.Tn) n (x) n = T - (n (x) w + w (x) n), w = 2 Tn - 2 (n.Tn) n */
    const sb_f4 w = (through - n * sb_splat(normal)) * sb_splat(2);
    (*at)[3] = xx - 2 * n[0] * w[0];
    *rest = (sb_f4){t[0] - 2 * n[1] * w[1], t[1] - n[0] * w[1] - n[1] * w[0], t[2] - n[0] * w[2] - n[2] * w[0],
                    t[3] - n[1] * w[2] - n[2] * w[1]};
}

SB_INLINE sb_f4 sb_path_plane(const sb_group_plane *planes, uint32_t path)
{
    return planes[(path & SB_REFLECTION_MASK) - 1].plane;
}

/* The place of an image, and the value that its original carries in the last lane. */
SB_INLINE sb_f4 sb_image_carrying(const sb_sim *sim, const sb_image *image)
{
    sb_f4 at;
    memcpy(&at, image->at, sizeof at); /* the last lane is image->from */
    return __builtin_shufflevector(at, (sb_f4)sim->state.position[image->from], 0, 1, 2, 7);
}

/* Appends the images to the records around a group. */
SB_INLINE void sb_around_images(const sb_sim *sim, const sb_group *group, sb_f4 *out)
{
    const sb_image *image = sim->groups.image + group->image;
    for (uint32_t k = 0; k < group->images; k++) out[k] = sb_image_carrying(sim, &image[k]);
}

/* Copies the records around a group, as offsets from its corner, and their images. out: SB_AROUND_MAX. */
SB_INLINE void sb_around(const sb_sim *sim, const sb_group *group, sb_f4 *out)
{
    const sb_record c = group->corner;
    const sb_two_records corner = __builtin_shufflevector(c, c, 0, 1, 2, 3, 0, 1, 2, 3);
    const sb_run *run = sim->groups.run + group->run;
    for (size_t r = 0; r < group->runs; r++) {
        const sb_record *record = sim->state.position + run[r].begin, *end = record + run[r].count;
        for (; end - record >= 2; record += 2, out += 2)
            *(sb_two_values *)out = SB_OFFSETS_CARRYING(*(const sb_two_records *)record, corner);
        if (record < end) *out++ = sb_offset_carrying(*record, c);
    }
    if (group->images > 0) sb_around_images(sim, group, out);
}

/* The records alone, each followed by its value of a field. Returns where the images would begin. out: 2
   SB_AROUND_MAX. */
SB_INLINE sb_f4 *sb_around_with(const sb_sim *sim, const sb_group *group, const sb_f4 *field, sb_f4 *out)
{
    const sb_record c = group->corner;
    const sb_two_records corner = __builtin_shufflevector(c, c, 0, 1, 2, 3, 0, 1, 2, 3);
    const sb_run *run = sim->groups.run + group->run;
    for (size_t r = 0; r < group->runs; r++) {
        const sb_record *record = sim->state.position + run[r].begin, *end = record + run[r].count;
        const sb_f4 *value = field + run[r].begin;
        for (; end - record >= 2; record += 2, value += 2, out += 4) {
            const sb_two_values a = SB_OFFSETS_CARRYING(*(const sb_two_records *)record, corner);
            const sb_two_values b = *(const sb_two_values *)value;
            *(sb_two_values *)out = __builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11);
            *(sb_two_values *)(out + 2) = __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15);
        }
        if (record == end) continue;
        *out++ = sb_offset_carrying(*record, c);
        *out++ = *value;
    }
    return out;
}

/* The same with images, of a field of vectors. */
SB_INLINE void sb_around_vectors(const sb_sim *sim, const sb_group *group, const sb_f4 *field, sb_f4 *out)
{
    out = sb_around_with(sim, group, field, out);
    const sb_image *image = sim->groups.image + group->image;
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    for (uint32_t k = 0; k < group->images; k++, out += 2) {
        sb_f4 value = sb_reflect_vector(sb_path_plane(planes, image[k].path), field[image[k].from]);
        for (uint32_t path = image[k].path >> SB_REFLECTION_BITS; path; path >>= SB_REFLECTION_BITS)
            value = sb_reflect_vector(sb_path_plane(planes, path), value);
        out[0] = sb_image_carrying(sim, &image[k]);
        out[1] = value;
    }
}

/* The same for tensors in the form of sb_reflect_tensor. Returns false, without images, if all tensors are 0, as in
   shallow water. */
SB_INLINE bool sb_around_tensors(const sb_sim *sim, const sb_group *group, const sb_f4 *field, sb_f4 *out)
{
    const sb_f4 *record = out;
    sb_i4 bits = {0};
    out = sb_around_with(sim, group, field, out);
    for (; record < out; record += 2) bits |= ((sb_i4)record[0] & (sb_i4){0, 0, 0, -1}) | (sb_i4)record[1];
    if ((bits[0] | bits[1] | bits[2] | bits[3]) == 0) return false;
    const sb_image *image = sim->groups.image + group->image;
    const sb_group_plane *planes = sim->groups.plane + group->plane;
    for (uint32_t k = 0; k < group->images; k++, out += 2) {
        out[0] = sb_image_carrying(sim, &image[k]);
        out[1] = field[image[k].from];
        for (uint32_t path = image[k].path; path; path >>= SB_REFLECTION_BITS)
            sb_reflect_tensor(sb_path_plane(planes, path), &out[0], &out[1]);
    }
    return true;
}

/* Puts another field's values into the last lanes of the values that sb_around_with copied. */
SB_INLINE void sb_around_last(const sb_sim *sim, const sb_group *group, const float *field, sb_f4 *around)
{
    const sb_run *run = sim->groups.run + group->run;
    sb_f4 *value = around + 1;
    for (size_t r = 0; r < group->runs; r++)
        for (size_t k = 0; k < run[r].count; k++, value += 2) (*value)[3] = field[run[r].begin + k];
}

/* Particle i of the group in the form that sb_around writes. */
SB_INLINE sb_f4 sb_in_group(const sb_sim *sim, const sb_group *group, size_t i)
{
    return sb_offset_carrying(sim->state.position[i], group->corner);
}

/* A neighbour's record in the output of sb_around. sb_at_with: its record, then its value, in the output of
   sb_around_with. */
SB_INLINE const sb_f4 *sb_at(const sb_f4 *around, uint16_t place)
{
    return (const sb_f4 *)((const char *)around + sizeof *around / SB_PLACE_STEP * place);
}

SB_INLINE const sb_f4 *sb_at_with(const sb_f4 *around, uint16_t place)
{
    return (const sb_f4 *)((const char *)around + 2 * sizeof *around / SB_PLACE_STEP * place);
}

/* Record and value in one vector. */
SB_INLINE const sb_f8 *sb_both_at(const sb_f4 *around, uint16_t place)
{
    return (const sb_f8 *)sb_at_with(around, place);
}

/* Lists are read once per pass, in order, from memory. This prefetches the entries of a few particles ahead
   (docs/decisions/0012). Past the end of the pool the prefetch has no effect. */
SB_INLINE void sb_prefetch(const sb_four_pairs *four)
{
    enum { BYTES = 4096 };
    /* Computed as an integer: a pointer past the pool would be undefined. NOLINTNEXTLINE(performance-no-int-to-ptr) */
    __builtin_prefetch((const void *)((uintptr_t)four + BYTES));
}

/* Slopes of four neighbours in units of sim->work.pairs.unit. */
SB_INLINE sb_f4 sb_slopes(const sb_four_pairs *four)
{
    typedef uint16_t four_shorts __attribute__((vector_size(8), aligned(2)));
    const four_shorts slope = *(const four_shorts *)four->slope;
    const sb_f4 root = __builtin_convertvector(__builtin_convertvector(slope, sb_i4), sb_f4);
    return root * root;
}

/* The particle, owned or of another domain, that an entry of the arrays around is, or is an image of. */
SB_INLINE uint32_t sb_entry_owner(const sb_sim *sim, uint32_t entry)
{
    const size_t images = sb_images_first(sim);
    return entry < images ? entry : sim->ghosts.of[entry - images];
}

/* Particle i's pairs at edges: their part of the sum of m (q_i + q_j) grad W, and of the sum of m (f_i - f_j) . grad W.
   Records carry q. */
SB_INLINE sb_f4 sb_edges_push(const sb_sim *sim, size_t i, float q)
{
    const sb_edge_pair *e = sim->work.edge_pairs.pair + sim->work.edge_pairs.first[i];
    sb_f4 sum = {0};
    for (const sb_edge_pair *end = e + sim->work.edge_pairs.count[i]; e < end; e++)
        sum += sb_edge_own(e) * sb_splat(q + sb_carried_value(sim->state.position[e->entry]));
    sum[3] = 0;
    return sum;
}

SB_INLINE float sb_edges_flow(const sb_sim *sim, size_t i, const sb_f4 *field)
{
    const sb_edge_pair *e = sim->work.edge_pairs.pair + sim->work.edge_pairs.first[i];
    float sum = 0;
    for (const sb_edge_pair *end = e + sim->work.edge_pairs.count[i]; e < end; e++)
        sum += sb_sum3(sb_edge_own(e) * field[i] + sb_edge_other(e) * field[e->entry]);
    return sum;
}

/* Number of records around the group, without images. */
SB_INLINE uint32_t sb_around_count(const sb_sim *sim, const sb_group *group)
{
    uint32_t count = 0;
    for (size_t r = 0; r < group->runs; r++) count += sim->groups.run[group->run + r].count;
    return count;
}

/* Divides the particles into groups; does not find the records around them. Returns 0, or -1 without memory. */
int sb_groups_build(sb_sim *sim);
/* After the search: orders the groups by whether they read ghosts. Returns 0, or -1 without memory. */
int sb_groups_order(sb_sim *sim);
void sb_groups_destroy(sb_sim *sim);

#endif
