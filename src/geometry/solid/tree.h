/* The bounding-volume tree over the triangles of a sb_solid, in a flat array. Private to src/geometry/solid*.c. */
#ifndef SB_GEOMETRY_SOLID_TREE_H
#define SB_GEOMETRY_SOLID_TREE_H

#include "geometry/solid/solid.h"

/* Median splits keep the depth below 32 for any number that a uint32_t can hold. */
enum { SB_SOLID_LEAF = 4, SB_SOLID_STACK = 64 };

typedef struct sb_solid_triangle {
    sb_vec3 a, b, c;
} sb_solid_triangle;

/* A node. Nodes are in depth-first order, so the left child follows its parent. count > 0: a leaf with triangles
   [first, first + count); otherwise first is the right child. */
typedef struct sb_solid_node {
    sb_vec3 min, max;
    uint32_t first, count;
} sb_solid_node;

/* A node seen from far away: area vector in m^2 at its area-weighted centre, and the radius of a ball around that
   centre which contains the node. */
typedef struct sb_solid_dipole {
    sb_vec3 center, area;
    double radius;
} sb_solid_dipole;

struct sb_solid {
    const sb_mesh *mesh;
    sb_role role;
    bool open_surface;            /* an open surface: inside means behind its normals */
    bool closed;                  /* watertight: the winding number is an integer and is counted instead of summed */
    sb_solid_triangle *triangles; /* in leaf order */
    sb_solid_node *nodes;
    sb_solid_dipole *dipoles; /* one per node */
};

/* Fills triangles and nodes from the mesh. The tree is the same in every run. */
sb_status sb_solid_build_tree(sb_solid *solid, sb_error *error);

/* Fills dipoles from the tree. Returns the total area in m^2. */
double sb_solid_build_dipoles(sb_solid *solid);

/* Half the cross product of two edges: area times unit normal. */
static inline sb_vec3 sb_solid_area_vector(const sb_solid_triangle *t)
{
    return sb_scale(sb_cross(sb_sub(t->b, t->a), sb_sub(t->c, t->a)), 0.5);
}

/* Returns the point of the triangle nearest to p. */
sb_vec3 sb_solid_nearest_on(const sb_solid_triangle *t, sb_vec3 p);

/* Returns the squared distance from p to a node's box. */
static inline double sb_solid_box_distance2(const sb_solid_node *node, sb_vec3 p)
{
    sb_vec3 outside = sb_max(sb_sub(node->min, p), sb_sub(p, node->max));
    outside = sb_max(outside, sb_vec(0, 0, 0));
    return sb_dot(outside, outside);
}

/* Whether the point is behind the angle-weighted normal at the nearest point [Baerentzen, Aanaes 2005]; for open
   surfaces. */
bool sb_solid_behind(const sb_solid *solid, sb_vec3 point);

#endif
