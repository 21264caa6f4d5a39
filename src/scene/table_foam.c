#include "scene/reader.h"

#include <math.h>

/* clang-format off */
static const sb_key keys[] = {
    {.name = "enabled", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_foam_settings, enabled), .fallback = "false",
     .doc = "Whether breaking water emits spray, foam and bubbles. They are drawn and written; they do not act on the "
            "water."},
    {.name = "most", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_foam_settings, most), .unit = "particles", .min = 1,
     .max = 10000000, .fallback = "100000",
     .doc = "Largest number of particles of foam at one time. From half of it on, water emits fewer."},
    {.name = "lifetime", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_foam_settings, lifetime), .unit = "s",
     SB_KEY_NOT_NEGATIVE, .fallback = "0",
     .doc = "Longest time that a particle spends at the surface or below it; the shortest is a third of it. 0: 6 sqrt(D/g)."},
    {.name = "amount", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_foam_settings, amount), SB_KEY_NOT_NEGATIVE,
     .fallback = "1", .doc = "Factor on the number of particles that water emits."},
};
/* clang-format on */

const sb_table sb_foam_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_foam_settings)};
