/* Damages valid mesh files of every format at random and imports them: fuzz_meshes FILES SEED. Each import must give
   valid meshes or a one-line error within the limits, and leave no process behind. The last line is a summary; the exit
   status is 0 if no import was wrong. */
#include "fuzz.h"

#include "base/clock.h"
#include "base/random.h"
#include "geometry/mesh/child.h"
#include "mesh_samples.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <sys/wait.h>

/* Texts that are likely to cause errors: limits of counts, offsets and coordinates, and delimiters. */
static const char *const tokens[] = {"4294967295",           "-1",         "nan", "1e400", "-1e-320", "2147483648",
                                     "99999999999999999999", "0",          "\n",  "{",     "}",       "\"",
                                     "\xff\xff\xff\xff",     "end_header", "<p>"};

typedef struct dice {
    uint64_t seed, throws;
} dice;

/* A whole number below `sides`. */
static size_t roll(dice *d, size_t sides)
{
    return (size_t)(sb_random(d->seed, d->throws++) * (double)sides);
}

static void insert(sample_text *text, size_t at, const char *bytes, size_t count)
{
    if (text->length + count > sizeof text->bytes) return;
    memmove(text->bytes + at + count, text->bytes + at, text->length - at);
    memcpy(text->bytes + at, bytes, count);
    text->length += count;
}

static void erase(sample_text *text, size_t at, size_t count)
{
    if (count > text->length - at) count = text->length - at;
    memmove(text->bytes + at, text->bytes + at + count, text->length - at - count);
    text->length -= count;
}

static void damage_once(sample_text *text, dice *d)
{
    if (text->length == 0) return;
    size_t at = roll(d, text->length);
    char copy[256];
    size_t length = 1 + roll(d, sizeof copy - 1);
    if (length > text->length - at) length = text->length - at;
    memcpy(copy, text->bytes + at, length);
    const char *token = tokens[roll(d, sizeof tokens / sizeof *tokens)];
    switch (roll(d, 12)) {
    case 1:
        text->bytes[at] = (char)(text->bytes[at] ^ (1 << roll(d, 8)));
        break;
    case 2:
        erase(text, at, length);
        break;
    case 3:
        insert(text, at, copy, length);
        break;
    case 4:
        insert(text, roll(d, text->length), copy, length);
        break;
    case 5:
    case 6:
    case 7: /* replace a number or a word */
        erase(text, at, strcspn(copy, " \n,<>\"") < length ? strcspn(copy, " \n,<>\"") : length);
        insert(text, at, token, strlen(token));
        break;
    case 8:
        text->length = at; /* truncate the file */
        break;
    default:
        text->bytes[at] = (char)roll(d, 256);
        break;
    }
}

/* Imports the n-th damaged file of the seed and counts the outcome. Returns the duration in s. */
static double try_file(uint64_t seed, long n, long outcomes[3])
{
    static const sb_mesh_limits limits = {.memory = 1u << 28, .seconds = 2};
    static sample_text text;
    const sample_format *format = &sample_formats[n % SAMPLE_FORMATS];
    dice d = {.seed = seed * 1000003 + (uint64_t)n};
    text.length = 0;
    format->make(&text);
    for (size_t times = 1 + roll(&d, 3); times > 0; --times) damage_once(&text, &d);
    const char *path = fuzz_save(format->name, (const uint8_t *)text.bytes, text.length);
    sb_mesh *meshes = NULL;
    size_t found = 0;
    sb_error error = {0};
    double begin = sb_clock();
    sb_status status = sb_mesh_import_within(path, &limits, &meshes, &found, &error);
    double took = sb_clock() - begin;
    sample_outcome outcome = sample_judge(path, status, meshes, found, &error);
    ++outcomes[outcome];
    if (outcome == SAMPLE_WRONG)
        printf("file %ld of seed %llu: status %d, %s\n", n, (unsigned long long)seed, (int)status, error.text);
    return took;
}

int main(int count, char **arguments)
{
    long files = count > 1 ? strtol(arguments[1], NULL, 10) : 200, outcomes[3] = {0};
    uint64_t seed = count > 2 ? strtoull(arguments[2], NULL, 10) : 1;
    double longest = 0;
    for (long n = 0; n < files; ++n) longest = fmax(longest, try_file(seed, n, outcomes));
    bool left = waitpid(-1, NULL, WNOHANG) != -1 || errno != ECHILD;
    if (left) puts("a child process is left behind");
    printf("%ld refused, %ld read, %ld wrong, longest %.1f s\n", outcomes[SAMPLE_REFUSED], outcomes[SAMPLE_SOUND],
           outcomes[SAMPLE_WRONG], longest);
    return outcomes[SAMPLE_WRONG] == 0 && !left ? 0 : 1;
}
