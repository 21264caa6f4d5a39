/* What the user has chosen to see, and what the keys do. */
#ifndef SB_MONITOR_VIEW_H
#define SB_MONITOR_VIEW_H

#include <stdbool.h>
#include <stddef.h>

typedef enum sb_panel_kind {
    SB_PANEL_FORCES,
    SB_PANEL_GAUGES,
    SB_PANEL_STAGES,
    SB_PANEL_SOLVER,
    SB_PANEL_STREAM,
    SB_PANELS
} sb_panel_kind;

/* Keys that are no characters. */
enum {
    SB_KEY_UP = 0x110000,
    SB_KEY_DOWN,
    SB_KEY_PAGE_UP,
    SB_KEY_PAGE_DOWN,
    SB_KEY_HOME,
    SB_KEY_END,
    SB_KEY_BACK_TAB,
    SB_KEY_RESIZE
};

/* What the program has to do after a key. */
typedef enum sb_action { SB_ACTION_NONE, SB_ACTION_QUIT, SB_ACTION_PAUSE, SB_ACTION_RESUME, SB_ACTION_STEP } sb_action;

typedef struct sb_view {
    sb_panel_kind panel;
    size_t scroll[SB_PANELS]; /* the first row shown; drawing limits it to the rows that exist */
    size_t page;              /* rows of the chosen panel that were drawn last */
    bool help;
    char note[400];    /* a message to the user; empty: none */
    double note_until; /* s, sb_clock() */
} sb_view;

/* Changes the view as the key says. */
sb_action sb_view_key(sb_view *view, int key);

/* Shows a message for some seconds. */
void sb_view_note(sb_view *view, double now, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
