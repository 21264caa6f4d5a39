/* Tests of the common rules of tools/stress: each rule is violated once. */
#include "check.h"

#include "stress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char sound[] = "{\n  \"fluid_particles\": 100, \"lost_particles\": 0, \"through_walls\": 0,\n"
                            "  \"left_domain\": 0, \"unreported_solves\": 0, \"not_finite\": 0,\n"
                            "  \"bodies\": [{\"name\": \"post\", \"impulse_vector_Ns\": [1.5, -2, 3e2]}],\n"
                            "  \"energy_work\": {\"viscosity_J\": -0.5, \"contact_J\": -0.01},\n"
                            "  \"energy_start\": {\"kinetic_J\": 1, \"potential_J\": 2, \"mass_kg\": 50},\n"
                            "  \"energy_end\": {\"kinetic_J\": 0.5, \"potential_J\": 2, \"mass_kg\": 50}\n}\n";

static const sb_trial usual = {.name = "usual", .ends = SB_ENDS_WELL};

/* Judges a run with this summary, one part of which is replaced. */
static sb_judged judge(const char *text, const char *from, const char *to)
{
    static char changed[2048];
    const char *at = strstr(text, from);
    assert_non_null(at);
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    sb_judged judged = {.trial = &usual, .outcome = {.there = true, .how = SB_ENDS_WELL, .summary = changed}};
    sb_judge_common(&judged);
    return judged;
}

static void assert_fails(const char *from, const char *to, const char *why)
{
    sb_judged judged = judge(sound, from, to);
    if (!judged.fails || !strstr(judged.why, why))
        fail_msg("%s -> %s: expected to fail for \"%s\", failed for \"%s\"", from, to, why, judged.why);
}

static void test_valid_run_passes(void **state)
{
    (void)state;
    sb_judged judged = judge(sound, "100", "100");
    if (judged.fails) fail_msg("%s", judged.why);
    assert_near(sb_energy_of(&judged, false), 3, 0);
    assert_near(sb_energy_of(&judged, true), 2.5, 0);
    sb_vec3 impulse = sb_outcome_vector(&judged.outcome, "post", "impulse_vector_Ns");
    assert_true(impulse.x == 1.5 && impulse.y == -2 && impulse.z == 300);
    assert_true(isnan(sb_outcome_vector(&judged.outcome, "tower", "impulse_vector_Ns").x));
}

static void test_each_common_rule_can_fail(void **state)
{
    (void)state;
    assert_fails("\"lost_particles\": 0", "\"lost_particles\": 2", "2 particles lost");
    assert_fails("\"through_walls\": 0", "\"through_walls\": 3", "3 particles through walls");
    assert_fails("\"through_walls\": 0", "\"through_walls\": null", "through walls");
    assert_fails("\"unreported_solves\": 0", "\"unreported_solves\": 1", "unreported");
    assert_fails("\"not_finite\": 0", "\"not_finite\": 7", "not finite");
    assert_fails("\"left_domain\": 0", "\"left_domain\": 2.5", "unaccounted");
    assert_fails("\"left_domain\": 0", "\"left_domain\": 100", "unaccounted");
    assert_fails("\"mass_kg\": 50}\n}", "\"mass_kg\": 49.7}\n}", "unaccounted");
    assert_fails("\"contact_J\": -0.01", "\"contact_J\": 0.0004", "contact");
}

static void test_particles_that_left_are_counted(void **state)
{
    (void)state;
    char text[2048];
    const char *end = strstr(sound, "\"mass_kg\": 50}\n}");
    snprintf(text, sizeof text, "%.*s\"mass_kg\": 45}\n}", (int)(end - sound), sound);
    assert_false(judge(text, "\"left_domain\": 0", "\"left_domain\": 10").fails);
    assert_true(judge(text, "\"left_domain\": 0", "\"left_domain\": 9").fails);
    /* Ten particles left before t = 0. */
    assert_false(judge(sound, "\"left_domain\": 0", "\"left_domain\": 10").fails);
}

static void test_end_is_judged(void **state)
{
    (void)state;
    const struct {
        unsigned how, may;
        const char *last_line;
        bool fails;
    } rows[] = {
        {0, SB_ENDS_WELL, "", true},
        {SB_ENDS_REFUSED, SB_ENDS_WELL, "shorebreak: x.yaml:3:1: level: expected a number", true},
        {SB_ENDS_REFUSED, SB_ENDS_WELL | SB_ENDS_REFUSED, "shorebreak: x.yaml:3:1: level: expected a number", false},
        {SB_ENDS_REFUSED, SB_ENDS_WELL | SB_ENDS_REFUSED, "", true},
        {SB_ENDS_FAILED, SB_ENDS_FAILED, "Aborted", true},
        {SB_ENDS_FAILED, SB_ENDS_FAILED, "shorebreak: step 3: too fast: particle 7", false},
        {SB_ENDS_WELL, SB_ENDS_WELL, "", true}, /* no summary.json */
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const sb_trial trial = {.name = "end", .ends = rows[i].may};
        sb_judged judged = {.trial = &trial, .outcome = {.there = true, .how = rows[i].how}};
        snprintf(judged.outcome.last_line, sizeof judged.outcome.last_line, "%s", rows[i].last_line);
        sb_judge_common(&judged);
        if (judged.fails != rows[i].fails) fail_msg("row %zu: \"%s\"", i, judged.why);
    }
}

static void write_table(const char *folder, const char *name, const char *text)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

/* An empty field is not a number in a table where every field has one; it is allowed where places may be dry. */
static void test_nan_in_tables_is_found(void **state)
{
    (void)state;
    static const struct {
        const char *table, *rows, *found;
    } cases[] = {
        {"forces.csv", "h\n0,post,1,2\n1,post,,2\n", "forces.csv:3"},
        {"forces.csv", "h\n0,post,1,\n", "forces.csv:2"},
        {"forces.csv", "h\n0,nana,1,-2\n", ""},
        {"forces.csv", "h\n0,post,1,-inf\n", "forces.csv:2"},
        {"energy.csv", "h\n0,nan,1\n", "energy.csv:2"},
        {"gauges.csv", "h\n0,dry,\n", ""},
        {"gauges.csv", "h\n0,dry,nan\n", "gauges.csv:2"},
    };
    char folder[] = "/tmp/shorebreak-judge-XXXXXX", path[200];
    assert_non_null(mkdtemp(folder));
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        sb_outcome outcome = {0};
        snprintf(outcome.folder, sizeof outcome.folder, "%s", folder);
        write_table(folder, cases[c].table, cases[c].rows);
        sb_outcome_read(&outcome);
        assert_string_equal(outcome.not_a_number, cases[c].found);
        sb_outcome_free(&outcome);
        snprintf(path, sizeof path, "%s/%s", folder, cases[c].table);
        assert_int_equal(remove(path), 0);
    }
    assert_int_equal(remove(folder), 0);
}

static void test_names_are_unique(void **state)
{
    (void)state;
    for (size_t c = 0; sb_stresses[c]; c++) {
        for (size_t d = 0; d < c; d++) assert_string_not_equal(sb_stresses[c]->name, sb_stresses[d]->name);
        for (int quick = 0; quick < 2; quick++) {
            sb_trials trials = {.assets = SB_SOURCE_DIR "/assets/stress"};
            sb_stresses[c]->plan(&trials, quick);
            assert_false(trials.incomplete);
            assert_true(trials.count > 0);
            for (size_t i = 0; i < trials.count; i++) {
                const sb_trial *t = &trials.list[i];
                assert_true(t->name[0] && !strchr(t->name, '/') && t->name[0] != '.');
                for (size_t k = 0; k < i; k++)
                    if (strcmp(t->name, trials.list[k].name) == 0)
                        fail_msg("%s: two trials are named %s", sb_stresses[c]->name, t->name);
            }
            sb_trials_free(&trials);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_valid_run_passes),
        cmocka_unit_test(test_each_common_rule_can_fail),
        cmocka_unit_test(test_particles_that_left_are_counted),
        cmocka_unit_test(test_end_is_judged),
        cmocka_unit_test(test_nan_in_tables_is_found),
        cmocka_unit_test(test_names_are_unique),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
