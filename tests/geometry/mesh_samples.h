/* Small valid files of every mesh format, and the check of an import of a damaged one. */
#ifndef SB_TESTS_MESH_SAMPLES_H
#define SB_TESTS_MESH_SAMPLES_H

#include "geometry/mesh/mesh.h"

typedef struct sample_text {
    char bytes[16384];
    size_t length;
} sample_text;

typedef struct sample_format {
    const char *name; /* of the file */
    void (*make)(sample_text *to);
    size_t mesh_count;
} sample_format;

enum { SAMPLE_FORMATS = 7 };
extern const sample_format sample_formats[SAMPLE_FORMATS];

/* Files that tests modify: two cubes; one cube; one cube at a height of 7 m. */
void sample_make_obj(sample_text *to);
void sample_make_stl_binary(sample_text *to);
void sample_make_dae(sample_text *to);

/* Frees the result of sb_mesh_import. */
void sample_free(sb_mesh *meshes, size_t count);

typedef enum sample_outcome { SAMPLE_SOUND, SAMPLE_REFUSED, SAMPLE_WRONG } sample_outcome;

/* SOUND: valid meshes, which are freed here. REFUSED: bad input with a message of one line that begins with the
   path. WRONG: anything else. */
sample_outcome sample_judge(const char *path, sb_status status, sb_mesh *meshes, size_t count, const sb_error *why);

#endif
