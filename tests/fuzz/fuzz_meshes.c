/* Damages sound mesh files of every format and imports them: fuzz_meshes FILES SEED. Each must give
   sound meshes or one clear line, within its limits, and leave no process behind. The last line sums
   up; the status is 0 when nothing was wrong. */
#include "fuzz.h"

#include "base/clock.h"
#include "base/random.h"
#include "geometry/mesh_child.h"
#include "mesh_samples.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>
#include <sys/wait.h>

/* Numbers at which counts, offsets and coordinates tip over. */
static const char *const words[] = {"4294967295",           "-1",         "nan", "1e400", "-1e-320", "2147483648",
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
    const char *word = words[roll(d, sizeof words / sizeof *words)];
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
    case 7: /* a number or a word in place of another */
        erase(text, at, strcspn(copy, " \n,<>\"") < length ? strcspn(copy, " \n,<>\"") : length);
        insert(text, at, word, strlen(word));
        break;
    case 8:
        text->length = at;
        break; /* the file ends */
    default:
        text->bytes[at] = (char)roll(d, 256);
        break;
    }
}

/* Imports the n-th damaged file of that seed; adds to the outcomes. Returns the seconds it took. */
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
    sb_error why = {0};
    double begin = sb_clock();
    sb_status status = sb_mesh_import_within(path, &limits, &meshes, &found, &why);
    double took = sb_clock() - begin;
    sample_outcome outcome = sample_judge(path, status, meshes, found, &why);
    ++outcomes[outcome];
    if (outcome == SAMPLE_WRONG)
        printf("file %ld of seed %llu: status %d, %s\n", n, (unsigned long long)seed, (int)status, why.text);
    return took;
}

int main(int count, char **arguments)
{
    long files = count > 1 ? strtol(arguments[1], NULL, 10) : 200, outcomes[3] = {0};
    uint64_t seed = count > 2 ? strtoull(arguments[2], NULL, 10) : 1;
    double longest = 0;
    for (long n = 0; n < files; ++n) longest = fmax(longest, try_file(seed, n, outcomes));
    bool left = waitpid(-1, NULL, WNOHANG) != -1 || errno != ECHILD;
    if (left) puts("a child is left behind");
    printf("%ld refused, %ld read, %ld wrong, longest %.1f s\n", outcomes[SAMPLE_REFUSED], outcomes[SAMPLE_SOUND],
           outcomes[SAMPLE_WRONG], longest);
    return outcomes[SAMPLE_WRONG] == 0 && !left ? 0 : 1;
}
