/* The panels: tables whose rows can be scrolled. Internal to the drawing of the monitor. */
#ifndef SB_MONITOR_PANEL_H
#define SB_MONITOR_PANEL_H

#include "cells.h"
#include "state.h"
#include "view.h"

/* A part of a row: the columns [left, left + width). */
typedef struct sb_strip {
    sb_cells *cells;
    int row, left, width;
} sb_strip;

/* Each function draws into the strip only. */
typedef struct sb_panel {
    const char *name;
    size_t (*count)(const sb_monitor_state *state);                /* rows */
    void (*header)(sb_strip strip, const sb_monitor_state *state); /* the heads of the columns */
    void (*row)(sb_strip strip, const sb_monitor_state *state, size_t index);
    /* What the title adds: the rows that are not kept, the time since which peaks are known. May be NULL. */
    void (*remark)(char *out, size_t size, const sb_monitor_state *state);
    const char *empty; /* what is shown without rows */
} sb_panel;

extern const sb_panel sb_panel_forces, sb_panel_gauges, sb_panel_stages, sb_panel_solver, sb_panel_stream;

/* By sb_panel_kind. */
const sb_panel *sb_panel_find(sb_panel_kind kind);

/* Write text at the strip's left end, or right-aligned in `width` columns, and move that end beyond it and `gap`
   blanks. Text that does not fit is cut. */
void sb_strip_left(sb_strip *strip, sb_style style, int width, int gap, const char *text);
void sb_strip_right(sb_strip *strip, sb_style style, int width, int gap, const char *text);

/* Writes a sparkline that takes `width` columns. */
void sb_strip_spark(sb_strip *strip, int width, int gap, const sb_history *course, double low, double high);

#endif
