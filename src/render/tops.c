/* Finds the outermost water of each cell. */
#include "render/tops.h"

#include "base/memory.h"

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
    made.texture = sb_texture_create(GL_R32F, side, side, GL_RED, GL_FLOAT, made.top, GL_NEAREST);
    *tops = made;
    return SB_OK;
}

void sb_tops_destroy(sb_tops *tops)
{
    sb_gl.DeleteTextures(1, &tops->texture);
    sb_free(tops->top);
    sb_free(tops->areas);
    *tops = (sb_tops){0};
}

void sb_tops_clear(sb_tops *tops)
{
    for (size_t i = 0; i < (size_t)tops->side * (size_t)tops->side; i++) tops->top[i] = SB_TOPS_DRY;
}

static float row_of(const float row[4], const float *p)
{
    return row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
}

void sb_tops_add(sb_tops *tops, const sb_frame *frame, const sb_density *density, float least, float map[3][4])
{
    const float side = (float)tops->side;
    for (size_t i = 0; i < frame->count; i++) {
        const float *p = frame->position + 3 * i;
        const float x = side * row_of(map[0], p), y = side * row_of(map[1], p);
        if (!(x >= 0 && x < side && y >= 0 && y < side)) continue;
        float *top = &tops->top[(size_t)y * (size_t)tops->side + (size_t)x];
        const float height = row_of(map[2], p);
        /* The density is read only for the few particles that are above the earlier ones. */
        if (height > *top && sb_density_at(density, p[0], p[1], p[2]) > least) *top = height;
    }
}

static void upload(const sb_tops *tops, const float *values)
{
    sb_gl.BindTexture(GL_TEXTURE_2D, tops->texture);
    sb_gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R32F, tops->side, tops->side, 0, GL_RED, GL_FLOAT, values);
}

void sb_tops_upload(const sb_tops *tops)
{
    upload(tops, tops->top);
}

/* The number of cells with water in and around a cell. */
static int wet_around(const sb_tops *tops, int x, int y)
{
    const int last = tops->side - 1;
    int wet = 0;
    for (int v = y > 0 ? y - 1 : y; v <= y + 1 && v <= last; v++)
        for (int u = x > 0 ? x - 1 : x; u <= x + 1 && u <= last; u++)
            wet += tops->top[(size_t)v * (size_t)tops->side + (size_t)u] > SB_TOPS_DRY;
    return wet;
}

sb_status sb_tops_upload_areas(sb_tops *tops, sb_error *error)
{
    const int side = tops->side;
    if (!tops->areas) tops->areas = sb_alloc_untouched((size_t)side * (size_t)side, sizeof *tops->areas);
    if (!tops->areas) return sb_fail_memory(error, "a map of the water");
    for (int y = 0; y < side; y++)
        for (int x = 0; x < side; x++) {
            const size_t cell = (size_t)y * (size_t)side + (size_t)x;
            const float top = tops->top[cell];
            tops->areas[cell] = top > SB_TOPS_DRY && wet_around(tops, x, y) < 4 ? SB_TOPS_DRY : top;
        }
    upload(tops, tops->areas);
    return SB_OK;
}
