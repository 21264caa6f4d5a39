/* The files that all ranks of a run write together: pieces of particle files, and checkpoints. */
#include "pair.h"

#include "base/memory.h"
#include "output/particles/pvd.h"
#include "output/particles/pvtp.h"
#include "output/particles/vtp.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PIECES "output.particle_pieces=true"

/* Fails unless the pieces of each time of `run`, one after another, are the particles of the file of the same number of
   the run "whole". The wall times differ. */
static void assert_pieces_are_whole(const char *run)
{
    sb_particle_list list = {0}, single = {0};
    sb_error error = {0};
    assert_int_equal(sb_pvd_read(in_folder("whole/particles.pvd"), &single, &error), SB_OK);
    if (sb_pvd_read(in_folder("%s/particles-pieces.pvd", run), &list, &error) != SB_OK) fail_msg("%s", error.text);
    assert_int_equal(list.count, single.count);
    assert_true(list.count > 3);
    for (size_t i = 0; i < list.count; i++) {
        sb_frame *one = NULL, *two = NULL;
        assert_true(list.entries[i].time == single.entries[i].time);
        if (sb_vtp_read(in_folder("whole/%s", single.entries[i].file), &one, &error) != SB_OK ||
            sb_pvtp_read(in_folder("%s/%s", run, list.entries[i].file), &two, &error) != SB_OK)
            fail_msg("%s", error.text);
        assert_same_frame(one, two);
        assert_int_equal(one->body_count, two->body_count);
        for (size_t b = 0; b < one->body_count; b++)
            assert_memory_equal(&one->bodies[b].force, &two->bodies[b].force, sizeof one->bodies[b].force);
        sb_frame_release(one);
        sb_frame_release(two);
    }
    assert_true(access(in_folder("%s/particles.pvd", run), F_OK) != 0);
    sb_particle_list_free(&list);
    sb_particle_list_free(&single);
}

static void one_process_writes_one_piece(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "alone", "--quiet", "--set", EVERY_THREE, "--set", PIECES);
    assert_pieces_are_whole("alone");
    assert_true(exists("alone/particles/rank0/000001.vtp"));
    assert_false(exists("alone/particles/rank1"));
    assert_same_file("whole", "alone", "energy.csv");
}

static void each_rank_writes_its_piece(void **state)
{
    (void)state;
    NEEDS_MPI();
    RUN_ON("3", 0, "measured.yaml", "--out", "three", "--quiet", "--set", EVERY_THREE, "--set", PIECES);
    assert_pieces_are_whole("three");
    sb_frame *piece = NULL;
    for (int rank = 0; rank < 3; rank++) {
        assert_int_equal(sb_vtp_read(in_folder("three/particles/rank%d/000002.vtp", rank), &piece, NULL), SB_OK);
        assert_true(piece->count > 0); /* no rank gathers the particles of all */
        sb_frame_release(piece);
    }
}

/* Resumed by fewer ranks, the run replaces the pieces after the checkpoint, also those of a rank that it has no more.
 */
static void a_run_with_pieces_resumes(void **state)
{
    (void)state;
    NEEDS_MPI();
    RUN_ON("3", 0, "measured.yaml", "--out", "parts", "--quiet", "--set", EVERY_THREE, "--set", PIECES, "--until",
           "0.25");
    assert_true(exists("parts/particles/rank2/000002.vtp"));
    assert_int_equal(
        rename(in_folder("parts/particles/rank2/000001.vtp"), in_folder("parts/particles/rank2/000007.vtp")),
        0); /* as of a run that was killed later */
    RUN_ON("2", 0, "measured.yaml", "--out", "parts", "--quiet", "--set", EVERY_THREE, "--set", PIECES, "--resume");
    assert_false(exists("parts/particles/rank2/000007.vtp"));
    assert_true(exists("parts/particles/rank1/000006.vtp"));
    assert_false(exists("parts/particles/rank2/000006.vtp"));
    RUN_ON("2", 0, "measured.yaml", "--out", "parts", "--quiet", "--set", EVERY_THREE, "--overwrite");
    assert_false(exists("parts/particles/rank2/000002.vtp"));
    assert_false(exists("parts/particles/000002.pvtp"));
    assert_same_run("whole", "parts", pair_tables);
}

/* Where rank 1 should have its folder there is a file, as on a host whose disk does not take it: the times are missed,
   with one warning that names the rank, and the run goes on. Its status is 2, as for all files that are missing. */
static void a_piece_that_cannot_be_written_is_missed(void **state)
{
    (void)state;
    NEEDS_MPI();
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "missed", "--quiet", "--set", PIECES, "--until", "0.02");
    write_text("missed/particles/rank1", "");
    program_on_ranks("2");
    outcome o = RUN(2, "run", "measured.yaml", "--out", "missed", "--quiet", "--set", PIECES, "--overwrite");
    program_on_ranks(NULL);
    assert_contains(o.err, "rank 1 on ");
    assert_contains(o.err, "particles/rank1: is not a directory, expected one of the run's own");
    outcome_free(&o);
    assert_true(json_number_of("missed/summary.json", "particle_files") == 0);
    assert_true(json_number_of("missed/summary.json", "particle_files_missing") > 3);
    assert_false(exists("missed/particles/000001.pvtp"));
}

/* `render` and `surface` read pieces as they read single files. */
static void pictures_are_drawn_from_pieces(void **state)
{
    (void)state;
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "tank", "--quiet", "--set", PIECES, "--until", "0.1", "--set",
                   "render.interval=0");
    RUN_AND_FORGET(0, "surface", "tank", "--quiet");
    assert_true(exists("tank/surface/000002.ply"));
}

/* Enough particles that each rank has whole blocks of a checkpoint, and few steps. */
#define FINE "--set", "resolution=0.01", "--set", "numerics.settle_steps=0", "--set", "measure.interval=0.001"

/* Whoever writes it, a checkpoint has the same bytes behind its first section, that of times of the clock. */
static void assert_same_state(const char *a, const char *b)
{
    size_t length[2];
    char *bytes[2] = {bytes_of(a, &length[0]), bytes_of(b, &length[1])}, *state[2];
    for (int k = 0; k < 2; k++) {
        state[k] = memmem(bytes[k], length[k], "sim\0\0\0\0\0", 8);
        assert_non_null(state[k]);
        length[k] -= (size_t)(state[k] - bytes[k]);
    }
    assert_int_equal(length[0], length[1]);
    assert_memory_equal(state[0], state[1], length[0]);
    sb_free(bytes[0]);
    sb_free(bytes[1]);
}

/* Maps with a terrain, and run-up over it: of one process, of three ranks, and resumed by one of them. */
static void maps_of_a_terrain_do_not_depend_on_the_ranks(void **state)
{
    (void)state;
    NEEDS_MPI();
    write_text("ground.obj", "v -1 -1 -0.2\nv 1.5 -1 -0.2\nv 1.5 2 -0.2\nv -1 2 -0.2\nv 5 -1 0.5\nv 5 2 0.5\n"
                             "f 1 2 3\nf 1 3 4\nf 2 5 6\nf 2 6 3\n");
    write_text("land.yaml", "resolution: 0.1\n"
                            "duration: 0.8\n"
                            "domain: {min: [0, 0, -0.2], max: [4, 1, 2]}\n"
                            "water: {boxes: [{min: [0, 0, -0.2], max: [0.8, 1, 0.6]}]}\n"
                            "bodies:\n"
                            "  - {name: ground, shape: mesh, file: ground.obj, role: terrain}\n"
                            "  - {name: hut, shape: box, min: [2.2, 0.3, -0.1], max: [2.4, 0.7, 0.3]}\n"
                            "measure:\n"
                            "  interval: 0.02\n"
                            "  runups: [{name: slope, from: [0.9, 0.5], to: [4, 0.5]}]\n"
                            "  map: {cell: 0.05}\n"
                            "output: {plots: false}\n");
    RUN_ON("1", 0, "land.yaml", "--out", "land-one", "--quiet");
    RUN_ON("3", 0, "land.yaml", "--out", "land-three", "--quiet", "--until", "0.5");
    RUN_AND_FORGET(0, "run", "land.yaml", "--out", "land-three", "--quiet", "--resume");
    static const char *const files[] = {"runup.csv",          "maps/ground.asc",       "maps/max_depth.asc",
                                        "maps/max_speed.asc", "maps/arrival_time.asc", "maps/max_momentum_flux.asc"};
    for (size_t f = 0; f < sizeof files / sizeof *files; f++) assert_same_file("land-one", "land-three", files[f]);
}

static void checkpoints_have_the_bytes_of_one_process(void **state)
{
    char names[2][16][64], path[2][128];
    (void)state;
    NEEDS_MPI();
    RUN_AND_FORGET(0, "run", "measured.yaml", "--out", "fine", "--quiet", FINE, "--until", "0.002");
    RUN_ON("3", 0, "measured.yaml", "--out", "fine3", "--quiet", FINE, "--until", "0.002");
    assert_int_equal(list_checkpoints("fine", names[0]), 1);
    assert_int_equal(list_checkpoints("fine3", names[1]), 1);
    for (int k = 0; k < 2; k++)
        snprintf(path[k], sizeof path[k], "%s/checkpoints/%s", k == 0 ? "fine" : "fine3", names[k][0]);
    assert_same_state(path[0], path[1]);
}

/* On the host of rank 1 the disk is full: there is a warning with the rank, the checkpoint before stands, and the run
   goes on. */
static void a_full_disk_of_one_rank_leaves_the_checkpoint_before(void **state)
{
    char names[16][64];
    (void)state;
    NEEDS_MPI();
    RUN_ON("2", 0, "measured.yaml", "--out", "full", "--quiet", FINE, "--until", "0.002");
    assert_int_equal(list_checkpoints("full", names), 1);
    program_on_ranks("1");
    outcome o =
        RUN(0, "run", "measured.yaml", "--out", in_folder("full"), "--quiet", FINE, "--until", "0.005", "--resume", ":",
            "-n", "1", "-x", "LD_PRELOAD=" SB_BINARY_DIR "/libfull_disk.so", SB_BINARY_DIR "/shorebreak", "run",
            "measured.yaml", "--out", in_folder("full"), "--quiet", FINE, "--until", "0.005", "--resume");
    program_on_ranks(NULL);
    assert_int_equal(count_of(o.err, "shorebreak: "), 1);
    assert_contains(o.err, "no checkpoint at step ");
    assert_contains(o.err, ": rank 1 cannot write: ");
    outcome_free(&o);
    char again[16][64];
    assert_int_equal(list_checkpoints("full", again), 1);
    assert_string_equal(again[0], names[0]);
    RUN_ON("2", 0, "measured.yaml", "--out", "full", "--quiet", FINE, "--until", "0.005", "--resume");
}

static sb_frame *last_frame(const char *path, bool pieces)
{
    sb_frame *frame = NULL;
    sb_error error = {0};
    const sb_status status = pieces ? sb_pvtp_read(path, &frame, &error) : sb_vtp_read(path, &frame, &error);
    if (status != SB_OK) fail_msg("%s", error.text);
    return frame;
}

#define LOADS "render.loads=true", "--set", "render.interval=0"

/* The loads on the faces of the bodies: of one process, of ranks, in pieces, and of a run that other ranks resume. */
static void loads_of_faces_do_not_depend_on_the_ranks(void **state)
{
    (void)state;
    NEEDS_MPI();
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "loads1", "--quiet", "--set", LOADS);
    RUN_ON("3", 0, "tank3.yaml", "--out", "loads3", "--quiet", "--set", PIECES, "--set", LOADS);
    RUN_ON("2", 0, "tank3.yaml", "--out", "loads2", "--quiet", "--set", LOADS, "--until", "0.17");
    RUN_AND_FORGET(0, "run", "tank3.yaml", "--out", "loads2", "--quiet", "--set", LOADS, "--resume");
    sb_frame *one = last_frame(in_folder("loads1/particles/000004.vtp"), false);
    sb_frame *two = last_frame(in_folder("loads2/particles/000004.vtp"), false);
    sb_frame *three = last_frame(in_folder("loads3/particles/000004.pvtp"), true);
    float most = 0;
    assert_same_frame(one, two);
    assert_same_frame(one, three);
    assert_int_equal(one->face_count, 12); /* of a post and a sill */
    for (size_t f = 0; f < one->face_count; f++) most = one->face_pressure[f] > most ? one->face_pressure[f] : most;
    assert_true(most > 100);
    sb_frame_release(one);
    sb_frame_release(two);
    sb_frame_release(three);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_process_writes_one_piece),
        cmocka_unit_test(each_rank_writes_its_piece),
        cmocka_unit_test(a_run_with_pieces_resumes),
        cmocka_unit_test(a_piece_that_cannot_be_written_is_missed),
        cmocka_unit_test(pictures_are_drawn_from_pieces),
        cmocka_unit_test(loads_of_faces_do_not_depend_on_the_ranks),
        cmocka_unit_test(maps_of_a_terrain_do_not_depend_on_the_ranks),
        cmocka_unit_test(checkpoints_have_the_bytes_of_one_process),
        cmocka_unit_test(a_full_disk_of_one_rank_leaves_the_checkpoint_before),
    };
    return cmocka_run_group_tests(tests, pair_setup_whole, program_teardown);
}
