/* The highest water so far, as seen from above: what wet ground and the greatest depth of pictures remember from frame
   to frame. It needs no OpenGL: renderers share it one after the other, and checkpoints hold it. */
#ifndef SB_RENDER_REACHED_H
#define SB_RENDER_REACHED_H

#include "base/archive.h"
#include "geometry/model/model.h"
#include "render/water/tops.h"
#include "scene/scene.h"

/* A zeroed struct has no water yet, and no memory. */
typedef struct sb_reached {
    sb_tops tops;     /* heights in m above the model's lowest corner */
    double time;      /* s, of the frame that was added last */
    uint64_t changes; /* how often it has changed; 0: no frame was added */
} sb_reached;

/* Whether pictures of the scene show it. */
bool sb_reached_shown(const sb_scene *scene);

/* Cells on each side of the map in pictures of this size (m, as sb_light.size). */
int sb_reached_side(double size, double spacing);

/* Adds the water of a frame, in three dimensions (flat is false) without drops and rows of particles. The frame that
   was added last is not added again, and one that is earlier begins the map anew. map: as for sb_tops_add.
   SB_BAD_INPUT: it has water already with another number of cells than `side`. */
sb_status sb_reached_add(sb_reached *reached, int side, const sb_frame *frame, const sb_density *density, bool flat,
                         float map[3][4], sb_error *error);

/* Write and read it within a section of an archive. The map that is read must have the size of those of this scene and
   model. SB_FAILED: no memory. */
void sb_reached_save(const sb_reached *reached, sb_archive_out *out);
sb_status sb_reached_load(sb_reached *reached, const sb_scene *scene, const sb_model *model, sb_archive_in *in,
                          sb_error *error);

void sb_reached_free(sb_reached *reached);

#endif
