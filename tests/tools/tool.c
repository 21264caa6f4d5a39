#include "tools/tool.h"

#include "base/file.h"
#include "base/memory.h"

#include <ftw.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

static char folder[512];

int tool_begin(void)
{
    const char *base = getenv("TMPDIR");
    snprintf(folder, sizeof folder, "%.400s/sb-tool-XXXXXX", base && *base ? base : "/tmp");
    return mkdtemp(folder) ? 0 : -1;
}

static int remove_one(const char *path, const struct stat *info, int kind, struct FTW *where)
{
    (void)info;
    (void)kind;
    (void)where;
    return remove(path);
}

int tool_end(void)
{
    return nftw(folder, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

int tool_run(const char *program, const char *arguments)
{
    char command[4096];
    snprintf(command, sizeof command, "'%s/%s' %s --out '%s/out' >'%s/output' 2>&1", SB_BINARY_DIR, program, arguments,
             folder, folder);
    const int how = system(command);
    return WIFEXITED(how) ? WEXITSTATUS(how) : -1;
}

const char *tool_path(const char *name)
{
    static char path[SB_PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

char *tool_text(const char *name)
{
    char *text = NULL;
    size_t length;
    return sb_file_read(tool_path(name), 1 << 20, &text, &length, NULL) == SB_OK ? text : NULL;
}

bool tool_contains(const char *name, const char *expected)
{
    char *text = tool_text(name);
    const bool found = text && strstr(text, expected);
    sb_free(text);
    return found;
}
