/* Greatest values, arrival and inundation per cell of a depth-averaged model. */
#ifndef SB_OFFSHORE_MAPS_H
#define SB_OFFSHORE_MAPS_H

#include "base/archive.h"
#include "offshore/offshore.h"

typedef struct sb_offshore_maps sb_offshore_maps;

/* Begins with the present state. threshold, m: the rise above the present depth that counts as arrival, and the depth
   from which speed, momentum flux and inundation count. */
sb_status sb_offshore_maps_create(const sb_offshore *offshore, double threshold, sb_offshore_maps **maps,
                                  sb_error *error);
void sb_offshore_maps_destroy(sb_offshore_maps *maps);

/* Call after every step, which took `taken` s. */
void sb_offshore_maps_step(sb_offshore_maps *maps, const sb_offshore *offshore, double taken);

/* Arrays of columns x rows, row 0 at the smallest y. Below 0: never. duration: 0 where it was wet at the start. */
typedef struct sb_offshore_map_view {
    size_t columns, rows;
    const float *depth, *speed, *flux, *arrival, *duration; /* m, m/s, m^3/s^2, s, s */
} sb_offshore_map_view;
sb_offshore_map_view sb_offshore_maps_read(const sb_offshore_maps *maps);

/* Writes the maps into the open section; reads them into maps of the same grid. Impossible values are refused. */
void sb_offshore_maps_save(const sb_offshore_maps *maps, sb_archive_out *out);
void sb_offshore_maps_load(sb_offshore_maps *maps, sb_archive_in *in);

/* Heap bytes that the maps of so many cells need. */
size_t sb_offshore_maps_bytes(size_t cells);

#endif
