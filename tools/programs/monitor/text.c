#include "text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void sb_text_duration(char *out, size_t size, double seconds)
{
    if (!(seconds >= 0) || seconds > 3.2e9) {
        snprintf(out, size, "unknown");
        return;
    }
    long whole = (long)(seconds + 0.5);
    if (whole < 60)
        snprintf(out, size, "%ld s", whole);
    else if (whole < 3600)
        snprintf(out, size, "%ld min %02ld s", whole / 60, whole % 60);
    else
        snprintf(out, size, "%ld h %02ld min", whole / 3600, whole % 3600 / 60);
}

sb_text_unit sb_text_force_unit(double peak)
{
    static const sb_text_unit units[] = {{"N", 1}, {"kN", 1e3}, {"MN", 1e6}, {"GN", 1e9}};
    size_t i = 0;
    while (i < 3 && peak >= 1000 * units[i].size) i++;
    return units[i];
}

void sb_text_number(char *out, size_t size, double value, bool sign)
{
    double large = fabs(value);
    if (large < 0.005) value = 0; /* no "-0.00" */
    if (large < 99999)
        snprintf(out, size, sign ? "%+.2f" : "%.2f", value);
    else
        snprintf(out, size, sign ? "%+.1e" : "%.1e", value);
}

static double clamped(double share)
{
    return share > 1 ? 1 : share > 0 ? share : 0;
}

void sb_text_bar(char *out, int cells, double share, double mark, bool utf8)
{
    static const char *const eighths[] = {" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉", "█"};
    int filled = (int)lround(clamped(share) * 8 * cells);
    int marked = mark >= 0 ? (int)(clamped(mark) * cells) : -1;
    if (marked == cells) marked = cells - 1;
    *out = 0;
    for (int i = 0; i < cells; i++) {
        int part = filled - 8 * i;
        const char *cell = utf8 ? (part >= 8 ? eighths[8] : part > 0 ? eighths[part] : "·") : (part >= 4 ? "#" : ".");
        if (i == marked && part <= 0) cell = utf8 ? "│" : "|";
        out = stpcpy(out, cell);
    }
}

/* The level from 0 to 7 of a value. */
static int level(double value, double low, double high)
{
    return high > low ? (int)lround(7 * clamped((value - low) / (high - low))) : 0;
}

void sb_text_spark(char *out, int cells, const double *values, int count, double low, double high, bool utf8)
{
    static const char *const blocks[] = {"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
    static const char *const letters[] = {"_", ".", "-", "=", "+", "*", "#", "@"};
    const int columns = count < cells ? count : cells;
    *out = 0;
    for (int c = 0; c < columns; c++) {
        int at = c * count / columns;
        for (int i = at + 1; i < (c + 1) * count / columns; i++)
            if (fabs(values[i]) > fabs(values[at])) at = i;
        out = stpcpy(out, (utf8 ? blocks : letters)[level(values[at], low, high)]);
    }
}
