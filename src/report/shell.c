#include "report/shell.h"

#include "base/file.h"
#include "base/memory.h"
#include "report/html.h"
#include "report/page.h"

#include <string.h>

#define DYGRAPHS "/usr/share/javascript/dygraphs"
enum { DYGRAPHS_LIMIT = 1 << 20 };

void sb_shell_read(const char *dygraphs, sb_shell *shell)
{
    static const char *const names[2] = {"dygraph.min.css", "dygraph.min.js"};
    *shell = (sb_shell){.has_plots = true};
    for (int f = 0; f < 2 && shell->has_plots; f++) {
        char path[SB_PATH_MAX];
        shell->has_plots = sb_path_join(path, dygraphs ? dygraphs : DYGRAPHS, names[f], NULL) == SB_OK &&
                           sb_file_read(path, DYGRAPHS_LIMIT, &shell->texts[f], &shell->sizes[f], NULL) == SB_OK;
    }
}

void sb_shell_free(sb_shell *shell)
{
    for (int f = 0; f < 2; f++) sb_free(shell->texts[f]);
    *shell = (sb_shell){0};
}

static void put_own(FILE *out, const char *url)
{
    for (size_t f = 0; f < sb_report_files_count; f++)
        if (strcmp(sb_report_files[f].url, url) == 0)
            sb_html_inline(out, (const char *)sb_report_files[f].bytes, sb_report_files[f].size);
}

/* The policy forbids the page to read anything from elsewhere, whatever a name or a scene's text contains. */
void sb_shell_top(FILE *out, const sb_shell *shell, const char *start, const char *title)
{
    fputs(start, out);
    fputs("\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
          "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data: blob:; "
          "media-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'; base-uri 'none'; "
          "form-action 'none'\">\n"
          "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
          out);
    sb_html_put(out, "<title>%s</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>", title);
    if (shell->has_plots) sb_html_inline(out, shell->texts[0], shell->sizes[0]);
    put_own(out, "/report.css");
    fputs("</style></head>\n<body>\n", out);
}

void sb_shell_bottom(FILE *out, const sb_shell *shell)
{
    if (shell->has_plots) {
        fputs("<script>", out);
        sb_html_inline(out, shell->texts[1], shell->sizes[1]);
        fputs("</script>\n", out);
    }
    fputs("<script>", out);
    put_own(out, "/report.js");
    fputs("</script>\n</body></html>\n", out);
}
