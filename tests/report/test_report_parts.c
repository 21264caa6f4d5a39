/* The parts of a report that compute: loads, thinning, maps, smaller pictures. */
#include "run_fixture.h"

#include "render/image/image.h"
#include "report/grid.h"
#include "report/loads.h"
#include "report/thin.h"

static void loads_of_bodies(void **state)
{
    (void)state;
    make_run();
    write_forces(3, 100, 0);
    sb_report_run run;
    sb_loads loads;
    assert_int_equal(sb_report_run_read(in_folder("run"), &run, NULL), SB_OK);
    assert_int_equal(sb_loads_make(&run, &loads, NULL), SB_OK);
    assert_int_equal(loads.count, 3);
    assert_int_equal(loads.reached, 3);
    for (int k = 0; k < 3; k++) {
        const sb_load *load = &loads.loads[2 - k]; /* the greatest first */
        double up = 0, impulse = 0;
        for (int row = 1; row <= 100; row++) {
            up += -(k + 1) * 0.1 * row * (row % 7) * 0.1;
            impulse += 5 * (k + 1) * 0.1 * row * 0.1;
        }
        assert_near(load->horizontal, 50 * (k + 1), 1e-6);
        assert_near(load->horizontal_time, 10, 1e-9);
        assert_near(load->moment, 130 * (k + 1), 1e-5);
        assert_near(load->impulse_horizontal, impulse, 1e-6 * impulse);
        assert_near(load->impulse, hypot(impulse, up), 1e-6 * impulse);
        assert_near(load->up, 0, 0);
        assert_near(load->down, -(k + 1) * 9.7 * 6, 1e-6);
        assert_int_equal(load->judged, k < 2);
        assert_int_equal(load->coarse, k == 0);
        assert_int_equal(load->narrow, k == 1);
    }
    sb_loads_free(&loads);
    sb_report_run_free(&run);
}

/* Compares with a search of the rows of each group. */
static void thinning_keeps_extremes(void **state)
{
    (void)state;
    enum { ROWS = 5000, PIXELS = 50, COLUMNS = 5 };
    static double values[ROWS * COLUMNS];
    static uint8_t keep[ROWS];
    unsigned random = 1;
    for (int row = 0; row < ROWS; row++) {
        values[row * COLUMNS] = row;
        for (int c = 1; c < COLUMNS; c++) {
            random = random * 1664525u + 1013904223u;
            values[row * COLUMNS + c] = random % 17 == 0 ? (double)NAN : (double)(random >> 8);
        }
    }
    sb_series series = {.rows = ROWS, .values = values};
    const sb_series_table table = {.columns = COLUMNS, .count = 1, .series = &series};
    memset(keep, 0, sizeof keep);
    const size_t kept = sb_thin(&table, &series, PIXELS, keep);
    assert_true(kept <= sb_thin_most(&table, PIXELS));
    for (int pixel = 0; pixel < PIXELS; pixel++)
        for (int c = 1; c < COLUMNS; c++) {
            double high[2] = {-INFINITY, -INFINITY}, low[2] = {INFINITY, INFINITY};
            for (int row = 0; row < ROWS; row++) {
                const double value = values[row * COLUMNS + c];
                const int of = row * PIXELS / (ROWS - 1);
                if ((of < PIXELS ? of : PIXELS - 1) != pixel || isnan(value)) continue;
                high[0] = fmax(high[0], value);
                low[0] = fmin(low[0], value);
                if (!keep[row]) continue;
                high[1] = fmax(high[1], value);
                low[1] = fmin(low[1], value);
            }
            assert_near(high[1], high[0], 0);
            assert_near(low[1], low[0], 0);
        }
    assert_true(keep[0] && keep[ROWS - 1]);
}

static const char map_text[] = "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\ncellsize 5\nNODATA_value -9999\n"
                               "1 2 -9999\n4 5 6\n";

static void maps(void **state)
{
    (void)state;
    sb_grid grid = {0};
    sb_image image = {0};
    sb_error error = {0};
    write_text("map.asc", map_text);
    assert_int_equal(sb_grid_read(in_folder("map.asc"), &grid, &error), SB_OK);
    assert_int_equal(grid.wet, 5);
    assert_near(grid.low, 1, 0);
    assert_near(grid.high, 6, 0);
    const sb_stops stops = sb_stops_of("0 '#000000', 0.5 '#0a0b0c', 1 '#ffffff'");
    assert_int_equal(stops.count, 3);
    assert_int_equal(sb_grid_draw(&grid, &stops, 1, 6, &image, &error), SB_OK);
    assert_int_equal(image.rgb[0], 0);    /* 1 */
    assert_int_equal(image.rgb[6], 0xe9); /* dry */
    assert_int_equal(image.rgb[15], 255); /* 6 */
    assert_int_equal(image.rgb[3], 4);    /* 2: 0.4 of the way from 0 to 10 */
    assert_int_equal(sb_grid_coarsen(&grid, 2, &error), SB_OK);
    assert_int_equal(grid.columns, 2);
    assert_int_equal(grid.rows, 1);
    assert_near((double)grid.values[0], 5, 0);
    assert_near((double)grid.values[1], 6, 0);
    sb_image_free(&image);
    sb_grid_free(&grid);
}

static void damaged_maps(void **state)
{
    (void)state;
    static const char *const texts[] = {"", "ncols 3\n",
                                        "ncols 1e9\nnrows 1e9\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
                                        "NODATA_value -9999\n",
                                        "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\n"
                                        "cellsize 5\nNODATA_value -9999\n1 2 3\n4 x\n"};
    for (size_t t = 0; t < sizeof texts / sizeof *texts; t++) {
        sb_grid grid = {0};
        sb_error error = {0};
        write_text("map.asc", texts[t]);
        assert_int_equal(sb_grid_read(in_folder("map.asc"), &grid, &error), SB_BAD_INPUT);
        assert_has(error.text, "map.asc: ");
        assert_null(grid.values);
    }
    make_run();
    mkdir(in_folder("run/maps"), 0777);
    write_text("run/maps/max_depth.asc", "ncols x\n");
    write_text("run/maps/max_speed.asc", map_text);
    write_text("run/maps/ground.asc", map_text); /* no map of the water */
    char *text = report_text();
    assert_has(text, "max_depth.asc: line 1: expected ncols and a number");
    assert_has(text, "greatest speed (m/s)");
    assert_null(strstr(text, "ground (z, m)"));
    sb_free(text);
}

static void smaller_pictures(void **state)
{
    (void)state;
    enum { WIDTH = 30, HEIGHT = 20 };
    sb_image image = {0}, small = {0}, again = {0};
    sb_error error = {0};
    unsigned char *bytes = NULL;
    size_t size = 0;
    assert_int_equal(sb_image_resize(&image, WIDTH, HEIGHT, &error), SB_OK);
    for (int p = 0; p < WIDTH * HEIGHT; p++) {
        image.rgb[3 * p] = 200;
        image.rgb[3 * p + 1] = p % WIDTH < WIDTH / 2 ? 0 : 255;
        image.rgb[3 * p + 2] = p % 2 ? 255 : 0; /* stripes */
    }
    assert_int_equal(sb_image_shrink(&image, 7, &small, &error), SB_OK);
    assert_int_equal(small.height, 5);
    assert_int_equal(small.rgb[0], 200);
    assert_int_equal(small.rgb[1], 0);
    assert_int_equal(small.rgb[3 * 6 + 1], 255);
    assert_int_equal(sb_image_shrink(&image, 15, &small, &error), SB_OK);
    assert_int_equal(small.rgb[2], 188); /* half of the light of 255 */
    assert_int_equal(sb_png_encode(&small, &bytes, &size, &error), SB_OK);
    FILE *file = fopen(in_folder("small.png"), "wb");
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    assert_int_equal(sb_png_read(in_folder("small.png"), &again, &error), SB_OK);
    assert_int_equal(again.width, 15);
    assert_memory_equal(again.rgb, small.rgb, (size_t)(3 * 15 * small.height));
    file = fopen(in_folder("small.png"), "wb"); /* cut */
    assert_int_equal(fwrite(bytes, 1, size / 2, file), size / 2);
    fclose(file);
    assert_int_equal(sb_png_read(in_folder("small.png"), &again, &error), SB_BAD_INPUT);
    assert_has(error.text, "small.png: ");
    sb_free(bytes);
    sb_image_free(&image);
    sb_image_free(&small);
    sb_image_free(&again);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(loads_of_bodies), cmocka_unit_test(thinning_keeps_extremes),
                                       cmocka_unit_test(maps), cmocka_unit_test(damaged_maps),
                                       cmocka_unit_test(smaller_pictures)};
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
