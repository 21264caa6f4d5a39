/* Reads commands from JSON and from words, by one table of their members. */
#include "control/command.h"

#include "base/nearest.h"

#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

typedef enum member_type { COUNT, NUMBER, POINT, NAME, TRUE } member_type;

typedef struct member {
    const char *name; /* NULL: no more members */
    member_type type;
    bool required;
    double min, max; /* of a count or a number */
    size_t at;       /* in sb_command */
} member;

enum { MEMBERS = 3 };

/* Coordinates are limited, so that no arithmetic with them overflows. */
static const double FARTHEST = 1e9;

static const member id_member = {"id", COUNT, false, 0, (double)SB_COMMAND_ID_MAX, offsetof(sb_command, id)};

#define FIRST_POINT offsetof(sb_command, number)
#define SECOND_POINT (FIRST_POINT + 3 * sizeof(double))

/* The row of a kind that users can send. */
static const struct {
    const char *name;
    member members[MEMBERS + 1];
} kinds[SB_COMMANDS] = {
    [SB_COMMAND_PAUSE] = {"pause", {{0}}},
    [SB_COMMAND_RESUME] = {"resume", {{0}}},
    [SB_COMMAND_STEP] = {"step", {{"steps", COUNT, false, 1, 1e9, offsetof(sb_command, count)}}},
    [SB_COMMAND_STOP] = {"stop", {{0}}},
    [SB_COMMAND_CHECKPOINT] = {"checkpoint", {{0}}},
    [SB_COMMAND_RATE] = {"rate", {{"rate", NUMBER, true, 0, 1000, FIRST_POINT}}},
    [SB_COMMAND_DECIMATION] = {"decimation", {{"decimation", COUNT, true, 1, 1e6, offsetof(sb_command, count)}}},
    [SB_COMMAND_REGION] = {"region",
                           {{"min", POINT, false, 0, 0, FIRST_POINT},
                            {"max", POINT, false, 0, 0, SECOND_POINT},
                            {"off", TRUE, false, 0, 0, offsetof(sb_command, off)}}},
    [SB_COMMAND_PICTURE] = {"picture",
                            {{"camera", NAME, false, 0, 0, offsetof(sb_command, name)},
                             {"eye", POINT, false, 0, 0, FIRST_POINT},
                             {"target", POINT, false, 0, 0, SECOND_POINT}}},
    [SB_COMMAND_TRIGGER] = {"trigger", {{"wavemaker", NAME, true, 0, 0, offsetof(sb_command, name)}}},
    [SB_COMMAND_LOSS] = {"loss", {{"lost", NUMBER, true, 0, 1, FIRST_POINT}}},
};

const char *sb_command_name(int32_t kind)
{
    static const char *const internal[] = {"faulty command", "counts"};
    if (kind >= 0 && kind < SB_COMMANDS) return kinds[kind].name;
    return kind >= SB_COMMANDS && kind < SB_COMMAND_KINDS ? internal[kind - SB_COMMANDS] : "unknown";
}

/* ---- one member ---- */

/* The value as the text has it, cut to fit. */
static void quote(const json_t *value, char text[64])
{
    const size_t length = json_dumpb(value, text, 63, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(9));
    text[length < 63 ? length : 63] = 0;
    if (length > 63) memcpy(text + 60, "...", 4);
}

static sb_status refuse(const member *m, const json_t *value, const char *expected, sb_error *error)
{
    char text[64] = "";
    quote(value, text);
    return sb_fail(error, SB_BAD_INPUT, "%s: %s, expected %s", m->name, text, expected);
}

static sb_status take_count(const member *m, const json_t *value, int64_t *out, sb_error *error)
{
    char expected[80];
    snprintf(expected, sizeof expected, "a whole number from %.0f to %.0f", m->min, m->max);
    if (!json_is_integer(value)) return refuse(m, value, expected, error);
    const int64_t number = json_integer_value(value);
    if (number < (int64_t)m->min || number > (int64_t)m->max) return refuse(m, value, expected, error);
    *out = number;
    return SB_OK;
}

static sb_status take_point(const member *m, const json_t *value, double *out, sb_error *error)
{
    static const char expected[] = "three numbers from -1e9 to 1e9";
    if (!json_is_array(value) || json_array_size(value) != 3) return refuse(m, value, expected, error);
    for (size_t i = 0; i < 3; i++) {
        const json_t *item = json_array_get(value, i);
        const double number = json_number_value(item);
        if (!json_is_number(item) || !(fabs(number) <= FARTHEST)) return refuse(m, value, expected, error);
        out[i] = number;
    }
    return SB_OK;
}

static sb_status take_name(const member *m, const json_t *value, char out[SB_COMMAND_NAME], sb_error *error)
{
    const char *text = json_string_value(value);
    const size_t length = text ? json_string_length(value) : 0;
    if (length < 1 || length >= SB_COMMAND_NAME || strlen(text) != length)
        return refuse(m, value, "a name of 1 to 127 bytes", error);
    memcpy(out, text, length + 1);
    return SB_OK;
}

static sb_status take(const member *m, const json_t *value, sb_command *command, sb_error *error)
{
    char expected[80];
    void *out = (char *)command + m->at;
    switch (m->type) {
    case COUNT:
        return take_count(m, value, out, error);
    case POINT:
        return take_point(m, value, out, error);
    case NAME:
        return take_name(m, value, out, error);
    case TRUE:
        if (!json_is_true(value)) return refuse(m, value, "true", error);
        *(int32_t *)out = 1;
        return SB_OK;
    case NUMBER:
        break;
    }
    snprintf(expected, sizeof expected, "a number from %g to %g", m->min, m->max);
    const double number = json_number_value(value);
    if (!json_is_number(value) || !(number >= m->min && number <= m->max)) return refuse(m, value, expected, error);
    *(double *)out = number;
    return SB_OK;
}

/* ---- a whole command ---- */

static sb_status find_kind(const json_t *root, int32_t *kind, sb_error *error)
{
    const char *name = json_string_value(json_object_get(root, "do"));
    if (!name) return sb_fail(error, SB_BAD_INPUT, "do: is missing, expected the name of a command");
    sb_nearest nearest = sb_nearest_to(name);
    for (*kind = 0; *kind < SB_COMMANDS; ++*kind) {
        if (strcmp(name, kinds[*kind].name) == 0) return SB_OK;
        sb_nearest_try(&nearest, kinds[*kind].name);
    }
    if (nearest.found)
        return sb_fail(error, SB_BAD_INPUT, "do: \"%.40s\", expected a command, did you mean %s?", name, nearest.found);
    return sb_fail(error, SB_BAD_INPUT,
                   "do: \"%.40s\", expected pause, resume, step, stop, checkpoint, rate, decimation, region, picture "
                   "or trigger",
                   name);
}

static const member *find_member(int32_t kind, const char *name)
{
    const member *m = kinds[kind].members;
    if (strcmp(name, id_member.name) == 0) return &id_member;
    while (m->name && strcmp(name, m->name) != 0) m++;
    return m->name ? m : NULL;
}

static bool has(const json_t *root, const char *name)
{
    return json_object_get(root, name) != NULL;
}

/* What the members of a command say together. */
static sb_status check_together(const json_t *root, const sb_command *command, sb_error *error)
{
    const double *first = command->number, *second = command->number + 3;
    if (command->kind == SB_COMMAND_REGION) {
        if (has(root, "min") != has(root, "max") || has(root, "min") == has(root, "off"))
            return sb_fail(error, SB_BAD_INPUT, "region: expected either min and max, or off");
        for (int axis = 0; axis < 3 && !command->off; axis++)
            if (!(first[axis] < second[axis]))
                return sb_fail(error, SB_BAD_INPUT, "max: %.9g in %c, expected more than min, %.9g", second[axis],
                               "xyz"[axis], first[axis]);
    }
    if (command->kind == SB_COMMAND_PICTURE) {
        if (has(root, "eye") != has(root, "target") || has(root, "eye") == has(root, "camera"))
            return sb_fail(error, SB_BAD_INPUT, "picture: expected either camera, or eye and target");
        if (has(root, "eye") && first[0] == second[0] && first[1] == second[1] && first[2] == second[2])
            return sb_fail(error, SB_BAD_INPUT, "target: is the same point as eye, expected a different point");
    }
    return SB_OK;
}

static sb_status take_members(json_t *root, sb_command *command, sb_error *error)
{
    const char *name;
    json_t *value;
    json_object_foreach(root, name, value)
    {
        if (strcmp(name, "do") == 0) continue;
        const member *m = find_member(command->kind, name);
        if (!m)
            return sb_fail(error, SB_BAD_INPUT, "%.40s: is not a member of the command %s", name,
                           kinds[command->kind].name);
        const sb_status status = take(m, value, command, error);
        if (status != SB_OK) return status;
    }
    for (const member *m = kinds[command->kind].members; m->name; m++)
        if (m->required && !has(root, m->name))
            return sb_fail(error, SB_BAD_INPUT, "%s: is missing in the command %s", m->name, kinds[command->kind].name);
    return check_together(root, command, error);
}

sb_status sb_command_from_json(const char *text, size_t size, sb_command *command, sb_error *error)
{
    json_error_t problem;
    if (size > SB_COMMAND_JSON_MAX)
        return sb_fail(error, SB_BAD_INPUT, "the command has %zu bytes, expected at most %d", size,
                       SB_COMMAND_JSON_MAX);
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &problem);
    if (!root) return sb_fail(error, SB_BAD_INPUT, "not JSON: %.150s, at byte %d", problem.text, problem.position);
    sb_command made = {.count = 1};
    sb_status status = json_is_object(root) ? find_kind(root, &made.kind, error)
                                            : sb_fail(error, SB_BAD_INPUT, "expected one JSON object, {...}");
    if (status == SB_OK) status = take_members(root, &made, error);
    json_decref(root);
    if (status == SB_OK) *command = made;
    return status;
}

bool sb_command_is_valid(const sb_command *command)
{
    if (command->kind < 0 || command->kind >= SB_COMMAND_KINDS || command->id < 0 || command->counter < 0 ||
        command->count < 0 || !memchr(command->name, 0, sizeof command->name))
        return false;
    for (int i = 0; i < SB_COMMAND_NUMBERS; i++)
        if (!isfinite(command->number[i])) return false;
    return true;
}
