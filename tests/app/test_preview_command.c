/* The picture of a scene's set-up. */
#include "program.h"

#include "base/memory.h"

#include <png.h>
#include <string.h>

enum { TILE_WIDTH = 1200, TILE_HEIGHT = 675 };

static void check_size(const char *path, int columns, int rows)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    if (!png_image_begin_read_from_file(&image, in_folder("%s", path))) fail_msg("%s: %s", path, image.message);
    assert_int_equal(image.width, columns * TILE_WIDTH);
    assert_int_equal(image.height, rows * TILE_HEIGHT);
    png_image_free(&image);
}

static void three_dimensions(void **state)
{
    (void)state;
    outcome o = RUN(0, "preview", "tank3.yaml", "-o", "a.png");
    assert_string_equal(o.out, "6 views in a.png\n");
    outcome_free(&o);
    check_size("a.png", 2, 3);
    /* An earlier picture of the program is replaced. */
    RUN_AND_FORGET(
        0, "preview", "tank3.yaml", "--out", "a.png", "--set",
        "render.cameras=[{name: p, closeup: post}, {name: o, orbit: {target: [1, 0, 0], radius: 3, period: 9}}, "
        "{name: f, eye: [1, -3, 1], target: [1, 0, 0], follow: crest}]");
    check_size("a.png", 2, 4);
    assert_false(exists("frames") || exists("run.jsonl"));
}

static void two_dimensions_and_walls_by_images(void **state)
{
    (void)state;
    outcome o = RUN(0, "preview", "tank2.yaml");
    assert_string_equal(o.out, "2 views in preview.png\n");
    outcome_free(&o);
    check_size("preview.png", 2, 1);
    RUN_AND_FORGET(0, "preview", "tank3.yaml", "-o", "images.png", "--set", "numerics.walls=images");
    check_size("images.png", 2, 3);
}

static void refuses(const char *expected, const char *const *arguments)
{
    outcome o = program_expect(1, arguments);
    assert_string_equal(o.out, "");
    assert_one_line(o.err, expected);
    outcome_free(&o);
}

#define REFUSES(expected, ...) refuses(expected, (const char *const[]){"preview", __VA_ARGS__, NULL})

static void bad_input_is_one_line(void **state)
{
    (void)state;
    write_text("notes.png", "my notes");
    REFUSES("notes.png: was not written by shorebreak; name another file with -o", "tank3.yaml", "-o", "notes.png");
    char *notes = text_of("notes.png");
    assert_string_equal(notes, "my notes");
    sb_free(notes);
    REFUSES("--out a.jpg: the picture is a PNG; expected a name that ends in .png", "tank3.yaml", "-o", "a.jpg");
    REFUSES("--out png: the picture is a PNG; expected a name that ends in .png", "tank3.yaml", "--out", "png");
    assert_false(exists("a.jpg"));
    REFUSES("-o: needs a value", "tank3.yaml", "-o");
    REFUSES("--resume: not an option of this command", "tank3.yaml", "--resume");
    REFUSES("none.yaml: cannot read", "none.yaml");
    REFUSES("render.cameras[0].closeup: no body is named pots, did you mean post?", "tank3.yaml", "--set",
            "render.cameras=[{name: a, closeup: pots}]");
    outcome o = RUN(2, "preview", "tank3.yaml", "-o", "no/such/folder/a.png");
    assert_one_line(o.err, "no/such/folder/a.png: cannot write: No such file or directory");
    outcome_free(&o);
    o = RUN(0, "preview", "--help");
    assert_contains(o.out, "usage: shorebreak preview SCENE");
    outcome_free(&o);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_dimensions),
        cmocka_unit_test(two_dimensions_and_walls_by_images),
        cmocka_unit_test(bad_input_is_one_line),
    };
    return cmocka_run_group_tests(tests, program_setup, program_teardown);
}
