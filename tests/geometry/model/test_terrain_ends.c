/* Tests terrain that ends within the domain: at a hole, before a side, between two strips. Whether there are walls
   at its border is checked with the boundary particles alone: no path leads past them from the sea to below the
   domain's floor. */
#include "small_model.h"

static const double ground = 1.5; /* m: three spacings above the floor */

/* In spacings. Every point of a boundary surface has a particle within 0.75 spacings, so a path through one comes as
   near as that plus half a step. */
enum { STEPS = 4 };
static const double blocked = 0.9;

static char path[64];

/* Adds a grid with nodes 1 m apart from (x, y) on; `missing` is the number of the node without a height. */
static sb_body *add_grid(double x, double y, int columns, int rows, double height, int missing)
{
    snprintf(path, sizeof path, "ends-%d-%zu.asc", (int)getpid(), scene.body_count);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols %d\nnrows %d\nxllcenter %g\nyllcenter %g\ncellsize 1\n", columns, rows, x, y);
    for (int i = 0; i < columns * rows; i++) fprintf(file, "%g\n", i == missing ? -9999 : height);
    assert_int_equal(fclose(file), 0);
    sb_body *body = &bodies[scene.body_count++];
    snprintf(body->name, sizeof body->name, "ground");
    body->shape = SB_SHAPE_GRID;
    body->role = SB_ROLE_TERRAIN;
    body->color[0] = -1;
    body->scale = 1;
    body->file = path;
    return body;
}

static void build_once(void)
{
    build();
    remove(path);
}

/* Lattice of the flood fill: the domain and two metres below it. */
typedef struct lattice {
    int nx, ny, nz;
    double step;
    unsigned char *mark; /* 1: blocked, 2: reached */
} lattice;

static unsigned char *at(const lattice *l, int i, int j, int k)
{
    return l->mark + ((size_t)k * (size_t)l->ny + (size_t)j) * (size_t)l->nx + (size_t)i;
}

static sb_vec3 place(const lattice *l, int i, int j, int k)
{
    const double y = scene.dimensions == 2 ? 0 : scene.domain.min.y + (j + 0.5) * l->step;
    return sb_vec(scene.domain.min.x + (i + 0.5) * l->step, y, scene.domain.min.z - 2 + (k + 0.5) * l->step);
}

static int clamp(double x, int count)
{
    return x < 0 ? 0 : x > count - 1 ? count - 1 : (int)x;
}

static void block(const lattice *l, sb_vec3 wall, double radius)
{
    const sb_vec3 from = sb_scale(sb_sub(wall, place(l, 0, 0, 0)), 1 / l->step);
    const double r = radius / l->step + 1;
    for (int k = clamp(from.z - r, l->nz); k <= clamp(from.z + r, l->nz); k++)
        for (int j = clamp(from.y - r, l->ny); j <= clamp(from.y + r, l->ny); j++)
            for (int i = clamp(from.x - r, l->nx); i <= clamp(from.x + r, l->nx); i++)
                if (sb_norm(sb_sub(place(l, i, j, k), wall)) < radius) *at(l, i, j, k) = 1;
}

/* Whether a path leads from the sea's seed to below the floor. */
static bool leaks(void)
{
    const double step = scene.resolution / STEPS;
    const sb_vec3 size = sb_sub(scene.domain.max, scene.domain.min);
    lattice l = {(int)(size.x / step), scene.dimensions == 2 ? 1 : (int)(size.y / step), (int)((size.z + 2) / step),
                 step, NULL};
    const size_t cells = (size_t)l.nx * (size_t)l.ny * (size_t)l.nz;
    l.mark = calloc(cells, 1);
    size_t *stack = malloc(cells * sizeof *stack), count = 0;
    assert_true(l.mark && stack);
    for (size_t w = 0; w < model.wall_count; w++) block(&l, model.wall_position[w], blocked * scene.resolution);
    const sb_vec3 seed = sb_scale(sb_sub(scene.sea.seed, place(&l, 0, 0, 0)), 1 / step);
    unsigned char *first = at(&l, clamp(seed.x, l.nx), clamp(seed.y, l.ny), clamp(seed.z, l.nz));
    assert_int_equal(*first, 0);
    *first = 2;
    stack[count++] = (size_t)(first - l.mark);
    bool out = false;
    while (count > 0 && !out) {
        const size_t c = stack[--count], plane = (size_t)l.nx * (size_t)l.ny;
        const int k = (int)(c / plane), j = (int)(c % plane / (size_t)l.nx), i = (int)(c % (size_t)l.nx);
        const int next[6][3] = {{i - 1, j, k}, {i + 1, j, k}, {i, j - 1, k},
                                {i, j + 1, k}, {i, j, k - 1}, {i, j, k + 1}};
        out = k == 0;
        for (int n = 0; n < 6; n++) {
            const int *o = next[n];
            if (o[0] < 0 || o[1] < 0 || o[2] < 0 || o[0] >= l.nx || o[1] >= l.ny || o[2] >= l.nz) continue;
            unsigned char *mark = at(&l, o[0], o[1], o[2]);
            if (*mark) continue;
            *mark = 2;
            stack[count++] = (size_t)(mark - l.mark);
        }
    }
    free(l.mark);
    free(stack);
    return out;
}

/* Counts the boundary particles of a body whose normals point along a direction. */
static size_t facing(const sb_model_body *body, sb_vec3 way)
{
    size_t count = 0;
    for (size_t i = body->begin; i < body->begin + body->count; i++) count += sb_dot(model.wall_normal[i], way) > 0.9;
    return count;
}

static void ground_that_reaches_the_sides_has_no_walls(void **state)
{
    (void)state;
    add_grid(-1, -1, 13, 9, ground, -1);
    build_once();
    assert_int_equal(model.bodies[0].mesh.ends, 0);
    assert_int_equal(facing(model.bodies, sb_vec(1, 0, 0)), 0);
    assert_false(warned("ends within the domain", ""));
    assert_false(leaks());
    scene.body_count = 0; /* and it just reaches the sides */
    add_grid(0, 0, 11, 7, ground, -1);
    build_once();
    assert_int_equal(model.bodies[0].mesh.ends, 0);
    assert_false(warned("ends within the domain", ""));
    assert_false(leaks());
}

static void a_hole_has_walls(void **state)
{
    (void)state;
    add_grid(-1, -1, 13, 9, ground, 4 * 13 + 6); /* from the north-west: (5, 3) */
    build_once();
    const sb_model_body *body = model.bodies;
    assert_int_equal(body->mesh.ends, 4); /* each square around it keeps the half that does not touch it */
    assert_true(warned("\"ground\": the ground ends within the domain, at 4 open edges", "no height"));
    assert_true(warned("nodata) at 1 node, the first at (5, 3)", ""));
    const double half = sqrt(0.5);
    for (int way = 0; way < 4; way++)
        assert_true(facing(body, sb_vec(way & 1 ? half : -half, way & 2 ? half : -half, 0)) > 4);
    assert_false(leaks());
}

static void ground_that_ends_before_a_side_has_a_wall(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++) {
        scene.dimensions = dimensions;
        scene.body_count = 0;
        add_grid(-1, -1, 9, 9, ground, -1); /* to x = 7 */
        build_once();
        assert_int_equal(model.bodies[0].mesh.ends, dimensions == 2 ? 1 : 8 - 2);
        assert_true(warned("ends within the domain", dimensions == 2 ? "(7, " : "(7, 0.5, 1.5)"));
        assert_false(warned("no height", ""));
        assert_true(facing(model.bodies, sb_vec(1, 0, 0)) >= (dimensions == 2 ? 2 : 2 * 12));
        /* No particle is farther below the floor than where the floor's own particles begin. */
        for (size_t i = 0; i < model.bodies[0].count; i++)
            assert_true(model.wall_position[i].z > scene.domain.min.z - 2 * scene.resolution);
        assert_false(leaks());
    }
}

static void strips_have_walls_where_no_solid_continues(void **state)
{
    (void)state;
    scene.sea.seed = sb_vec(2, 1, 2.6);
    for (int strip = 0; strip < 2; strip++) {
        sb_body *body = add_box("strip", sb_vec(0, 0, 0), sb_vec(0, 0, 0));
        body->shape = SB_SHAPE_PLANE;
        body->role = SB_ROLE_TERRAIN;
        body->center = sb_vec(5, strip ? 5 : 0.5, ground);
        body->normal = sb_vec(0, 0, 1);
        body->width = 12;
        body->length = strip ? 4 : 3; /* y to 2, and from 3 */
    }
    build();
    assert_int_equal(model.bodies[0].mesh.ends, 1);
    assert_int_equal(model.bodies[1].mesh.ends, 1);
    assert_true(facing(model.bodies, sb_vec(0, 1, 0)) > 30);
    assert_true(facing(model.bodies + 1, sb_vec(0, -1, 0)) > 30);
    assert_false(leaks());
    bodies[1].center.y = 4; /* the other strip continues where the first ends */
    build();
    assert_int_equal(model.bodies[0].mesh.ends + model.bodies[1].mesh.ends, 0);
    assert_false(warned("ends within the domain", ""));
    assert_false(leaks());
    scene.body_count = 1; /* a quay that stands there closes the end, too */
    sb_body *quay = add_box("quay", sb_vec(-1, 2, -1), sb_vec(11, 4, 2.5));
    quay->role = SB_ROLE_SOLID;
    build();
    assert_int_equal(model.bodies[0].mesh.ends, 0);
    assert_false(leaks());
    quay->min.z = 1; /* but not a quay that water can flow under */
    build();
    assert_int_equal(model.bodies[0].mesh.ends, 1);
    assert_false(leaks());
}

static void walls_end_where_ground_continues_below(void **state)
{
    (void)state;
    scene.sea.seed = sb_vec(2, 3, 2.6);
    add_grid(-1, -1, 9, 9, 2, -1)->name[0] = 'u'; /* to x = 7, with lower ground throughout */
    sb_model_free(&model);
    char upper[64];
    memcpy(upper, path, sizeof upper);
    bodies[0].file = upper;
    add_grid(-1, -1, 13, 9, 1, -1);
    build_once();
    remove(upper);
    assert_int_equal(model.bodies[0].mesh.ends, 6);
    assert_int_equal(model.bodies[1].mesh.ends, 0);
    assert_true(facing(model.bodies, sb_vec(1, 0, 0)) > 12);
    for (size_t i = 0; i < model.bodies[0].count; i++) assert_true(model.wall_position[i].z > 0);
    assert_false(leaks());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        CASE(ground_that_reaches_the_sides_has_no_walls), CASE(a_hole_has_walls),
        CASE(ground_that_ends_before_a_side_has_a_wall),  CASE(strips_have_walls_where_no_solid_continues),
        CASE(walls_end_where_ground_continues_below),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
