#include "offshore/maps.h"
#include "base/memory.h"
#include "base/multiversion.h"

#include <math.h>

struct sb_offshore_maps {
    size_t columns, rows;
    float threshold;
    float *depth, *speed, *flux, *arrival, *duration, *start;
};

enum { ARRAYS = 6 };

static void find_arrays(sb_offshore_maps *maps, float **arrays[ARRAYS])
{
    float **const all[] = {&maps->depth, &maps->speed, &maps->flux, &maps->arrival, &maps->duration, &maps->start};
    for (size_t k = 0; k < ARRAYS; k++) arrays[k] = all[k];
}

void sb_offshore_maps_destroy(sb_offshore_maps *maps)
{
    if (!maps) return;
    float **arrays[ARRAYS];
    find_arrays(maps, arrays);
    for (size_t k = 0; k < ARRAYS; k++) sb_free(*arrays[k]);
    sb_free(maps);
}

typedef struct line {
    const double *h, *hu, *hv;
    float *depth, *speed, *flux, *arrival, *duration;
    const float *start;
} line;

/* The greater one. */
SB_INLINE float greater(float old, float value)
{
    return old > value ? old : value;
}

SB_MULTIVERSION static void record_line(line l, float threshold, float time, float taken, size_t count)
{
#pragma omp simd
    for (size_t i = 0; i < count; i++) {
        const float h = (float)l.h[i], square = (float)(l.hu[i] * l.hu[i] + l.hv[i] * l.hv[i]);
        const float deep = h >= threshold ? h : 1, flux = square / deep;
        const float none = -1; /* below all values: leaves what is there */
        const float depth = greater(l.depth[i], h > 0 ? h : none);
        const float speed = greater(l.speed[i], h >= threshold ? sqrtf(square) / deep : none);
        const float highest = greater(l.flux[i], h >= threshold ? flux : none);
        const float arrival = l.arrival[i] >= 0 ? l.arrival[i] : h - l.start[i] >= threshold ? time : none;
        l.depth[i] = depth;
        l.speed[i] = speed;
        l.flux[i] = highest;
        l.arrival[i] = arrival;
        l.duration[i] += h >= threshold && !(l.start[i] >= threshold) ? taken : 0;
    }
}

void sb_offshore_maps_step(sb_offshore_maps *maps, const sb_offshore *offshore, double taken)
{
    const sb_offshore_view v = sb_offshore_read(offshore);
#pragma omp parallel for schedule(static) if (v.columns * v.rows > 20000)
    for (size_t j = 0; j < v.rows; j++) {
        const size_t to = j * v.columns, from = j * v.stride;
        const line l = {v.h + from,      v.hu + from,        v.hv + from,         maps->depth + to, maps->speed + to,
                        maps->flux + to, maps->arrival + to, maps->duration + to, maps->start + to};
        record_line(l, maps->threshold, (float)v.time, (float)taken, v.columns);
    }
}

sb_status sb_offshore_maps_create(const sb_offshore *offshore, double threshold, sb_offshore_maps **maps,
                                  sb_error *error)
{
    const sb_offshore_view v = sb_offshore_read(offshore);
    sb_offshore_maps *made = sb_alloc(1, sizeof *made);
    if (!made) return sb_fail_memory(error, "maps");
    *made = (sb_offshore_maps){.columns = v.columns, .rows = v.rows, .threshold = (float)threshold};
    float **arrays[ARRAYS];
    find_arrays(made, arrays);
    for (size_t k = 0; k < ARRAYS; k++) {
        *arrays[k] = sb_alloc(v.columns * v.rows, sizeof(float));
        if (!*arrays[k]) {
            sb_offshore_maps_destroy(made);
            return sb_fail_memory(error, "maps");
        }
        for (size_t i = 0; i < v.columns * v.rows && k < 4; i++) (*arrays[k])[i] = -1;
    }
    for (size_t j = 0; j < v.rows; j++)
        for (size_t i = 0; i < v.columns; i++) made->start[j * v.columns + i] = (float)v.h[j * v.stride + i];
    sb_offshore_maps_step(made, offshore, 0);
    *maps = made;
    return SB_OK;
}

sb_offshore_map_view sb_offshore_maps_read(const sb_offshore_maps *maps)
{
    return (sb_offshore_map_view){.columns = maps->columns,
                                  .rows = maps->rows,
                                  .depth = maps->depth,
                                  .speed = maps->speed,
                                  .flux = maps->flux,
                                  .arrival = maps->arrival,
                                  .duration = maps->duration};
}

void sb_offshore_maps_save(const sb_offshore_maps *maps, sb_archive_out *out)
{
    sb_offshore_maps copy = *maps;
    float **arrays[ARRAYS];
    find_arrays(&copy, arrays);
    for (size_t k = 0; k < ARRAYS; k++) sb_put_list(out, *arrays[k], maps->columns * maps->rows, sizeof(float));
}

void sb_offshore_maps_load(sb_offshore_maps *maps, sb_archive_in *in)
{
    const size_t cells = maps->columns * maps->rows;
    float **arrays[ARRAYS];
    find_arrays(maps, arrays);
    for (size_t k = 0; k < ARRAYS; k++) {
        sb_take_list(in, *arrays[k], cells, sizeof(float));
        for (size_t i = 0; i < cells; i++)
            if (!isfinite((*arrays[k])[i])) {
                sb_archive_refuse(in, "a map of the depth-averaged water has the value %g, expected finite ones",
                                  (double)(*arrays[k])[i]);
                return;
            }
    }
}

size_t sb_offshore_maps_bytes(size_t cells)
{
    return ARRAYS * cells * sizeof(float);
}
