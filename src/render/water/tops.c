/* Finds the outermost water of each cell. */
#include "render/water/tops.h"

#include "base/memory.h"

#include <math.h>
#include <stdbool.h>

/* The means of four values, weighted so that they have no steps between cells. */
const char sb_tops_source[] =
    "float between(sampler2D map, vec2 at, float from, float width) {\n"
    "  vec2 p = at * vec2(textureSize(map, 0)) - 0.5;\n"
    "  ivec2 low = ivec2(floor(p)), last = textureSize(map, 0) - 1;\n"
    "  vec2 s = smoothstep(0.0, 1.0, p - vec2(low));\n"
    "  ivec2 a = clamp(low, ivec2(0), last), b = clamp(low + 1, ivec2(0), last);\n"
    "  vec4 tops = vec4(texelFetch(map, a, 0).x, texelFetch(map, ivec2(b.x, a.y), 0).x,\n"
    "                   texelFetch(map, ivec2(a.x, b.y), 0).x, texelFetch(map, b, 0).x);\n"
    "  vec4 over = width > 0.0 ? clamp((tops - from) / width, 0.0, 1.0) : step(from, tops);\n"
    "  return mix(mix(over.x, over.y, s.x), mix(over.z, over.w, s.x), s.y);\n"
    "}\n"
    "float above(sampler2D map, vec2 at, float height) { return between(map, at, height, 0.0); }\n"
    "float shading(sampler2D map, vec2 at, float height, float bias) {\n"
    "  return between(map, at, height + 0.5 * bias, 2.5 * bias);\n"
    "}\n";

sb_status sb_tops_create(int side, sb_tops *tops, sb_error *error)
{
    sb_tops made = {.side = side};
    made.top = sb_alloc((size_t)side * (size_t)side, sizeof *made.top);
    if (!made.top) return sb_fail_memory(error, "a map of the water");
    sb_tops_clear(&made);
    *tops = made;
    return SB_OK;
}

void sb_tops_free(sb_tops *tops)
{
    sb_free(tops->top);
    sb_free(tops->now);
    *tops = (sb_tops){0};
}

static size_t cells_of(const sb_tops *tops)
{
    return (size_t)tops->side * (size_t)tops->side;
}

static void dry(float *cells, size_t count)
{
    for (size_t i = 0; i < count; i++) cells[i] = SB_TOPS_DRY;
}

void sb_tops_clear(sb_tops *tops)
{
    dry(tops->top, cells_of(tops));
}

static float row_of(const float row[4], const float *p)
{
    return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
}

static void raise_cells(float *cells, int count, const sb_frame *frame, const sb_density *density, float least,
                        float map[3][4])
{
    const float side = (float)count;
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        const float x = side * row_of(map[0], p), y = side * row_of(map[1], p);
        if (!(x >= 0 && x < side && y >= 0 && y < side)) continue;
        float *top = &cells[(size_t)y * (size_t)count + (size_t)x];
        const float height = row_of(map[2], p);
        /* The density is read only for the few particles that are above the earlier ones. */
        if (height > *top && sb_density_at(density, p[0], p[1], p[2]) > least) *top = height;
    }
}

void sb_tops_add(sb_tops *tops, const sb_frame *frame, const sb_density *density, float least, float map[3][4])
{
    raise_cells(tops->top, tops->side, frame, density, least, map);
}

sb_status sb_tops_add_areas(sb_tops *tops, const sb_frame *frame, const sb_density *density, float least,
                            float map[3][4], sb_error *error)
{
    const size_t side = (size_t)tops->side;
    if (!tops->now) tops->now = sb_alloc_untouched(cells_of(tops), sizeof *tops->now);
    if (!tops->now) return sb_fail_memory(error, "a map of the water");
    dry(tops->now, cells_of(tops));
    raise_cells(tops->now, tops->side, frame, density, least, map);
    for (size_t y = 0; y + 1 < side; y++)
        for (size_t x = 0; x + 1 < side; x++) {
            const size_t low = y * side + x, block[4] = {low, low + 1, low + side, low + side + 1};
            bool full = true;
            for (int c = 0; c < 4; c++) full = full && tops->now[block[c]] > SB_TOPS_DRY;
            for (int c = 0; full && c < 4; c++) tops->top[block[c]] = fmaxf(tops->top[block[c]], tops->now[block[c]]);
        }
    return SB_OK;
}
