/* A temporary folder for each test program, and its files. */
#ifndef SB_TESTS_FOLDER_H
#define SB_TESTS_FOLDER_H

#include "base/file.h"
#include "base/memory.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char folder[SB_PATH_MAX];

static inline int folder_make(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "%s/test-output-XXXXXX", SB_BINARY_DIR);
    return mkdtemp(folder) ? 0 : -1;
}

static inline int folder_remove(void **state)
{
    (void)state;
    char command[SB_PATH_MAX + 16];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

/* The path of a file in the folder; valid until the next call but one. */
static inline const char *in_folder(const char *name)
{
    static char paths[2][SB_PATH_MAX];
    static int turn;
    turn = !turn;
    snprintf(paths[turn], SB_PATH_MAX, "%.3000s/%s", folder, name);
    return paths[turn];
}

/* The whole file; free with sb_free. NULL when it cannot be read. */
__attribute__((noinline, unused)) static char *text_of(const char *name)
{
    char *text = NULL;
    size_t length;
    sb_file_read(in_folder(name), 1 << 26, &text, &length, NULL);
    return text;
}

#endif
