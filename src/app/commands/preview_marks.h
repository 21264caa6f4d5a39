/* What `shorebreak preview` draws over its pictures: the domain, and the names of bodies, wave makers and measuring
   places. Private to src/app. */
#ifndef SB_APP_PREVIEW_MARKS_H
#define SB_APP_PREVIEW_MARKS_H

#include "geometry/model/model.h"
#include "render/camera/camera.h"
#include "render/image/image.h"

enum { SB_MARK_BODIES = 1, SB_MARK_PLACES = 2 /* of measurements */ };

/* Draws the domain, the wave makers, and what `marks` names into a picture of the view. *left_out is the number of
   names for which there was no room. */
sb_status sb_preview_marks(const sb_scene *scene, const sb_model *model, unsigned marks, const sb_view *view,
                           sb_image *image, size_t *left_out, sb_error *error);

/* Draws the outlines of the facets of walls that reflect water. */
void sb_preview_facets(const sb_model *model, const sb_view *view, sb_image *image);

#endif
