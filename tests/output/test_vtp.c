/* Particle files are read back equal, also far from the origin; damaged files are refused. */
#include "output/particles/pvd.h"
#include "output/particles/vtp.h"

#include "base/random.h"
#include "folder.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static sb_frame *make_frame(size_t count, size_t bodies)
{
    sb_frame *frame = sb_frame_create(count, bodies);
    assert_non_null(frame);
    frame->origin = sb_vec(1.0e6 + 0.125, -2.0e6, 17);
    frame->spacing = 0.25;
    frame->index = 42;
    frame->status = (sb_frame_status){.step = 1234,
                                      .time = 5.4321,
                                      .duration = 90,
                                      .time_step = 0.0125,
                                      .iterations = 7,
                                      .density_error = 1e-4,
                                      .max_speed = 12.5,
                                      .wall_seconds = 33,
                                      .eta_seconds = 44,
                                      .lost_particles = 3};
    for (size_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            frame->position[3 * i + (size_t)k] = (float)(1000 * sb_random((uint64_t)k, i));
            frame->velocity[3 * i + (size_t)k] = (float)sb_random(10 + (uint64_t)k, i) - 0.5f;
        }
        frame->pressure[i] = (float)(1e5 * sb_random(20, i));
        frame->id[i] = (uint32_t)(count - i);
    }
    if (count % 2 == 1 && sb_frame_add_faces(frame, 3 * count)) /* the same */
        for (size_t f = 0; f < 3 * count; f++) frame->face_pressure[f] = (float)(1e4 * sb_random(31, f));
    if (count % 2 == 1 && sb_frame_add_density_error(frame)) /* an array that not all frames have */
        for (size_t i = 0; i < count; i++) frame->density_error[i] = (float)(0.01 * sb_random(30, i));
    for (size_t b = 0; b < bodies; b++) {
        sb_frame_body *body = &frame->bodies[b];
        snprintf(body->name, sizeof body->name, "body-%zu", b);
        body->displacement = sb_vec((double)b, 0.1, 0.2);
        body->force = sb_vec(1e7, (double)b, 3);
        body->moment = sb_vec(4, 5, (double)b);
        body->report = b % 2;
    }
    return frame;
}

static void assert_same(const sb_frame *a, const sb_frame *b)
{
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->body_count, b->body_count);
    assert_memory_equal(&a->origin, &b->origin, sizeof a->origin);
    assert_true(a->spacing == b->spacing && a->index == b->index);
    assert_true(a->status.step == b->status.step && a->status.time == b->status.time);
    assert_true(a->status.iterations == b->status.iterations);
    assert_true(a->status.eta_seconds == b->status.eta_seconds);
    assert_true(a->status.lost_particles == b->status.lost_particles);
    for (size_t i = 0; i < 3 * a->count; i++)
        assert_true(fabs((double)a->position[i] - (double)b->position[i]) < 1e-9 * 1e6);
    assert_memory_equal(a->velocity, b->velocity, 12 * a->count);
    assert_memory_equal(a->pressure, b->pressure, 4 * a->count);
    assert_memory_equal(a->id, b->id, 4 * a->count);
    assert_true((a->density_error == NULL) == (b->density_error == NULL));
    assert_int_equal(a->face_count, b->face_count);
    if (a->face_count > 0) assert_memory_equal(a->face_pressure, b->face_pressure, 4 * a->face_count);
    if (a->density_error) assert_memory_equal(a->density_error, b->density_error, 4 * a->count);
    for (size_t k = 0; k < a->body_count; k++) {
        assert_string_equal(a->bodies[k].name, b->bodies[k].name);
        assert_true(a->bodies[k].report == b->bodies[k].report);
        assert_memory_equal(&a->bodies[k].displacement, &b->bodies[k].displacement, sizeof(sb_vec3));
        assert_memory_equal(&a->bodies[k].force, &b->bodies[k].force, sizeof(sb_vec3));
        assert_memory_equal(&a->bodies[k].moment, &b->bodies[k].moment, sizeof(sb_vec3));
    }
}

static void round_trip(void **state)
{
    (void)state;
    const size_t counts[] = {0, 1, 4095, 4096, 10000}, bodies[] = {0, 1, 5, 0, 20};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        sb_frame *frame = make_frame(counts[i], bodies[i]), *read = NULL;
        sb_error error = {0};
        assert_int_equal(sb_vtp_write(in_folder("a.vtp"), frame, frame->index, &error), SB_OK);
        assert_int_equal(sb_vtp_read(in_folder("a.vtp"), &read, &error), SB_OK);
        assert_same(frame, read);
        sb_frame_release(frame);
        sb_frame_release(read);
    }
}

/* The layout that ParaView requires: offsets that point to the arrays' lengths, absolute doubles, and verts. */
static void layout_is_what_the_header_says(void **state)
{
    (void)state;
    sb_frame *frame = make_frame(5, 2);
    assert_int_equal(sb_vtp_write(in_folder("b.vtp"), frame, frame->index, NULL), SB_OK);
    char *bytes;
    size_t length;
    assert_int_equal(sb_file_read(in_folder("b.vtp"), 1 << 20, &bytes, &length, NULL), SB_OK);
    const char *base = strstr(bytes, "<AppendedData encoding=\"raw\">");
    assert_non_null(base);
    base = strchr(base, '_') + 1;
    size_t arrays = 0;
    uint64_t expected = 0;
    for (const char *tag = bytes; (tag = strstr(tag, "<DataArray ")) && tag < base; tag++) {
        uint64_t offset = strtoull(strstr(tag, "offset=\"") + 8, NULL, 10), size;
        assert_true(offset == expected);
        memcpy(&size, base + offset, sizeof size);
        expected = offset + sizeof size + size;
        arrays++;
        const char *data = base + offset + sizeof size;
        if (strncmp(tag, "<DataArray type=\"Float64\" Name=\"Points\"", 39) == 0) {
            double x;
            memcpy(&x, data, sizeof x);
            assert_true(x == frame->origin.x + (double)frame->position[0]);
            assert_int_equal(size, 5 * 24);
        }
        if (strncmp(tag, "<DataArray type=\"Int32\" Name=\"offsets\"", 38) == 0) {
            int32_t offsets[5];
            memcpy(offsets, data, sizeof offsets);
            assert_true(offsets[0] == 1 && offsets[4] == 5);
        }
    }
    assert_int_equal(arrays, 4 + 5 + 1 + 4 + 3);
    assert_true(strncmp(base + expected, "\n</AppendedData>", 16) == 0);
    assert_non_null(strstr(bytes, "NumberOfVerts=\"5\""));
    assert_non_null(strstr(bytes, "Name=\"TimeValue\""));
    sb_free(bytes);
    sb_frame_release(frame);
}

static void write_bytes(const char *name, const char *bytes, size_t length)
{
    FILE *stream = fopen(in_folder(name), "wb");
    assert_non_null(stream);
    fwrite(bytes, 1, length, stream);
    fclose(stream);
}

/* Files cut at every length, and with each byte of the header changed: an error or a frame, never a crash. */
static void damaged_files_are_refused(void **state)
{
    (void)state;
    sb_frame *frame = make_frame(20, 2);
    assert_int_equal(sb_vtp_write(in_folder("c.vtp"), frame, frame->index, NULL), SB_OK);
    char *bytes;
    size_t length, refused = 0;
    assert_int_equal(sb_file_read(in_folder("c.vtp"), 1 << 20, &bytes, &length, NULL), SB_OK);
    const char *base = strchr(strstr(bytes, "<AppendedData"), '_') + 1;
    size_t header = (size_t)(base - bytes), declaration = (size_t)(strstr(bytes, "<PolyData>") - bytes);
    size_t needed = length - strlen("\n</AppendedData>\n</VTKFile>\n") - 2 * (8 + 20 * 4);
    for (size_t cut = 0; cut < needed; cut += cut < header ? 61 : 7) {
        sb_frame *read = NULL;
        sb_error error = {0};
        write_bytes("d.vtp", bytes, cut);
        assert_int_equal(sb_vtp_read(in_folder("d.vtp"), &read, &error), SB_BAD_INPUT);
        assert_null(read);
        assert_non_null(strstr(error.text, "d.vtp"));
    }
    write_bytes("d.vtp", bytes, length);
    FILE *stream = fopen(in_folder("d.vtp"), "r+b");
    assert_non_null(stream);
    setvbuf(stream, NULL, _IONBF, 0);
    for (size_t i = 0; i < header + 300; i++)
        for (int k = 0; k < 3; k++) { /* changed twice, then restored */
            sb_frame *read = NULL;
            fseek(stream, (long)i, SEEK_SET);
            fputc(k == 0 ? bytes[i] ^ 0x81 : k == 1 ? '9' : bytes[i], stream);
            if (k == 2) continue;
            if (sb_vtp_read(in_folder("d.vtp"), &read, NULL) != SB_OK)
                refused++;
            else if (i < declaration && (k == 0 || bytes[i] != '9'))
                fail_msg("byte %zu of the declaration changed, and the file is read", i);
            else
                sb_frame_release(read);
        }
    fclose(stream);
    assert_true(refused > 500);
    sb_error error = {0};
    sb_frame *read = NULL;
    assert_int_equal(sb_vtp_read(in_folder("absent.vtp"), &read, &error), SB_BAD_INPUT);
    assert_non_null(strstr(error.text, "absent.vtp"));
    sb_free(bytes);
    sb_frame_release(frame);
}

/* Each value of each kind in turn is not a number. */
static void values_that_are_not_finite_are_refused(void **state)
{
    (void)state;
    sb_frame *frame = make_frame(20, 2);
    const float none[] = {(float)NAN, (float)INFINITY};
    float *const values[] = {&frame->position[59], &frame->velocity[0], &frame->pressure[7]};
    double *const doubles[] = {&frame->bodies[1].force.z,
                               &frame->bodies[0].moment.x,
                               &frame->bodies[1].displacement.y,
                               &frame->status.time,
                               &frame->status.eta_seconds,
                               &frame->origin.y,
                               &frame->spacing};
    for (int k = 0; k < 2; k++) {
        sb_frame *read = NULL;
        for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
            const float kept = *values[v];
            *values[v] = none[k];
            assert_int_equal(sb_vtp_write(in_folder("n.vtp"), frame, frame->index, NULL), SB_OK);
            assert_int_equal(sb_vtp_read(in_folder("n.vtp"), &read, NULL), SB_BAD_INPUT);
            *values[v] = kept;
        }
        for (size_t d = 0; d < sizeof doubles / sizeof *doubles; d++) {
            const double kept = *doubles[d];
            *doubles[d] = (double)none[k];
            assert_int_equal(sb_vtp_write(in_folder("n.vtp"), frame, frame->index, NULL), SB_OK);
            assert_int_equal(sb_vtp_read(in_folder("n.vtp"), &read, NULL), SB_BAD_INPUT);
            *doubles[d] = kept;
        }
        assert_null(read);
    }
    sb_frame_release(frame);
}

/* A step number in the status that is not a whole number is refused. */
static void fractional_counts_are_refused(void **state)
{
    (void)state;
    sb_frame *frame = make_frame(20, 2), *read = NULL;
    const double whole = 123456789, half = 123456789.5;
    frame->status.step = (uint64_t)whole;
    assert_int_equal(sb_vtp_write(in_folder("h.vtp"), frame, frame->index, NULL), SB_OK);
    char *bytes;
    size_t length;
    assert_int_equal(sb_file_read(in_folder("h.vtp"), 1 << 20, &bytes, &length, NULL), SB_OK);
    char *at = memmem(bytes, length, &whole, sizeof whole);
    assert_non_null(at);
    memcpy(at, &half, sizeof half);
    FILE *stream = fopen(in_folder("h.vtp"), "wb");
    assert_int_equal(fwrite(bytes, 1, length, stream), length);
    assert_int_equal(fclose(stream), 0);
    assert_int_equal(sb_vtp_read(in_folder("h.vtp"), &read, NULL), SB_BAD_INPUT);
    assert_null(read);
    sb_free(bytes);
    sb_frame_release(frame);
}

static void failing_memory_is_an_error(void **state)
{
    (void)state;
    sb_frame *frame = make_frame(20, 2);
    assert_int_equal(sb_vtp_write(in_folder("e.vtp"), frame, frame->index, NULL), SB_OK);
    int failures = 0;
    for (long n = 1; n < 50; n++) {
        sb_frame *read = NULL;
        sb_memory_fail_at(n);
        sb_status status = sb_vtp_read(in_folder("e.vtp"), &read, NULL);
        sb_memory_fail_at(0);
        failures += status == SB_FAILED;
        assert_true((status == SB_OK) == (read != NULL));
        sb_frame_release(read);
    }
    assert_true(failures >= 3 && failures < 49);
    sb_frame_release(frame);
}

/* A frame with foam, and one with the same origin that it is read into. */
static void make_foam(size_t count, sb_frame *frames[2])
{
    for (int k = 0; k < 2; k++) frames[k] = make_frame(3, 0);
    assert_int_equal(sb_frame_add_foam(frames[0], count), 0);
    sb_frame_foam *foam = &frames[0]->foam;
    for (size_t i = 0; i < 3 * count; i++) {
        foam->position[i] = 0.25f * (float)i;
        foam->velocity[i] = (float)sb_random(3, i);
    }
    for (size_t i = 0; i < count; i++) {
        foam->life[i] = (float)sb_random(4, i);
        foam->id[i] = (uint32_t)(1000 + i);
        foam->kind[i] = (uint8_t)(i % SB_FOAM_KINDS);
    }
}

static void foam_is_read_back(void **state)
{
    (void)state;
    static const size_t counts[] = {0, 1, 500};
    for (size_t c = 0; c < 3; c++) {
        const size_t n = counts[c];
        sb_frame *frames[2];
        sb_error error = {0};
        make_foam(n, frames);
        assert_int_equal(sb_vtp_write_foam(in_folder("f.vtp"), frames[0], &error), SB_OK);
        if (sb_vtp_read_foam(in_folder("f.vtp"), frames[1], &error) != SB_OK) fail_msg("%s", error.text);
        const sb_frame_foam *a = &frames[0]->foam, *b = &frames[1]->foam;
        assert_int_equal(b->count, n);
        assert_memory_equal(a->position, b->position, 12 * n); /* multiples of 1/4 */
        assert_memory_equal(a->velocity, b->velocity, 12 * n);
        assert_memory_equal(a->life, b->life, 4 * n);
        assert_memory_equal(a->id, b->id, 4 * n);
        assert_memory_equal(a->kind, b->kind, n);
        for (int k = 0; k < 2; k++) sb_frame_release(frames[k]);
    }
}

static void bad_foam_is_refused(void **state)
{
    (void)state;
    for (int fault = 0; fault < 4; fault++) {
        sb_frame *frames[2];
        sb_error error = {0};
        make_foam(20, frames);
        if (fault == 0) frames[0]->foam.kind[7] = SB_FOAM_KINDS;
        if (fault == 1) frames[0]->foam.life[19] = (float)NAN;
        if (fault == 2) frames[0]->foam.position[59] = (float)INFINITY;
        if (fault < 3) assert_int_equal(sb_vtp_write_foam(in_folder("g.vtp"), frames[0], NULL), SB_OK);
        /* A file of particles is none of foam. */
        if (fault == 3) assert_int_equal(sb_vtp_write(in_folder("g.vtp"), frames[0], 1, NULL), SB_OK);
        assert_int_equal(sb_vtp_read_foam(in_folder("g.vtp"), frames[1], &error), SB_BAD_INPUT);
        assert_non_null(strstr(error.text, "g.vtp"));
        for (int k = 0; k < 2; k++) sb_frame_release(frames[k]);
    }
}

static void bare_points(void **state)
{
    (void)state;
    const sb_vec3 at[2] = {{1, 2, 3}, {4, 5, 6}}, normals[2] = {{0, 0, 1}, {1, 0, 0}};
    const int32_t bodies[2] = {-1, 3};
    assert_int_equal(sb_vtp_write_points(in_folder("p.vtp"), 2, at, normals, bodies, NULL), SB_OK);
    char *text;
    size_t length;
    assert_int_equal(sb_file_read(in_folder("p.vtp"), 1 << 20, &text, &length, NULL), SB_OK);
    const char *base = strchr(strstr(text, "<AppendedData"), '_') + 1;
    assert_memory_equal(base + 8, normals, sizeof normals);
    assert_memory_equal(base + 8 + 48 + 8, bodies, sizeof bodies);
    assert_memory_equal(base + 8 + 48 + 8 + 8 + 8, at, sizeof at);
    sb_free(text);
    assert_int_equal(sb_vtp_write_points(in_folder("q.vtp"), 2, at, NULL, NULL, NULL), SB_OK);
    sb_error error = {0};
    assert_int_equal(sb_vtp_write_points(in_folder("no/q.vtp"), 2, at, NULL, NULL, &error), SB_FAILED);
    assert_non_null(strstr(error.text, "no/q.vtp"));
}

static sb_status add(sb_particle_list *list, double time, const char *file, sb_error *error)
{
    return sb_particle_list_add(list, time, file, strlen(file), error);
}

static void pvd_lists_real_times(void **state)
{
    (void)state;
    sb_particle_list list = {0}, read = {0};
    assert_int_equal(add(&list, 0, "particles/000001.vtp", NULL), SB_OK);
    assert_int_equal(add(&list, 0.50321, "particles/000002.vtp", NULL), SB_OK);
    assert_int_equal(sb_pvd_write(in_folder("particles.pvd"), &list, NULL), SB_OK);
    char *text = text_of("particles.pvd");
    assert_non_null(strstr(text, "<DataSet timestep=\"0.50321\" part=\"0\" file=\"particles/000002.vtp\"/>"));
    assert_int_equal(sb_pvd_read(in_folder("particles.pvd"), &read, NULL), SB_OK);
    assert_int_equal(read.count, 2);
    assert_true(read.entries[1].time == 0.50321);
    assert_string_equal(read.entries[0].file, "particles/000001.vtp");
    sb_particle_list_free(&read);
    size_t whole = (size_t)(strstr(text, "</Collection>") - text);
    for (size_t cut = 0; cut < whole; cut += 5) {
        sb_error error = {0};
        write_bytes("cut.pvd", text, cut);
        assert_int_equal(sb_pvd_read(in_folder("cut.pvd"), &read, &error), SB_BAD_INPUT);
        assert_null(read.entries);
    }
    sb_free(text);
    sb_error error = {0};
    assert_int_equal(add(&list, 1, "a\"b.vtp", &error), SB_BAD_INPUT);
    assert_int_equal(list.count, 2);
    sb_particle_list_free(&list);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(round_trip),
        cmocka_unit_test(layout_is_what_the_header_says),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(fractional_counts_are_refused),
        cmocka_unit_test(values_that_are_not_finite_are_refused),
        cmocka_unit_test(failing_memory_is_an_error),
        cmocka_unit_test(foam_is_read_back),
        cmocka_unit_test(bad_foam_is_refused),
        cmocka_unit_test(bare_points),
        cmocka_unit_test(pvd_lists_real_times),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
