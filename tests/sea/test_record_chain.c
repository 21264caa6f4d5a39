/* A record that a run writes is read as given water. */
#include "output/tables/csv.h"
#include "sea_scene.h"

/* Rows of a wave that comes in alone: u = 2 sqrt(g h) - 2 sqrt(g d). */
static void write_record(const sea_case *c)
{
    sb_flow_plane plane = {"line", 0, 0, 0, 6, 0, 2, true, 0.1, 3, {.height = 0}};
    sb_scene scene = {.dimensions = 3, .measure = {.planes = &plane, .plane_count = 1}};
    const sb_model model = {0};
    sb_csv *csv;
    assert_int_equal(sb_csv_open(c->folder, &scene, &model, &csv, NULL), SB_OK);
    for (int i = 0; i <= 200; i++) {
        sb_water_record rows[2] = {{.time = 0.1 * i, .y = 1.5, .bed = 0}, {.time = 0.1 * i, .y = 4.5, .bed = 0}};
        for (int p = 0; p < 2; p++) {
            rows[p].surface = 1 + (p + 1) * 0.1 * pow(sin(0.1 * i), 2);
            for (int j = 0; j < SB_RECORD_LAYERS; j++)
                rows[p].velocity[j].x = 2 * sqrt(9.81) * (sqrt(rows[p].surface) - 1);
        }
        const sb_measure_records records = {.water_count = 2, .waters = rows};
        assert_int_equal(sb_csv_write(csv, &records, NULL), SB_OK);
    }
    assert_int_equal(sb_csv_close(csv, NULL), SB_OK);
}

static void a_written_record_is_read(void **state)
{
    (void)state;
    static const char *const names[] = {"forces.csv", "gauges.csv",      "probes.csv",
                                        "energy.csv", "overtopping.csv", "record.csv"};
    sea_case writer, reader;
    char path[300], block[400];
    sea_make(&writer, SEA_SPACE, "source: none", NULL);
    write_record(&writer);
    snprintf(block, sizeof block, "source: record, file: %s/record.csv, plane: line", writer.folder);
    sea_make(&reader, SEA_SPACE, block, NULL);
    for (double t = 0; t < 20; t += 0.1) {
        const double h = 1 + 0.1 * pow(sin(t), 2);
        const sb_sea_point low = sea_at(&reader, t, 0, 0, 0.5), middle = sea_at(&reader, t, 0, 3, 0.5);
        assert_near(low.surface, h, 1e-8); /* nine digits in the table */
        assert_near(low.velocity[0], 2 * sqrt(9.81) * (sqrt(h) - 1), 1e-7);
        assert_near(middle.surface, 1 + 1.5 * (h - 1), 1e-8);
    }
    sea_free(&reader);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%.250s/%s", writer.folder, names[i]);
        unlink(path);
    }
    sea_free(&writer);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_written_record_is_read)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
