#include "pair.h"

#include "../output/json_check.h"
#include "base/file.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "output/particles/pvd.h"
#include "output/particles/vtp.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char measured[] =
    "dimensions: 2\n"
    "resolution: 0.05\n"
    "duration: 0.6\n"
    "domain: {min: [0, 0], max: [3, 1]}\n"
    "water: {boxes: [{min: [0.3, 0], max: [1.4, 0.5]}]}\n"
    "bodies:\n"
    "  - {name: paddle, shape: box, min: [0, 0], max: [0.28, 0.9]}\n"
    "  - {name: step, shape: box, min: [1.5, 0], max: [1.8, 0.2]}\n"
    "wavemakers: [{name: w, body: paddle, kind: stroke, stroke: 0.2, speed: 0.5}]\n"
    "measure:\n"
    "  interval: 0.03\n"
    "  gauges: [{name: wet, x: 0.8}, {name: near, x: 0.9}, {name: mid, x: 0.6}, {name: dry, x: 2.8}]\n"
    "  reflections: [{name: r, gauges: [mid, wet, near], period: 0.2, depth: 0.5, harmonics: 1, window: 0.2}]\n"
    "  probes: [{name: deep, at: [0.8, 0.2]}]\n"
    "  planes: [{name: lip, from: [1.45], record: true}]\n"
    "  runups: [{name: floor, from: [0.3], to: [2.9]}]\n"
    "  map: {}\n"
    "output: {particle_interval: 0.1, plots: false}\n";

int pair_setup(void **state)
{
    if (program_setup(state) != 0) return -1;
    write_text("measured.yaml", measured);
    return 0;
}

int pair_setup_whole(void **state)
{
    if (pair_setup(state) != 0) return -1;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "whole", "--quiet", "--set", EVERY_THREE);
    return 0;
}

void assert_one_reason(const char *text, const char *expected)
{
    assert_int_equal(count_of(text, "shorebreak: "), 1);
    assert_contains(strstr(text, "shorebreak: "), expected);
}

const char *const pair_tables[] = {"forces.csv",
                                   "gauges.csv",
                                   "probes.csv",
                                   "energy.csv",
                                   "overtopping.csv",
                                   "runup.csv",
                                   "reflections.csv",
                                   "record.csv",
                                   "maps/max_depth.asc",
                                   "maps/max_speed.asc",
                                   "maps/arrival_time.asc",
                                   "maps/max_momentum_flux.asc",
                                   NULL};

void assert_same_file(const char *a, const char *b, const char *name)
{
    sb_error error = {0};
    char *text[2];
    size_t length[2];
    const char *const runs[] = {a, b};
    for (int k = 0; k < 2; k++)
        if (sb_file_read(in_folder("%s/%s", runs[k], name), 1 << 26, &text[k], &length[k], &error) != SB_OK)
            fail_msg("%s", error.text);
    if (length[0] != length[1] || memcmp(text[0], text[1], length[0]) != 0)
        fail_msg("%s/%s and %s/%s differ:\n%s---\n%s", a, name, b, name, text[0], text[1]);
    sb_free(text[0]);
    sb_free(text[1]);
}

void assert_same_frame(const sb_frame *one, const sb_frame *two)
{
    assert_int_equal(one->count, two->count);
    assert_int_equal(one->index, two->index);
    assert_memory_equal(one->position, two->position, 12 * one->count);
    assert_memory_equal(one->velocity, two->velocity, 12 * one->count);
    assert_memory_equal(one->pressure, two->pressure, 4 * one->count);
    assert_memory_equal(one->id, two->id, 4 * one->count);
    assert_int_equal(one->face_count, two->face_count);
    if (one->face_count > 0) assert_memory_equal(one->face_pressure, two->face_pressure, 4 * one->face_count);
}

/* Particle files contain the wall time; everything else is compared. */
static void assert_same_particles(const char *a, const char *b)
{
    sb_particle_list list = {0};
    sb_error error = {0};
    assert_same_file(a, b, "particles.pvd");
    assert_int_equal(sb_pvd_read(in_folder("%s/particles.pvd", a), &list, &error), SB_OK);
    for (size_t i = 0; i < list.count; i++) {
        sb_frame *one = NULL, *two = NULL;
        if (sb_vtp_read(in_folder("%s/%s", a, list.entries[i].file), &one, &error) != SB_OK ||
            sb_vtp_read(in_folder("%s/%s", b, list.entries[i].file), &two, &error) != SB_OK)
            fail_msg("%s", error.text);
        assert_same_frame(one, two);
        sb_frame_release(one);
        sb_frame_release(two);
    }
    assert_false(access(in_folder("%s/particles/%06zu.vtp", b, list.count + 1), F_OK) == 0);
    sb_particle_list_free(&list);
}

static void hash_of(const char *run, char hash[32])
{
    char name[96];
    snprintf(name, sizeof name, "%s/summary.json", run);
    char *text = text_of(name);
    const char *value = json_find(text, "state_hash");
    assert_non_null(value);
    assert_int_equal(sscanf(value, "\"%31[0-9a-f]\"", hash), 1);
    sb_free(text);
}

void assert_same_run(const char *a, const char *b, const char *const *files)
{
    static const char *const numbers[] = {
        "simulated_s", "steps",          "mean_iterations", "peak_N",           "peak_time_s",    "impulse_Ns",
        "kinetic_J",   "particle_files", "pictures",        "compression_mean", "compression_max"};
    char hash[2][32], name[2][96];
    hash_of(a, hash[0]);
    hash_of(b, hash[1]);
    if (strcmp(hash[0], hash[1]) != 0) fail_msg("%s ends as %s, %s as %s", a, hash[0], b, hash[1]);
    snprintf(name[0], sizeof name[0], "%s/summary.json", a);
    snprintf(name[1], sizeof name[1], "%s/summary.json", b);
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++)
        assert_near(json_number_of(name[0], numbers[k]), json_number_of(name[1], numbers[k]), 0);
    for (; *files; files++) assert_same_file(a, b, *files);
    assert_same_particles(a, b);
}

int list_checkpoints(const char *run, char names[16][64])
{
    struct dirent **entries;
    int found = scandir(in_folder("%s/checkpoints", run), &entries, NULL, alphasort), count = 0;
    assert_true(found >= 0);
    for (int i = 0; i < found; i++) {
        if (entries[i]->d_name[0] != '.' && count < 16) snprintf(names[count++], 64, "%.63s", entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
    return count;
}

int count_of(const char *text, const char *part)
{
    int count = 0;
    for (; (text = strstr(text, part)); text += strlen(part)) count++;
    return count;
}

char *bytes_of(const char *name, size_t *length)
{
    sb_error error = {0};
    char *bytes;
    if (sb_file_read(in_folder("%s", name), 1 << 26, &bytes, length, &error) != SB_OK) fail_msg("%s", error.text);
    return bytes;
}

void put_bytes(const char *name, const char *bytes, size_t length)
{
    FILE *file = fopen(in_folder("%s", name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}
