/* Incident and reflected waves at gauges over water whose surface is a known sum of both. */
#include "../check.h"
#include "base/memory.h"
#include "fake_sim.h"
#include "physics/waves/dispersion.h"

static const double period = 1.6, depth = 1;

typedef struct flume {
    fake_world world;
    sb_vec3 *rest; /* positions in still water */
    sb_gauge gauges[4];
    sb_gauge_name names[4];
    sb_reflection_set sets[2];
    double free, bound; /* m, amplitudes of second harmonics */
    double longer;      /* of the first harmonic, over linear theory */
} flume;

/* 2D, 8 m long, 1 m deep, spacing 5 cm; gauges 0.3 to 1 m apart; windows of two periods, and one window. */
static void make(flume *f)
{
    static const double places[] = {3, 3.3, 3.8, 4.4};
    *f = (flume){.longer = 1};
    fake_world_make(&f->world, 2, 0.05, sb_vec(0, 0, 0), sb_vec(8, 0, 2));
    fake_fill(&f->world, sb_vec(0, 0, 0), sb_vec(8, 0, depth), 0, 0, 0, 1);
    f->rest = sb_alloc(f->world.sim.report.fluid_count, sizeof *f->rest);
    for (size_t i = 0; i < f->world.sim.report.fluid_count; i++) f->rest[i] = f->world.sim.samples[i].position;
    for (size_t g = 0; g < 4; g++) {
        snprintf(f->gauges[g].name, SB_NAME_MAX, "g%zu", g);
        snprintf(f->names[g].name, SB_NAME_MAX, "g%zu", g);
        f->gauges[g].x = places[g];
    }
    f->sets[0] = (sb_reflection_set){"windows", 4, f->names, period, 2, depth, 0, 0.5, 2 * period, false};
    f->sets[1] = (sb_reflection_set){"whole", 3, f->names, period, 1, depth, 0, 0, 1.5 * period, false};
    sb_measure_settings *measure = &f->world.scene.measure;
    measure->interval = 0.05;
    measure->gauges = f->gauges;
    measure->gauge_count = 4;
    measure->reflections = f->sets;
    measure->reflection_count = 2;
    f->world.scene.duration = 8;
}

static void put_surface(flume *f, double incident, double reflected)
{
    const double w = 2 * M_PI / period, k = sb_wave_number(period, depth, 9.81) / f->longer,
                 t = f->world.sim.report.time;
    const double k2 = sb_wave_number(period / 2, depth, 9.81);
    for (size_t i = 0; i < f->world.sim.report.fluid_count; i++) {
        const sb_vec3 at = f->rest[i];
        const double eta = incident * cos(k * at.x - w * t) + reflected * cos(k * at.x + w * t + 0.7) +
                           f->bound * cos(2 * (k * at.x - w * t)) + f->free * cos(k2 * at.x - 2 * w * t + 1);
        f->world.sim.samples[i].position.z = at.z + eta;
    }
}

/* Each window has a row per harmonic at its end. The gauges average over the kernel's width, which lowers the
   amplitude by (k s)^2 2/3 = 0.4 %. */
static void each_window_has_rows(void **state)
{
    (void)state;
    flume f;
    sb_measure *measure;
    make(&f);
    put_surface(&f, 0.1, 0.04);
    assert_int_equal(sb_measure_create(&f.world.scene, &f.world.model, &f.world.sim, &measure, NULL), SB_OK);
    size_t windows = 0, whole = 0, count;
    for (int s = 1; s <= 160; s++) {
        f.world.sim.report.time = 0.05 * s;
        put_surface(&f, 0.1, 0.04);
        assert_int_equal(sb_measure_step(measure, &f.world.sim, NULL), SB_OK);
        const sb_measure_records *records = sb_measure_latest(measure);
        for (size_t i = 0; i < records->reflection_count; i++) {
            const sb_reflection_record *row = &records->reflections[i];
            whole += row->set == 1;
            if (row->set == 0) assert_near(row->time, 0.5 + 3.2 * (double)(windows++ / 2 + 1), 1e-9);
            if (row->harmonic == 1) {
                assert_near(row->incident, 0.1, 0.01 * 0.1);
                assert_near(row->reflected, 0.04, 0.01 * 0.1);
                assert_near(row->wavelength, 2 * M_PI / sb_wave_number(period, depth, 9.81), 1e-12);
                assert_true(row->misfit < 0.01 * 0.1 && row->separation > 0.5);
            } else {
                assert_true(row->incident < 0.01 * 0.1 && row->period == period / 2);
            }
        }
    }
    assert_int_equal(windows, 4);
    assert_int_equal(whole, 3); /* 2.4, 4.8, 7.2 s: windows of one and a half periods */
    const sb_reflection_record *rows;
    assert_int_equal(sb_measure_reflections(measure, &rows, &count, NULL), SB_OK);
    assert_int_equal(count, 3);
    assert_true(rows[0].from == 0.5 && rows[1].harmonic == 2 && rows[2].set == 1 && rows[2].time == 8);
    assert_near(rows[2].reflected, 0.04, 0.01 * 0.1);
    sb_measure_destroy(measure);
    sb_free(f.rest);
    fake_world_free(&f.world);
}

/* Measures 75 rows, 3.75 s, of incident waves of 0.1 m and these reflected ones. */
static sb_measure *measured(flume *f, double reflected)
{
    sb_measure *measure;
    put_surface(f, 0.1, reflected);
    assert_int_equal(sb_measure_create(&f->world.scene, &f->world.model, &f->world.sim, &measure, NULL), SB_OK);
    for (int s = 1; s <= 75; s++) {
        f->world.sim.report.time = 0.05 * s;
        put_surface(f, 0.1, reflected);
        assert_int_equal(sb_measure_step(measure, &f->world.sim, NULL), SB_OK);
    }
    return measure;
}

/* A set that requires it finds a bound and a free second harmonic, and the other does not. The gauges'
   average over the kernel's width takes up to (k s)^2 2/3 = 7 % of a free wave of 0.8 s. */
static void bound_harmonics_are_split(void **state)
{
    (void)state;
    static const double places[] = {2, 2.6, 3.6, 5.5};
    flume f;
    sb_measure *measure;
    make(&f);
    for (int g = 0; g < 4; g++) f.gauges[g].x = places[g];
    f.sets[0].bound = true;
    f.bound = 0.02;
    f.free = 0.01;
    measure = measured(&f, 0);
    const sb_reflection_record *rows;
    size_t count;
    assert_int_equal(sb_measure_reflections(measure, &rows, &count, NULL), SB_OK);
    assert_near(rows[0].incident, 0.1, 0.01 * 0.1);
    assert_true(isnan(rows[0].bound_incident) && isnan(rows[2].bound_incident));
    assert_near(rows[1].incident, 0.01, 0.1 * 0.01);
    assert_near(rows[1].bound_incident, 0.02, 0.05 * 0.02);
    assert_true(rows[1].reflected < 1e-3 && rows[1].bound_reflected < 1e-3 && rows[1].separation > 0.05);
    sb_measure_destroy(measure);
    sb_free(f.rest);
    fake_world_free(&f.world);
}

/* High waves are longer than those of linear theory, with which a part of them seems to come back; with their own
   wavelength nothing does, and a bound harmonic is no free one. */
static void longer_waves_need_their_length(void **state)
{
    (void)state;
    static const double places[] = {2, 2.6, 3.6, 5.5};
    for (int given = 0; given < 2; given++) {
        flume f;
        sb_measure *measure;
        make(&f);
        f.longer = 1.04;
        f.bound = 0.02;
        f.sets[0].bound = true;
        for (int g = 0; g < 4; g++) f.gauges[g].x = places[g];
        if (given) f.sets[0].length = 1.04 * 2 * M_PI / sb_wave_number(period, depth, 9.81);
        measure = measured(&f, 0);
        const sb_reflection_record *rows;
        size_t count;
        assert_int_equal(sb_measure_reflections(measure, &rows, &count, NULL), SB_OK);
        assert_near(rows[0].wavelength, 2 * M_PI / sb_reflection_number(&f.world.scene, &f.sets[0], 1), 1e-12);
        assert_true((rows[0].reflected < 0.005 * 0.1) == given);
        assert_true((rows[1].incident < 0.05 * 0.02) == given);
        sb_measure_destroy(measure);
        sb_free(f.rest);
        fake_world_free(&f.world);
    }
}

/* A gauge outside of the water is left out; with one gauge left there is no split. */
static void dry_gauges_are_left_out(void **state)
{
    (void)state;
    for (int dry = 1; dry <= 3; dry++) {
        flume f;
        sb_measure *measure;
        make(&f);
        f.world.scene.measure.reflection_count = 1;
        for (int g = 0; g < dry; g++) f.gauges[g].x = 20 + g; /* beyond the water */
        measure = measured(&f, 0.04);
        size_t count;
        const sb_reflection_record *row;
        assert_int_equal(sb_measure_reflections(measure, &row, &count, NULL), SB_OK);
        assert_true(row->period == period);
        if (dry == 3) assert_true(isnan(row->incident) && isnan(row->reflected));
        sb_measure_destroy(measure);
        sb_free(f.rest);
        fake_world_free(&f.world);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_window_has_rows),
        cmocka_unit_test(bound_harmonics_are_split),
        cmocka_unit_test(longer_waves_need_their_length),
        cmocka_unit_test(dry_gauges_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
