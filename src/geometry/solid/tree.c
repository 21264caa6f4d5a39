/* Builds the bounding-volume tree of a mesh by median splits. */
#include "geometry/solid/tree.h"

#include "base/memory.h"

typedef struct item {
    double center[3];
    uint32_t triangle;
} item;

typedef struct builder {
    const sb_mesh *mesh;
    item *items;
    sb_solid *solid;
    uint32_t node_count;
} builder;

/* Ties are resolved by number, so that the order of equal centres does not depend on the sort. */
static bool before(const item *a, const item *b, int axis)
{
    return a->center[axis] < b->center[axis] || (a->center[axis] == b->center[axis] && a->triangle < b->triangle);
}

/* Quickselect: moves the element of rank k of [0, count) to its place and smaller elements before it. */
static void select_rank(item *items, size_t count, size_t k, int axis)
{
    size_t low = 0, high = count - 1;
    while (low < high) {
        const item pivot = items[low + (high - low) / 2];
        size_t i = low, j = high;
        for (;;) {
            while (before(&items[i], &pivot, axis)) ++i;
            while (before(&pivot, &items[j], axis)) --j;
            if (i >= j) break;
            item swapped = items[i];
            items[i++] = items[j];
            items[j--] = swapped;
        }
        if (k <= j)
            high = j;
        else
            low = j + 1;
    }
}

static int widest_axis(const item *items, size_t count)
{
    double low[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, high[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < count; ++i)
        for (int axis = 0; axis < 3; ++axis) {
            double at = items[i].center[axis];
            low[axis] = at < low[axis] ? at : low[axis];
            high[axis] = at > high[axis] ? at : high[axis];
        }
    int widest = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (high[axis] - low[axis] > high[widest] - low[widest]) widest = axis;
    return widest;
}

static void fill_leaf(builder *b, sb_solid_node *node, size_t begin, size_t count)
{
    node->first = (uint32_t)begin;
    node->count = (uint32_t)count;
    node->min = sb_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    node->max = sb_vec(-HUGE_VAL, -HUGE_VAL, -HUGE_VAL);
    for (size_t i = begin; i < begin + count; ++i) {
        const uint32_t *corner = b->mesh->triangles[b->items[i].triangle];
        const sb_vec3 *at = b->mesh->vertices;
        sb_solid_triangle t = {at[corner[0]], at[corner[1]], at[corner[2]]};
        b->solid->triangles[i] = t;
        node->min = sb_min(node->min, sb_min(t.a, sb_min(t.b, t.c)));
        node->max = sb_max(node->max, sb_max(t.a, sb_max(t.b, t.c)));
    }
}

/* Builds the node of items [begin, begin + count) and its descendants; the depth is log2(count). */
static uint32_t build_node(builder *b, size_t begin, size_t count)
{
    uint32_t self = b->node_count++;
    sb_solid_node *node = b->solid->nodes + self;
    if (count <= SB_SOLID_LEAF) {
        fill_leaf(b, node, begin, count);
        return self;
    }
    /* The left child gets a whole number of leaves, so that all leaves except the last are full. */
    size_t leaves = (count + SB_SOLID_LEAF - 1) / SB_SOLID_LEAF;
    size_t half = leaves / 2 * SB_SOLID_LEAF;
    select_rank(b->items + begin, count, half, widest_axis(b->items + begin, count));
    const sb_solid_node *left = b->solid->nodes + build_node(b, begin, half);
    uint32_t right = build_node(b, begin + half, count - half);
    node->first = right;
    node->count = 0;
    node->min = sb_min(left->min, b->solid->nodes[right].min);
    node->max = sb_max(left->max, b->solid->nodes[right].max);
    return self;
}

static sb_status check_mesh(const sb_mesh *mesh, sb_error *error)
{
    if (mesh->triangle_count == 0 || mesh->triangle_count > UINT32_MAX / 2)
        return sb_fail(error, SB_BAD_INPUT, "mesh \"%s\": %zu triangles, expected 1 to 2^31", mesh->name,
                       mesh->triangle_count);
    for (size_t i = 0; i < mesh->vertex_count; ++i)
        if (!sb_isfinite(mesh->vertices[i]))
            return sb_fail(error, SB_BAD_INPUT, "mesh \"%s\": vertex %zu is not finite", mesh->name, i);
    for (size_t i = 0; i < mesh->triangle_count; ++i)
        for (int corner = 0; corner < 3; ++corner)
            if (mesh->triangles[i][corner] >= mesh->vertex_count)
                return sb_fail(error, SB_BAD_INPUT, "mesh \"%s\": triangle %zu has vertex %u, expected below %zu",
                               mesh->name, i, mesh->triangles[i][corner], mesh->vertex_count);
    return SB_OK;
}

sb_status sb_solid_build_tree(sb_solid *solid, sb_error *error)
{
    const sb_mesh *mesh = solid->mesh;
    sb_status status = check_mesh(mesh, error);
    if (status != SB_OK) return status;
    size_t count = mesh->triangle_count;
    size_t leaves = (count + SB_SOLID_LEAF - 1) / SB_SOLID_LEAF;
    builder b = {.mesh = mesh, .solid = solid};
    b.items = sb_alloc_untouched(count, sizeof *b.items);
    solid->triangles = sb_alloc_untouched(count, sizeof *solid->triangles);
    solid->nodes = sb_alloc_untouched(2 * leaves - 1, sizeof *solid->nodes);
    solid->dipoles = sb_alloc_untouched(2 * leaves - 1, sizeof *solid->dipoles);
    if (!b.items || !solid->triangles || !solid->nodes || !solid->dipoles) {
        sb_free(b.items);
        return sb_fail_memory(error, "the search tree of a mesh");
    }
    for (size_t i = 0; i < count; ++i) {
        const uint32_t *corner = mesh->triangles[i];
        const sb_vec3 *at = mesh->vertices;
        sb_vec3 low = sb_min(at[corner[0]], sb_min(at[corner[1]], at[corner[2]]));
        sb_vec3 high = sb_max(at[corner[0]], sb_max(at[corner[1]], at[corner[2]]));
        sb_vec3 center = sb_add(sb_scale(low, 0.5), sb_scale(high, 0.5));
        b.items[i] = (item){{center.x, center.y, center.z}, (uint32_t)i};
    }
    build_node(&b, 0, count);
    sb_free(b.items);
    return SB_OK;
}
