/* Every row of the table of particle formats: its names are its own, its files begin as the row says, and what it reads
   is what it wrote. */
#include "output/particles/particle_format.h"

#include "folder.h"

#include <setjmp.h>
#include <stdarg.h>
#include <sys/stat.h>

#include <cmocka.h>

enum { PARTICLES = 3 };

static sb_frame *make_frame(void)
{
    sb_frame *frame = sb_frame_create(PARTICLES, 1);
    assert_non_null(frame);
    frame->origin = sb_vec(100, -20, 3);
    frame->spacing = 0.5;
    frame->status.time = 1.25;
    frame->status.duration = 2;
    for (size_t i = 0; i < PARTICLES; i++) {
        for (size_t k = 0; k < 3; k++) {
            frame->position[3 * i + k] = (float)(i + k);
            frame->velocity[3 * i + k] = -(float)k;
        }
        frame->pressure[i] = 1000 * (float)i;
        frame->id[i] = (uint32_t)(7 + i);
    }
    snprintf(frame->bodies[0].name, sizeof frame->bodies[0].name, "house");
    return frame;
}

static void assert_begins(const char *name, const char *start)
{
    char *text = text_of(name);
    assert_non_null(text);
    assert_true(strlen(start) > 0);
    assert_memory_equal(text, start, strlen(start));
    sb_free(text);
}

static void assert_differ(const char *a, const char *b)
{
    assert_true(!a || !b || strcmp(a, b) != 0);
}

static void names_are_unique(void **state)
{
    (void)state;
    size_t count = 0;
    for (; sb_particle_formats[count]; count++) {
        const sb_particle_format *one = sb_particle_formats[count];
        assert_true(one->name && *one->name && one->summary && *one->summary && one->write);
        assert_true(one->ending[0] == '.' && strlen(one->ending) > 1 && strlen(one->ending) < 16);
        assert_true(!one->read == !one->read_list);
        assert_true(!one->list_ending == !one->list_start && !one->list_ending == !one->write_list);
        assert_true(one->list_ending || !one->read);
        for (size_t k = 0; k < count; k++) {
            const sb_particle_format *other = sb_particle_formats[k];
            assert_differ(one->name, other->name);
            assert_differ(one->ending, other->ending);
            assert_differ(one->list_ending, other->list_ending);
        }
    }
    assert_true(count > 0);
}

static void files_are_named_by_the_row(void **state)
{
    (void)state;
    for (const sb_particle_format *const *row = sb_particle_formats; *row; row++) {
        char name[SB_PARTICLE_NAME_MAX], expected[SB_PARTICLE_NAME_MAX];
        sb_particle_format_file(*row, 12, name);
        snprintf(expected, sizeof expected, "particles/000012%s", (*row)->ending);
        assert_string_equal(name, expected);
        sb_particle_format_file(*row, 0, name);
        snprintf(expected, sizeof expected, "particles/last-good%s", (*row)->ending);
        assert_string_equal(name, expected);
        assert_true(sb_particle_format_list(*row, name) == ((*row)->list_ending != NULL));
    }
    const char *first = sb_particle_formats[0]->name;
    assert_string_equal(first, "vtp"); /* the documented format of a run */
}

static void each_format_reads_what_it_writes(void **state)
{
    (void)state;
    sb_frame *frame = make_frame();
    for (const sb_particle_format *const *row = sb_particle_formats; *row; row++) {
        sb_error error = {0};
        sb_frame *read = NULL;
        if ((*row)->write(in_folder("one"), frame, 5, &error) != SB_OK) fail_msg("%s", error.text);
        assert_begins("one", (*row)->start);
        assert_int_equal((*row)->write(in_folder("absent/one"), frame, 5, &error), SB_FAILED);
        assert_non_null(strstr(error.text, "absent/one"));
        if (!(*row)->read) continue;
        if ((*row)->read(in_folder("one"), &read, &error) != SB_OK) fail_msg("%s", error.text);
        assert_int_equal(read->count, PARTICLES);
        assert_int_equal(read->index, 5);
        assert_true(read->status.time == 1.25 && read->spacing == 0.5);
        for (size_t k = 0; k < 3; k++) { /* the origin may differ */
            const double at[] = {frame->origin.x, frame->origin.y, frame->origin.z};
            const double found[] = {read->origin.x, read->origin.y, read->origin.z};
            for (size_t i = 0; i < PARTICLES; i++)
                assert_true(at[k] + (double)frame->position[3 * i + k] == found[k] + (double)read->position[3 * i + k]);
        }
        assert_memory_equal(read->velocity, frame->velocity, 3 * PARTICLES * sizeof *frame->velocity);
        assert_memory_equal(read->pressure, frame->pressure, PARTICLES * sizeof *frame->pressure);
        assert_memory_equal(read->id, frame->id, PARTICLES * sizeof *frame->id);
        sb_frame_release(read);
    }
    sb_frame_release(frame);
}

static void each_list_is_read_back_and_identifies_the_format(void **state)
{
    (void)state;
    assert_ptr_equal(sb_particle_format_in(folder), sb_particle_formats[0]);
    for (const sb_particle_format *const *row = sb_particle_formats; *row; row++) {
        char name[SB_PARTICLE_NAME_MAX], file[SB_PARTICLE_NAME_MAX];
        sb_particle_list list = {0}, read = {0};
        if (!sb_particle_format_list(*row, name)) continue;
        for (uint64_t number = 1; number <= 2; number++) {
            sb_particle_format_file(*row, number, file);
            assert_int_equal(sb_particle_list_add(&list, 0.25 * (double)number, file, strlen(file), NULL), SB_OK);
        }
        assert_int_equal((*row)->write_list(in_folder(name), &list, NULL), SB_OK);
        assert_begins(name, (*row)->list_start);
        assert_ptr_equal(sb_particle_format_in(folder), *row);
        if ((*row)->read_list) {
            assert_int_equal((*row)->read_list(in_folder(name), &read, NULL), SB_OK);
            assert_int_equal(read.count, 2);
            assert_true(read.entries[0].time == 0.25 && read.entries[1].time == 0.5);
            assert_string_equal(read.entries[1].file, file);
        }
        assert_int_equal(unlink(in_folder(name)), 0);
        sb_particle_list_free(&list);
        sb_particle_list_free(&read);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_unique),
        cmocka_unit_test(files_are_named_by_the_row),
        cmocka_unit_test(each_format_reads_what_it_writes),
        cmocka_unit_test(each_list_is_read_back_and_identifies_the_format),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
