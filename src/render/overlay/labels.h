/* Names at places of a scene, with lines that lead to them, over a picture. */
#ifndef SB_RENDER_LABELS_H
#define SB_RENDER_LABELS_H

#include "render/camera/camera.h"
#include "render/image/image.h"

enum { SB_LABELS_MAX = 128 };

/* The labels of one picture. A zeroed struct has none. */
typedef struct sb_labels {
    size_t count, left_out; /* left_out: those for which there was no room */
    struct {
        double x0, y0, x1, y1;
    } box[SB_LABELS_MAX]; /* px */
} sb_labels;

/* Finds the px of a place (m, scene) in a picture of the view, from its top left corner. False: it is behind the eye.
 */
bool sb_labels_project(const sb_view *view, const sb_image *image, sb_vec3 at, double *x, double *y);

/* Draws a line between two places. The part behind the eye is left out. */
void sb_labels_line(sb_image *image, const sb_view *view, sb_vec3 from, sb_vec3 to, const float rgb[3]);

/* Draws a mark at a place, and its name near it where no other label is. A place outside of the picture has none. */
sb_status sb_labels_add(sb_labels *labels, sb_image *image, const sb_view *view, sb_vec3 at, const float rgb[3],
                        const char *text, sb_error *error);

#endif
