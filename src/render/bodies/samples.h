/* A picture of boundary particles, coloured by how densely they lie on their surface. */
#ifndef SB_RENDER_SAMPLES_H
#define SB_RENDER_SAMPLES_H

#include "geometry/model/model.h"
#include "render/camera/camera.h"
#include "render/image/image.h"

/* Finds for each boundary particle how many there are around it: the sum of (1 - (r/R)^2)^2 over those nearer than R =
   2 spacings, itself included, divided by that sum on a plane (a line in 2D) with one particle per square (length) of
   the spacing. spacing: of boundary particles, m. `density` has model->wall_count numbers. SB_FAILED without memory.
 */
sb_status sb_samples_density(const sb_model *model, double spacing, float *density, sb_error *error);

/* Draws the particles that face the camera (all in 2D) as discs of one spacing over a plain ground, nearer ones before
   others, with a legend of the colours from 0.5 to 1.5. The image has its size already. */
sb_status sb_samples_draw(const sb_model *model, const float *density, const sb_view *view, sb_image *image,
                          sb_error *error);

#endif
