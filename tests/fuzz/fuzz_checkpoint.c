/* Fuzzes the state and the measurements in a checkpoint. An input that begins with 'e' is a sequence of edits to a
   valid checkpoint of a run, one that begins with 's' to a valid checkpoint of the settling. Any other input is the
   file itself. Each input is loaded as it is, and again with corrected checksums, so that the code behind the checksums
   is tested. */
#include "fuzz.h"

#include "base/memory.h"
#include "measure/measure.h"
#include "sim/sim.h"

#include <stdbool.h>
#include <string.h>

enum { FORMAT = 1 };
static const char kind[] = "fuzzed";

static const char running[] =
    "dimensions: 2\n"
    "resolution: 0.1\n"
    "duration: 1\n"
    "domain: {min: [0, 0], max: [0.8, 0.6]}\n"
    "water: {boxes: [{min: [0.2, 0], max: [0.5, 0.3]}]}\n"
    "numerics: {settle_steps: 0}\n"
    "bodies: [{name: paddle, shape: box, min: [0, 0], max: [0.1, 0.6]}]\n"
    "wavemakers: [{name: w, body: paddle, kind: goring, height: 0.05, depth: 0.3, direction: [1, 0]}]\n"
    "measure:\n"
    "  gauges: [{name: g, x: 0.3}]\n"
    "  planes: [{name: p, from: [0.6], to: [0.6], z_min: 0, z_max: 0.6}]\n"
    "  map: {min: [0], max: [0.8], cell: 0.2}\n";

static const char settling[] = "dimensions: 2\n"
                               "resolution: 0.1\n"
                               "duration: 1\n"
                               "domain: {min: [0, 0], max: [0.8, 0.6]}\n"
                               "water: {level: 0.3, seed: [0.4, 0.2]}\n"
                               "numerics: {settle_steps: 20}\n"
                               "bodies: [{name: block, shape: box, min: [0, 0], max: [0.2, 0.6]}]\n";

/* A simulation and its valid checkpoint. */
typedef struct subject {
    const char *text;
    bool settles;
    sb_scene scene;
    sb_model model;
    sb_sim *sim;
    sb_measure *measure; /* NULL if it settles */
    sb_archive_out valid;
} subject;

static subject subjects[] = {{.text = running}, {.text = settling, .settles = true}};
enum { SUBJECTS = sizeof subjects / sizeof *subjects };

static void save(subject *s)
{
    sb_error error = {0};
    sb_archive_begin(&s->valid, kind, FORMAT);
    sb_sim_save(s->sim, &s->valid);
    if (s->measure) sb_measure_save(s->measure, &s->valid);
    FUZZ_CHECK(sb_archive_close(&s->valid, &error) == SB_OK);
}

static void save_third(void *context, int done, int most, double speed)
{
    (void)most;
    (void)speed;
    if (done == 3) save(context);
}

static void make(subject *s)
{
    sb_error error = {0};
    sb_status status = sb_scene_read(fuzz_save("scene.yaml", (const uint8_t *)s->text, strlen(s->text)), NULL, NULL, 0,
                                     &s->scene, &error);
    if (status == SB_OK) status = sb_model_build(&s->scene, &s->model, &error);
    if (status == SB_OK) status = sb_sim_create(&s->scene, &s->model, NULL, &s->sim, &error);
    if (status == SB_OK && s->settles) status = sb_sim_settle_watched(s->sim, save_third, s, &error);
    if (status == SB_OK && !s->settles) status = sb_measure_create(&s->scene, &s->model, s->sim, &s->measure, &error);
    if (status == SB_OK && !s->settles) status = sb_sim_step(s->sim, &error);
    if (status == SB_OK && !s->settles) status = sb_measure_step(s->measure, s->sim, &error);
    if (status != SB_OK) fprintf(stderr, "%s\n", error.text);
    FUZZ_CHECK(status == SB_OK);
    if (!s->settles) save(s);
    FUZZ_CHECK(s->valid.used > 0);
}

/* Returns whether the bytes were loaded without an error. */
static bool try_bytes(subject *s, const uint8_t *bytes, size_t size)
{
    sb_archive_in in = {0};
    sb_error error = {0};
    sb_status status = sb_archive_parse(&in, "some.checkpoint", bytes, size, kind, FORMAT, &error);
    if (status == SB_OK) status = sb_sim_load(s->sim, &in, &error);
    if (status == SB_OK && s->measure) status = sb_measure_load(s->measure, &in, &error);
    sb_archive_in_free(&in);
    if (status != SB_OK) fuzz_check_refusal(status, &error);
    return status == SB_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    for (size_t k = 0; k < SUBJECTS; k++)
        if (!subjects[k].sim) make(&subjects[k]);
    subject *s = &subjects[size > 0 && data[0] == 's'];
    const bool edits = size > 0 && (data[0] == 'e' || data[0] == 's');
    const size_t length = edits ? s->valid.used : size;
    uint8_t *bytes = malloc(length ? length : 1);
    FUZZ_CHECK(bytes);
    memcpy(bytes, edits ? s->valid.bytes : data, length);
    if (edits) fuzz_edit(bytes, length, data + 1, size - 1);
    try_bytes(s, bytes, length);
    fuzz_repair(bytes, length, kind, FORMAT);
    try_bytes(s, bytes, length);
    free(bytes);
    /* After any error, the valid checkpoint can still be loaded. */
    FUZZ_CHECK(try_bytes(s, s->valid.bytes, s->valid.used));
    return 0;
}
