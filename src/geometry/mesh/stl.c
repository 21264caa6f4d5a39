/* Converts STL files to the form that assimp accepts. Assimp recognises an STL file as binary only if its size is
   exactly that of its triangles, and as text only if it begins with "solid" in lower case. It refuses a text that
   begins with an empty solid. */
#include "geometry/mesh/stl.h"

#include "base/memory.h"

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { HEAD = 84, COUNT_AT = 80, TRIANGLE = 50, LOOK = 1024 };

bool sb_mesh_is_stl(const char *name)
{
    const char *dot = strrchr(name, '.');
    return dot && strcasecmp(dot, ".stl") == 0;
}

static size_t read_all(int file, char *bytes, size_t size)
{
    size_t got = 0;
    ssize_t part;
    while (got < size && (part = pread(file, bytes + got, size - got, (off_t)got)) > 0) got += (size_t)part;
    return got;
}

/* Whether the bytes are text. A binary file has zeros in its first bytes: its number of triangles is below 2^24 in
   practice, and its numbers contain zeros, too. */
static bool is_text(const char *bytes, size_t size)
{
    while (size > 0 && (bytes[size - 1] == '\0' || bytes[size - 1] == '\x1a')) --size; /* padding */
    for (size_t i = 0; i < size; ++i) {
        const unsigned char c = (unsigned char)bytes[i];
        if (c == 127 || (c < ' ' && !strchr("\t\r\n\f\v", c)) || c == 0) return false;
    }
    return true;
}

/* ---------------------------------------------------------------------------------- text */

typedef struct text {
    char *bytes;
    size_t size;
    bool changed;
} text;

static size_t skip_blanks(const text *of, size_t at, size_t end)
{
    while (at < end && isspace((unsigned char)of->bytes[at])) ++at;
    return at;
}

static size_t word_end(const text *of, size_t at, size_t end)
{
    while (at < end && !isspace((unsigned char)of->bytes[at])) ++at;
    return at;
}

static size_t line_end(const text *of, size_t at)
{
    const char *end = memchr(of->bytes + at, '\n', of->size - at);
    return end ? (size_t)(end - of->bytes) : of->size;
}

static bool is_word(const text *of, size_t at, size_t end, const char *word)
{
    return strlen(word) == end - at && strncasecmp(of->bytes + at, word, end - at) == 0;
}

/* Converts a keyword to lower case. */
static void lower(text *of, size_t at, size_t end)
{
    static const char *const words[] = {"solid", "endsolid", "facet",  "endfacet", "outer",
                                        "loop",  "endloop",  "vertex", "normal"};
    for (size_t w = 0; isalpha((unsigned char)of->bytes[at]) && w < sizeof words / sizeof *words; ++w) {
        if (!is_word(of, at, end, words[w])) continue;
        of->changed |= memcmp(of->bytes + at, words[w], end - at) != 0;
        memcpy(of->bytes + at, words[w], end - at);
    }
}

static bool begins_line(const text *of, size_t at)
{
    while (at > 0 && of->bytes[at - 1] != '\n' && isspace((unsigned char)of->bytes[at - 1])) --at;
    return at == 0 || of->bytes[at - 1] == '\n';
}

/* Overwrites with blanks, also line ends: assimp looks for "solid" only after blanks of the same line. */
static void blank(text *of, size_t from, size_t to)
{
    memset(of->bytes + from, ' ', to - from);
    of->changed |= to > from;
}

/* Corrects the text word by word, as assimp reads it: after "solid" one word is the name, after "endsolid" the rest
   of the line. Solids without a facet are overwritten with blanks. Returns the number of solids; *full is the number
   of solids with a facet. */
static size_t correct_words(text *of, size_t *full)
{
    size_t solids = 0, begin = 0, end = 0;
    bool open = false, facets = false;
    *full = 0;
    for (size_t at = skip_blanks(of, 0, of->size); at < of->size; at = skip_blanks(of, end, of->size)) {
        end = word_end(of, at, of->size);
        lower(of, at, end);
        if (is_word(of, at, end, "endsolid")) {
            end = line_end(of, at);
            if (open && !facets) blank(of, begin, skip_blanks(of, end, of->size));
            open = false;
        } else if (is_word(of, at, end, "solid") && (!open || begins_line(of, at))) {
            if (open && !facets) blank(of, begin, at);
            const size_t stop = line_end(of, at);
            end = word_end(of, skip_blanks(of, end, stop), stop);
            begin = at;
            open = true;
            facets = false;
            ++solids;
        } else if (open && !facets && is_word(of, at, end, "facet")) {
            facets = true;
            ++*full;
        }
    }
    if (open && !facets) blank(of, begin, of->size);
    return solids;
}

static void correct_text(int file, char **bytes, size_t size, char *refusal, size_t room)
{
    static const char mark[] = "\xef\xbb\xbf";
    text whole = {.bytes = sb_alloc_untouched(size, 1)};
    size_t full = 0;
    if (!whole.bytes) return; /* assimp then fails for lack of memory and reports that */
    whole.size = read_all(file, whole.bytes, size);
    if (whole.size == size) {
        if (size >= 3 && memcmp(whole.bytes, mark, 3) == 0) blank(&whole, 0, 3);
        const size_t at = skip_blanks(&whole, 0, size);
        if (size - at < 5 || strncasecmp(whole.bytes + at, "solid", 5) != 0)
            snprintf(refusal, room, "text that does not begin with \"solid\", expected an STL file");
        else if (blank(&whole, 0, at), correct_words(&whole, &full) > 0 && full == 0)
            snprintf(refusal, room, "its solids have no facets, expected at least one");
    }
    if (whole.size == size && whole.changed)
        *bytes = whole.bytes;
    else
        sb_free(whole.bytes);
}

/* -------------------------------------------------------------------------------- either */

void sb_mesh_stl_content(int file, char **bytes, size_t *size, char *refusal, size_t room)
{
    char head[LOOK];
    const size_t look = read_all(file, head, *size < LOOK ? *size : LOOK);
    uint64_t triangles = 0;
    *bytes = NULL;
    if (is_text(head, look)) {
        correct_text(file, bytes, *size, refusal, room);
        return;
    }
    for (int i = 3; look >= HEAD && i >= 0; --i) triangles = triangles << 8 | (unsigned char)head[COUNT_AT + i];
    const uint64_t whole = HEAD + TRIANGLE * triangles;
    if (look < HEAD)
        snprintf(refusal, room, "%zu bytes of binary data, expected at least the %d of a binary STL file", *size, HEAD);
    else if (triangles == 0)
        snprintf(refusal, room, "its header counts 0 triangles, expected 1 or more");
    else if (whole > *size)
        snprintf(refusal, room,
                 "its header counts %llu triangles, but it has data for %llu: it is truncated, or not an STL file",
                 (unsigned long long)triangles, (unsigned long long)((*size - HEAD) / TRIANGLE));
    else
        *size = (size_t)whole;
}
