/* The water of a grid over ground that is not the grid's: walls between the centres of its cells, and land. */
#include "grid_case.h"

#include "base/random.h"
#include "offshore/motion.h"

#include <stdio.h>

enum { COLUMNS = 12, ROWS = 9, PLACES = 20000 };

static const double G = 9.81, CELL = 10, DRY = 1e-3;

/* Water, quays and houses: about a half of the cells are land. */
static double town(double x, double y)
{
    const uint64_t cell = (uint64_t)(x / CELL) + COLUMNS * (uint64_t)(y / CELL);
    const double kind = sb_random(1, cell);
    return kind < 0.5 ? -8 * sb_random(2, cell) : kind < 0.8 ? 4.5 : 20 + 20 * sb_random(2, cell);
}

static grid_water at_rest(double x, double y, double time)
{
    (void)time;
    return (grid_water){.h = fmax(0 - town(x, y), 0)};
}

/* Not at rest: other surfaces and velocities in each cell. */
static grid_water rough(double x, double y, double time)
{
    const uint64_t cell = (uint64_t)(x / CELL) + COLUMNS * (uint64_t)(y / CELL);
    (void)time;
    return (grid_water){.h = fmax(0.5 * sb_random(3, cell) - town(x, y), 0),
                        .u = sb_random(4, cell) - 0.5,
                        .v = sb_random(5, cell) - 0.5};
}

static sb_offshore *make(grid_state *state)
{
    const sb_offshore_options options = {
        .columns = COLUMNS, .rows = ROWS, .cell = CELL, .gravity = G, .dry_depth = DRY};
    return grid_create(&options, town, state);
}

/* A place between the outer cells' centres, and a ground. */
typedef struct place {
    double x, y, ground;
} place;

static place place_of(uint64_t k)
{
    return (place){CELL * (0.5 + (COLUMNS - 1) * sb_random(6, k)), CELL * (0.5 + (ROWS - 1) * sb_random(7, k)),
                   -10 + 40 * sb_random(8, k)};
}

/* The mean surface and velocity of the wet ones of the four cells around a place, cell by cell. Returns their weight.
 */
static double around(const sb_offshore *grid, const place *p, double *surface, double *u)
{
    const sb_offshore_view v = sb_offshore_read(grid);
    double weight = 0, sum = 0, h = 0, hu = 0;
    for (size_t j = 0; j < ROWS; j++)
        for (size_t i = 0; i < COLUMNS; i++) {
            const size_t at = j * v.stride + i;
            const double w =
                fmax(1 - fabs(p->x / CELL - 0.5 - (double)i), 0) * fmax(1 - fabs(p->y / CELL - 0.5 - (double)j), 0);
            h += w * v.h[at];
            hu += w * v.hu[at];
            if (!(v.h[at] > DRY)) continue;
            weight += w;
            sum += w * (v.bed[at] + v.h[at]);
        }
    *surface = sum / weight;
    *u = h > 0 ? hu / h : 0;
    return weight;
}

/* Whether there is water around a place; its surface and velocity by brute force, and the motion that is given there.
 */
static bool look(const sb_offshore *grid, const place *p, double *surface, double *u, sb_offshore_motion *m)
{
    sb_offshore_motion_over(grid, 0, p->x, p->y, p->ground, m);
    return around(grid, p, surface, u) > 0;
}

/* Still water is at its level, or there is none: nowhere is water above the level, whatever the ground. */
static void still_water_has_its_level(void **state)
{
    (void)state;
    sb_offshore *grid = make(at_rest);
    size_t wet = 0, low = 0, none = 0;
    for (uint64_t k = 0; k < PLACES; k++) {
        sb_offshore_motion m;
        double surface, u;
        const place p = place_of(k);
        const bool water = look(grid, &p, &surface, &u, &m);
        assert_int_equal(m.wet, water && p.ground < 0);
        if (water)
            assert_near(m.surface, 0, 1e-12);
        else
            assert_true(m.surface <= p.ground);
        wet += m.wet;
        low += m.wet && m.bed > 0;
        none += !water && p.ground < 0;
    }
    printf(
        "%d places: %zu wet, %zu of them where the grid's bed is above the water; %zu low ones without water around\n",
        PLACES, wet, low, none);
    assert_true(low > 100 && none > 100);
    sb_offshore_destroy(grid);
}

/* The surface is the mean of the wet cells around, and so is the velocity; where the ground is above it, nothing moves.
 */
static void water_is_that_of_the_cells_around(void **state)
{
    (void)state;
    sb_offshore *grid = make(rough);
    for (uint64_t k = 0; k < PLACES; k++) {
        sb_offshore_motion m;
        double surface, u;
        const place p = place_of(k);
        const bool water = look(grid, &p, &surface, &u, &m);
        assert_int_equal(m.wet, water && p.ground < surface);
        if (water) assert_near(m.surface, surface, 1e-9);
        if (m.wet && m.surface - m.bed > 1) assert_near(m.u, u, 1e-6);
        if (!m.wet) assert_true(m.surface <= p.ground && m.u == 0 && m.v == 0 && m.divergence == 0);
    }
    sb_offshore_destroy(grid);
}

/* Over the grid's own bed, and after steps, it is the motion as before; a dry place is then the bed itself. */
static void over_its_own_bed_nothing_changes(void **state)
{
    (void)state;
    sb_offshore *grid = make(rough);
    grid_run(grid, 3);
    const double time = sb_offshore_read(grid).time - 0.01;
    for (uint64_t k = 0; k < PLACES; k++) {
        const place p = place_of(k);
        sb_offshore_motion own, over;
        sb_offshore_motion_at(grid, time, p.x, p.y, &own);
        sb_offshore_motion_over(grid, time, p.x, p.y, own.bed, &over);
        assert_int_equal(own.wet, over.wet);
        if (!own.wet) assert_true(own.surface == own.bed && over.surface <= over.bed);
        over.surface = own.wet ? over.surface : own.surface;
        assert_memory_equal(&own, &over, sizeof own);
    }
    sb_offshore_destroy(grid);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(still_water_has_its_level),
        cmocka_unit_test(water_is_that_of_the_cells_around),
        cmocka_unit_test(over_its_own_bed_nothing_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
