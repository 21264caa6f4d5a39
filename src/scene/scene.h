/* A scene with all defaults filled in. Other modules do not change it. SI units; z is up; gravity points to -z. In 2D
   the plane is x-z and y is 0 everywhere. */
#ifndef SB_SCENE_SCENE_H
#define SB_SCENE_SCENE_H

#include "base/status.h"
#include "scene/bodies.h"
#include "scene/domain.h"
#include "scene/measure.h"
#include "scene/numerics.h"
#include "scene/offshore.h"
#include "scene/render.h"
#include "scene/water.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct sb_stream_settings {
    bool enabled;
    char *url;                /* LCM provider; empty: LCM's default */
    char prefix[SB_NAME_MAX]; /* of the channel names */
    double interval;          /* s simulated between particle messages */
    int decimation;           /* every n-th particle */
} sb_stream_settings;

typedef struct sb_control_settings {
    bool enabled; /* commands are allowed */
    bool paused;  /* the run begins paused */
} sb_control_settings;

/* When the state is saved for --resume. Both 0: never. */
typedef struct sb_checkpoint_settings {
    double minutes; /* wall time between two checkpoints; 0: by steps only */
    int steps;      /* steps between two checkpoints; 0: by time only */
    int keep;       /* number of latest checkpoints that are kept */
} sb_checkpoint_settings;

typedef struct sb_output_settings {
    double particle_interval; /* s between particles/NNNNNN.vtp; 0: off */
    bool particle_pieces;     /* each rank writes its own */
    bool plots;
    sb_checkpoint_settings checkpoint;
} sb_output_settings;

typedef struct sb_scene {
    char *path; /* of the scene file, for messages */
    char *title;
    int dimensions;    /* 2 or 3 */
    double resolution; /* m, rest inter-particle distance (delta r); without particles the cell of offshore */
    double duration;   /* s */
    sb_fluid_properties fluid;
    sb_domain domain;
    sb_offshore_settings offshore;
    sb_sea sea;
    size_t box_count;
    sb_fluid_box *boxes;
    sb_initial_wave wave;
    sb_given_sea given;
    sb_numerics numerics;
    size_t body_count;
    sb_body *bodies;
    size_t wavemaker_count;
    sb_wavemaker_use *wavemakers;
    size_t sponge_count;
    sb_sponge *sponges;
    sb_foam_settings foam;
    sb_measure_settings measure;
    sb_render_settings render;
    sb_stream_settings stream;
    sb_control_settings control;
    sb_output_settings output;
} sb_scene;

/* Whether a camera shows the density error, which frames contain only then. */
static inline bool sb_scene_shows_density_error(const sb_scene *scene)
{
    for (size_t c = 0; c < scene->render.camera_count; c++) {
        const sb_camera *camera = &scene->render.cameras[c];
        const bool sliced = camera->slice.normal.x != 0 || camera->slice.normal.y != 0 || camera->slice.normal.z != 0;
        if (camera->color == SB_COLOR_DENSITY_ERROR || (sliced && camera->slice.field == SB_COLOR_DENSITY_ERROR))
            return true;
    }
    return false;
}

/* Whether a run of the scene draws pictures. */
static inline bool sb_scene_draws(const sb_scene *scene)
{
    return (scene->render.interval > 0 || scene->render.still_count > 0) && scene->render.camera_count > 0;
}

/* Whether water of a given sea comes in and goes out through a side. */
static inline bool sb_scene_sea_side(const sb_scene *scene, int side)
{
    return scene->domain.side[side] == SB_SIDE_SEA && !(scene->dimensions == 2 && side / 2 == 1);
}

static inline bool sb_scene_has_sea(const sb_scene *scene)
{
    for (int side = 0; side < SB_SIDES; side++)
        if (sb_scene_sea_side(scene, side)) return true;
    return false;
}

/* Whether the source of a given sea is that of a side; otherwise the side has still water, if it is of kind sea. */
static inline bool sb_scene_given_side(const sb_scene *scene, int side)
{
    return sb_scene_sea_side(scene, side) && scene->given.source != SB_GIVEN_NONE &&
           scene->given.side[side] == SB_GIVEN_HERE;
}

/* Whether the depth-averaged model gives the water at sides of kind sea, and whether it runs without particles. */
static inline bool sb_scene_nested(const sb_scene *scene)
{
    return scene->offshore.present && scene->given.source == SB_GIVEN_OFFSHORE;
}
static inline bool sb_scene_grid_alone(const sb_scene *scene)
{
    return scene->offshore.present && scene->given.source != SB_GIVEN_OFFSHORE;
}

/* Whether all water is a sea at one level at the start. */
static inline bool sb_scene_starts_still(const sb_scene *scene)
{
    return scene->wave.kind == SB_INITIAL_NONE && scene->box_count == 0;
}

/* Whether the domain is periodic along an axis (0, 1, 2). In 2D it is never periodic along y. */
static inline bool sb_scene_repeats(const sb_scene *scene, int axis)
{
    return scene->domain.side[2 * axis] == SB_SIDE_PERIODIC && !(scene->dimensions == 2 && axis == 1);
}

/* Whether a body may have this name. The names of a split mesh are known only when its file is read. */
bool sb_scene_may_have_body(const sb_scene *scene, const char *name);

/* The parts of a paddle: push-plates side by side, or the rows of a flap above each other. `count` of equal width from
   `from` to `to` (m) along an axis, 0: x, 1: y, 2: z. Of a flap `from` is the height of its hinge. Each push-plate is
   `levels` plates above each other, which move as one. */
typedef struct sb_plate_row {
    int axis;
    double from, to;
    size_t count, levels;
} sb_plate_row;
/* Finds the parts of a wave maker's body, within the domain. Returns their number, 0: the paddle is one. */
size_t sb_scene_plates(const sb_scene *scene, const sb_wavemaker_use *use, sb_plate_row *row);

/* Index of the gauge of that name; gauge_count if there is none. */
size_t sb_scene_gauge(const sb_scene *scene, const char *name);
/* Distance of gauge i of a set from its first gauge, along the line to the last one, m. */
double sb_reflection_place(const sb_scene *scene, const sb_reflection_set *set, size_t i);

/* Wave number of free waves of a harmonic of the set's period, 1/m: by linear theory, or that of the given wavelength.
 */
double sb_reflection_number(const sb_scene *scene, const sb_reflection_set *set, int harmonic);

/* The sides' names in a scene: "x_min" and so on. */
extern const char *const sb_side_names[SB_SIDES];

/* Speed above which a simulation counts as diverged, m/s: 100 times that of a fall from half the domain's height. */
static inline double sb_scene_speed_limit(const sb_scene *scene)
{
    return 100 * sqrt(scene->fluid.gravity * (scene->domain.max.z - scene->domain.min.z));
}

/* One --set KEY=VALUE. key: dotted path, list items by index or name: "bodies.reactor1.scale".
   value: YAML text. */
typedef struct sb_override {
    const char *key, *value;
} sb_override;

/* Reads a scene, applies the preset (preset_name NULL: the scene's own) and the overrides, and checks all values. On an
   error *scene is unchanged and *error contains "file:line:column: key: what is wrong, what was expected" ("--set: key:
   ..." for an override). */
sb_status sb_scene_read(const char *path, const char *preset_name, const sb_override *overrides, size_t override_count,
                        sb_scene *scene, sb_error *error);

/* The beginning of the first line of a scene that sb_scene_write wrote. */
#define SB_SCENE_WRITTEN "# A scene as shorebreak"

/* Writes the scene with all defaults and absolute paths. Reading it gives the same scene. */
sb_status sb_scene_write(const sb_scene *scene, const char *path, sb_error *error);

/* Writes everything that determines a run's state, measurements and frames as text, so that two scenes can be compared:
   the scene with all defaults, without the keys that change none of these (duration, stream, output at the end), and
   its files as names and hashes of their contents. Free with sb_free. SB_BAD_INPUT names a file that cannot be read. */
sb_status sb_scene_identity(const sb_scene *scene, char **text, sb_error *error);

/* One key of a scene, for docs/scene.md. Texts are valid during the visit only. */
typedef struct sb_scene_key {
    const char *path;     /* "bodies[].scale" */
    const char *unit;     /* "m"; empty: none */
    const char *fallback; /* its default, as YAML or as a description; empty: none */
    const char *range;    /* "> 0", "wall or open" */
    const char *doc;      /* a sentence or two */
    const char *only;     /* the case in which it applies, "shape cylinder"; NULL: always */
    bool required;        /* if it applies */
} sb_scene_key;

/* Visits all keys in the order in which they are written, blocks and lists before their contents. */
void sb_scene_keys(void (*visit)(void *context, const sb_scene_key *key), void *context);

/* Frees all that the scene owns and zeroes it. Allowed on a zeroed scene. */
void sb_scene_free(sb_scene *scene);

#endif
