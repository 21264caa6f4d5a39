/* A dense grid of nodes around the water, to which particles give values and from which they take them. Nodes are half
   a cell of the search apart, in the middles of half-cells. A particle shares in the 3 x 3 x 3 (2D: 3 x 3) nodes around
   it, by quadratic B-splines; the weights of a particle sum to 1. The same bits for any number of threads. */
#ifndef SB_SIM_NODES_H
#define SB_SIM_NODES_H

#include "sim/simulation.h"

/* Nodes beyond the outermost cells: values may spread by this many nodes after a particle gave them. */
enum { SB_NODES_MARGIN = 4 };

typedef struct sb_nodes {
    int64_t low[3]; /* the first node along each axis, in half-cells from the origin of positions */
    size_t size[3]; /* number along each axis; 1 along y in 2D */
    size_t count;
    int shift;    /* half-cells are 2^shift quanta wide */
    double width; /* m, between nodes */
    bool flat;    /* 2D */
} sb_nodes;

/* The grid around the particles as the cells have them. */
sb_nodes sb_nodes_around(const sb_sim *sim);

/* Number of nodes per step along an axis. */
static inline size_t sb_nodes_stride(const sb_nodes *nodes, int axis)
{
    return axis == 0 ? 1 : axis == 1 ? nodes->size[0] : nodes->size[0] * nodes->size[1];
}

/* values[node] += weight of the node * field[i][3] * factor, over the particles of all domains, each of which has the
   same values afterwards. Returns 0, or -1 without memory. */
int sb_nodes_give(const sb_sim *sim, const sb_nodes *nodes, const sb_f4 *field, double factor, double *values);

/* The sum of weight * values[node] of particle i, for `components` <= 3 values per node. */
void sb_nodes_take(const sb_sim *sim, const sb_nodes *nodes, size_t i, const double *values, int components,
                   double sum[3]);

/* One binomial mean (1, 2, 1)/4 along each axis, of `components` values per node; 0 beyond the grid. The operator is
   symmetric and keeps the sum of what does not reach the grid's edge. spare: as many values, overwritten. */
void sb_nodes_smooth(const sb_nodes *nodes, double *values, int components, double *spare);

#endif
