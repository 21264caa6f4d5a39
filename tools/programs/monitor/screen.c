#define NCURSES_WIDECHAR 1
#include "screen.h"

#include "view.h"

#include <curses.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <term.h>
#include <termios.h>
#include <unistd.h>

static SCREEN *screen;
/* Shared with the process that watches: whether the terminal is taken. NULL: nobody watches. */
static volatile bool *taken;
static attr_t attributes[SB_STYLES];
static short pairs[SB_STYLES];

/* Without colours, bold and inverse text remain. */
static void choose_styles(bool colour)
{
    attributes[SB_STYLE_BOLD] = attributes[SB_STYLE_BAD] = A_BOLD;
    attributes[SB_STYLE_DIM] = A_DIM;
    attributes[SB_STYLE_INVERSE] = A_REVERSE;
    if (!colour || !has_colors() || start_color() == ERR || use_default_colors() == ERR) return;
    init_pair(1, COLOR_GREEN, -1);
    init_pair(2, COLOR_RED, -1);
    init_pair(3, COLOR_CYAN, -1);
    pairs[SB_STYLE_GOOD] = 1;
    pairs[SB_STYLE_BAD] = 2;
    pairs[SB_STYLE_ACCENT] = 3;
}

bool sb_screen_open(bool colour)
{
    screen = newterm(NULL, stdout, stdin);
    if (!screen) return false;
    if (taken) *taken = true;
    cbreak();
    noecho();
    nodelay(stdscr, TRUE);
    keypad(stdscr, TRUE);
    set_escdelay(50);
    curs_set(0);
    choose_styles(colour);
    return true;
}

void sb_screen_close(void)
{
    if (!screen) return;
    curs_set(1);
    endwin();
    delscreen(screen);
    screen = NULL;
    if (taken) *taken = false;
}

void sb_screen_size(int *width, int *height)
{
    getmaxyx(stdscr, *height, *width);
}

void sb_screen_show(const sb_cells *cells)
{
    erase();
    for (int row = 0; row < cells->height; row++) {
        for (int column = 0; column < cells->width; column++) {
            const sb_cell *cell = &cells->cells[(size_t)row * (size_t)cells->width + (size_t)column];
            const wchar_t text[2] = {cell->glyph, 0};
            cchar_t drawn;
            setcchar(&drawn, text, attributes[cell->style], pairs[cell->style], NULL);
            mvadd_wch(row, column, &drawn);
        }
    }
    refresh();
}

int sb_screen_key(void)
{
    static const struct {
        int code, key;
    } known[] = {
        {KEY_UP, SB_KEY_UP},     {KEY_DOWN, SB_KEY_DOWN}, {KEY_PPAGE, SB_KEY_PAGE_UP}, {KEY_NPAGE, SB_KEY_PAGE_DOWN},
        {KEY_HOME, SB_KEY_HOME}, {KEY_END, SB_KEY_END},   {KEY_BTAB, SB_KEY_BACK_TAB}, {KEY_RESIZE, SB_KEY_RESIZE},
    };
    const int code = getch();
    if (code == ERR) return -1;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (code == known[i].code) return known[i].key;
    return code > 0 && code < 0x80 ? code : 0;
}

/* ---- after a crash ---- */

static struct termios settings;
static bool settings_known;

void sb_screen_remember(void)
{
    void *shared = mmap(NULL, sizeof *taken, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    taken = shared == MAP_FAILED ? NULL : shared;
    settings_known = tcgetattr(STDIN_FILENO, &settings) == 0;
}

void sb_screen_restore(void)
{
    int result = 0;
    if (!taken || !*taken) return;
    *taken = false;
    if (settings_known) tcsetattr(STDIN_FILENO, TCSANOW, &settings);
    if (setupterm(NULL, STDOUT_FILENO, &result) == ERR) return;
    const char *const names[] = {"sgr0", "rmkx", "cnorm", "rmcup"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const char *text = tigetstr(names[i]);
        if (text && text != (const char *)(intptr_t)-1) putp(text); /* NOLINT: terminfo's sign of an error */
    }
    del_curterm(cur_term);
    fflush(stdout);
}
