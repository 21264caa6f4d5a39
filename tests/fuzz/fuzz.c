/* Files, edits and checks for the fuzz targets. */
#include "fuzz.h"

#include "base/archive_layout.h"
#include "base/file.h"

#include <stdbool.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64];
static char names[8][32]; /* of the files made so far */

static void clean_up(void)
{
    char path[SB_PATH_MAX];
    for (size_t i = 0; i < sizeof names / sizeof *names; ++i)
        if (names[i][0] && sb_path_join(path, folder, names[i], NULL) == SB_OK) remove(path);
    rmdir(folder);
}

/* Makes the folder in /dev/shm if possible, because thousands of files per second are written to it. */
static void make_folder(void)
{
    struct stat found;
    bool memory = stat("/dev/shm", &found) == 0 && access("/dev/shm", W_OK) == 0;
    snprintf(folder, sizeof folder, "%s/shorebreak-fuzz-XXXXXX", memory ? "/dev/shm" : "/tmp");
    FUZZ_CHECK(mkdtemp(folder));
    atexit(clean_up);
}

static void remember(const char *name)
{
    size_t i = 0;
    while (i < sizeof names / sizeof *names - 1 && names[i][0] && strcmp(names[i], name) != 0) ++i;
    snprintf(names[i], sizeof names[i], "%s", name);
}

const char *fuzz_save(const char *name, const uint8_t *data, size_t size)
{
    static char path[SB_PATH_MAX];
    if (!folder[0]) make_folder();
    remember(name);
    FUZZ_CHECK(sb_path_join(path, folder, name, NULL) == SB_OK);
    FILE *file = fopen(path, "wb");
    FUZZ_CHECK(file);
    FUZZ_CHECK(size == 0 || fwrite(data, 1, size, file) == size);
    FUZZ_CHECK(fclose(file) == 0);
    return path;
}

void fuzz_check_refusal(sb_status status, const sb_error *error)
{
    FUZZ_CHECK(status == SB_BAD_INPUT || status == SB_FAILED);
    FUZZ_CHECK(error->status == status && error->text[0]);
    for (const unsigned char *c = (const unsigned char *)error->text; *c; ++c)
        FUZZ_CHECK(*c >= ' ' && *c != 0x7f && !(c[0] == 0xc2 && c[1] >= 0x80 && c[1] < 0xa0));
}

void fuzz_edit(uint8_t *bytes, size_t size, const uint8_t *edits, size_t left)
{
    while (left > 3) {
        size_t at = ((size_t)edits[0] | (size_t)edits[1] << 8) % size, length = edits[2];
        edits += 3;
        left -= 3;
        if (length > left) length = left;
        if (length > size - at) length = size - at;
        memcpy(bytes + at, edits, length);
        edits += length;
        left -= length;
    }
}

static uint64_t word_at(const uint8_t *bytes)
{
    uint64_t word;
    memcpy(&word, bytes, sizeof word);
    return word;
}

void fuzz_repair(uint8_t *bytes, size_t size, const char *kind, uint32_t version)
{
    const uint32_t words[2] = {version, SB_ARCHIVE_ORDER};
    if (size < SB_ARCHIVE_HEAD) return;
    memset(bytes, 0, SB_ARCHIVE_NAME);
    memcpy(bytes, kind, strlen(kind));
    memcpy(bytes + SB_ARCHIVE_NAME, words, sizeof words);
    for (size_t at = SB_ARCHIVE_HEAD; size - at >= SB_SECTION_HEAD;) {
        const uint64_t length = word_at(bytes + at + SB_ARCHIVE_NAME);
        if (length > size - at - SB_SECTION_HEAD) return;
        const uint64_t sum = sb_archive_sum(bytes + at, length);
        memcpy(bytes + at + SB_ARCHIVE_NAME + 8, &sum, sizeof sum);
        at += SB_SECTION_HEAD + length;
    }
}
