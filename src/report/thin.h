/* Thins a series for a plot: what a plot of some pixels shows is kept, and so are all extreme values. */
#ifndef SB_REPORT_THIN_H
#define SB_REPORT_THIN_H

#include "report/series_table.h"

#include <stdint.h>

/* Marks the rows to keep, keep[row] = 1, and returns their number. The rows are divided into `pixels` groups of equal
   duration. Of each group the rows with the least and the greatest value of each column are kept, and that with the
   greatest length of the vector of the first three columns; also the first and the last row of the series. keep has
   series->rows elements, all 0. */
size_t sb_thin(const sb_series_table *table, const sb_series *series, size_t pixels, uint8_t *keep);

/* The most rows that sb_thin keeps. */
size_t sb_thin_most(const sb_series_table *table, size_t pixels);

#endif
