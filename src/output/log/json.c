#include "output/log/json.h"

#include <assert.h>
#include <inttypes.h>

size_t sb_utf8_length(const char *at)
{
    const unsigned char *text = (const unsigned char *)at;
    size_t length = text[0] < 0x80   ? 1
                    : text[0] < 0xc2 ? 0
                    : text[0] < 0xe0 ? 2
                    : text[0] < 0xf0 ? 3
                    : text[0] < 0xf5 ? 4
                                     : 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80) return 0;
    bool overlong = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && text[1] < 0x90);
    bool surrogate = text[0] == 0xed && text[1] >= 0xa0;
    bool beyond = text[0] == 0xf4 && text[1] >= 0x90;
    return overlong || surrogate || beyond ? 0 : length;
}

static void put_text(FILE *stream, const char *text)
{
    fputc('"', stream);
    for (const unsigned char *at = (const unsigned char *)text; *at;) {
        size_t length = sb_utf8_length((const char *)at);
        if (length == 0)
            fputs("\\ufffd", stream);
        else if (*at == '"' || *at == '\\')
            fprintf(stream, "\\%c", *at);
        else if (*at == '\n')
            fputs("\\n", stream);
        else if (*at < 0x20 || *at == 0x7f)
            fprintf(stream, "\\u%04x", *at);
        else
            fwrite(at, 1, length, stream);
        at += length ? length : 1;
    }
    fputc('"', stream);
}

static void new_line(const sb_json *json)
{
    if (!json->pretty) return;
    fputc('\n', json->stream);
    for (int i = 0; i < json->depth; i++) fputs("  ", json->stream);
}

/* Writes what precedes every value: comma, line break, key. */
static void lead(sb_json *json, const char *key)
{
    if (json->depth > 0) {
        if (json->filled[json->depth - 1]) fputc(',', json->stream);
        json->filled[json->depth - 1] = true;
        assert((key != NULL) == (json->bracket[json->depth - 1] == '{'));
        new_line(json);
    }
    if (key) {
        put_text(json->stream, key);
        fputs(json->pretty ? ": " : ":", json->stream);
    }
}

void sb_json_begin(sb_json *json, FILE *stream, bool pretty)
{
    *json = (sb_json){.stream = stream, .pretty = pretty};
}

void sb_json_open(sb_json *json, const char *key, char bracket)
{
    assert(json->depth < SB_JSON_DEPTH);
    lead(json, key);
    fputc(bracket, json->stream);
    json->bracket[json->depth] = bracket;
    json->filled[json->depth++] = false;
}

void sb_json_close(sb_json *json)
{
    assert(json->depth > 0);
    json->depth--;
    if (json->filled[json->depth]) new_line(json);
    fputc(json->bracket[json->depth] == '{' ? '}' : ']', json->stream);
    if (json->depth == 0) fputc('\n', json->stream);
}

void sb_json_text(sb_json *json, const char *key, const char *text)
{
    lead(json, key);
    if (text)
        put_text(json->stream, text);
    else
        fputs("null", json->stream);
}

static void put_number(FILE *stream, double value)
{
    if (isfinite(value))
        fprintf(stream, "%.9g", value);
    else
        fputs("null", stream);
}

void sb_json_number(sb_json *json, const char *key, double value)
{
    lead(json, key);
    put_number(json->stream, value);
}

void sb_json_count(sb_json *json, const char *key, uint64_t value)
{
    lead(json, key);
    fprintf(json->stream, "%" PRIu64, value);
}

void sb_json_bool(sb_json *json, const char *key, bool value)
{
    lead(json, key);
    fputs(value ? "true" : "false", json->stream);
}

void sb_json_vector(sb_json *json, const char *key, sb_vec3 value)
{
    lead(json, key);
    const double parts[3] = {value.x, value.y, value.z};
    for (int i = 0; i < 3; i++) {
        fputs(i ? ", " : "[", json->stream);
        put_number(json->stream, parts[i]);
    }
    fputc(']', json->stream);
}

void sb_json_hash(sb_json *json, const char *key, uint64_t value)
{
    lead(json, key);
    fprintf(json->stream, "\"%016" PRIx64 "\"", value);
}
