/* What a run of the depth-averaged model records: rows of tables, maps, files for ParaView. */
#ifndef SB_APP_GRID_RECORD_H
#define SB_APP_GRID_RECORD_H

#include "offshore/maps.h"
#include "output/particles/particle_list.h"
#include "output/tables/csv.h"

typedef struct sb_grid_record {
    const sb_scene *scene;
    const char *directory;
    sb_csv *csv;
    sb_model model; /* empty: the tables need one */
    sb_offshore_maps *maps;
    sb_gauge_record *gauges; /* of one instant */
    sb_probe_record *probes;
    sb_runup_record *runups;
    double next, next_frame; /* s */
    uint64_t rows;           /* instants recorded */
    sb_particle_list frames;
} sb_grid_record;

/* Opens the tables, and records t = 0. */
sb_status sb_grid_record_begin(sb_grid_record *record, const sb_scene *scene, const char *directory,
                               const sb_offshore *water, sb_error *error);

/* Call after every step, which took `taken` s. */
sb_status sb_grid_record_step(sb_grid_record *record, const sb_offshore *water, double taken, sb_error *error);

/* Writes the maps and closes the tables. Frees all but `frames`, also after a failure. */
sb_status sb_grid_record_end(sb_grid_record *record, const sb_offshore *water, sb_error *error);

#endif
