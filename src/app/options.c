#include "app/options.h"

#include "app/check/team.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "surface/make.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct flag {
    const char *name;
    unsigned bit;
    enum { NO_VALUE, VALUE, MAYBE_VALUE } takes; /* MAYBE_VALUE: only behind "=" */
} flag;

enum { DEFAULT_PORT = 8080 };         /* of --live */
enum { DEFAULT_RANK_DEADLINE = 300 }; /* s */

static const flag flags[] = {
    {"--out", SB_OPT_OUT, VALUE},
    {"-o", SB_OPT_SHORT_OUT, VALUE},
    {"--until", SB_OPT_UNTIL, VALUE},
    {"--threads", SB_OPT_THREADS, VALUE},
    {"--preset", SB_OPT_PRESET, VALUE},
    {"--set", SB_OPT_SET, VALUE},
    {"--quiet", SB_OPT_QUIET, NO_VALUE},
    {"--json", SB_OPT_JSON, NO_VALUE},
    {"--camera", SB_OPT_CAMERA, VALUE},
    {"--profile", SB_OPT_PROFILE, NO_VALUE},
    {"--resume", SB_OPT_RESUME, NO_VALUE},
    {"--overwrite", SB_OPT_OVERWRITE, NO_VALUE},
    {"--other-build", SB_OPT_OTHER_BUILD, NO_VALUE},
    {"--url", SB_OPT_URL, VALUE},
    {"--prefix", SB_OPT_PREFIX, VALUE},
    {"--speed", SB_OPT_SPEED, VALUE},
    {"--control", SB_OPT_CONTROL, NO_VALUE},
    {"--live", SB_OPT_LIVE, MAYBE_VALUE},
    {"--title", SB_OPT_TITLE, VALUE},
    {"--format", SB_OPT_FORMAT, VALUE},
    {"--times", SB_OPT_TIMES, VALUE},
    {"--cell", SB_OPT_CELL, VALUE},
    {"--smooth", SB_OPT_SMOOTH, VALUE},
    {"--film", SB_OPT_FILM, NO_VALUE},
    {"--rank-deadline", SB_OPT_RANK_DEADLINE, VALUE},
    {"--mixed", SB_OPT_MIXED, NO_VALUE},
};

static sb_status add_override(sb_options *options, const char *text, sb_error *error)
{
    const char *equals = strchr(text, '=');
    if (!equals || equals == text) return sb_fail(error, SB_BAD_INPUT, "--set %.200s: expected KEY=VALUE", text);
    if (options->override_count == SB_OVERRIDES_MAX)
        return sb_fail(error, SB_BAD_INPUT, "--set: more than %d of them", SB_OVERRIDES_MAX);
    char *copy = sb_strdup(text);
    if (!copy) return sb_fail_memory(error, "options");
    copy[equals - text] = '\0';
    options->texts[options->override_count] = copy;
    options->overrides[options->override_count++] = (sb_override){.key = copy, .value = copy + (equals - text) + 1};
    return SB_OK;
}

/* "", "8080" or "10.0.0.5:8080"; an address with colons is in brackets. */
static sb_status take_live(sb_options *options, const char *value, sb_error *error)
{
    const char *colon = strrchr(value, ':'), *digits = colon ? colon + 1 : value;
    char *end = NULL;
    const long port = *digits ? strtol(digits, &end, 10) : colon ? 0 : DEFAULT_PORT;
    size_t length = colon ? (size_t)(colon - value) : 0;
    const bool brackets = length > 2 && value[0] == '[' && value[length - 1] == ']';
    if (brackets) length -= 2;
    if ((end && *end) || port < 1 || port > 65535 || length >= sizeof options->live_address)
        return sb_fail(error, SB_BAD_INPUT, "--live=%.100s: expected PORT from 1 to 65535, or ADDRESS:PORT", value);
    options->live_port = (int)port;
    snprintf(options->live_address, sizeof options->live_address, "%.*s", (int)length, value + brackets);
    return add_override(options, "stream.enabled=true", error);
}

static sb_status take_cell(sb_options *options, const char *value, sb_error *error)
{
    char *end;
    options->cell = strtod(value, &end);
    if (end != value && !*end && options->cell >= SB_WATER_MESH_CELL_LEAST && options->cell <= SB_WATER_MESH_CELL_MOST)
        return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "--cell %.100s: expected %g to %g particle spacings", value,
                   SB_WATER_MESH_CELL_LEAST, SB_WATER_MESH_CELL_MOST);
}

static sb_status take_smooth(sb_options *options, const char *value, sb_error *error)
{
    char *end;
    const long rounds = strtol(value, &end, 10);
    if (end == value || *end || rounds < 0 || rounds > SB_WATER_MESH_SMOOTH_MOST)
        return sb_fail(error, SB_BAD_INPUT, "--smooth %.100s: expected 0 to %d rounds", value,
                       SB_WATER_MESH_SMOOTH_MOST);
    options->smooth = (int)rounds;
    return SB_OK;
}

/* A refused deadline is not used: the default counts until all ranks agree on the refusal. */
static sb_status take_deadline(const char *value, double *deadline, sb_error *error)
{
    char *end;
    const double seconds = strtod(value, &end);
    if (end == value || *end || !(seconds >= 1 && seconds <= 1e6))
        return sb_fail(error, SB_BAD_INPUT, "--rank-deadline %.100s: expected seconds from 1 to 1e6", value);
    *deadline = seconds;
    return SB_OK;
}

static sb_status take(sb_options *options, unsigned bit, const char *value, sb_error *error)
{
    char *end = NULL, duration[64];
    switch (bit) {
    case SB_OPT_OUT:
    case SB_OPT_SHORT_OUT:
        options->out = value;
        break;
    case SB_OPT_PRESET:
        options->preset = value;
        break;
    case SB_OPT_TITLE:
        options->title = value;
        break;
    case SB_OPT_FORMAT:
        options->format = value;
        break;
    case SB_OPT_TIMES:
        options->times = value;
        break;
    case SB_OPT_CELL:
        return take_cell(options, value, error);
    case SB_OPT_SMOOTH:
        return take_smooth(options, value, error);
    case SB_OPT_URL:
        options->url = value;
        break;
    case SB_OPT_PREFIX:
        options->prefix = value;
        break;
    case SB_OPT_SPEED:
        options->speed = strtod(value, &end);
        if (end == value || *end || !isfinite(options->speed) || options->speed < 0 || options->speed > 1e6)
            return sb_fail(error, SB_BAD_INPUT, "--speed %.100s: expected a factor from 0 to 1e6", value);
        break;
    case SB_OPT_CAMERA:
        if (options->camera_count == SB_CAMERA_OPTIONS_MAX)
            return sb_fail(error, SB_BAD_INPUT, "--camera: more than %d of them", SB_CAMERA_OPTIONS_MAX);
        options->cameras[options->camera_count++] = value;
        break;
    case SB_OPT_QUIET:
        options->quiet = true;
        break;
    case SB_OPT_FILM:
        options->film = true;
        break;
    case SB_OPT_MIXED:
        options->mixed = true;
        break;
    case SB_OPT_RANK_DEADLINE:
        return take_deadline(value, &options->rank_deadline, error);
    case SB_OPT_OTHER_BUILD:
        options->other_build = true;
        break;
    case SB_OPT_OVERWRITE:
        options->overwrite = true;
        break;
    case SB_OPT_RESUME:
        options->resume = true;
        break;
    case SB_OPT_PROFILE:
        options->profile = true;
        break;
    case SB_OPT_JSON:
        options->json = true;
        break;
    case SB_OPT_CONTROL:
        return add_override(options, "control.enabled=true", error);
    case SB_OPT_LIVE:
        return take_live(options, value, error);
    case SB_OPT_SET:
        return add_override(options, value, error);
    case SB_OPT_UNTIL: {
        double until = strtod(value, &end);
        if (end == value || *end || !isfinite(until) || until <= 0)
            return sb_fail(error, SB_BAD_INPUT, "--until %.100s: expected seconds > 0", value);
        /* As an override it passes the same checks as the scene's own duration. */
        snprintf(duration, sizeof duration, "duration=%.17g", until);
        return add_override(options, duration, error);
    }
    default: {
        long threads = strtol(value, &end, 10);
        if (end == value || *end || threads < 1 || threads > 1024)
            return sb_fail(error, SB_BAD_INPUT, "--threads %.100s: expected a count from 1 to 1024", value);
        options->threads = (int)threads;
    }
    }
    return SB_OK;
}

static const flag *find_flag(const char *argument, unsigned accepted)
{
    size_t length = strcspn(argument, "=");
    for (size_t f = 0; f < sizeof flags / sizeof flags[0]; f++)
        if (flags[f].bit & accepted && strlen(flags[f].name) == length && strncmp(flags[f].name, argument, length) == 0)
            return &flags[f];
    return NULL;
}

static sb_status refuse_flag(const char *argument, unsigned accepted, sb_error *error)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)strcspn(argument, "="), argument);
    sb_nearest nearest = sb_nearest_to(name);
    for (size_t f = 0; f < sizeof flags / sizeof flags[0]; f++)
        if (flags[f].bit & accepted) sb_nearest_try(&nearest, flags[f].name);
    return nearest.found ? sb_fail(error, SB_BAD_INPUT,
                                   "%.200s: not an option of this command, did you mean %s? --help lists the options",
                                   argument, nearest.found)
                         : sb_fail(error, SB_BAD_INPUT,
                                   "%.200s: not an option of this command; --help lists the options", argument);
}

static sb_status take_positional(sb_options *options, unsigned accepted, const char *argument, const char *what,
                                 sb_error *error)
{
    if (options->positional && !(accepted & SB_OPT_SEVERAL))
        return sb_fail(error, SB_BAD_INPUT, "%.200s: expected one %s, and %.200s was given before", argument, what,
                       options->positional);
    if (options->positional_count == SB_POSITIONALS_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%.200s: more than %d of %s", argument, SB_POSITIONALS_MAX, what);
    if (!options->positional) options->positional = argument;
    options->positionals[options->positional_count++] = argument;
    return SB_OK;
}

sb_status sb_options_parse(int count, char **arguments, unsigned accepted, const char *what, sb_options *options,
                           sb_error *error)
{
    *options = (sb_options){
        .speed = 1, .cell = SB_WATER_MESH_CELL, .smooth = SB_WATER_MESH_SMOOTH, .rank_deadline = DEFAULT_RANK_DEADLINE};
    for (int i = 0; i < count; i++) {
        const char *argument = arguments[i];
        if (strcmp(argument, "--help") == 0 || strcmp(argument, "-h") == 0) {
            options->help = true;
            return SB_OK;
        }
        if (argument[0] != '-') {
            const sb_status status = take_positional(options, accepted, argument, what, error);
            if (status != SB_OK) return status;
            continue;
        }
        const flag *found = find_flag(argument, accepted);
        if (!found) return refuse_flag(argument, accepted, error);
        const char *equals = strchr(argument, '='), *value = equals ? equals + 1 : "";
        if (found->takes == NO_VALUE && equals) return sb_fail(error, SB_BAD_INPUT, "%.200s: takes no value", argument);
        if (found->takes == VALUE && !equals) {
            if (i + 1 == count) return sb_fail(error, SB_BAD_INPUT, "%.200s: needs a value", argument);
            value = arguments[++i];
        }
        sb_status status = take(options, found->bit, value, error);
        if (status != SB_OK) return status;
    }
    if (!options->positional) return sb_fail(error, SB_BAD_INPUT, "no %s given; --help describes the command", what);
    return SB_OK;
}

void sb_options_free(sb_options *options)
{
    for (size_t i = 0; i < options->override_count; i++) sb_free(options->texts[i]);
    *options = (sb_options){0};
}

sb_status sb_options_scene(const sb_options *options, const char *path, sb_scene *scene, sb_error *error)
{
    const sb_status status =
        sb_scene_read(path, options->preset, options->overrides, options->override_count, scene, error);
    if (status == SB_OK) sb_team_choose(scene, options->threads);
    return status;
}
