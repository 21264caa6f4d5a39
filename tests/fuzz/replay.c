/* Calls a target once for each of the named files and each file of the named folders. Tests run it on the committed
   inputs. */
#include "fuzz.h"

#include "base/file.h"
#include "base/memory.h"

#include <dirent.h>
#include <sys/stat.h>

static size_t inputs;

static void run_file(const char *path)
{
    char *bytes;
    size_t size;
    sb_error error = {0};
    if (sb_file_read(path, (size_t)1 << 30, &bytes, &size, &error) != SB_OK) {
        fprintf(stderr, "%s\n", error.text);
        exit(1);
    }
    /* A block of exactly that size, so that a sanitizer detects a read beyond the end. */
    uint8_t *exact = malloc(size ? size : 1);
    FUZZ_CHECK(exact);
    for (size_t i = 0; i < size; ++i) exact[i] = (uint8_t)bytes[i];
    sb_free(bytes);
    fprintf(stderr, "%s\n", path);
    LLVMFuzzerTestOneInput(exact, size);
    free(exact);
    ++inputs;
}

static void run_path(const char *path)
{
    DIR *listing = opendir(path);
    if (!listing) {
        run_file(path);
        return;
    }
    for (const struct dirent *entry; (entry = readdir(listing));) {
        char inner[SB_PATH_MAX];
        if (entry->d_name[0] != '.' && sb_path_join(inner, path, entry->d_name, NULL) == SB_OK) run_file(inner);
    }
    closedir(listing);
}

int main(int count, char **arguments)
{
    for (int i = 1; i < count; ++i) run_path(arguments[i]);
    printf("%zu inputs\n", inputs);
    return inputs > 0 ? 0 : 1;
}
