/* Fuzzes the files from which a report is made. The first byte chooses which file of a run has the rest as its content.
 */
#include "fuzz.h"

#include "base/file.h"
#include "base/memory.h"
#include "report/report.h"

#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *const files[] = {"summary.json",       "run.jsonl",       "forces.csv",         "gauges.csv",
                                    "runup.csv",          "energy.csv",      "scene.yaml",         "probes.csv",
                                    "maps/max_depth.asc", "overtopping.csv", "frames/c/000001.png"};
enum { FILES = sizeof files / sizeof *files };

static void save(const char *folder, const char *name, const void *bytes, size_t size)
{
    char path[SB_PATH_MAX];
    FUZZ_CHECK(sb_path_join(path, folder, name, NULL) == SB_OK);
    FILE *file = fopen(path, "wb");
    FUZZ_CHECK(file && fwrite(bytes, 1, size, file) == size);
    fclose(file);
}

/* Nothing of the input may become markup: each script of the page is one of its own two. */
static void check_page(const char *path)
{
    char *text = NULL;
    size_t length = 0, scripts = 0;
    FUZZ_CHECK(sb_file_read(path, 1 << 28, &text, &length, NULL) == SB_OK);
    FUZZ_CHECK(length < SB_REPORT_BYTES_MAX && strlen(text) == length);
    for (const char *at = text; (at = strstr(at, "<script")); at++) scripts++;
    FUZZ_CHECK(scripts == 2);
    sb_free(text);
}

static char run[SB_PATH_MAX]; /* the folder of the run, below that of fuzz_save */

static void remove_all(void)
{
    static const char *const names[] = {"maps", "frames/c", "frames"};
    char path[SB_PATH_MAX];
    for (int f = 0; f < FILES; f++)
        if (sb_path_join(path, run, files[f], NULL) == SB_OK) unlink(path);
    for (size_t n = 0; n < 3; n++)
        if (sb_path_join(path, run, names[n], NULL) == SB_OK) rmdir(path);
    rmdir(run);
}

/* Makes the folder with a valid scene, which has a camera. */
static void make_run(const char *folder)
{
    static const char scene[] = "title: t\nresolution: 0.1\nduration: 1\ndomain: {min: [0, 0, 0], max: [1, 1, 1]}\n"
                                "water: {boxes: [{min: [0, 0, 0], max: [1, 1, 0.5]}]}\n"
                                "render: {interval: 1, cameras: [{name: c, eye: [0, 0, 1], target: [1, 1, 0]}]}\n";
    static const char *const names[] = {"", "maps", "frames", "frames/c"};
    char path[SB_PATH_MAX];
    if (!*run) atexit(remove_all); /* before that of fuzz_save removes the folder above */
    FUZZ_CHECK(sb_path_join(run, folder, "run", NULL) == SB_OK);
    remove_all();
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        FUZZ_CHECK(sb_path_join(path, run, names[n], NULL) == SB_OK);
        FUZZ_CHECK(mkdir(path, 0777) == 0);
    }
    save(run, "scene.yaml", scene, sizeof scene - 1);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    char folder[SB_PATH_MAX], page[SB_PATH_MAX];
    if (size == 0) return 0;
    snprintf(page, sizeof page, "%s", fuzz_save("page", data, 0));
    sb_path_folder(folder, page);
    make_run(folder);
    save(run, files[data[0] % FILES], data + 1, size - 1);
    sb_error error = {0};
    /* Without dygraphs, whose own text has scripts. */
    const sb_report_options options = {.dygraphs = run};
    const sb_status status = sb_report_write(run, page, &options, NULL, &error);
    if (status == SB_OK)
        check_page(page);
    else
        fuzz_check_refusal(status, &error);
    return 0;
}
