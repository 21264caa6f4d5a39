#include "control/target.h"

#include "base/file.h"

#include <inttypes.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

sb_status sb_target_write(int64_t run_id, const char *prefix, const char *url, char text[SB_TARGET_TEXT],
                          sb_error *error)
{
    const sb_target *sizes = NULL;
    if (strlen(prefix) >= sizeof sizes->prefix || strlen(url) >= sizeof sizes->url)
        return sb_fail(error, SB_BAD_INPUT, "stream.url: has %zu characters, expected at most %zu", strlen(url),
                       sizeof sizes->url - 1);
    snprintf(text, SB_TARGET_TEXT, "run id %" PRId64 ", prefix %s, url %s", run_id, prefix, url);
    return SB_OK;
}

static bool take_text(const char *text, sb_target *target)
{
    return text && sscanf(text, "run id %" SCNd64 ", prefix %63[^ ,], url %511[^\n]", &target->run_id, target->prefix,
                          target->url) == 3;
}

/* Takes a line of the log if it is the event. */
static bool take_line(const char *line, size_t length, sb_target *target)
{
    if (!strstr(line, "\"" SB_TARGET_EVENT "\"")) return false;
    json_t *root = json_loadb(line, length, 0, NULL);
    const char *event = json_string_value(json_object_get(root, "event"));
    const bool taken = event && strcmp(event, SB_TARGET_EVENT) == 0 &&
                       take_text(json_string_value(json_object_get(root, "text")), target);
    json_decref(root);
    return taken;
}

sb_status sb_target_read(const char *directory, sb_target *target, sb_error *error)
{
    char path[SB_PATH_MAX];
    char *line = NULL;
    size_t capacity = 0;
    bool found = false;
    sb_target made = {0};
    sb_status status = sb_path_join(path, directory, "run.jsonl", error);
    if (status != SB_OK) return status;
    FILE *log = fopen(path, "r");
    if (!log) return sb_fail(error, SB_BAD_INPUT, "%.500s: cannot open, expected the directory of a run", path);
    for (ssize_t length; (length = getline(&line, &capacity, log)) > 0;)
        found |= take_line(line, (size_t)length, &made);
    free(line);
    fclose(log);
    if (!found)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: the run takes no commands, expected it to be started with --control", directory);
    status = sb_path_join(path, directory, SB_TOKEN_FILE, error);
    if (status == SB_OK) status = sb_token_read(path, &made.token, error);
    if (status == SB_OK) *target = made;
    return status;
}

int64_t sb_target_counter(void)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return (int64_t)now.tv_sec * 1000000 + now.tv_nsec / 1000;
}
