/* What repeats the run: command, version, state, scene. */
#include "report/sections.h"

#include "report/html.h"

#include <string.h>

enum { SCENE_BYTES = 200000 }; /* of the scene's text in the page */

/* The argument as a shell reads it back. */
static void put_argument(FILE *out, const char *text)
{
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_./=,:+@%-";
    char one[2] = {0};
    if (*text && text[strspn(text, plain)] == '\0') {
        sb_html_text(out, text);
        return;
    }
    fputs("&#39;", out);
    for (; *text; text++)
        if (*text == '\'')
            fputs("&#39;\\&#39;&#39;", out);
        else if ((unsigned char)*text < 0x80) {
            one[0] = *text;
            sb_html_text(out, one);
        } else
            fputc(*text, out); /* jansson has checked that this is UTF-8 */
    fputs("&#39;", out);
}

static void put_commands(FILE *out, const sb_report_run *run)
{
    size_t i, a;
    json_t *event, *argument;
    fputs("<h3>Command</h3>\n", out);
    if (json_array_size(run->arguments) == 0)
        fputs("<p class=\"note\">The log has no command: an earlier version of shorebreak wrote it. The scene below, "
              "which "
              "contains all changes of the command line, repeats the run.</p>\n",
              out);
    json_array_foreach(run->arguments, i, event)
    {
        fputs("<pre>shorebreak", out);
        json_array_foreach(json_object_get(event, "arguments"), a, argument)
        {
            fputc(' ', out);
            if (json_is_string(argument)) put_argument(out, json_string_value(argument));
        }
        sb_html_put(out, "</pre><p class=\"note\">in %s</p>\n", json_string_value(json_object_get(event, "folder")));
    }
}

static void put_scene(FILE *out, const char *text)
{
    const size_t length = strlen(text);
    fputs("<details open><summary>Scene, with all defaults</summary><pre class=\"scene\">", out);
    if (length <= SCENE_BYTES)
        sb_html_text(out, text);
    else
        for (size_t i = 0; i < SCENE_BYTES; i++) {
            const char one[2] = {(unsigned char)text[i] < 0x80 ? text[i] : '?'};
            sb_html_text(out, one);
        }
    fputs("</pre></details>\n", out);
    if (length > SCENE_BYTES)
        sb_html_put(out, "<p class=\"note\">The first %z of %z bytes; scene.yaml of the run has all.</p>\n",
                    (size_t)SCENE_BYTES, length);
}

void sb_section_record(FILE *out, const sb_report_page *page)
{
    const sb_report_run *run = page->run;
    const char *version = sb_report_text(run, "version"), *hash = sb_report_text(run, "state_hash");
    fputs("<section id=\"record\"><h2>Record</h2>\n", out);
    put_commands(out, run);
    fputs("<h3>Program</h3>\n<dl>", out);
    if (!version && run->start) version = json_string_value(json_object_get(run->start, "version"));
    sb_html_put(out, "<div><dt>Version of the run</dt><dd>shorebreak %s</dd></div>", version ? version : "unknown");
    sb_html_put(out, "<div><dt>Version of this page</dt><dd>shorebreak %s</dd></div>", SB_VERSION);
    if (run->build) sb_html_put(out, "<div><dt>Build</dt><dd>%s</dd></div>", run->build);
    if (hash) sb_html_put(out, "<div><dt>Hash of the final state</dt><dd>%s</dd></div>", hash);
    fputs("</dl>\n", out);
    if (run->scene_text) put_scene(out, run->scene_text);
    fputs("</section>\n", out);
}
