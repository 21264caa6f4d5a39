/* Makes commands of the words of a command line. */
#include "control/command.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A word as a JSON value: a number if it is one. */
static json_t *value_of(const char *word)
{
    char *end;
    const long long whole = strtoll(word, &end, 10);
    if (*word && !*end) return json_integer(whole);
    const double number = strtod(word, &end);
    json_t *real = *word && !*end ? json_real(number) : NULL; /* NULL also for one that is not finite */
    return real ? real : json_string(word);
}

static json_t *point_of(char *const words[])
{
    json_t *point = json_array();
    for (int i = 0; i < 3; i++) json_array_append_new(point, value_of(words[i]));
    return point;
}

/* Adds the members that follow the command's name. False: the number of words is wrong. */
static bool add_members(json_t *root, int count, char *const words[])
{
    static const struct {
        const char *name, *member;
        bool optional, text;
    } simple[] = {{"step", "steps", true, false},
                  {"rate", "rate", false, false},
                  {"decimation", "decimation", false, false},
                  {"picture", "camera", false, true},
                  {"trigger", "wavemaker", false, true}};
    if (count == 7) {
        const bool picture = strcmp(words[0], "picture") == 0;
        json_object_set_new(root, picture ? "eye" : "min", point_of(words + 1));
        json_object_set_new(root, picture ? "target" : "max", point_of(words + 4));
        return picture || strcmp(words[0], "region") == 0;
    }
    if (strcmp(words[0], "region") == 0) {
        json_object_set_new(root, "off", json_true());
        return count == 2 && strcmp(words[1], "off") == 0;
    }
    for (size_t k = 0; k < sizeof simple / sizeof *simple; k++) {
        if (strcmp(words[0], simple[k].name) != 0) continue;
        if (count == 2)
            json_object_set_new(root, simple[k].member, simple[k].text ? json_string(words[1]) : value_of(words[1]));
        return count == 2 || (count == 1 && simple[k].optional);
    }
    return count == 1;
}

sb_status sb_command_from_words(int count, char *const words[], int64_t id, char text[SB_COMMAND_JSON_MAX],
                                sb_error *error)
{
    sb_command command;
    if (count < 1) return sb_fail(error, SB_BAD_INPUT, "no command given");
    json_t *root = json_object();
    json_object_set_new(root, "do", json_string(words[0]));
    json_object_set_new(root, "id", json_integer(id));
    const bool fits = add_members(root, count, words);
    const size_t size = json_dumpb(root, text, SB_COMMAND_JSON_MAX - 1, JSON_COMPACT);
    json_decref(root);
    if (size >= SB_COMMAND_JSON_MAX) return sb_fail(error, SB_BAD_INPUT, "%.40s: its values are too long", words[0]);
    text[size] = 0;
    const sb_status status = sb_command_from_json(text, size, &command, error);
    if (fits || (status != SB_OK && strncmp(error ? error->text : "", "do:", 3) == 0)) return status;
    return sb_fail(error, SB_BAD_INPUT,
                   "%.40s: a wrong number of values; expected pause, resume, step [N], stop, checkpoint, rate R, "
                   "decimation N, region X0 Y0 Z0 X1 Y1 Z1, region off, picture CAMERA, picture EX EY EZ TX TY TZ or "
                   "trigger WAVEMAKER",
                   words[0]);
}
