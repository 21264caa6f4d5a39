/* Which water of a map's cell stands on something: the water that is connected, particle above particle, with the
   ground or with a floor above it (a deck, a roof, a submerged body). Drops and jets in the air are not. Private to
   src/measure. */
#ifndef SB_MEASURE_STANDING_H
#define SB_MEASURE_STANDING_H

#include "frame/records.h"
#include "geometry/model/model.h"

/* Heights are counted in levels of half a spacing (more in very high domains). Each cell has one bit per level. */
typedef struct sb_standing {
    size_t cells, words; /* words: of 64 levels, per cell */
    double low, step;    /* m, bottom of level 0, height of a level */
    double half;         /* m, half a spacing */
    uint64_t *solid;     /* levels of the ground and of floors */
    uint64_t *water;     /* levels in which there is water; after sb_standing_connect of standing water only */
    float *ground; /* m, z of the ground in the middle of a cell, NaN where another body stands on it at the start;
                      NULL: no body has the role of terrain */
} sb_standing;

/* Finds the ground and the floors of each cell from the bodies that do not move. Where a body that moves is higher
   than the ground at the start, the ground is NaN. SB_FAILED without memory. */
sb_status sb_standing_create(const sb_scene *scene, const sb_model *model, const sb_map_record *grid,
                             sb_standing *standing, sb_error *error);
void sb_standing_free(sb_standing *standing);
size_t sb_standing_bytes(const sb_standing *standing);

/* Removes all water. */
void sb_standing_clear(sb_standing *standing);

static inline size_t sb_standing_level(const sb_standing *s, double z)
{
    const double level = (z - s->low) / s->step, last = 64.0 * (double)s->words - 1;
    return level > 0 ? (size_t)(level < last ? level : last) : 0;
}

/* Adds a particle at the height z to the water of a cell: its cube covers a spacing. */
static inline void sb_standing_add(sb_standing *s, size_t cell, double z)
{
    uint64_t *water = s->water + cell * s->words;
    const size_t end = sb_standing_level(s, z + s->half);
    for (size_t l = sb_standing_level(s, z - s->half); l <= end; l++) water[l / 64] |= (uint64_t)1 << l % 64;
}

/* Leaves in each cell the water that is connected with the ground or a floor. A gap ends the connection that contains a
   whole level: particles up to 1.5 spacings above each other are connected, and from two spacings on they are not. */
void sb_standing_connect(sb_standing *standing);

/* Whether a particle at the height z stands in a cell. Call after sb_standing_connect. */
static inline bool sb_standing_has(const sb_standing *s, size_t cell, double z)
{
    const size_t l = sb_standing_level(s, z);
    return s->water[cell * s->words + l / 64] >> l % 64 & 1;
}

#endif
