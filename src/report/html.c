#include "report/html.h"

#include "output/log/json.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>
#include <strings.h>

static void put_escaped(FILE *stream, unsigned char c)
{
    const char *entity = c == '&'    ? "&amp;"
                         : c == '<'  ? "&lt;"
                         : c == '>'  ? "&gt;"
                         : c == '"'  ? "&quot;"
                         : c == '\'' ? "&#39;"
                                     : NULL;
    const bool control = (c < ' ' && c != '\n' && c != '\t') || c == 0x7f;
    if (entity)
        fputs(entity, stream);
    else if (control)
        fputs("\xef\xbf\xbd", stream);
    else
        fputc(c, stream);
}

void sb_html_text(FILE *stream, const char *text)
{
    while (text && *text) {
        const size_t length = sb_utf8_length(text);
        if (length == 1)
            put_escaped(stream, (unsigned char)*text);
        else if (length == 0)
            fputs("\xef\xbf\xbd", stream);
        else
            fwrite(text, 1, length, stream);
        text += length ? length : 1;
    }
}

void sb_html_put(FILE *stream, const char *format, ...)
{
    char figure[SB_FIGURE_MAX];
    va_list values;
    va_start(values, format);
    for (const char *at = format; *at; at++) {
        if (*at != '%') {
            fputc(*at, stream);
            continue;
        }
        switch (*++at) {
        case 's':
            sb_html_text(stream, va_arg(values, const char *));
            break;
        case 'd':
            fprintf(stream, "%d", va_arg(values, int));
            break;
        case 'z':
            fprintf(stream, "%zu", va_arg(values, size_t));
            break;
        case 'g':
            fputs(sb_figure(figure, va_arg(values, double)), stream);
            break;
        default:
            fputc('%', stream);
        }
    }
    va_end(values);
}

void sb_html_base64(FILE *stream, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const unsigned word = (unsigned)bytes[i] << 16 | (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) |
                              (left > 2 ? (unsigned)bytes[i + 2] : 0);
        fputc(digits[word >> 18], stream);
        fputc(digits[word >> 12 & 63], stream);
        fputc(left > 1 ? digits[word >> 6 & 63] : '=', stream);
        fputc(left > 2 ? digits[word & 63] : '=', stream);
    }
}

void sb_html_inline(FILE *stream, const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++) {
        fputc(text[i], stream);
        if (text[i] != '<' || i + 3 >= size) continue;
        if (strncasecmp(text + i, "</s", 3) == 0 || strncmp(text + i, "<!--", 4) == 0) fputc('\\', stream);
    }
}

/* Puts a narrow space, which does not break, between thousands of the integer part. */
static void group(char out[SB_FIGURE_MAX], const char *plain)
{
    const size_t sign = plain[0] == '-', whole = strcspn(plain, ".");
    size_t to = 0;
    for (size_t i = 0; plain[i] && to + 4 < SB_FIGURE_MAX; i++) {
        const bool apart = i > sign && i < whole && (whole - i) % 3 == 0 && whole - sign > 4;
        if (apart) {
            memcpy(out + to, "\xe2\x80\xaf", 3);
            to += 3;
        }
        out[to++] = plain[i];
    }
    out[to] = '\0';
}

static void remove_zeros(char *plain)
{
    size_t length = strlen(plain);
    if (!strchr(plain, '.')) return;
    while (plain[length - 1] == '0') length--;
    plain[plain[length - 1] == '.' ? length - 1 : length] = '\0';
}

const char *sb_figure(char out[SB_FIGURE_MAX], double value)
{
    char plain[SB_FIGURE_MAX];
    const double size = fabs(value);
    if (!isfinite(value))
        snprintf(out, SB_FIGURE_MAX, "–");
    else if (size < 1e-12)
        snprintf(out, SB_FIGURE_MAX, "0");
    else if (size < 1e-4 || size >= 1e9)
        snprintf(out, SB_FIGURE_MAX, "%.2e", value);
    else {
        const int digits = (int)floor(log10(size)), places = digits < 2 ? 2 - digits : 0;
        const double unit = digits > 2 ? pow(10, digits - 2) : 1;
        snprintf(plain, sizeof plain, "%.*f", places, round(value / unit) * unit);
        if (digits <= 2) snprintf(plain, sizeof plain, "%.*f", places, value);
        remove_zeros(plain);
        group(out, plain);
    }
    return out;
}
