/* Tests the facets of walls that reflect water: which there are, that they cover the surface, and the kinds of their
   edges. */
#include "check.h"
#include "small_model.h"

#include <math.h>
#include <time.h>

static char paths[16][64], *path = paths[0]; /* by body */

static int set_up_images(void **state)
{
    set_up(state);
    memset(paths, 0, sizeof paths);
    path = paths[0];
    scene.numerics.walls = SB_WALLS_IMAGES;
    return 0;
}

/* Adds a body with this surface: vertices, then triangles that count from 0. */
static sb_body *add_mesh(const char *name, size_t vertices, double vertex[][3], size_t triangles, int triangle[][3])
{
    path = paths[scene.body_count];
    snprintf(path, sizeof paths[0], "facets-%d-%zu.obj", (int)getpid(), scene.body_count);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (size_t v = 0; v < vertices; v++)
        fprintf(file, "v %.17g %.17g %.17g\n", vertex[v][0], vertex[v][1], vertex[v][2]);
    for (size_t t = 0; t < triangles; t++)
        fprintf(file, "f %d %d %d\n", triangle[t][0] + 1, triangle[t][1] + 1, triangle[t][2] + 1);
    assert_int_equal(fclose(file), 0);
    return add_file(name, path);
}

static void build_once(void)
{
    build();
    for (size_t k = 0; k < scene.body_count; k++)
        if (paths[k][0]) remove(paths[k]);
}

static size_t body_of(const char *name)
{
    for (size_t b = 0; b < model.body_count; b++)
        if (strcmp(model.bodies[b].name, name) == 0) return b;
    fail_msg("no body %s", name);
    return 0;
}

static size_t count_of(size_t body)
{
    size_t count = 0;
    for (size_t f = 0; f < model.facets.count; f++) count += model.facets.facets[f].body == body;
    return count;
}

/* The facet of a body with this normal that contains `at`, NULL if there is none. */
static const sb_facet *facet_at(size_t body, sb_vec3 normal, sb_vec3 at)
{
    for (size_t k = 0; k < model.facets.count; k++) {
        const sb_facet *f = &model.facets.facets[k];
        bool inside = f->body == body && sb_dot(f->normal, normal) > 1 - 1e-6;
        inside &= fabs(sb_dot(f->normal, at) - f->distance) < 1e-6;
        for (uint32_t e = f->edge; e < f->edge + f->edges; e++)
            inside &= sb_dot(model.facets.edges[e].inward, sb_sub(at, model.facets.edges[e].from)) > -1e-9;
        if (inside) return f;
    }
    return NULL;
}

/* The bend at the edge of facet f whose inward direction is this. */
static sb_bend bend(const sb_facet *f, sb_vec3 inward)
{
    assert_non_null(f);
    for (uint32_t e = f->edge; e < f->edge + f->edges; e++)
        if (sb_dot(model.facets.edges[e].inward, inward) > 1 - 1e-6) return model.facets.edges[e].bend;
    fail_msg("no edge with this direction");
    return SB_BEND_SOFT;
}

static size_t bends(const sb_facet *f, sb_bend kind)
{
    assert_non_null(f);
    size_t count = 0;
    for (uint32_t e = f->edge; e < f->edge + f->edges; e++) count += model.facets.edges[e].bend == kind;
    return count;
}

/* Area of a body's facets. Each of them is convex: all of its corners are inside of all of its edges. */
static double area_of(size_t body)
{
    double area = 0;
    for (size_t k = 0; k < model.facets.count; k++) {
        const sb_facet *f = &model.facets.facets[k];
        if (f->body != body) continue;
        const sb_facet_edge *edge = model.facets.edges + f->edge;
        assert_near(sb_norm(f->normal), 1, 1e-12);
        for (uint32_t e = 0; e < f->edges; e++) {
            const sb_vec3 side = sb_sub(edge[e].to, edge[0].from), before = sb_sub(edge[e].from, edge[0].from);
            area += 0.5 * sb_dot(f->normal, sb_cross(before, side));
            assert_near(sb_norm(edge[e].inward), 1, 1e-12);
            assert_near(sb_dot(edge[e].inward, f->normal), 0, 1e-12);
            assert_near(sb_dot(f->normal, edge[e].from), f->distance, 1e-6);
            for (uint32_t other = 0; other < f->edges; other++)
                assert_true(sb_dot(edge[e].inward, sb_sub(edge[other].from, edge[e].from)) > -1e-6);
        }
    }
    return area;
}

static const sb_vec3 X = {1, 0, 0}, Y = {0, 1, 0}, Z = {0, 0, 1};
static sb_vec3 minus(sb_vec3 v)
{
    return sb_scale(v, -1);
}

/* Six facets of twelve triangles, all edges convex; the walls of the domain have no edges. */
static void a_box_in_the_water(void **state)
{
    (void)state;
    add_box("box", sb_vec(4, 2, 1), sb_vec(6, 5, 2));
    build();
    const size_t box = body_of("box"), sides = body_of("domain");
    assert_int_equal(count_of(box), 6);
    assert_near(area_of(box), 2 * (2 * 3 + 3 + 2), 1e-9);
    for (size_t k = 0; k < model.facets.count; k++) {
        const sb_facet *f = &model.facets.facets[k];
        assert_false(f->both);
        if (f->body == box) assert_int_equal(bends(f, SB_BEND_CONVEX), 4);
    }
    assert_int_equal(count_of(sides), 5); /* open at the top */
    for (size_t k = 0; k < model.facets.count; k++)
        assert_true(model.facets.facets[k].body == box || model.facets.facets[k].edges == 0);
    assert_non_null(facet_at(sides, X, sb_vec(0, 3, 1)));
    assert_non_null(facet_at(sides, minus(X), sb_vec(10, 3, 1)));
    assert_non_null(facet_at(sides, Z, sb_vec(5, 3, 0)));
}

/* The bottom is hidden, the foot is concave, and the other edges are convex. */
static void a_box_on_the_floor(void **state)
{
    (void)state;
    add_box("box", sb_vec(4, 2, 0), sb_vec(6, 5, 2));
    build();
    const size_t box = body_of("box");
    assert_int_equal(count_of(box), 5);
    const sb_facet *front = facet_at(box, minus(X), sb_vec(4, 3, 1)), *top = facet_at(box, Z, sb_vec(5, 3, 2));
    assert_int_equal(bend(front, Z), SB_BEND_CONCAVE);
    assert_int_equal(bend(front, minus(Z)), SB_BEND_CONVEX);
    assert_int_equal(bend(front, Y), SB_BEND_CONVEX);
    assert_int_equal(bends(front, SB_BEND_CONVEX), 3);
    assert_int_equal(bends(top, SB_BEND_CONVEX), 4);
}

/* A box that ends at a side of the domain, and one that is sunk into the floor. */
static void boxes_in_walls(void **state)
{
    (void)state;
    add_box("wide", sb_vec(4, 0, 0), sb_vec(6, 6, 2));
    add_box("sunk", sb_vec(8, 2, -1), sb_vec(9, 4, 2));
    build();
    const size_t wide = body_of("wide"), sunk = body_of("sunk");
    assert_int_equal(count_of(wide), 3);
    const sb_facet *top = facet_at(wide, Z, sb_vec(5, 3, 2)), *front = facet_at(wide, minus(X), sb_vec(4, 3, 1));
    assert_int_equal(bend(top, Y), SB_BEND_CONCAVE);
    assert_int_equal(bend(top, minus(Y)), SB_BEND_CONCAVE);
    assert_int_equal(bend(top, X), SB_BEND_CONVEX);
    assert_int_equal(bends(front, SB_BEND_CONCAVE), 3);
    assert_int_equal(count_of(sunk), 5);
    assert_int_equal(bend(facet_at(sunk, minus(X), sb_vec(8, 3, 1)), Z), SB_BEND_CONCAVE);
}

/* Two boxes of the same height that touch have one surface: no edge is seen where they meet. */
static void boxes_side_by_side(void **state)
{
    (void)state;
    add_box("one", sb_vec(3, 2, 0), sb_vec(5, 4, 2));
    add_box("other", sb_vec(5, 2, 0), sb_vec(7, 4, 2));
    build();
    const size_t one = body_of("one"), other = body_of("other");
    assert_int_equal(count_of(one), 4);
    assert_int_equal(count_of(other), 4);
    const sb_facet *first = facet_at(one, Z, sb_vec(4, 3, 2)), *second = facet_at(other, Z, sb_vec(6, 3, 2));
    assert_int_equal(bends(first, SB_BEND_CONVEX), 3);
    assert_int_equal(bend(first, minus(X)), SB_BEND_SOFT);
    assert_int_equal(bend(second, X), SB_BEND_SOFT);
    assert_int_equal(bend(facet_at(one, Y, sb_vec(4, 4, 1)), minus(X)), SB_BEND_SOFT);
}

/* A lower box beside a higher one: its top ends at a wall. */
static void a_step(void **state)
{
    (void)state;
    add_box("low", sb_vec(3, 2, 0), sb_vec(5, 4, 1));
    add_box("high", sb_vec(5, 2, 0), sb_vec(7, 4, 2));
    build();
    const size_t low = body_of("low"), high = body_of("high");
    assert_int_equal(count_of(low), 4);
    assert_int_equal(count_of(high), 5);
    assert_int_equal(bend(facet_at(low, Z, sb_vec(4, 3, 1)), minus(X)), SB_BEND_CONCAVE);
    assert_int_equal(bends(facet_at(high, Z, sb_vec(6, 3, 2)), SB_BEND_CONVEX), 4);
}

/* A wall across a bed of two slopes: each slope has water, although its middle and its corners are in the wall or
   outside of the domain; and the bed goes on below the wall. */
static void a_wall_on_a_bed(void **state)
{
    (void)state;
    double vertex[6][3] = {{-7, -9, 1}, {-7, 9, 1}, {5, -9, 1}, {5, 9, 1}, {14, -9, 0.6}, {14, 9, 0.6}};
    int triangle[4][3] = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
    add_mesh("bed", 6, vertex, 4, triangle)->role = SB_ROLE_TERRAIN;
    add_box("wall", sb_vec(4.5, 2, 0), sb_vec(5.5, 4, 5));
    build_once();
    const size_t bed = body_of("bed");
    assert_int_equal(count_of(bed), 2);
    const sb_vec3 down = sb_normalize(sb_vec(0.4, 0, 9));
    assert_int_equal(bend(facet_at(bed, Z, sb_vec(1, 1, 1)), minus(X)), SB_BEND_SOFT);
    assert_int_equal(bends(facet_at(bed, down, sb_vec(9.5, 1, 0.8)), SB_BEND_SOFT), 1);
}

/* A dam with gentle slopes across a level bed: where they meet, the facets of both end, and bend towards the water.
   What the dam covers of the bed is no facet. */
static void a_dam_across_a_bed(void **state)
{
    (void)state;
    const double slope = M_PI / 6, crest = 2 * tan(slope), toe = 0.5 / tan(slope);
    double level[4][3] = {{-7, -9, 0.5}, {-7, 9, 0.5}, {14, -9, 0.5}, {14, 9, 0.5}};
    int two[2][3] = {{0, 2, 3}, {0, 3, 1}};
    double vertex[6][3] = {{3, -9, 0}, {7, -9, 0}, {5, -9, crest}, {3, 9, 0}, {7, 9, 0}, {5, 9, crest}};
    int triangle[8][3] = {{0, 1, 2}, {3, 5, 4}, {0, 2, 5}, {0, 5, 3}, {1, 4, 5}, {1, 5, 2}, {0, 3, 4}, {0, 4, 1}};
    add_mesh("bed", 4, level, 2, two)->role = SB_ROLE_TERRAIN;
    add_mesh("dam", 6, vertex, 8, triangle);
    build_once();
    const size_t bed = body_of("bed"), dam = body_of("dam");
    assert_int_equal(count_of(bed), 2);
    assert_int_equal(count_of(dam), 2);
    assert_near(area_of(bed), 18 * (21 - 4 + 2 * toe), 1e-6);
    assert_near(area_of(dam), 18 * 2 * (crest - 0.5) / sin(slope), 1e-6);
    const sb_facet *left = facet_at(bed, Z, sb_vec(1, 3, 0.5)), *right = facet_at(bed, Z, sb_vec(9, 3, 0.5));
    const sb_vec3 up = sb_vec(-sin(slope), 0, cos(slope));
    const sb_facet *side = facet_at(dam, up, sb_vec(4.5, 3, 1.5 * tan(slope)));
    assert_int_equal(bend(left, minus(X)), SB_BEND_HOLLOW);
    assert_int_equal(bend(right, X), SB_BEND_HOLLOW);
    assert_int_equal(bend(side, sb_vec(cos(slope), 0, sin(slope))), SB_BEND_HOLLOW);
    assert_int_equal(bend(side, sb_vec(-cos(slope), 0, -sin(slope))), SB_BEND_CONVEX); /* 60 degrees */
}

/* A prism with an L as its base: its top falls into convex pieces, with soft edges between them. */
static void a_prism_with_an_l_as_its_base(void **state)
{
    (void)state;
    static const double base[6][2] = {{3, 1}, {7, 1}, {7, 3}, {5, 3}, {5, 5}, {3, 5}};
    static const int cut[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
    double vertex[12][3];
    int triangle[20][3], n = 0;
    for (int k = 0; k < 12; k++) {
        vertex[k][0] = base[k % 6][0];
        vertex[k][1] = base[k % 6][1];
        vertex[k][2] = k < 6 ? 0.75 : 2;
    }
    for (int k = 0; k < 4; k++) {
        const int top[3] = {cut[k][0] + 6, cut[k][1] + 6, cut[k][2] + 6}, bottom[3] = {cut[k][2], cut[k][1], cut[k][0]};
        memcpy(triangle[n++], top, sizeof top);
        memcpy(triangle[n++], bottom, sizeof bottom);
    }
    for (int k = 0; k < 6; k++) {
        const int next = (k + 1) % 6, one[3] = {k, next, next + 6}, two[3] = {k, next + 6, k + 6};
        memcpy(triangle[n++], one, sizeof one);
        memcpy(triangle[n++], two, sizeof two);
    }
    add_mesh("l", 12, vertex, 20, triangle);
    build_once();
    const size_t l = body_of("l");
    assert_int_equal(count_of(l), 2 * 2 + 6);
    assert_near(area_of(l), 2 * 12 + 16 * 1.25, 1e-6);
    const sb_facet *one = facet_at(l, Z, sb_vec(6.5, 1.5, 2)), *other = facet_at(l, Z, sb_vec(3.5, 4.5, 2));
    assert_ptr_not_equal(one, other);
    assert_int_equal(bends(one, SB_BEND_SOFT), 1);
    assert_int_equal(bends(other, SB_BEND_SOFT), 1);
    assert_int_equal(bends(one, SB_BEND_CONCAVE) + bends(other, SB_BEND_CONCAVE), 0);
    const sb_facet *inner = facet_at(l, Y, sb_vec(6, 3, 1.5)), *next = facet_at(l, X, sb_vec(5, 4, 1.5));
    assert_int_equal(bend(inner, X), SB_BEND_CONCAVE);
    assert_int_equal(bend(inner, minus(X)), SB_BEND_CONVEX);
    assert_int_equal(bend(next, Y), SB_BEND_CONCAVE);
}

/* A surface that encloses nothing has water on both sides. */
static void a_plate(void **state)
{
    (void)state;
    double vertex[4][3] = {{4, 2, 0.5}, {4, 4, 0.5}, {4, 4, 2}, {4, 2, 2}};
    int triangle[2][3] = {{0, 1, 2}, {0, 2, 3}};
    scene.sea.seed = sb_vec(8, 3, 2); /* a surface that faces one way has its solid behind it */
    add_mesh("plate", 4, vertex, 2, triangle);
    build_once();
    const size_t plate = body_of("plate");
    assert_int_equal(count_of(plate), 1);
    assert_near(area_of(plate), 3, 1e-9);
    const sb_facet *f = facet_at(plate, X, sb_vec(4, 3, 1));
    assert_true(f->both);
    assert_int_equal(bends(f, SB_BEND_CONVEX), 4);
}

/* Heights on a grid of nodes 1 m apart over the whole domain. */
static double height_of(int column)
{
    static const double height[] = {0.5, 0.5, 0.5, 0.7, 0.9, 1.1, 1.1, 1.1, 1, 0.9, 0.8};
    return height[column];
}

static void add_terrain(double y_min)
{
    snprintf(path, sizeof paths[0], "facets-%d.asc", (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols 11\nnrows 7\nxllcenter 0\nyllcenter %g\ncellsize 1\n", y_min);
    for (int k = 0; k < 77; k++) fprintf(file, "%.17g\n", height_of(k % 11));
    assert_int_equal(fclose(file), 0);
    sb_body *body = add_file("bed", path);
    body->shape = SB_SHAPE_GRID;
    body->role = SB_ROLE_TERRAIN;
}

/* Terrain with small bends: planes are merged, the edges between them are soft, and the sides of the domain end it. */
static void a_terrain(void **state)
{
    (void)state;
    add_terrain(0);
    build_once();
    const size_t bed = body_of("bed");
    double area = 0;
    for (int k = 0; k < 10; k++) area += 6 * sqrt(1 + pow(height_of(k + 1) - height_of(k), 2));
    assert_near(area_of(bed), area, 1e-6);
    assert_int_equal(count_of(bed), 4); /* level, up, level, down */
    for (size_t k = 0; k < model.facets.count; k++) {
        const sb_facet *f = &model.facets.facets[k];
        if (f->body != bed) continue;
        assert_false(f->both);
        assert_int_equal(bends(f, SB_BEND_CONVEX), 0);
    }
    const sb_facet *slope = facet_at(bed, sb_normalize(sb_vec(-0.2, 0, 1)), sb_vec(3.5, 3, 0.8));
    for (uint32_t e = slope->edge; e < slope->edge + slope->edges; e++) {
        const sb_facet_edge *edge = &model.facets.edges[e];
        const sb_bend right = edge->inward.x > 0 ? SB_BEND_HOLLOW : SB_BEND_SOFT; /* at its foot and at its top */
        assert_int_equal(edge->bend, fabs(edge->inward.y) > 0.5 ? SB_BEND_CONCAVE : right);
    }
}

/* In 2D a facet is a segment with two ends; those in line are joined. */
static void sections(void **state)
{
    (void)state;
    scene.dimensions = 2;
    scene.sea.seed = sb_vec(2, 0, 2);
    add_terrain(-3);
    add_box("box", sb_vec(6.2, -1, 1.6), sb_vec(7.2, 1, 2.6));
    build_once();
    const size_t bed = body_of("bed"), box = body_of("box");
    assert_int_equal(count_of(bed), 4);
    assert_int_equal(count_of(box), 4);
    assert_int_equal(count_of(body_of("domain")), 3);
    double length = 0;
    for (size_t k = 0; k < model.facets.count; k++) {
        const sb_facet *f = &model.facets.facets[k];
        if (f->edges == 0) continue;
        assert_int_equal(f->edges, 2);
        assert_near(f->normal.y, 0, 0);
        const sb_facet_edge *e = model.facets.edges + f->edge;
        for (int end = 0; end < 2; end++) {
            assert_near(sb_dot(f->normal, e[end].from), f->distance, 1e-6);
            assert_near(sb_dot(e[end].inward, sb_sub(e[1 - end].from, e[end].from)),
                        sb_norm(sb_sub(e[1].from, e[0].from)), 1e-9);
        }
        if (f->body == bed) length += sb_norm(sb_sub(e[1].from, e[0].from));
        if (f->body == box) assert_int_equal(bends(f, SB_BEND_CONVEX), 2);
    }
    double right = 0;
    for (int k = 0; k < 10; k++) right += sqrt(1 + pow(height_of(k + 1) - height_of(k), 2));
    assert_near(length, right, 1e-6);
    const sb_facet *slope = facet_at(bed, sb_normalize(sb_vec(-0.2, 0, 1)), sb_vec(3.5, 0, 0.8));
    assert_int_equal(bends(slope, SB_BEND_SOFT), 1);
    assert_int_equal(bends(slope, SB_BEND_HOLLOW), 1);
    assert_int_equal(bends(facet_at(bed, Z, sb_vec(1, 0, 0.5)), SB_BEND_CONCAVE), 1);
}

/* A bed of 100 000 triangles, none of which are coplanar. */
static void many_triangles(void **state)
{
    (void)state;
    enum { COLUMNS = 251, ROWS = 201 };
    snprintf(path, sizeof paths[0], "facets-%d.asc", (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols %d\nnrows %d\nxllcenter 0\nyllcenter 0\ncellsize %.17g\n", COLUMNS, ROWS,
            10.0 / (COLUMNS - 1));
    for (int k = 0; k < COLUMNS * ROWS; k++)
        fprintf(file, "%.6f\n", 1 + 0.3 * sin(0.05 * (k % COLUMNS)) * cos(0.07 * (k / COLUMNS)));
    assert_int_equal(fclose(file), 0);
    double area = 0;
    for (int k = 0; k < 250 * 200; k++) {
        const double x = 0.05 * (k % 250 + 0.5), y = 0.07 * (k / 250 + 0.5);
        area += 0.0016 * sqrt(1 + pow(7.5 * 0.05 * cos(x) * cos(y), 2) + pow(7.5 * 0.07 * sin(x) * sin(y), 2));
    }
    scene.domain.max.y = 8;
    sb_body *body = add_file("bed", path);
    body->shape = SB_SHAPE_GRID;
    body->role = SB_ROLE_TERRAIN;
    const clock_t start = clock();
    build();
    const double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    remove(path);
    print_message("%zu facets in %.2f s\n", model.facets.count, seconds);
    assert_true(count_of(body_of("bed")) < 1500);
    assert_near(area_of(body_of("bed")), area, 0.005 * area); /* chords are shorter */
    assert_true(seconds < 10);
}

/* A bed of 17 280 triangles in two planes is two facets: pieces of edges that continue each other are one edge. */
static void two_planes_of_many_triangles(void **state)
{
    (void)state;
    enum { COLUMNS = 121, ROWS = 73 };
    snprintf(path, sizeof paths[0], "facets-%d.asc", (int)getpid());
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols %d\nnrows %d\nxllcenter 0\nyllcenter 0\ncellsize %.17g\n", COLUMNS, ROWS,
            10.0 / (COLUMNS - 1));
    for (int k = 0; k < COLUMNS * ROWS; k++) fprintf(file, "%.17g\n", 0.5 + 0.01 * fmax(k % COLUMNS - 60, 0));
    assert_int_equal(fclose(file), 0);
    sb_body *body = add_file("bed", path);
    body->shape = SB_SHAPE_GRID;
    body->role = SB_ROLE_TERRAIN;
    build_once();
    const size_t bed = body_of("bed");
    assert_int_equal(count_of(bed), 2);
    assert_near(area_of(bed), 30 + 6 * sqrt(25 + 0.36), 1e-6);
    const sb_facet *level = facet_at(bed, Z, sb_vec(2, 3, 0.5));
    assert_non_null(level);
    assert_int_equal(level->edges, 4);
    assert_int_equal(bend(level, minus(X)), SB_BEND_HOLLOW);
    assert_int_equal(bends(level, SB_BEND_CONCAVE), 3);
}

/* A gentle slope that stands on the domain's floor: where they meet, the facets of both end and bend towards the water.
   What the slope covers of the floor is no facet; the other sides stay whole. */
static void check_slope_on_floor(double below)
{
    const double rise = 1.2 / 6;
    const double x[2] = {4 - below / rise, 12}, z[2] = {-below, rise * 8};
    double vertex[6][3] = {{x[0], -1, z[0]},    {x[0], 7, z[0]},  {x[1], -1, z[0] - 1},
                           {x[1], 7, z[0] - 1}, {x[1], -1, z[1]}, {x[1], 7, z[1]}};
    int triangle[8][3] = {{0, 4, 5}, {0, 5, 1}, {0, 1, 3}, {0, 3, 2}, {2, 3, 5}, {2, 5, 4}, {0, 2, 4}, {1, 5, 3}};
    add_mesh("slope", 6, vertex, 8, triangle);
    build_once();
    const size_t slope = body_of("slope"), sides = body_of("domain");
    const sb_vec3 up = sb_normalize(sb_vec(-rise, 0, 1)), along = sb_normalize(sb_vec(1, 0, rise));
    const bool flat = scene.dimensions == 2;
    const sb_facet *floor = facet_at(sides, Z, sb_vec(2, flat ? 0 : 3, 0));
    assert_non_null(floor);
    assert_int_equal(floor->edges, flat ? 2 : 4);
    assert_int_equal(bend(floor, minus(X)), SB_BEND_HOLLOW);
    assert_int_equal(bends(floor, SB_BEND_CONCAVE), flat ? 1 : 3);
    assert_non_null(facet_at(sides, Z, sb_vec(3.99, flat ? 0 : 3, 0)));
    assert_null(facet_at(sides, Z, sb_vec(4.01, flat ? 0 : 3, 0)));
    const sb_facet *wet = facet_at(slope, up, sb_vec(7, flat ? 0 : 3, 3 * rise));
    assert_int_equal(bend(wet, along), SB_BEND_HOLLOW);
    assert_null(facet_at(slope, up, sb_vec(3.9, flat ? 0 : 3, -0.1 * rise)));
    assert_int_equal(count_of(sides), flat ? 3 : 5);
    for (size_t k = 0; k < model.facets.count; k++)
        assert_true(model.facets.facets[k].body == slope || &model.facets.facets[k] == floor ||
                    model.facets.facets[k].edges == 0);
}

static void a_slope_on_the_floor_of_the_domain(void **state)
{
    check_slope_on_floor(0);
    tear_down(state);
    set_up_images(state);
    check_slope_on_floor(0.3); /* it goes on below the floor */
}

static void a_section_of_a_slope_on_the_floor(void **state)
{
    (void)state;
    scene.dimensions = 2;
    scene.sea.seed = sb_vec(2, 0, 2);
    check_slope_on_floor(0);
}

#define IMAGES(f) cmocka_unit_test_setup_teardown(f, set_up_images, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IMAGES(a_box_in_the_water),
        IMAGES(a_box_on_the_floor),
        IMAGES(boxes_in_walls),
        IMAGES(boxes_side_by_side),
        IMAGES(a_step),
        IMAGES(a_wall_on_a_bed),
        IMAGES(a_dam_across_a_bed),
        IMAGES(a_prism_with_an_l_as_its_base),
        IMAGES(two_planes_of_many_triangles),
        IMAGES(a_plate),
        IMAGES(a_terrain),
        IMAGES(a_slope_on_the_floor_of_the_domain),
        IMAGES(a_section_of_a_slope_on_the_floor),
        IMAGES(sections),
        IMAGES(many_triangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
