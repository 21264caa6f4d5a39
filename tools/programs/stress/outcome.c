#include "outcome.h"

#include "base/memory.h"
#include "sheet.h"
#include "summary_text.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

double sb_outcome_number(const sb_outcome *outcome, const char *key)
{
    return outcome->summary ? sb_json_number_in(outcome->summary, key) : (double)NAN;
}

static const char *place_of(const sb_outcome *outcome, const char *within)
{
    char quoted[96];
    snprintf(quoted, sizeof quoted, "\"%.90s\"", within);
    return outcome->summary ? strstr(outcome->summary, quoted) : NULL;
}

double sb_outcome_number_in(const sb_outcome *outcome, const char *within, const char *key)
{
    const char *place = place_of(outcome, within);
    return place ? sb_json_number_in(place, key) : (double)NAN;
}

sb_vec3 sb_outcome_vector(const sb_outcome *outcome, const char *body, const char *key)
{
    double v[3] = {(double)NAN, (double)NAN, (double)NAN};
    char quoted[96];
    const char *at = place_of(outcome, body);
    snprintf(quoted, sizeof quoted, "\"%.90s\"", key);
    if (at) at = strstr(at, quoted);
    if (at) at = strchr(at, '[');
    for (int axis = 0; at && axis < 3; axis++) {
        char *end;
        v[axis] = strtod(at + 1, &end);
        at = end + strspn(end, " \n");
    }
    return sb_vec(v[0], v[1], v[2]);
}

sb_status sb_outcome_curve(const sb_outcome *outcome, const char *table, const char *where, const char *x,
                           const char *y, sb_curve *curve, sb_error *error)
{
    char path[SB_PATH_MAX];
    sb_sheet sheet = {0};
    sb_status status = sb_path_join(path, outcome->folder, table, error);
    if (status == SB_OK) status = sb_sheet_read(path, &sheet, error);
    if (status == SB_OK) status = sb_sheet_curve(&sheet, where, x, y, curve, error);
    sb_sheet_free(&sheet);
    return status;
}

/* Tables in which every field has a number; in others a field may be empty for a dry place. NaN is written as an empty
 * field. */
static const char *const full_tables[] = {"forces.csv", "energy.csv", "overtopping.csv"};

static bool is_full(const char *name)
{
    for (size_t i = 0; i < sizeof full_tables / sizeof *full_tables; i++)
        if (strcmp(name, full_tables[i]) == 0) return true;
    return false;
}

/* Whether a field of the line is nan or inf, as printf writes them, or empty in a full table. */
static bool line_is_bad(const char *line, bool full)
{
    for (const char *at = line;; at++) {
        const size_t length = strcspn(at, ",\r\n");
        const char *field = at + (*at == '-');
        if (length == 0 && full) return true;
        if ((size_t)(at + length - field) == 3 && (strncmp(field, "nan", 3) == 0 || strncmp(field, "inf", 3) == 0))
            return true;
        at += length;
        if (*at != ',') return false;
    }
}

static void look_for_bad_numbers(sb_outcome *outcome, const char *name)
{
    char path[SB_PATH_MAX], line[4096];
    size_t number = 0;
    const bool full = is_full(name);
    FILE *in = sb_path_join(path, outcome->folder, name, NULL) == SB_OK ? fopen(path, "r") : NULL;
    while (in && !outcome->not_a_number[0] && fgets(line, sizeof line, in))
        if (number++ > 0 && line_is_bad(line, full))
            snprintf(outcome->not_a_number, sizeof outcome->not_a_number, "%.60s:%zu", name, number);
    if (in) fclose(in);
}

void sb_outcome_read(sb_outcome *outcome)
{
    sb_summary_read(outcome->folder, &outcome->summary, NULL);
    DIR *folder = opendir(outcome->folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        size_t n = strlen(entry->d_name);
        if (n > 4 && strcmp(entry->d_name + n - 4, ".csv") == 0) look_for_bad_numbers(outcome, entry->d_name);
    }
    if (folder) closedir(folder);
}

void sb_outcome_free(sb_outcome *outcome)
{
    sb_free(outcome->summary);
    *outcome = (sb_outcome){0};
}
