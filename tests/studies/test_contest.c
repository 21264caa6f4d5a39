/* Tests of the errors of choices, and of the tables of choices and subjects. */
#include "check.h"

#include "choice.h"
#include "entries.h"
#include "sensitivity.h"
#include "subject.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const houses[] = {"a", "b", NULL};

static void put(sb_figures *figures, const char *quantity, double reference, double value)
{
    sb_figure_report(figures, quantity, "N", reference, value, "%s", "");
}

static void test_error_of_figure_is_absolute(void **state)
{
    (void)state;
    const sb_error_measure m = {"peak", "%", "peak force", NULL};
    sb_figures f = {0};
    put(&f, "peak force", 10, 8);
    assert_near(sb_subject_error(&m, &f, NULL, 0), 20, 1e-12);
    const sb_error_measure other = {"peak", "%", "no such figure", NULL};
    assert_true(isnan(sb_subject_error(&other, &f, NULL, 0)));
    sb_figures_free(&f);
}

/* Error against the mean of two reference runs: (|13 - 10| + |4 - 6|)/16. */
static void test_errors_of_bodies_are_weighted_by_load(void **state)
{
    (void)state;
    const sb_error_measure m = {"impulse", "%", "#, impulse", houses};
    sb_figures f = {0}, first = {0}, second = {0};
    const sb_figures *const references[] = {&first, &second};
    put(&f, "a, impulse", (double)NAN, 13);
    put(&f, "b, impulse", (double)NAN, 4);
    put(&first, "a, impulse", (double)NAN, 9);
    put(&first, "b, impulse", (double)NAN, 7);
    put(&second, "a, impulse", (double)NAN, 11);
    put(&second, "b, impulse", (double)NAN, 5);
    assert_near(sb_subject_error(&m, &f, references, 2), 100 * 5.0 / 16, 1e-12);
    const sb_error_measure one = {"impulse", "%", "b, impulse", NULL};
    assert_near(sb_subject_error(&one, &f, references, 2), 100 * 2.0 / 6, 1e-12);
    sb_figures_free(&f);
    sb_figures_free(&first);
    sb_figures_free(&second);
}

static bool is_default_key(const char *name)
{
    for (const sb_sensitivity_key *key = sb_sensitivity_keys; key->key; key++)
        if (strcmp(key->key, name) == 0) return true;
    return false;
}

static size_t entries_of(const sb_subject *subject, const char *scene)
{
    sb_store store = {.assets = SB_SOURCE_DIR "/assets/validation"};
    sb_contest c;
    size_t count = 0;
    assert_int_equal(sb_contest_begin(&c, subject, &store, &(sb_contest_selection){.seeds = 1}, NULL), SB_OK);
    for (size_t i = 0; i < c.trial_count; i++) count += strstr(c.trials[i].request.of->scene, scene) != NULL;
    sb_contest_free(&c);
    return count;
}

/* Four rows at three spacings have the plant's nested scene; other subjects have none of them. */
static void test_rows_of_one_subject_have_its_scene(void **state)
{
    (void)state;
    for (const sb_subject *s = sb_subjects; s->name; s++)
        assert_int_equal(entries_of(s, "plant-coast.yaml"), strcmp(s->name, "plant") == 0 ? 12 : 0);
}

/* Only the first row changes nothing; every scene accepts all settings; names are unique. */
static void test_choices_are_valid(void **state)
{
    (void)state;
    for (const sb_choice *c = sb_choices; c->name; c++) {
        assert_true(c == sb_choices || c->paper || c->key || c->fixed[0]);
        assert_true(!c->key || (is_default_key(c->key) && c->factor > 0 && c->factor != 1));
        for (const sb_choice *k = sb_choices; k < c; k++) assert_string_not_equal(k->name, c->name);
    }
    sb_store store = {.assets = SB_SOURCE_DIR "/assets/validation"};
    char record[] = "/tmp/test-contest-XXXXXX", file[64];
    assert_non_null(mkdtemp(record));
    snprintf(file, sizeof file, "%s/record.csv", record);
    FILE *empty = fopen(file, "w");
    assert_true(empty && fclose(empty) == 0);
    for (const sb_subject *s = sb_subjects; s->name; s++) {
        sb_contest c;
        sb_error error = {0};
        char folder[SB_PATH_MAX];
        if (sb_contest_begin(&c, s, &store, &(sb_contest_selection){.seeds = 1}, &error) != SB_OK)
            fail_msg("%s", error.text);
        for (size_t i = 0; i < c.record_count; i++)
            if (sb_run_folder(&store, &c.records[i].request, folder, &error) != SB_OK) fail_msg("%s", error.text);
        for (sb_entry *e = c.entries; e < c.entries + c.entry_count; e++)
            for (size_t i = e->first; i < e->first + e->seeds; i++)
                if (sb_contest_record(&c, e, i)) c.trials[i].request.replays = record;
        for (size_t i = 0; i < c.trial_count; i++)
            if (sb_run_folder(&store, &c.trials[i].request, folder, &error) != SB_OK) fail_msg("%s", error.text);
        sb_contest_free(&c);
    }
    assert_true(remove(file) == 0 && rmdir(record) == 0);
}

/* The choice `wcsph` has the numerics of the preset `wen`; only some scenes have slow choices. */
static void test_wcsph_is_the_preset_wen(void **state)
{
    (void)state;
    const sb_store store = {.assets = SB_SOURCE_DIR "/assets/validation"};
    size_t found = 0, without = 0;
    for (const sb_subject *s = sb_subjects; s->name; s++) {
        sb_contest c;
        size_t before = found;
        assert_int_equal(sb_contest_begin(&c, s, &store, &(sb_contest_selection){.seeds = 1, .few = true}, NULL),
                         SB_OK);
        for (size_t i = 0; i < c.entry_count; i++) {
            if (!c.entries[i].choice || strcmp(c.entries[i].choice->name, "wcsph") != 0) continue;
            sb_settings settings;
            sb_scene made, preset;
            char path[SB_PATH_MAX], resolution[48];
            const sb_request *request = &c.trials[c.entries[i].first].request;
            sb_request_settings(request, &settings);
            snprintf(resolution, sizeof resolution, "%s", settings.resolution);
            const char *const plain[] = {resolution};
            assert_int_equal(sb_path_join(path, store.assets, s->of->scene, NULL), SB_OK);
            assert_int_equal(sb_settings_scene(path, "default", settings.list, settings.count, &made, NULL), SB_OK);
            assert_int_equal(sb_settings_scene(path, "wen", plain, 1, &preset, NULL), SB_OK);
            made.numerics.preset = preset.numerics.preset;
            assert_memory_equal(&made.numerics, &preset.numerics, sizeof made.numerics);
            sb_scene_free(&made);
            sb_scene_free(&preset);
            found++;
        }
        without += found == before;
        assert_true((found > before) == s->slow);
        sb_contest_free(&c);
    }
    assert_true(found > 1 && without > 1);
}

/* All but the wave basin, which takes too long, have a quick form. */
static void test_subjects_have_spacings_and_errors(void **state)
{
    (void)state;
    int forms = 0, subjects = 0;
    for (const sb_subject *s = sb_subjects; s->name; s++) {
        assert_true(s->full[0] > 0 && s->errors[0].name);
        forms += s->quick[0] > 0;
        for (int i = 0; s->full[i] > 0; i++) assert_true(s->full_reference < s->full[i]);
        for (int i = 0; s->quick[i] > 0; i++) assert_true(s->quick_reference < s->quick[i]);
        assert_true((s->full_reference > 0) == (s->quick_reference > 0));
        subjects++;
    }
    assert_int_equal(forms, subjects - 1);
}

/* Fewer choices or spacings, or another spacing of the reference, are selected. There is a reference only if runs are
   compared with it. */
static void test_part_of_runs_can_be_selected(void **state)
{
    (void)state;
    const sb_store store = {.assets = SB_SOURCE_DIR "/assets/validation"};
    const sb_subject *s = sb_subjects;
    while (s->full_reference <= 0 || s->full[1] <= 0) s++;
    const sb_contest_selection selections[] = {
        {.seeds = 1},
        {.seeds = 1, .few = true},
        {.seeds = 1, .spacings = 1},
        {.seeds = 1, .spacing = s->full[1]},
        {.seeds = 1, .spacing = 0.123},
        {.seeds = 1, .reference = 3},
    };
    enum { SELECTIONS = sizeof selections / sizeof *selections };
    size_t entries[SELECTIONS];
    for (size_t w = 0; w < SELECTIONS; w++) {
        sb_contest c;
        sb_error error = {0};
        if (sb_contest_begin(&c, s, &store, &selections[w], &error) != SB_OK) fail_msg("%s", error.text);
        entries[w] = c.entry_count;
        const double reference = selections[w].reference > 0 ? selections[w].reference : s->full_reference;
        assert_true(c.entry_count == 0 || (!c.entries[0].choice && c.entries[0].plan.resolution == reference));
        for (size_t i = 1; i < c.entry_count; i++) {
            const double spacing = c.entries[i].plan.resolution;
            assert_true(!selections[w].few || c.entries[i].choice->quick);
            assert_true(!selections[w].spacings || spacing == s->full[0]);
            assert_true(!(selections[w].spacing > 0) || spacing == selections[w].spacing);
        }
        sb_contest_free(&c);
    }
    assert_true(entries[1] < entries[0] && entries[2] < entries[0]);
    assert_int_equal(entries[3], entries[2]);
    assert_int_equal(entries[4], 0);
    assert_int_equal(entries[5], entries[0]);
    assert_true(s->full_reference != 3);
}

/* By a part of their names choices are selected in any form, beside `default` and the reference. */
static void test_choices_can_be_selected(void **state)
{
    (void)state;
    const sb_store store = {.assets = SB_SOURCE_DIR "/assets/validation"};
    const sb_subject *plant = sb_subjects;
    while (strcmp(plant->name, "plant") != 0) plant++;
    const sb_contest_selection nested = {.quick = true, .seeds = 1, .choice = "sea nested"};
    const sb_contest_selection none = {.quick = true, .seeds = 1, .choice = "sea nestled"};
    sb_contest c;
    sb_error error = {0};
    if (sb_contest_begin(&c, plant, &store, &nested, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(c.entry_count, 5); /* with the reference, and one that the quick form omits */
    assert_null(c.entries[0].choice);
    assert_string_equal(c.entries[1].choice->name, "default");
    for (size_t i = 2; i < c.entry_count; i++) assert_non_null(strstr(c.entries[i].choice->name, "sea nested"));
    sb_contest_free(&c);
    if (sb_contest_begin(&c, plant, &store, &none, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(c.trial_count, 0);
    sb_contest_free(&c);
    /* Choices of the plant are none of another scene. */
    if (sb_contest_begin(&c, sb_subjects, &store, &nested, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(c.trial_count, 0);
    sb_contest_free(&c);
}

/* Marks a trial as finished with this run time and first error, in the unit of the figure. */
static void mark_done(sb_contest *c, const sb_entry *e, size_t seed, double seconds, double error)
{
    sb_result *t = &c->trials[e->first + seed];
    t->state = SB_RESULT_DONE;
    t->run.view.wall = seconds;
    t->run.cpu = 2 * seconds;
    t->run.threads = 2;
    put(&t->figures, c->subject->errors[0].quantity, 100, 100 + error);
}

static void test_means_over_seeds_and_front(void **state)
{
    (void)state;
    sb_store store = {.assets = SB_SOURCE_DIR "/assets/validation"};
    sb_contest c;
    sb_error error = {0};
    const sb_subject *column = &sb_subjects[1];
    if (sb_contest_begin(&c, column, &store, &(sb_contest_selection){.quick = true, .seeds = 2}, &error) != SB_OK)
        fail_msg("%s", error.text);
    assert_true(c.entry_count > 3);
    assert_int_equal(c.trial_count, 2 * c.entry_count);
    const sb_entry *e = c.entries;
    mark_done(&c, &e[0], 0, 10, -4);
    mark_done(&c, &e[0], 1, 12, 6);
    mark_done(&c, &e[1], 0, 20, 6); /* slower, larger error */
    mark_done(&c, &e[2], 0, 30, 1); /* slower, smaller error */
    assert_int_equal(sb_contest_judge(&c, false, &error), SB_OK);
    assert_near(e[0].time.mean, 11, 1e-12);
    assert_near(e[0].errors[0].mean, 5, 1e-12);
    assert_near(e[0].errors[0].low, 4, 1e-12);
    assert_near(e[0].errors[0].high, 6, 1e-12);
    assert_true(e[0].front && !e[1].front && e[2].front);
    assert_false(e[3].front);
    assert_true(isnan(e[3].time.mean) && isnan(e[1].errors[1].mean));
    assert_int_equal(sb_contest_judge(&c, true, &error), SB_OK);
    assert_near(e[0].time.mean, 22, 1e-12);
    /* A run time with fewer threads is not compared; its processor time is. */
    c.trials[e[2].first].run.threads = 1;
    assert_int_equal(sb_contest_judge(&c, true, &error), SB_OK);
    assert_near(e[2].time.mean, 60, 1e-12);
    assert_int_equal(sb_contest_judge(&c, false, &error), SB_OK);
    assert_true(isnan(e[2].time.mean) && !e[2].front);
    sb_contest_free(&c);
}

/* The seeds of the reference are compared with each other; without the reference there are no errors. */
static void test_reference_is_mean_of_its_seeds(void **state)
{
    (void)state;
    sb_store store = {.assets = SB_SOURCE_DIR "/assets/validation"};
    sb_contest c;
    sb_error error = {0};
    const sb_subject *s = sb_subjects;
    while (s->quick_reference <= 0) s++;
    if (sb_contest_begin(&c, s, &store, &(sb_contest_selection){.quick = true, .seeds = 2}, &error) != SB_OK)
        fail_msg("%s", error.text);
    const sb_entry *e = c.entries;
    assert_null(e[0].choice);
    assert_near(e[0].plan.resolution, s->quick_reference, 0);
    for (size_t i = 0; i < 3; i++) {
        sb_result *t = &c.trials[i];
        t->state = i < 2 ? SB_RESULT_NOT_RUN : SB_RESULT_DONE;
        t->run.view.wall = 1;
        for (const char *const *body = s->errors[0].bodies; *body; body++) {
            char quantity[SB_FIGURE_TEXT];
            snprintf(quantity, sizeof quantity, "%s%s", *body, s->errors[0].quantity + 1);
            put(&t->figures, quantity, (double)NAN, i == 0 ? 8 : i == 1 ? 12 : 15);
        }
    }
    assert_int_equal(sb_contest_judge(&c, false, &error), SB_OK);
    assert_true(isnan(e[1].errors[0].mean) && !e[1].front);
    c.trials[0].state = c.trials[1].state = SB_RESULT_DONE;
    assert_int_equal(sb_contest_judge(&c, false, &error), SB_OK);
    assert_near(e[0].errors[0].mean, 50 * (4.0 / 12 + 4.0 / 8), 1e-12);
    assert_near(e[1].errors[0].mean, 50, 1e-12);
    assert_true(e[1].front && !e[0].front);
    sb_contest_free(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_error_of_figure_is_absolute),
        cmocka_unit_test(test_errors_of_bodies_are_weighted_by_load),
        cmocka_unit_test(test_choices_are_valid),
        cmocka_unit_test(test_wcsph_is_the_preset_wen),
        cmocka_unit_test(test_rows_of_one_subject_have_its_scene),
        cmocka_unit_test(test_part_of_runs_can_be_selected),
        cmocka_unit_test(test_choices_can_be_selected),
        cmocka_unit_test(test_means_over_seeds_and_front),
        cmocka_unit_test(test_reference_is_mean_of_its_seeds),
        cmocka_unit_test(test_subjects_have_spacings_and_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
