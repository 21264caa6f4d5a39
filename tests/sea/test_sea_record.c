/* Given water from the record of an earlier run: layers, and the part that comes in. */
#include "scene/record_columns.h"
#include "sea_scene.h"

static const double g = 9.81;

/* A row with the bed at 0, the surface, u of each layer, and w of all. */
static void add_row(char *text, size_t size, double t, const char *plane, double y, double surface, const double *u,
                    double w)
{
    size_t used = strlen(text);
    used += (size_t)snprintf(text + used, size - used, "%.12g,%s,0,%.12g,%.15g,0", t, plane, y, surface);
    for (int j = 0; j < 3 * SB_RECORD_LAYERS; j++)
        used += (size_t)snprintf(text + used, size - used, ",%.15g",
                                 j < SB_RECORD_LAYERS       ? u[j]
                                 : j < 2 * SB_RECORD_LAYERS ? 0
                                                            : w);
    assert_true(used + 2 < size);
    strcat(text, "\n");
}

enum { TEXT = 1 << 20 };
static char text[TEXT];

/* A wave that comes in, u = 2 sqrt(g h) - 2 sqrt(g d), to which one that goes out is added by its invariant: the replay
   is the incoming one alone. 1 m deep; level(t), shear over depth. */
static double root_in(double t)
{
    return sqrt(g) * (1 + 0.08 * sin(0.5 * t) * sin(0.5 * t));
}

static double root_out(double t)
{
    return sqrt(g) * (1 + 0.05 * sin(0.4 * t) * sin(0.4 * t));
}

static void only_what_comes_in_is_replayed(void **state)
{
    (void)state;
    sea_case c;
    double u[SB_RECORD_LAYERS];
    snprintf(text, TEXT, SB_RECORD_HEADER "\n");
    for (int i = 0; i <= 400; i++) {
        const double t = 0.05 * i, rest = sqrt(g);
        /* u + 2r = 4 r_in - 2 r_0 and u - 2r = 2 r_0 - 4 r_out: each wave alone has the other's invariant at rest */
        const double r = root_in(t) + root_out(t) - rest, mean = 2 * (root_in(t) - root_out(t));
        for (int j = 0; j < SB_RECORD_LAYERS; j++) u[j] = mean + 0.02 * (j - 3.5);
        const double d = 1e-3, later = root_in(t + d) + root_out(t + d) - rest,
                     earlier = root_in(t - d) + root_out(t - d) - rest;
        add_row(text, TEXT, t, "p", 0, r * r / g, u, (later * later - earlier * earlier) / g / (2 * d));
    }
    sea_make(&c, SEA_FLAT, "source: record, file: table.csv, plane: p", text);
    for (double t = 0.13; t < 19; t += 0.71) {
        const double r = root_in(t), speed = 2 * (r - sqrt(g));
        const sb_sea_point at = sea_at(&c, t, 0, 0, 0.5 * r * r / g), top = sea_at(&c, t, 0, 0, 3);
        assert_near(at.surface, r * r / g, 2e-5); /* monotone cubics through 20 rows per second */
        assert_near(at.velocity[0], speed, 1e-4);
        assert_near(top.velocity[0], speed + 0.07, 1e-4);
        const double d = 1e-3, rate = 2 * (root_in(t + d) - root_in(t - d)) / (2 * d);
        assert_near(at.acceleration[0], rate, 5e-3);
        const double rise = (pow(root_in(t + d), 2) - pow(root_in(t - d), 2)) / g / (2 * d);
        assert_near(top.velocity[2], rise, 5e-3);
    }
    double highest = 0;
    for (double t = 0; t < 20; t += 0.01) highest = fmax(highest, root_in(t) * root_in(t) / g);
    assert_near(sb_sea_greatest_surface(c.sea), highest, 1e-3);
    assert_true(sb_sea_greatest_speed(c.sea) >= 2 * 0.08 * sqrt(g) * 0.999);
    sea_free(&c);
}

/* Towards a domain on the other side of the plane the same record has the other incoming part. */
static void the_domain_tells_what_comes_in(void **state)
{
    (void)state;
    sea_case c;
    double u[SB_RECORD_LAYERS];
    snprintf(text, TEXT, SB_RECORD_HEADER "\n");
    for (int i = 0; i <= 20; i++) {
        const double r = sqrt(g) * (i > 0 ? 1.1 : 1);
        for (int j = 0; j < SB_RECORD_LAYERS; j++) u[j] = 2 * (r - sqrt(g));
        add_row(text, TEXT, i, "p", 0, r * r / g, u, 0);
    }
    sea_make(&c, SEA_FLAT, "source: record, file: table.csv, plane: p", text);
    assert_near(sea_at(&c, 9, 0, 0, 0).surface, 1.21, 1e-9);
    sea_free(&c);
    sea_make(&c,
             "dimensions: 2\nresolution: 0.1\nduration: 20\ndomain: {min: [-10, 0], max: [0, 2], sides: {x_max: sea}}\n"
             "water: {level: 1, seed: [-1, 0.2]}\n",
             "source: record, file: table.csv, plane: p", text);
    const sb_sea_point at = sea_at(&c, 9, 0, 0, 0.5);
    assert_near(at.surface, 1, 1e-9);
    assert_near(at.velocity[0], 0, 1e-9);
    sea_free(&c);
}

static void points_along_a_plane_and_dry_cells(void **state)
{
    (void)state;
    sea_case c;
    const double u[SB_RECORD_LAYERS] = {0};
    snprintf(text, TEXT, SB_RECORD_HEADER "\n");
    for (int i = 0; i <= 1; i++) {
        add_row(text, TEXT, 20 * i, "other", 0, 1.5, u, 0);
        add_row(text, TEXT, 20 * i, "p", 0, 1, u, 0);
        snprintf(text + strlen(text), TEXT - strlen(text), "%d,p,0,6,,1.3,,,,,,,,,,,,,,,,,,,,,,,,\n", 20 * i);
    }
    sea_make(&c, SEA_SPACE, "source: record, file: table.csv, plane: p", text);
    sb_sea_point dry;
    sb_sea_at(c.sea, 3, 0, 6, 1.4, 1.3, &dry);
    assert_true(dry.surface <= 1.3 && dry.velocity[0] == 0);
    assert_near(sea_at(&c, 3, 0, 0, 0.5).surface, 1, 1e-12);
    sea_free(&c);
    sea_refused(SEA_SPACE, "source: record, file: table.csv, plane: q", text,
                "no rows of the plane q, expected sea.plane: other");
    sea_refused(SEA_SPACE, "source: record, file: table.csv, plane: q", "t,eta,u\n", "header of a record");
    sea_refused(SEA_SPACE, "source: record, file: table.csv, plane: q", SB_RECORD_HEADER "\n1,q,0\n",
                "csv:2: 3 columns");
    sea_refused("resolution: 0.1\nduration: 20\ndomain: {min: [-5, 0, 0], max: [5, 6, 2], sides: {x_min: sea}}\n"
                "water: {level: 1, seed: [1, 1, 0.2]}\n",
                "source: record, file: table.csv, plane: p", text, "through the middle of the domain");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_what_comes_in_is_replayed),
        cmocka_unit_test(the_domain_tells_what_comes_in),
        cmocka_unit_test(points_along_a_plane_and_dry_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
