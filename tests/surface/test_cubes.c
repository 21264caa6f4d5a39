/* The table of marching cubes. */
#include "../check.h"
#include "surface/cubes.h"

#include <string.h>

static sb_cube_case cases[256];

static int ends_of(int edge, int end)
{
    return sb_cube_edge_corner(edge) + (end ? 1 << edge / 4 : 0);
}

/* Corners are exactly the edges with one end in the water, and every inner edge has two triangles. */
static void every_case_is_complete(void **state)
{
    (void)state;
    for (unsigned water = 0; water < 256; water++) {
        bool used[SB_CUBE_EDGES] = {false};
        int times[SB_CUBE_EDGES][SB_CUBE_EDGES] = {{0}};
        for (int t = 0; t < cases[water].count; t++)
            for (int k = 0; k < 3; k++) {
                const int a = cases[water].corners[t][k], b = cases[water].corners[t][(k + 1) % 3];
                used[a] = true;
                assert_int_equal(times[a][b]++, 0);
            }
        for (int e = 0; e < SB_CUBE_EDGES; e++)
            assert_int_equal(used[e], (water >> ends_of(e, 0) & 1) != (water >> ends_of(e, 1) & 1));
        assert_true(cases[water].count <= 5);
    }
}

/* The common face of two edges as axis and side, 2 axis + side, or -1. */
static int common_face(int a, int b)
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            bool in = true;
            for (int end = 0; end < 2; end++)
                in &= (ends_of(a, end) >> axis & 1) == side && (ends_of(b, end) >> axis & 1) == side;
            if (in) return 2 * axis + side;
        }
    return -1;
}

/* The lines of a case within a face as bits: line from edge a to edge b. */
static void lines_of(unsigned water, int face, bool lines[SB_CUBE_EDGES][SB_CUBE_EDGES])
{
    memset(lines, 0, SB_CUBE_EDGES * SB_CUBE_EDGES * sizeof(bool));
    for (int t = 0; t < cases[water].count; t++)
        for (int k = 0; k < 3; k++) {
            const int a = cases[water].corners[t][k], b = cases[water].corners[t][(k + 1) % 3];
            if (common_face(a, b) == face) lines[a][b] = true;
        }
}

/* An edge of the lower face along `axis` as an edge of the upper face. */
static int shifted(int edge, int axis)
{
    for (int e = 0; e < SB_CUBE_EDGES; e++)
        if (e / 4 == edge / 4 && sb_cube_edge_corner(e) == (sb_cube_edge_corner(edge) | 1 << axis)) return e;
    return -1;
}

/* Two cubes that share a face have the same lines there, in opposite directions. This finds holes, and triangles with
   an inner edge in a face. */
static void neighbours_agree(void **state)
{
    (void)state;
    for (int axis = 0; axis < 3; axis++)
        for (unsigned one = 0; one < 256; one++)
            for (unsigned other = 0; other < 256; other++) {
                bool upper[SB_CUBE_EDGES][SB_CUBE_EDGES], lower[SB_CUBE_EDGES][SB_CUBE_EDGES], same = true;
                for (int c = 0; c < 8; c++)
                    if (!(c >> axis & 1)) same &= (other >> c & 1) == (one >> (c | 1 << axis) & 1);
                if (!same) continue;
                lines_of(one, 2 * axis + 1, upper);
                lines_of(other, 2 * axis, lower);
                for (int a = 0; a < SB_CUBE_EDGES; a++)
                    for (int b = 0; b < SB_CUBE_EDGES; b++)
                        if (lower[a][b]) assert_true(upper[shifted(b, axis)][shifted(a, axis)]);
                int balance = 0;
                for (int a = 0; a < SB_CUBE_EDGES * SB_CUBE_EDGES; a++)
                    balance += (&upper[0][0])[a] - (&lower[0][0])[a];
                assert_int_equal(balance, 0);
            }
}

int main(void)
{
    sb_cube_cases(cases);
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_case_is_complete), cmocka_unit_test(neighbours_agree)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
