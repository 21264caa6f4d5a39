#include "sim/state/space.h"

#include "sim/search/sort.h"

static int bits_for(uint32_t count)
{
    int bits = 0;
    while (bits < 31 && (uint32_t)1 << bits < count) bits++;
    return bits;
}

static void make_spread(sb_space *space)
{
    int place[3][24];
    int next = 0;
    for (int level = 0; level < 24; level++)
        for (int axis = 0; axis < 3; axis++) place[axis][level] = level < space->bits[axis] ? next++ : -1;
    space->key_bits = next;
    for (int axis = 0; axis < 3; axis++)
        for (int byte = 0; byte < 3; byte++)
            for (int value = 0; value < 256; value++) {
                uint64_t key = 0;
                for (int bit = 0; bit < 8; bit++)
                    if (value >> bit & 1 && place[axis][8 * byte + bit] >= 0)
                        key |= (uint64_t)1 << place[axis][8 * byte + bit];
                space->spread[axis][byte][value] = key;
            }
}

sb_status sb_space_create(sb_vec3 min, sb_vec3 max, double cell, sb_space *space, sb_error *error)
{
    /* With 22 bits per cell, differences within three cells are exact in float. */
    enum { MOST_SHIFT = 22, LEAST_SHIFT = 14, MOST_KEY_BITS = 64 - SB_INDEX_BITS };
    sb_space made = {.cell = cell};
    double extent[3] = {max.x - min.x, max.y - min.y, max.z - min.z};
    int most = 1;
    for (int axis = 0; axis < 3; axis++) {
        double cells = floor(extent[axis] / cell) + 1 + 2 * SB_SPACE_MARGIN;
        if (!(cells < (double)(1 << (31 - LEAST_SHIFT))))
            return sb_fail(error, SB_BAD_INPUT, "domain of %g m is %.0f support radii long: expected fewer than %d",
                           extent[axis], cells, 1 << (31 - LEAST_SHIFT));
        made.bits[axis] = bits_for((uint32_t)cells);
        if (made.bits[axis] > most) most = made.bits[axis];
    }
    made.shift = 31 - most < MOST_SHIFT ? 31 - most : MOST_SHIFT;
    made.quantum = cell / (double)(1 << made.shift);
    made.origin = sb_sub(min, sb_vec(SB_SPACE_MARGIN * cell, SB_SPACE_MARGIN * cell, SB_SPACE_MARGIN * cell));
    make_spread(&made);
    if (made.key_bits > MOST_KEY_BITS)
        return sb_fail(error, SB_BAD_INPUT,
                       "domain of %g x %g x %g m holds up to 2^%d cells of %g m: expected at most 2^%d", extent[0],
                       extent[1], extent[2], made.key_bits, cell, MOST_KEY_BITS);
    *space = made;
    return SB_OK;
}

void sb_space_repeat(sb_space *space, int axis, double length)
{
    space->period[axis] = (uint32_t)nearbyint(length / space->quantum);
    space->repeats = true;
}

int sb_space_images(const sb_space *space, sb_record record, sb_record image[SB_IMAGES_MAX])
{
    const uint32_t low = sb_space_low(space);
    const int32_t range = (int32_t)1 << space->shift;
    int count = 0;
    for (int axis = 0; axis < 3; axis++) {
        const uint32_t period = space->period[axis];
        const bool ahead = period > 0 && (int32_t)(record[axis] - low) < range;
        const bool behind = period > 0 && (int32_t)(low + period - record[axis]) < range;
        const int before = count;
        for (int k = -1; k < before; k++) {
            sb_record from = k < 0 ? record : image[k];
            sb_record step = {axis == 0 ? period : 0, axis == 1 ? period : 0, axis == 2 ? period : 0, 0};
            if (ahead) image[count++] = from + step;
            if (behind) image[count++] = from - step;
        }
    }
    return count;
}

static uint32_t quanta(double distance, double quantum)
{
    double value = nearbyint(distance / quantum);
    return value <= 0 ? 0 : value >= 2147483647.0 ? 2147483647u : (uint32_t)value;
}

sb_record sb_space_record(const sb_space *space, sb_vec3 position)
{
    sb_vec3 d = sb_sub(position, space->origin);
    return (sb_record){quanta(d.x, space->quantum), quanta(d.y, space->quantum), quanta(d.z, space->quantum), 0};
}

sb_vec3 sb_space_position(const sb_space *space, sb_record record)
{
    return sb_vec(space->origin.x + record[0] * space->quantum, space->origin.y + record[1] * space->quantum,
                  space->origin.z + record[2] * space->quantum);
}
