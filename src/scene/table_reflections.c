#include "physics/records/reflection.h"
#include "physics/waves/dispersion.h"
#include "scene/reader.h"
#include "scene/scene_waves.h"

#include <math.h>
#include <string.h>

size_t sb_scene_gauge(const sb_scene *scene, const char *name)
{
    size_t i = 0;
    while (i < scene->measure.gauge_count && strcmp(scene->measure.gauges[i].name, name) != 0) i++;
    return i;
}

static const sb_gauge *gauge_of(const sb_scene *scene, const sb_reflection_set *set, size_t i)
{
    return &scene->measure.gauges[sb_scene_gauge(scene, set->gauges[i].name)];
}

/* Sets the place along the line from the first gauge to the last, and returns the distance from that line. */
static double place_of(const sb_scene *scene, const sb_reflection_set *set, size_t i, double *along)
{
    const sb_gauge *first = gauge_of(scene, set, 0), *last = gauge_of(scene, set, set->gauge_count - 1);
    const sb_gauge *gauge = gauge_of(scene, set, i);
    const double dx = last->x - first->x, dy = last->y - first->y, length = hypot(dx, dy);
    const double x = gauge->x - first->x, y = gauge->y - first->y;
    *along = length > 0 ? (x * dx + y * dy) / length : 0;
    return length > 0 ? fabs(x * dy - y * dx) / length : hypot(x, y);
}

double sb_reflection_place(const sb_scene *scene, const sb_reflection_set *set, size_t i)
{
    double along;
    place_of(scene, set, i, &along);
    return along;
}

double sb_reflection_number(const sb_scene *scene, const sb_reflection_set *set, int harmonic)
{
    if (harmonic == 1 && set->length > 0) return 2 * M_PI / set->length;
    return sb_wave_number(set->period / harmonic, set->depth, scene->fluid.gravity);
}

/* clang-format off */
static const sb_key name_keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_gauge_name, name), .flags = SB_KEY_REQUIRED,
     .doc = "Name of a gauge; the item may be the name alone."},
};

static const sb_table name_table = {SB_KEY_ROWS(name_keys), .size = sizeof(sb_gauge_name), .plain = true};

static const sb_key keys[] = {
    {.name = "name", .type = SB_KEY_NAME, SB_KEY_AT(sb_reflection_set, name), .flags = SB_KEY_REQUIRED,
     .doc = "Unique name of the set."},
    {.name = "gauges", .type = SB_KEY_LIST, SB_KEY_ITEMS(sb_reflection_set, gauges, gauge_count), .table = &name_table,
     .doc = "Names of three or more gauges in a line. Incident waves travel from the first to the last."},
    {.name = "period", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_reflection_set, period), .unit = "s",
     SB_KEY_POSITIVE, .derived = "that of the scene's regular waves",
     .doc = "Longest period. Of irregular waves: the time after which they repeat."},
    {.name = "harmonics", .type = SB_KEY_INTEGER, SB_KEY_AT(sb_reflection_set, harmonics), .min = 1, .max = 100,
     .fallback = "3", .doc = "Number of components: the period and its fractions 1/2, 1/3, ..."},
    {.name = "depth", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_reflection_set, depth), .unit = "m",
     SB_KEY_POSITIVE, .derived = "that of the scene's waves", .doc = "Still-water depth at the gauges."},
    {.name = "wavelength", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_reflection_set, length), .unit = "m",
     SB_KEY_NOT_NEGATIVE, .derived = "that of the wave maker's regular waves of the period, or 0", .flags = SB_KEY_LATER,
     .doc = "Wavelength of the first harmonic; 0: that of linear theory. High and long waves are longer."},
    {.name = "bound", .type = SB_KEY_SWITCH, SB_KEY_AT(sb_reflection_set, bound), .fallback = "false",
     .flags = SB_KEY_LATER,
     .doc = "For regular waves, with four or more gauges: harmonics above the first are split into free waves and waves "
            "bound to the first harmonic."},
    {.name = "start", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_reflection_set, start), .unit = "s", SB_KEY_NOT_NEGATIVE,
     .fallback = "0", .doc = "Time at which the first window begins: when the waves are regular."},
    {.name = "window", .type = SB_KEY_NUMBER, SB_KEY_AT(sb_reflection_set, window), .unit = "s", SB_KEY_POSITIVE,
     .derived = "5 periods", .doc = "Length of the windows, at least one period."},
};
/* clang-format on */

static sb_status check_gauges(sb_reader *reader, const sb_yaml *map, const sb_reflection_set *set)
{
    const sb_scene *scene = reader->scene;
    if (set->gauge_count < 3)
        return sb_reader_fail(reader, map, "gauges", "has %zu gauges, expected at least 3", set->gauge_count);
    if (set->bound && set->gauge_count < 4)
        return sb_reader_fail(reader, map, "bound",
                              "true with 3 gauges: free and bound, incident and reflected waves "
                              "are four unknowns, expected at least 4 gauges");
    for (size_t i = 0; i < set->gauge_count; i++)
        if (sb_scene_gauge(scene, set->gauges[i].name) == scene->measure.gauge_count)
            return sb_reader_fail(reader, map, "gauges", "no gauge is named %s, expected names of measure.gauges",
                                  set->gauges[i].name);
    for (size_t i = 0; i < set->gauge_count; i++) {
        double along;
        const double away = place_of(scene, set, i, &along);
        if (away > 0.1 * scene->resolution)
            return sb_reader_fail(reader, map, "gauges",
                                  "%s lies %g m from the line through the first and the last gauge, "
                                  "expected all in a line",
                                  set->gauges[i].name, away);
    }
    if (!(sb_reflection_place(scene, set, set->gauge_count - 1) > 0))
        return sb_reader_fail(reader, map, "gauges", "the first and the last gauge are at one place, expected a line");
    return SB_OK;
}

/* Length in a closed flume of the regular waves of one wave maker, if they have the period, m; otherwise 0. */
static double length_of_waves(const sb_scene *scene, const sb_reflection_set *set)
{
    static const double same = 0.005;
    const sb_scene_waves waves = sb_scene_waves_of(scene);
    if (!waves.regular || !waves.law || !(fabs(waves.period / set->period - 1) < same)) return 0;
    const double length = sb_flume_length_of(waves.law, set->depth).length;
    return length > 0 ? length : 0;
}

static sb_status finish(sb_reader *reader, const sb_yaml *map, void *item)
{
    sb_reflection_set *set = item;
    const double interval = reader->scene->measure.interval;
    sb_status status = check_gauges(reader, map, set);
    if (status == SB_OK) status = sb_reader_period(reader, map, true, &set->period, &set->depth);
    if (status != SB_OK) return status;
    if (!sb_yaml_child(map, "wavelength")) set->length = length_of_waves(reader->scene, set);
    if (!sb_yaml_child(map, "window")) set->window = 5 * set->period;
    if (set->window < set->period)
        return sb_reader_fail(reader, map, "window", "%g s is shorter than the period, expected at least %g s",
                              set->window, set->period);
    if (set->harmonics > sb_harmonics_most(set->period, interval))
        return sb_reader_fail(
            reader, map, "harmonics",
            "the shortest period of %g s has two rows of measure.interval %g s or fewer, expected fewer "
            "harmonics or a shorter interval",
            set->period / set->harmonics, interval);
    if (set->bound && set->harmonics < 2)
        return sb_reader_fail(reader, map, "bound",
                              "true with one harmonic: the first has no bound waves, expected "
                              "harmonics: 2 or more");
    return SB_OK;
}

const sb_table sb_reflection_table = {SB_KEY_ROWS(keys), .size = sizeof(sb_reflection_set), .finish = finish};
