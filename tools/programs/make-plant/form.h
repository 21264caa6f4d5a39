/* Closed forms as triangles: prisms, lofts and dikes. */
#ifndef SB_MAKE_PLANT_FORM_H
#define SB_MAKE_PLANT_FORM_H

#include "base/vec.h"
#include "geometry/mesh/mesh.h"

/* A mesh being built. After a failed allocation, later calls do nothing. */
typedef struct sb_form {
    sb_mesh mesh;
    size_t vertex_capacity, triangle_capacity;
    int failed;
} sb_form;

uint32_t sb_form_vertex(sb_form *form, sb_vec3 at);
void sb_form_triangle(sb_form *form, uint32_t a, uint32_t b, uint32_t c);
/* a b c d counter-clockwise seen from outside, split along a-c. */
void sb_form_quad(sb_form *form, uint32_t a, uint32_t b, uint32_t c, uint32_t d);

/* Moves the finished mesh with its name to *mesh. SB_FAILED: out of memory; *mesh is unchanged. */
sb_status sb_form_finish(sb_form *form, const char *name, sb_mesh *mesh, sb_error *error);

/* A horizontal outline, counter-clockwise from above. */
enum { SB_FORM_CORNERS = 32 };
typedef struct sb_ring {
    size_t count; /* 3..SB_FORM_CORNERS */
    double x[SB_FORM_CORNERS], y[SB_FORM_CORNERS];
    double z;
} sb_ring;

sb_ring sb_ring_rectangle(double x_min, double x_max, double y_min, double y_max, double z);
sb_ring sb_ring_circle(double x, double y, double radius, double z);

/* A solid through rings from the lowest to the highest, all with the same number of corners. The two end rings are
   closed by flat faces. Rings may be concave. */
void sb_form_loft(sb_form *form, const sb_ring *rings, size_t count);

/* A dike of trapezoidal section along a line of at least two points. Its crest is flat, at height `crest` and with the
   full `width`; sides and heads fall 1 : slope to foot[i] at point i. */
typedef struct sb_dike {
    const double (*line)[2]; /* m, the crest's axis */
    const double *foot;      /* m, lowest level at each point */
    size_t count;
    double crest, width, slope;
} sb_dike;
void sb_form_dike(sb_form *form, const sb_dike *dike);

#endif
