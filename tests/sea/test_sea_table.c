/* Given water from tables: formats, interpolation, and what is refused. */
#include "sea_scene.h"

#define TABLE "source: table, file: table.csv"

static void one_point(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n10,0.4,1\n20,0.2,-1\n");
    const sb_sea_point at = sea_at(&c, 10, 0, 0, 0.7), middle = sea_at(&c, 5, 3, 9, 0.7);
    assert_near(at.surface, 1.4, 1e-12); /* the datum is the still level */
    assert_near(at.velocity[0], 1, 1e-12);
    assert_near(at.velocity[2], 0, 1e-12); /* the table's greatest level is one of the surface */
    assert_true(middle.surface > 1.2 && middle.surface < 1.4);
    /* The surface rises with the water; below it in proportion to the height. */
    const double d = 1e-5, rise = (sea_at(&c, 5 + d, 0, 0, 0).surface - sea_at(&c, 5 - d, 0, 0, 0).surface) / (2 * d);
    assert_near(sea_at(&c, 5, 0, 0, 3).velocity[2], rise, 1e-9);
    assert_near(middle.velocity[2], rise * 0.7 / middle.surface, 1e-9);
    assert_near((sea_at(&c, 5 + d, 0, 0, 1).velocity[0] - sea_at(&c, 5 - d, 0, 0, 1).velocity[0]) / (2 * d),
                middle.acceleration[0], 1e-9);
    assert_near(sb_sea_greatest_surface(c.sea), 1.4, 1e-12);
    assert_near(sb_sea_greatest_speed(c.sea), 1, 1e-12);
    assert_null(sb_sea_warning(c.sea));
    sea_free(&c);
}

/* Between the rows the cubic stays between them, and a parabola is met to the second order. */
static void interpolation_is_monotone_and_of_second_order(void **state)
{
    (void)state;
    sea_case c;
    char table[4096] = "t eta u\n";
    for (int i = 0; i <= 20; i++)
        snprintf(table + strlen(table), sizeof table - strlen(table), "%d %g %g\n", i, i < 10 ? 0.0 : 0.3,
                 0.01 * i * i);
    sea_make(&c, SEA_FLAT, TABLE, table);
    double before = 1, error = 0;
    for (double t = 0; t < 20; t += 0.01) {
        const sb_sea_point at = sea_at(&c, t, 0, 0, 0);
        assert_true(at.surface >= before - 1e-14 && at.surface <= 1.3 + 1e-14);
        before = at.surface;
        if (t > 1 && t < 19) error = fmax(error, fabs(at.velocity[0] - 0.01 * t * t));
    }
    assert_true(error < 0.01 / 8); /* a quarter of the error of straight lines is 0.01/16 */
    sea_free(&c);
}

static void several_points_along_a_side(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_SPACE, TABLE ", datum: 0.9, start: -100, units: cm",
             "time (s);x (cm);y (cm);eta (cm);u (cm/s);v (cm/s)\n"
             "100;0;0;10;0;0\n100;0;600;10;0;0\n120;0;0;40;50;0\n120;0;600;20;0;25\n");
    const sb_sea_point low = sea_at(&c, 20, 0, -1, 0), high = sea_at(&c, 20, 0.2, 6, 0),
                       mid = sea_at(&c, 20, 0, 1.5, 0);
    assert_near(low.surface, 1.3, 1e-12);
    assert_near(high.surface, 1.1, 1e-12);
    assert_near(mid.surface, 1.25, 1e-12);
    assert_near(mid.velocity[0], 0.375, 1e-12);
    assert_near(mid.velocity[1], 0.0625, 1e-12);
    assert_near(sb_sea_greatest_surface(c.sea), 1.3, 1e-12);
    sea_free(&c);
}

/* Places in the coordinates of a projection, of which one is (0, 0) of the scene. */
static void a_place_is_the_zero_of_the_scene(void **state)
{
    (void)state;
    static const char far[] = "t,x,y,eta,u,v\n0,547000,4250000,0,0,0\n0,547000,4250004,0.2,0,0\n"
                              "20,547000,4250000,0,0,0\n20,547000,4250004,0.2,0,0\n";
    sea_case c;
    sea_make(&c, SEA_SPACE, TABLE ", zero: [547000, 4250000]", far);
    assert_near(sea_at(&c, 3, 0, 1, 0).surface, 1.05, 1e-12);
    sea_free(&c);
    sea_refused(SEA_SPACE, TABLE, far, "sea.zero is the place of the table that is (0, 0)");
    sea_refused(SEA_SPACE, "source: none, zero: [1, 2]", NULL, "does not apply");
}

/* A line that is not that of the side: across it, or at the opposite side. A line around a corner is right. */
static void lines_elsewhere_are_doubted(void **state)
{
    (void)state;
#define LINE(x0, y0, x1, y1)                                                                                           \
    "t,x,y,eta,u,v\n0," x0 "," y0 ",0,0,0\n0," x1 "," y1 ",0,0,0\n20," x0 "," y0 ",0,0,0\n20," x1 "," y1 ",0,0,0\n"
    static const struct {
        const char *table, *doubt;
    } cases[] = {
        {LINE("0", "0", "0", "6"), NULL},
        {LINE("-3", "0", "-2", "6"), NULL},
        {LINE("0", "3", "9", "4"), "runs across the side x_min, from x = 0 to 9 m"},
        {LINE("10", "0", "10", "6"), "at x = 10 m, is nearer to the side x_max than to x_min"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        sea_case c;
        sea_make(&c, SEA_SPACE, TABLE, cases[k].table);
        const char *doubt = sb_sea_warning(c.sea);
        if (cases[k].doubt ? !doubt || !strstr(doubt, cases[k].doubt) : doubt != NULL) fail_msg("%zu: %s", k, doubt);
        sea_free(&c);
    }
    static const char corner[] =
        "resolution: 0.1\nduration: 20\ndomain: {min: [0, 0, 0], max: [10, 6, 2], sides: {x_min: sea, y_min: sea}}\n"
        "water: {level: 1, seed: [1, 1, 0.2]}\n";
    sea_case c;
    sea_make(&c, corner, TABLE, LINE("0", "0", "10", "0"));
    assert_null(sb_sea_warning(c.sea));
    sea_free(&c);
}

/* Velocities in cm/s are a hundred times too high. */
static void fast_water_is_doubted(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, "source: table, file: table.csv", "t,eta,u\n0,0,0\n10,0.2,60\n20,0,0\n");
    assert_non_null(sb_sea_warning(c.sea));
    assert_non_null(strstr(sb_sea_warning(c.sea), "up to 60 m/s, 17 times as fast as long waves"));
    sea_free(&c);
    sea_make(&c, SEA_FLAT, "source: table, file: table.csv", "t,eta,u\n0,0,0\n10,0.2,6\n20,0,0\n");
    assert_null(sb_sea_warning(c.sea));
    sea_free(&c);
}

static void without_a_header_and_with_comments(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_SPACE, TABLE, "# any text\r\n0, 0, 0, 0, 0, 0\r\n\n20, 0, 0, 0.2, 0.1, 0.3 # end\n");
    assert_near(sea_at(&c, 20, 0, 0, 0).velocity[1], 0.3, 1e-12);
    sea_free(&c);
    sea_make(&c, SEA_SPACE, TABLE, "0 0 0 1\n20 0.2 0.1 0.3");
    assert_near(sea_at(&c, 20, 0, 0, 0).velocity[1], 0.3, 1e-12);
    sea_free(&c);
}

/* Ends of lines of other systems, and a header in which blanks separate and units are in brackets. */
static void ends_of_lines_and_blanks(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, TABLE, "t,eta,u\r0,0,0\r20,0.2,0.1\r");
    assert_near(sea_at(&c, 20, 0, 0, 0).velocity[0], 0.1, 1e-12);
    sea_free(&c);
    sea_make(&c, SEA_FLAT, TABLE, "time (s) u [m / s]  eta (m)\r\n0 0 0\r\n20 0.1 0.2\r\n");
    assert_near(sea_at(&c, 20, 0, 0, 0).velocity[0], 0.1, 1e-12);
    sea_free(&c);
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\r0,0,0\r20,0.2,a\r", "table.csv:3: u is a,");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\r\n0,0,0\r\n20,0.2,a\r\n", "table.csv:3: u is a,");
}

/* The key sea.units is the unit of all columns that are used. */
static void units_of_a_header(void **state)
{
    (void)state;
    sea_case c;
    sea_make(&c, SEA_FLAT, TABLE, "time_s,eta_m,u_m_s,depth (km)\n0,0,0,3\n20,0.2,0.1,3\n");
    sea_free(&c);
    sea_make(&c, SEA_FLAT, TABLE ", units: ft", "t,eta (feet),u (ft s-1)\n0,0,0\n20,1,1\n");
    assert_near(sea_at(&c, 20, 0, 0, 0).surface, 1.3048, 1e-12);
    sea_free(&c);
    sea_refused(SEA_FLAT, TABLE, "t (s), eta (mm), u\n0,0,0\n",
                "table.csv:1: its column \"eta (mm)\" names the unit mm, expected seconds and m, the unit of the key "
                "sea.units");
    sea_refused(SEA_FLAT, TABLE, "t (min), eta, u\n0,0,0\n", "\"t (min)\" names the unit min");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u (km/h)\n0,0,0\n", "\"u (km/h)\" names the unit km");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u (m/min)\n0,0,0\n", "\"u (m/min)\" names the unit min");
    sea_refused(SEA_FLAT, TABLE ", units: cm", "t,eta (m),u (m/s)\n0,0,0\n20,0,0\n",
                "\"eta (m)\" names the unit m, expected seconds and cm");
    sea_refused(SEA_FLAT, TABLE ", units: cm", "t,eta (cm),u (m/s)\n0,0,0\n20,0,0\n", "\"u (m/s)\" names the unit m,");
    sea_refused(SEA_FLAT, TABLE, "time (s) eta (cm) u (m/s)\n0 0 0\n20 0 0\n", "\"eta(cm)\" names the unit cm");
}

/* Without v the water at a side across y would come in with half of its wave. */
static void v_is_required_across_y(void **state)
{
    (void)state;
    static const char side[] =
        "resolution: 0.1\nduration: 20\ndomain: {min: [0, 0, 0], max: [10, 6, 2], sides: {y_max: "
        "sea}}\nwater: {level: 1, seed: [1, 1, 0.2]}\n";
    static const char both[] =
        "resolution: 0.1\nduration: 20\ndomain: {min: [0, 0, 0], max: [10, 6, 2], sides: {x_min: "
        "sea, y_max: sea}}\nwater: {level: 1, seed: [1, 1, 0.2]}\n";
    sea_case c;
    sea_refused(side, TABLE, "t,eta,u\n0,0,0\n20,0,0\n",
                "table.csv:1: no column is v, expected v, the velocity along y, because the water is given at y_max");
    sea_refused(side, TABLE, "0,0,0\n20,0,0\n", "table.csv:1: no column is v");
    sea_make(&c, both, TABLE ", sides: {y_max: still}", "t,eta,u\n0,0,0\n20,0,0\n");
    sea_free(&c);
    sea_make(&c, side, TABLE, "t,eta,u,v\n0,0,0,0\n20,0,0,0\n");
    sea_free(&c);
}

/* A guess at degrees needs places that no side explains. */
static void what_looks_like_degrees(void **state)
{
    (void)state;
    static const char *const tables[][3] = {
        {TABLE ", units: mm", "t,x,y,eta,u\n0,50,50,0,0\n29,50,50,0,0\n0,50,53,0,0\n29,50,53,0,0\n",
         "its 2 points lie within 0.003 m of (0.05, 0.05), less than a spacing of 0.1 m"},
        {TABLE, "t,x,y,eta,u\n0,0,0,0,0\n29,0,0,0,0\n0,0,0.09,0,0\n29,0,0.09,0,0\n", "its 2 points lie within 0.09 m"},
        {TABLE, "t,x,y,eta,u\n0,0,50,0,0\n29,0,50,0,0\n0,0,60,0,0\n29,0,60,0,0\n", "the point (0, 50) lies 44 m"},
    };
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++) {
        sea_case c;
        sea_refused(SEA_SPACE, tables[i][0], tables[i][1], tables[i][2]);
        assert_int_equal(sea_try(&c, SEA_SPACE, tables[i][0], tables[i][1]), SB_BAD_INPUT);
        if (strstr(c.error.text, "longitudes")) fail_msg("%s", c.error.text);
        sea_free(&c);
    }
}

/* Two gauges as GeoClaw writes them, joined to one file; the second one is dry at first. */
#define GEOCLAW(number, y)                                                                                             \
    "# gauge_id=   " number " location=(  0.0000000000E+00  " y " ) num_eqn=  4\n"                                     \
    "# Columns: level time q(1 ... num_eqn)\n"

static void gauges_of_geoclaw(void **state)
{
    (void)state;
    sea_case c;
    sea_make(
        &c, SEA_SPACE, TABLE ", datum: 1",
        GEOCLAW("  1",
                "0.0000000000E+00") " 01  0.000E+00  1.0E+00  0.0E+00  0.0E+00  0.0E+00\n"
                                    " 02  2.000E+01  1.2E+00  6.0E-01 -1.2E-01  2.0E-01\n" GEOCLAW(
                                        "  2",
                                        "6.0000000000E+00") " 01  0.000E+00  0.0E+00  0.0E+00  0.0E+00  1.0E-01\n"
                                                            " 01  2.500E+01  1.0E-04  1.0E+00  0.0E+00  1.0E-01\n");
    const sb_sea_point first = sea_at(&c, 20, 0, 0, 0), second = sea_at(&c, 20, 0, 6, 0);
    assert_near(first.surface, 1.2, 1e-12);
    assert_near(first.velocity[0], 0.5, 1e-12);
    assert_near(first.velocity[1], -0.1, 1e-12);
    assert_near(second.surface, 1.1, 1e-12);
    assert_near(second.velocity[0], 0, 0); /* a film has no speed */
    sea_free(&c);
    sea_refused(SEA_SPACE, TABLE, "# gauge_id= 1 num_eqn= 4\n01 0 1 0 0 0\n",
                "table.csv:1: a gauge of GeoClaw without");
    sea_refused(SEA_SPACE, TABLE, GEOCLAW("1", "0") "01 0 1 0 0\n", "table.csv:3: eta is missing");
    sea_refused(
        SEA_SPACE, TABLE, GEOCLAW("1", "0") "# file format binary64, time series in .bin file\n",
        "table.csv:3: a gauge of GeoClaw in the format binary64, whose rows are in another file, expected ascii");
    sea_refused(SEA_SPACE, TABLE, GEOCLAW("1", "0") "# file format ascii, time series follow in this file\n",
                "has no rows");
}

static void what_is_refused(void **state)
{
    (void)state;
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n19,0,0\n",
                "table.csv: the series at (0, 0) ends at 19 s, expected 20 s or later");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n3,0,0\n29,0,0\n", "begins at 3 s, expected 0 s or earlier");
    sea_refused(SEA_FLAT, TABLE ", datum: 101", "t,eta,u\n0,0,0\n29,0,0\n",
                "the surface begins at 101 m, 100 m from the still level of 1 m");
    sea_refused(
        SEA_SPACE, TABLE, "t,x,y,eta,u\n0,1.03,7.42,0,0\n29,1.03,7.42,0,0\n0,1.03,7.43,0,0\n29,1.03,7.43,0,0\n",
        "its 2 points lie within 0.01 m of (1.03, 7.42), less than a spacing of 0.1 m, expected points along a side, "
        "in metres of the scene; these look like longitudes and latitudes");
    sea_refused(SEA_SPACE, TABLE, "t,x,y,eta,u\n0,0,0,0,0\n29,0,0,0,0\n0,0,4,0,0\n29,0,4,0,0\n0,0,2,0,0\n29,0,2,0,0\n",
                "the line of its points turns back at (0, 4), expected points in their order along the side");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n29,nan,0\n", "table.csv:3: eta is nan, expected a number");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n29,0,\n", "table.csv:3: u is missing");
    sea_refused(SEA_FLAT, TABLE, "t;eta;u\n0;0,0;0\n29;0,1;0\n",
                "table.csv:2: has commas and semicolons, expected one kind of separator; decimals have points");
    sea_refused(SEA_FLAT, TABLE, "0;0,12;0\n29;0,12;0\n", "table.csv:1: has commas and semicolons");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n29,0,12,0\n",
                "table.csv:3: 4 columns, expected at most the 3 of the table; decimals have points");
    sea_refused(SEA_FLAT, TABLE, "0,0,0\n29,0,0,0\n", "table.csv:2: 4 columns");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n8,0,0\n7,0,0\n29,0,0\n",
                "table.csv:4: time 7 s does not follow 8 s, expected increasing times");
    sea_refused(SEA_FLAT, TABLE, "time_s,gauge,eta_m,z_m\n0,a,0,0\n",
                "table.csv:1: no column is u, expected t, eta, u");
    sea_refused(SEA_SPACE, TABLE, "t,x,eta,u\n0,0,0,0\n20,0,0,0\n0,4,0,0\n20,4,0,0\n",
                "table.csv:1: no column is y, expected t, eta, u");
    sea_refused(SEA_FLAT, TABLE, "0,0\n1,2\n", "table.csv:1: 2 columns without a header");
    sea_refused(SEA_FLAT, TABLE, "t,eta,eta,u\n", "two columns are eta: \"eta\" and \"eta\"");
    sea_refused(SEA_FLAT, TABLE, "t,eta (m),Surface,u\n",
                "table.csv:1: two columns are eta: \"eta (m)\" and \"Surface\", expected one");
    char wide[400] = "t,eta,u";
    for (int i = 3; i < 65; i++) strcat(wide, ",a");
    sea_refused(SEA_FLAT, TABLE, strcat(wide, "\n"), "table.csv:1: has more columns than 64, expected at most 64");
    sea_refused(SEA_FLAT, TABLE, "\n\n", "is empty");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n", "has no rows");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n", "has 1 row, expected at least 2");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n1e-15,1,0\n20,0,0\n", "per second");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n20,5,0\n", "rises to 6 m, above the domain");
    sea_refused(SEA_FLAT, TABLE, "t,eta,u\n0,0,0\n20,0,1e5\n", "speed of 100000 m/s");
    sea_refused(SEA_FLAT, TABLE ", level: 1, plane: a", "t,eta,u\n", "does not apply");
    sea_refused(SEA_FLAT, TABLE, NULL, "cannot read");
    sea_refused(SEA_SPACE, TABLE,
                "t,x,y,eta,u,v\n0,141.0,37.4,0,0,0\n0,141.1,37.4,0,0,0\n20,141.0,37.4,0,0,0\n20,141.1,37.4,0,0,0\n",
                "longitudes and latitudes");
    sea_refused(SEA_SPACE, TABLE, "t,x,y,eta,u,v\n0,0,0,0,0,0\n0,500,0,0,0,0\n20,0,0,0,0,0\n20,500,0,0,0,0\n",
                "(500, 0) lies 490 m from the domain");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_point),
        cmocka_unit_test(interpolation_is_monotone_and_of_second_order),
        cmocka_unit_test(several_points_along_a_side),
        cmocka_unit_test(a_place_is_the_zero_of_the_scene),
        cmocka_unit_test(lines_elsewhere_are_doubted),
        cmocka_unit_test(fast_water_is_doubted),
        cmocka_unit_test(without_a_header_and_with_comments),
        cmocka_unit_test(ends_of_lines_and_blanks),
        cmocka_unit_test(units_of_a_header),
        cmocka_unit_test(v_is_required_across_y),
        cmocka_unit_test(what_looks_like_degrees),
        cmocka_unit_test(gauges_of_geoclaw),
        cmocka_unit_test(what_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
