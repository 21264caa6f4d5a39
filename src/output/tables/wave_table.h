/* waves.csv: heights and periods of the waves at the gauges of a run. */
#ifndef SB_OUTPUT_WAVE_TABLE_H
#define SB_OUTPUT_WAVE_TABLE_H

#include "physics/records/wave_heights.h"
#include "scene/scene.h"

/* The first bytes of waves.csv. */
#define SB_WAVE_TABLE_START "gauge,from_s,"

enum { SB_WAVE_HARMONICS = 5 };

/* The waves at one gauge since measure.waves.start. */
typedef struct sb_gauge_waves {
    double from, to;  /* s, of the rows that are used; NaN: none */
    size_t rows, dry; /* numbers of rows that are used, and of those without water */
    sb_wave_heights heights;
    double harmonic[SB_WAVE_HARMONICS]; /* m, amplitudes at period/n; NaN: not known */
} sb_gauge_waves;

/* Number of harmonics that waves.csv has: at most SB_WAVE_HARMONICS, fewer if measure.interval has not more than two
   rows in their period; 0 without measure.waves.period. */
int sb_wave_table_harmonics(const sb_scene *scene);

/* Finds the waves from gauges.csv of the run's directory, and writes waves.csv. *waves: one per gauge, which the caller
   frees with sb_free. */
sb_status sb_wave_table_write(const char *directory, const sb_scene *scene, sb_gauge_waves **waves, sb_error *error);

#endif
