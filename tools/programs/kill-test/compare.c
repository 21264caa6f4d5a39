#include "compare.h"

#include "base/file.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "output/particles/vtp.h"

#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { LARGEST = 1 << 28 };

typedef struct pair {
    const char *name; /* within the runs */
    char path[2][SB_PATH_MAX];
    char *text[2];
    size_t length[2];
} pair;

static bool ends_with(const char *name, const char *ending)
{
    const size_t length = strlen(name), tail = strlen(ending);
    return length >= tail && strcmp(name + length - tail, ending) == 0;
}

static sb_status differs(const pair *p, const char *how, sb_error *error)
{
    return sb_fail(error, SB_FAILED, "%.300s and %.300s: %.300s", p->path[0], p->path[1], how);
}

/* ---- kinds of files ---- */

static sb_status compare_bytes(const pair *p, sb_error *error)
{
    if (p->length[0] == p->length[1] && memcmp(p->text[0], p->text[1], p->length[0]) == 0) return SB_OK;
    return differs(p, "differ", error);
}

static bool same_frames(const sb_frame *a, const sb_frame *b)
{
    const size_t n = a->count, bodies = a->body_count;
    return a->count == b->count && a->body_count == b->body_count && a->index == b->index &&
           a->status.step == b->status.step && a->status.time == b->status.time &&
           memcmp(&a->origin, &b->origin, sizeof a->origin) == 0 && !a->density_error == !b->density_error &&
           (!a->density_error || memcmp(a->density_error, b->density_error, n * sizeof(float)) == 0) &&
           memcmp(a->position, b->position, 3 * n * sizeof(float)) == 0 &&
           memcmp(a->velocity, b->velocity, 3 * n * sizeof(float)) == 0 &&
           memcmp(a->pressure, b->pressure, n * sizeof(float)) == 0 && memcmp(a->id, b->id, n * sizeof *a->id) == 0 &&
           memcmp(a->bodies, b->bodies, bodies * sizeof *a->bodies) == 0;
}

static sb_status compare_particles(const pair *p, sb_error *error)
{
    sb_frame *frame[2] = {NULL, NULL};
    sb_status status = SB_OK;
    for (int k = 0; k < 2 && status == SB_OK; k++) status = sb_vtp_read(p->path[k], &frame[k], error);
    if (status == SB_OK && !same_frames(frame[0], frame[1])) status = differs(p, "the particles differ", error);
    sb_frame_release(frame[0]);
    sb_frame_release(frame[1]);
    return status;
}

/* The next line that has no run time or memory; NULL: none. */
static const char *next_compared_line(const char *at)
{
    static const char *const omitted[] = {"\"wall_", "_seconds\"", "_bytes\"", "\"bytes_per_"};
    for (bool out = true; *at && out;) {
        const size_t length = strcspn(at, "\n");
        out = false;
        for (size_t t = 0; t < sizeof omitted / sizeof *omitted; t++) {
            const char *found = strstr(at, omitted[t]);
            out |= found && found < at + length;
        }
        if (out) at += length + (at[length] == '\n');
    }
    return *at ? at : NULL;
}

static sb_status compare_summaries(const pair *p, sb_error *error)
{
    for (int k = 0; k < 2; k++) { /* the table of stages is last and has only times */
        char *stages = strstr(p->text[k], "\"stages\"");
        if (stages) *stages = '\0';
    }
    const char *a = next_compared_line(p->text[0]), *b = next_compared_line(p->text[1]);
    while (a && b) {
        const size_t length = strcspn(a, "\n");
        char how[200];
        snprintf(how, sizeof how, "\"%.*s\" and \"%.*s\"", (int)(length < 80 ? length : 80), a,
                 (int)(strcspn(b, "\n") < 80 ? strcspn(b, "\n") : 80), b);
        if (length != strcspn(b, "\n") || memcmp(a, b, length) != 0) return differs(p, how, error);
        a = next_compared_line(a + length + (a[length] == '\n'));
        b = next_compared_line(b + length + (b[length] == '\n'));
    }
    return a || b ? differs(p, "one is longer", error) : SB_OK;
}

/* The next state hash in a log from *at, as 16 digits; NULL: none. Moves *at behind it. */
static const char *next_hash(const char **at, unsigned long long *step)
{
    static const char event[] = "{\"event\":\"step\"", number[] = "\"step\":", hash[] = "\"state_hash\":\"";
    for (const char *line = strstr(*at, event); line; line = strstr(*at, event)) {
        const char *end = line + strcspn(line, "\n");
        const char *count = strstr(line + sizeof event - 1, number), *found = strstr(line, hash);
        *at = end;
        if (!count || !found || count > end || found > end) continue;
        *step = strtoull(count + sizeof number - 1, NULL, 10);
        return found + sizeof hash - 1;
    }
    return NULL;
}

/* Every state in the log of the killed run must equal that of the undisturbed run at the same step. */
static sb_status compare_logs(const pair *p, sb_error *error)
{
    size_t common = 0;
    unsigned long long step, other;
    const char *hash, *there, *at = p->text[1];
    while ((hash = next_hash(&at, &step))) {
        const char *from = p->text[0];
        while ((there = next_hash(&from, &other)) && other != step) continue;
        if (there && strncmp(hash, there, 16) != 0) return differs(p, "their states at one step differ", error);
        common += there != NULL;
    }
    return common > 0 ? SB_OK : differs(p, "no step in common", error);
}

/* ---- folders ---- */

static sb_status compare_file(pair *p, sb_error *error)
{
    sb_status status = SB_OK;
    if (ends_with(p->name, ".vtp")) return compare_particles(p, error);
    for (int k = 0; k < 2 && status == SB_OK; k++)
        status = sb_file_read(p->path[k], LARGEST, &p->text[k], &p->length[k], error);
    if (status == SB_OK)
        status = ends_with(p->name, "summary.json") ? compare_summaries(p, error)
                 : ends_with(p->name, "run.jsonl")  ? compare_logs(p, error)
                                                    : compare_bytes(p, error);
    sb_free(p->text[0]);
    sb_free(p->text[1]);
    return status;
}

static int visible(const struct dirent *entry)
{
    return entry->d_name[0] != '.';
}

static sb_status compare_folder(const char *const root[2], const char *name, size_t *files, sb_error *error);

static sb_status compare_entry(const char *const root[2], const char *folder, const char *entry, size_t *files,
                               sb_error *error)
{
    char name[SB_PATH_MAX];
    struct stat found;
    pair p = {.name = name};
    snprintf(name, sizeof name, "%.2000s%s%.2000s", folder, *folder ? "/" : "", entry);
    for (int k = 0; k < 2; k++) {
        sb_status status = sb_path_join(p.path[k], root[k], name, error);
        if (status != SB_OK) return status;
    }
    if (stat(p.path[0], &found) != 0)
        return sb_fail(error, SB_FAILED, "%.500s: cannot read: %s", p.path[0], strerror(errno));
    if (S_ISDIR(found.st_mode)) return compare_folder(root, name, files, error);
    ++*files;
    return compare_file(&p, error);
}

/* Reads entries in order of their names; returns their number, or -1. */
static int list(const char *root, const char *name, struct dirent ***entries)
{
    char path[SB_PATH_MAX];
    if (sb_path_join(path, root, *name ? name : ".", NULL) != SB_OK) return -1;
    return scandir(path, entries, visible, alphasort);
}

static void free_list(struct dirent **entries, int count)
{
    for (int i = 0; i < count; i++) free(entries[i]);
    if (count >= 0) free(entries);
}

/* Compares two lists from their ends; of checkpoints only the last name. */
static bool same_names(struct dirent **const entries[2], const int count[2], bool checkpoints, const char **odd)
{
    for (int i = 0; i < count[0] || i < count[1]; i++) {
        const char *a = i < count[0] ? entries[0][count[0] - 1 - i]->d_name : "";
        const char *b = i < count[1] ? entries[1][count[1] - 1 - i]->d_name : "";
        *odd = *a ? a : b;
        if (strcmp(a, b) != 0) return false;
        if (checkpoints) return true;
    }
    return true;
}

static sb_status compare_folder(const char *const root[2], const char *name, size_t *files, sb_error *error)
{
    const bool checkpoints = strcmp(name, "checkpoints") == 0;
    struct dirent **entries[2] = {NULL, NULL};
    const int count[2] = {list(root[0], name, &entries[0]), list(root[1], name, &entries[1])};
    const char *odd = "";
    sb_status status = SB_OK;
    if (count[0] < 0 || count[1] < 0)
        status = sb_fail(error, SB_FAILED, "%.300s/%.300s: cannot read", root[count[0] < 0 ? 0 : 1], name);
    else if (!same_names(entries, count, checkpoints, &odd))
        status = sb_fail(error, SB_FAILED, "%.300s and %.300s: \"%.200s\" in \"%.200s\" exists in only one of them",
                         root[0], root[1], odd, name);
    for (int i = 0; status == SB_OK && !checkpoints && i < count[0]; i++)
        status = compare_entry(root, name, entries[0][i]->d_name, files, error);
    free_list(entries[0], count[0]);
    free_list(entries[1], count[1]);
    return status;
}

sb_status sb_kill_compare(const char *whole, const char *other, size_t *files, sb_error *error)
{
    const char *const root[2] = {whole, other};
    return compare_folder(root, "", files, error);
}
