/* Groups of particles and the records around them. A group is the content of one block of 2 x 2 x 2 cells. These
   particles follow one another on the Z-curve and share most of their neighbours. A pass copies the records around the
   group into one contiguous array. The neighbour lists of the group hold 16-bit places in that array
   (docs/decisions/0007). */
#ifndef SB_SIM_AROUND_H
#define SB_SIM_AROUND_H

#include "sim/simulation.h"

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

/* Copies the records around a group, as offsets from its corner. out: SB_AROUND_MAX. */
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
}

/* The same, each record followed by its value of a field. out: 2 SB_AROUND_MAX. */
SB_INLINE void sb_around_with(const sb_sim *sim, const sb_group *group, const sb_f4 *field, sb_f4 *out)
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

/* Number of records around the group. */
SB_INLINE uint32_t sb_around_count(const sb_sim *sim, const sb_group *group)
{
    uint32_t count = 0;
    for (size_t r = 0; r < group->runs; r++) count += sim->groups.run[group->run + r].count;
    return count;
}

/* Divides the particles into groups; does not find the records around them. Returns 0, or -1 without memory. */
int sb_groups_build(sb_sim *sim);
void sb_groups_destroy(sb_sim *sim);

#endif
