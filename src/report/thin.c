#include "report/thin.h"

#include <math.h>

/* Of one group: the rows with extreme values, by column; the last entries are for the vector's length. */
typedef struct extremes {
    size_t least[SB_SERIES_COLUMNS_MAX + 1], greatest[SB_SERIES_COLUMNS_MAX + 1];
    double low[SB_SERIES_COLUMNS_MAX + 1], high[SB_SERIES_COLUMNS_MAX + 1];
    bool found[SB_SERIES_COLUMNS_MAX + 1];
} extremes;

static void note(extremes *e, size_t column, size_t row, double value)
{
    if (isnan(value)) return;
    if (!e->found[column] || value < e->low[column]) {
        e->low[column] = value;
        e->least[column] = row;
    }
    if (!e->found[column] || value > e->high[column]) {
        e->high[column] = value;
        e->greatest[column] = row;
    }
    e->found[column] = true;
}

static double length_of(const sb_series_table *table, const sb_series *series, size_t row)
{
    double sum = 0;
    for (size_t c = 1; c < 4; c++) sum += pow(sb_series_table_value(table, series, row, c), 2);
    return sqrt(sum);
}

static void mark(const extremes *e, size_t columns, uint8_t *keep)
{
    for (size_t c = 1; c < columns; c++)
        if (e->found[c]) keep[e->least[c]] = keep[e->greatest[c]] = 1;
    if (e->found[SB_SERIES_COLUMNS_MAX]) keep[e->greatest[SB_SERIES_COLUMNS_MAX]] = 1;
}

size_t sb_thin_most(const sb_series_table *table, size_t pixels)
{
    return 2 + pixels * (2 * table->columns - 1);
}

size_t sb_thin(const sb_series_table *table, const sb_series *series, size_t pixels, uint8_t *keep)
{
    const size_t rows = series->rows;
    size_t kept = 0;
    if (rows == 0) return 0;
    const double first = sb_series_table_value(table, series, 0, 0),
                 last = sb_series_table_value(table, series, rows - 1, 0);
    const double scale = last > first ? (double)pixels / (last - first) : 0;
    extremes group = {0};
    size_t present = 0;
    keep[0] = keep[rows - 1] = 1;
    for (size_t row = 0; row < rows; row++) {
        size_t pixel = (size_t)((sb_series_table_value(table, series, row, 0) - first) * scale);
        if (pixel >= pixels) pixel = pixels - 1;
        if (pixel != present) {
            mark(&group, table->columns, keep);
            group = (extremes){0};
            present = pixel;
        }
        for (size_t c = 1; c < table->columns; c++) note(&group, c, row, sb_series_table_value(table, series, row, c));
        if (table->columns >= 4) note(&group, SB_SERIES_COLUMNS_MAX, row, length_of(table, series, row));
    }
    mark(&group, table->columns, keep);
    for (size_t row = 0; row < rows; row++) kept += keep[row];
    return kept;
}
