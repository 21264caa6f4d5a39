/* Writes HTML to a stream. All texts are escaped. Write errors are left in the stream. */
#ifndef SB_REPORT_HTML_H
#define SB_REPORT_HTML_H

#include <stddef.h>
#include <stdio.h>

/* Writes a text so that it is no markup, in elements and in quoted attributes. Bytes that are not UTF-8 and control
   characters except line breaks and tabs become U+FFFD. NULL is empty. */
void sb_html_text(FILE *stream, const char *text);

/* Writes the format, which is trusted markup. Its fields:
   %s a text, escaped; %d an int; %z a size_t; %g a double as sb_figure writes it; %% a percent sign. */
void sb_html_put(FILE *stream, const char *format, ...);

/* Writes bytes in base64. */
void sb_html_base64(FILE *stream, const unsigned char *bytes, size_t size);

/* Writes a program into a <script> or a style into a <style> element: "</s" and "<!--" in its strings get a backslash,
   so that they end or begin nothing. */
void sb_html_inline(FILE *stream, const char *text, size_t size);

/* The value with at most three significant digits, without exponent between 1e-4 and 1e9, thousands apart; a dash for
   NaN. */
enum { SB_FIGURE_MAX = 48 };
const char *sb_figure(char out[SB_FIGURE_MAX], double value);

#endif
