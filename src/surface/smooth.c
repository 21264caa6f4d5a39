#include "surface/smooth.h"

#include "base/memory.h"

#include <math.h>

/* Factors of the shrinking and the growing half of a round. Features longer than about five edges pass unchanged. */
static const float shrink = 0.5F, grow = -0.53F;

enum { ROUNDS_PER_MOVE = 2, LAST_MOVES = 3 }; /* corrections of volume between rounds, and after the last one */

/* The triangles around each vertex: their other two corners, counter-clockwise. */
typedef struct work {
    sb_water_mesh *mesh;
    uint32_t *begin; /* of each vertex's triangles, and the end */
    uint32_t (*other)[2];
    float (*moved)[3];
    const sb_waters *waters;
    double spacing;     /* m */
    double *now, *area; /* of each water: m^3, then the way of the next move in m; m^2 / 3 */
} work;

static sb_status list_triangles(work *w, sb_error *error)
{
    const sb_water_mesh *mesh = w->mesh;
    w->begin = sb_alloc(mesh->vertices + 2, sizeof *w->begin);
    w->other = sb_alloc_untouched(3 * mesh->triangles, sizeof *w->other);
    w->moved = sb_alloc_untouched(mesh->vertices, sizeof *w->moved);
    w->now = sb_alloc(w->waters->count, sizeof *w->now);
    w->area = sb_alloc(w->waters->count, sizeof *w->area);
    if (!w->begin || !w->other || !w->moved || !w->now || !w->area) return sb_fail_memory(error, "smoothing a surface");
    uint32_t *next =
        w->begin + 1; /* next[v]: where the next triangle of v goes; at the end, where those of v + 1 begin */
    for (size_t t = 0; t < mesh->triangles; t++)
        for (int k = 0; k < 3; k++) next[mesh->corner[t][k] + 1]++;
    for (size_t v = 0; v < mesh->vertices; v++) next[v + 1] += next[v];
    for (size_t t = 0; t < mesh->triangles; t++)
        for (int k = 0; k < 3; k++) {
            uint32_t *at = w->other[next[mesh->corner[t][k]]++];
            at[0] = mesh->corner[t][(k + 1) % 3];
            at[1] = mesh->corner[t][(k + 2) % 3];
        }
    return SB_OK;
}

/* Moves each vertex towards the mean of its neighbours by a part of the way. */
static void filter(work *w, float part)
{
    float(*position)[3] = w->mesh->position;
#pragma omp parallel for schedule(static)
    for (size_t v = 0; v < w->mesh->vertices; v++) {
        float mean[3] = {0};
        for (uint32_t i = w->begin[v]; i < w->begin[v + 1]; i++)
            for (int a = 0; a < 3; a++) mean[a] += position[w->other[i][0]][a] - position[v][a];
        const float scale = part / (float)(w->begin[v + 1] - w->begin[v]);
        for (int a = 0; a < 3; a++) w->moved[v][a] = position[v][a] + scale * mean[a];
    }
    w->mesh->position = w->moved;
    w->moved = position;
}

/* Sets the normals to the sums of the area vectors of the triangles around each vertex. */
static void sum_areas(work *w)
{
    float(*position)[3] = w->mesh->position;
#pragma omp parallel for schedule(static)
    for (size_t v = 0; v < w->mesh->vertices; v++) {
        float sum[3] = {0};
        for (uint32_t i = w->begin[v]; i < w->begin[v + 1]; i++) {
            float b[3], c[3];
            for (int a = 0; a < 3; a++) {
                b[a] = position[w->other[i][0]][a] - position[v][a];
                c[a] = position[w->other[i][1]][a] - position[v][a];
            }
            for (int a = 0; a < 3; a++)
                sum[a] += 0.5F * (b[(a + 1) % 3] * c[(a + 2) % 3] - b[(a + 2) % 3] * c[(a + 1) % 3]);
        }
        for (int a = 0; a < 3; a++) w->mesh->normal[v][a] = sum[a];
    }
}

static double length_of(const float v[3])
{
    return sqrt((double)v[0] * (double)v[0] + (double)v[1] * (double)v[1] + (double)v[2] * (double)v[2]);
}

/* The volumes of the waters from the area vectors: the derivative of the volume by the place of a vertex is a third of
   its area vector A, and the volume is of third degree in the places x, so that it is the sum of A . x / 9. */
static void measure(work *w)
{
    const sb_water_mesh *mesh = w->mesh;
    for (size_t k = 0; k < w->waters->count; k++) w->now[k] = w->area[k] = 0;
    for (size_t v = 0; v < mesh->vertices; v++) {
        const uint32_t water = w->waters->water[v];
        const float *at = mesh->position[v], *from = mesh->position[w->waters->first[water]], *area = mesh->normal[v];
        for (int a = 0; a < 3; a++) w->now[water] += (double)area[a] * ((double)at[a] - (double)from[a]) / 9;
        w->area[water] += length_of(area) / 3;
    }
}

/* Moves the surfaces of each water along their normals, so that it has the volume of its particles, to first order. */
static void restore(work *w, double most)
{
    const double particle = w->spacing * w->spacing * w->spacing;
    sum_areas(w);
    measure(w);
    for (size_t k = 0; k < w->waters->count; k++) {
        const double wanted = particle * w->waters->particles[k];
        const double way = wanted > 0 && w->area[k] > 0 ? (wanted - w->now[k]) / w->area[k] : 0;
        w->now[k] = fmin(fmax(way, -most), most);
    }
#pragma omp parallel for schedule(static)
    for (size_t v = 0; v < w->mesh->vertices; v++) {
        const double length = length_of(w->mesh->normal[v]), way = w->now[w->waters->water[v]];
        for (int a = 0; a < 3 && length > 0; a++)
            w->mesh->position[v][a] += (float)(way * (double)w->mesh->normal[v][a] / length);
    }
}

static void set_normals(work *w)
{
    sum_areas(w);
#pragma omp parallel for schedule(static)
    for (size_t v = 0; v < w->mesh->vertices; v++) {
        const double length = length_of(w->mesh->normal[v]);
        for (int a = 0; a < 3; a++)
            w->mesh->normal[v][a] = length > 0 ? (float)((double)w->mesh->normal[v][a] / length) : (float)(a == 2);
    }
}

sb_status sb_water_mesh_smooth(sb_water_mesh *mesh, const sb_waters *waters, double spacing, int rounds, double most,
                               sb_error *error)
{
    work w = {.mesh = mesh, .waters = waters, .spacing = spacing};
    sb_status status = list_triangles(&w, error);
    if (status == SB_OK) {
        for (int r = 0; r < rounds; r++) {
            filter(&w, shrink);
            filter(&w, grow);
            if (r % ROUNDS_PER_MOVE == 0) restore(&w, most);
        }
        for (int r = 0; r < LAST_MOVES; r++) restore(&w, most);
        set_normals(&w);
    }
    sb_free(w.begin);
    sb_free(w.other);
    sb_free(w.moved);
    sb_free(w.now);
    sb_free(w.area);
    return status;
}
