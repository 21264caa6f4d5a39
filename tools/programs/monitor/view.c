#include "view.h"

#include <stdarg.h>
#include <stdio.h>

#define NOTE_SECONDS 6

static void scroll(sb_view *view, bool down, size_t rows)
{
    size_t *first = &view->scroll[view->panel];
    if (down)
        *first += rows;
    else
        *first = *first > rows ? *first - rows : 0;
}

static void scroll_key(sb_view *view, int key)
{
    const size_t page = view->page > 1 ? view->page - 1 : 1;
    switch (key) {
    case SB_KEY_UP:
    case SB_KEY_DOWN:
        scroll(view, key == SB_KEY_DOWN, 1);
        break;
    case SB_KEY_PAGE_UP:
    case SB_KEY_PAGE_DOWN:
        scroll(view, key == SB_KEY_PAGE_DOWN, page);
        break;
    case SB_KEY_HOME:
        view->scroll[view->panel] = 0;
        break;
    case SB_KEY_END:
        view->scroll[view->panel] = 1u << 30;
        break;
    default:
        break;
    }
}

sb_action sb_view_key(sb_view *view, int key)
{
    const bool help = view->help;
    view->help = false; /* any key closes the help */
    switch (key) {
    case 'q':
    case 'Q':
        return SB_ACTION_QUIT;
    case '?':
    case 'h':
        view->help = !help;
        break;
    case 'p':
        return SB_ACTION_PAUSE;
    case 'r':
        return SB_ACTION_RESUME;
    case 's':
        return SB_ACTION_STEP;
    case '\t':
        view->panel = (sb_panel_kind)((view->panel + 1) % SB_PANELS);
        break;
    case SB_KEY_BACK_TAB:
        view->panel = (sb_panel_kind)((view->panel + SB_PANELS - 1) % SB_PANELS);
        break;
    case SB_KEY_RESIZE:
        view->help = help;
        break;
    default:
        scroll_key(view, key);
    }
    return SB_ACTION_NONE;
}

void sb_view_note(sb_view *view, double now, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vsnprintf(view->note, sizeof view->note, format, list);
    va_end(list);
    view->note_until = now + NOTE_SECONDS;
}
