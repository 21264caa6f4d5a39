#include "surface/cubes.h"

#include <stdbool.h>

/* The corners of each face, counter-clockwise from outside. */
static const uint8_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

int sb_cube_edge_corner(int edge)
{
    static const uint8_t lower[SB_CUBE_EDGES] = {0, 2, 4, 6, 0, 1, 4, 5, 0, 1, 2, 3};
    return lower[edge];
}

static int edge_between(int a, int b)
{
    const int lower = a < b ? a : b, axis = (a ^ b) >> 1;
    for (int k = 0; k < 4; k++)
        if (sb_cube_edge_corner(4 * axis + k) == lower) return 4 * axis + k;
    return -1;
}

/* next[e]: the edge at the other end of the line that begins at edge e, with the water at its right as seen from
   outside of the cube. An edge with one end in the water begins one line and ends another one, -1: no line. */
static void join_edges(unsigned water, int next[SB_CUBE_EDGES])
{
    for (int e = 0; e < SB_CUBE_EDGES; e++) next[e] = -1;
    for (int f = 0; f < 6; f++)
        for (int i = 0; i < 4; i++) {
            const int a = faces[f][i], b = faces[f][(i + 1) & 3];
            if (!(water >> a & 1) || water >> b & 1) continue;
            int j = i; /* the edge where the circuit of the face leaves the water; the next one where it enters */
            do j = (j + 1) & 3;
            while (water >> faces[f][j] & 1 || !(water >> faces[f][(j + 1) & 3] & 1));
            next[edge_between(a, b)] = edge_between(faces[f][j], faces[f][(j + 1) & 3]);
        }
}

/* Whether two edges belong to one face of the cube. */
static bool share_face(int a, int b)
{
    for (int f = 0; f < 6; f++) {
        bool has[2] = {false, false};
        for (int i = 0; i < 4; i++) {
            const int e = edge_between(faces[f][i], faces[f][(i + 1) & 3]);
            has[0] |= e == a;
            has[1] |= e == b;
        }
        if (has[0] && has[1]) return true;
    }
    return false;
}

/* The best division of a polygon: cost[i][j] counts the inner edges within faces of the part from corner i to j. */
typedef struct division {
    int length, corners[SB_CUBE_EDGES];
    int cost[SB_CUBE_EDGES][SB_CUBE_EDGES], middle[SB_CUBE_EDGES][SB_CUBE_EDGES];
} division;

static void divide(division *d)
{
    for (int i = 0; i + 1 < d->length; i++) d->cost[i][i + 1] = 0;
    for (int span = 2; span < d->length; span++)
        for (int i = 0; i + span < d->length; i++) {
            const int j = i + span;
            const bool outer = i == 0 && j == d->length - 1;
            d->cost[i][j] = 1000;
            for (int k = i + 1; k < j; k++) {
                const int cost = d->cost[i][k] + d->cost[k][j];
                if (cost < d->cost[i][j]) {
                    d->cost[i][j] = cost;
                    d->middle[i][j] = k;
                }
            }
            if (!outer) d->cost[i][j] += share_face(d->corners[i], d->corners[j]);
        }
}

static void emit(const division *d, int i, int j, sb_cube_case *out)
{
    if (j - i < 2) return;
    const int k = d->middle[i][j];
    uint8_t *corners = out->corners[out->count++];
    corners[0] = (uint8_t)d->corners[i];
    corners[1] = (uint8_t)d->corners[j];
    corners[2] = (uint8_t)d->corners[k];
    emit(d, i, k, out);
    emit(d, k, j, out);
}

void sb_cube_cases(sb_cube_case cases[256])
{
    for (unsigned water = 0; water < 256; water++) {
        int next[SB_CUBE_EDGES];
        bool done[SB_CUBE_EDGES] = {false};
        cases[water].count = 0;
        join_edges(water, next);
        for (int e = 0; e < SB_CUBE_EDGES; e++) {
            if (next[e] < 0 || done[e]) continue;
            division d = {.length = 0};
            for (int at = e; !done[at]; at = next[at]) {
                done[at] = true;
                d.corners[d.length++] = at;
            }
            divide(&d);
            emit(&d, 0, d.length - 1, &cases[water]);
        }
    }
}
