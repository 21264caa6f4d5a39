/* The key tables of a scene. One row per key defines how it is read, checked and written, its default, and its entry in
   docs/scene.md. */
#ifndef SB_SCENE_KEY_H
#define SB_SCENE_KEY_H

#include "scene/scene.h"
#include "scene/yaml.h"

typedef enum sb_key_type {
    SB_KEY_NUMBER,  /* double; with `words`, the first of them stands for infinity */
    SB_KEY_INTEGER, /* int */
    SB_KEY_SEED,    /* uint64_t */
    SB_KEY_SWITCH,  /* bool */
    SB_KEY_TEXT,    /* char *, owned */
    SB_KEY_NAME,    /* char[SB_NAME_MAX] */
    SB_KEY_FILE,    /* char *, owned: absolute path of a file that exists */
    SB_KEY_VECTOR,  /* sb_vec3 */
    SB_KEY_PLACE,   /* two doubles: x, y */
    SB_KEY_COLOR,   /* float[3] */
    SB_KEY_CHOICE,  /* an enum, one of `words` */
    SB_KEY_LETTER,  /* char, one of `words` */
    SB_KEY_KERNEL,  /* const sb_kernel * */
    SB_KEY_LAW,     /* const sb_wavemaker * */
    SB_KEY_BLOCK,   /* a struct, read by `table` */
    SB_KEY_LIST     /* pointer and count of structs, read by `table` */
} sb_key_type;

enum {
    SB_KEY_REQUIRED = 1,
    SB_KEY_REQUIRED_3D = 2, /* required in 3D; in 2D the default, or 0 */
    SB_KEY_ABOVE = 4,       /* the value must be above min */
    SB_KEY_BELOW = 8,       /* the value must be below max */
    SB_KEY_FULL = 16,       /* vector: three components also in 2D */
    SB_KEY_ANY_Y = 32,      /* vector: y may differ from 0 in 2D */
    SB_KEY_UNIT = 64,       /* vector: a direction, made a unit vector */
    SB_KEY_PRESET = 128,    /* the default depends on the numerics preset */
    SB_KEY_FREE = 256,      /* changes no state, measurement or frame; not part of the identity */
    SB_KEY_LATER =
        512 /* switch, choice, number or place that did not exist at first: not part of the identity while it is
               false, its first word, 0 or (0, 0), so that checkpoints and results of earlier builds stay valid */
};

typedef struct sb_table sb_table;
typedef struct sb_reader sb_reader;

typedef struct sb_key {
    const char *name; /* NULL: a list of one item, whose keys are written directly in the parent */
    sb_key_type type;
    size_t offset, count_offset;
    const char *unit;     /* NULL: none */
    const char *fallback; /* YAML text of the default; NULL: none */
    const char *derived;  /* description of a default that table->finish computes */
    double min, max;      /* of a number and of a vector's components */
    unsigned flags;
    unsigned applies; /* bits of table->variant; 0: always */
    const char *only; /* description of these bits */
    const char *const *words;
    const sb_table *table;
    const char *doc;
} sb_key;

/* A key that there is not, but that users may expect: it is refused with the reason. */
typedef struct sb_removed_key {
    const char *name, *reason;
} sb_removed_key;

struct sb_table {
    const sb_key *keys;
    size_t count;
    const sb_removed_key *removed; /* ends with a row without a name; NULL: none */
    size_t size;                   /* of the struct, for lists */
    bool plain;                    /* an item of a list may be written as the value of the first row alone */
    /* Returns the bits of the rows that apply. They follow from the values read so far and from the keys present (map;
       NULL when writing). */
    unsigned (*variant)(const void *item, const sb_yaml *map);
    /* Computes derived defaults and checks the values together, after all rows are read. May be NULL. */
    sb_status (*finish)(sb_reader *reader, const sb_yaml *map, void *item);
};

/* Largest magnitude of a number of a scene. Products of larger ones are beyond what single precision has. */
#define SB_NUMBER_LARGEST 1e12

#define SB_KEY_ROWS(rows) .keys = (rows), .count = sizeof(rows) / sizeof *(rows)
#define SB_KEY_AT(type, member) .offset = offsetof(type, member)
#define SB_KEY_ITEMS(type, member, counter) .offset = offsetof(type, member), .count_offset = offsetof(type, counter)
#define SB_KEY_ANY .min = -HUGE_VAL, .max = HUGE_VAL
#define SB_KEY_POSITIVE .min = 0, .max = HUGE_VAL, .flags = SB_KEY_ABOVE
#define SB_KEY_NOT_NEGATIVE .min = 0, .max = HUGE_VAL

/* The table of the whole scene, and those of its blocks that are in other files. */
extern const sb_table sb_scene_table;
extern const sb_table sb_grid_paddle_table; /* the law alone of a wave maker */
extern const sb_table sb_numerics_table, sb_offshore_table, sb_wave_table, sb_water_table, sb_given_table,
    sb_body_table, sb_wavemaker_table, sb_sponge_table, sb_foam_table, sb_reflection_table;
extern const sb_table sb_measure_table, sb_render_table, sb_stream_table, sb_control_table, sb_output_table;

/* Bits of the rows that apply to this item; all bits if the table has only one variant. */
unsigned sb_table_variant(const sb_table *table, const void *item, const sb_yaml *map);

/* Whether the row applies for these bits. */
bool sb_key_applies(const sb_key *key, unsigned variant);

/* The row of that name, including the rows of lists of one; NULL if there is none. */
const sb_key *sb_table_find(const sb_table *table, const char *name);

/* The key name most similar to a misspelt one; NULL if none is similar. */
const char *sb_table_nearest(const sb_table *table, const char *name);

/* The default under that preset in a scene of that many dimensions as YAML text; NULL if the row has none. */
const char *sb_key_default(const sb_key *key, sb_preset preset, int dimensions);

/* Describes the values that the key accepts: "metres > 0", "[x, z] in metres", "wall, open or periodic". */
void sb_key_expectation(const sb_key *key, int dimensions, char *out, size_t size);

/* Describes the range only: "> 0", "2 to 3", "wall or open". */
void sb_key_range(const sb_key *key, char *out, size_t size);

/* Frees what the rows of one item own, and zeroes these pointers and counts. */
void sb_table_free(const sb_table *table, void *item);

#endif
