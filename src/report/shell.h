/* What surrounds the sections of a page: its head with style and policy, dygraphs, and the program of the plots. */
#ifndef SB_REPORT_SHELL_H
#define SB_REPORT_SHELL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

typedef struct sb_shell {
    bool has_plots; /* dygraphs is there */
    char *texts[2]; /* dygraphs' style and program */
    size_t sizes[2];
} sb_shell;

/* Reads dygraphs from its folder; NULL: where Debian's libjs-dygraphs has it. Without it the page has no plots. */
void sb_shell_read(const char *dygraphs, sb_shell *shell);
void sb_shell_free(sb_shell *shell);

/* Writes the page up to <body>. start: its first line, by which the page is recognised. */
void sb_shell_top(FILE *out, const sb_shell *shell, const char *start, const char *title);
/* Writes what follows </main> and the data of the plots. */
void sb_shell_bottom(FILE *out, const sb_shell *shell);

#endif
