#include "panel.h"

#include "text.h"

#include <stdio.h>

static const sb_panel *const panels[SB_PANELS] = {
    [SB_PANEL_FORCES] = &sb_panel_forces, [SB_PANEL_GAUGES] = &sb_panel_gauges, [SB_PANEL_STAGES] = &sb_panel_stages,
    [SB_PANEL_SOLVER] = &sb_panel_solver, [SB_PANEL_STREAM] = &sb_panel_stream,
};

const sb_panel *sb_panel_find(sb_panel_kind kind)
{
    return panels[kind];
}

static void advance(sb_strip *strip, int columns)
{
    if (columns > strip->width) columns = strip->width;
    strip->left += columns;
    strip->width -= columns;
}

/* Texts of several bytes per column are made here and fit; others are ASCII. */
static void put(const sb_strip *strip, sb_style style, int column, int width, const char *text)
{
    if (sb_cells_columns(text) <= width)
        sb_cells_put(strip->cells, strip->row, column, style, text);
    else
        sb_cells_print(strip->cells, strip->row, column, style, "%.*s", width > 0 ? width : 0, text);
}

void sb_strip_left(sb_strip *strip, sb_style style, int width, int gap, const char *text)
{
    if (width > strip->width) width = strip->width;
    put(strip, style, strip->left, width, text);
    advance(strip, width + gap);
}

void sb_strip_right(sb_strip *strip, sb_style style, int width, int gap, const char *text)
{
    if (width > strip->width) width = strip->width;
    const int columns = sb_cells_columns(text);
    put(strip, style, columns < width ? strip->left + width - columns : strip->left, width, text);
    advance(strip, width + gap);
}

void sb_strip_spark(sb_strip *strip, int width, int gap, const sb_history *course, double low, double high)
{
    char text[3 * SB_HISTORY + 1];
    const int cells = width < SB_HISTORY ? width : SB_HISTORY;
    sb_text_spark(text, cells > 0 ? cells : 0, course->value, course->count, low, high, strip->cells->utf8);
    sb_strip_left(strip, SB_STYLE_ACCENT, width, gap, text);
}
