/* Contact resolution stops particles that come too close to a wall, along the wall's normal, and adds no energy. */
#include "base/random.h"
#include "check.h"
#include "sim/tank.h"
#include "sim/walls/basin.h"
#include "sim/walls/contact.h"
#include "sim/walls/mirrors.h"

#include <stdio.h>
#include <unistd.h>

static const double DR = 0.1, PLATE = 0.4, SIZE = 0.8;

/* A tank of still water with a plate. The nearest water is 0.05 spacings away from the plate's facets, which is 0.05
   spacings closer than contact resolution permits. */
static sb_sim *crowded(tank *t, int dimensions, sb_preset preset)
{
    tank_of_particles(t, dimensions, DR, sb_vec(SIZE, SIZE, 1.2), SIZE, SIZE, 0);
    tank_use(t, preset);
    t->scene.numerics.jitter = 0;
    const double shift = (t->scene.numerics.wall_offset - 0.45) * DR;
    for (size_t i = 0; i < t->model.fluid_count; i++)
        t->model.fluid_position[i].x += t->model.fluid_position[i].x < PLATE ? -shift : shift;
    tank_add_plate(t, "plate", PLATE, 0, 1, sb_vec(0, 0, 0), NULL);
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 0.01), 0);
    return sim;
}

/* Moves of particles at rest. */
typedef struct moves {
    size_t beside, away; /* of particles next to the plate, and of others */
    double speed;        /* highest of all, m/s */
} moves;

/* The velocity after contact of particle i of a group, and the number of pushes, whose sum is added to *given. */
static sb_f4 resolved(const sb_sim *sim, const sb_group *group, size_t i, sb_f4 velocity, size_t *count, sb_f4 *given)
{
    sb_facet_contact c;
    *count = 0;
    for (; *count < SB_CONTACT_PUSHES_MAX && sb_contact_find(sim, group, i, velocity, &c); ++*count) {
        const sb_f4 change = c.normal * sb_splat(c.push * (float)(sim->space.quantum / sim->state.time_step));
        *given += change;
        velocity += change;
    }
    return velocity;
}

static moves moves_from_rest(const sb_sim *sim)
{
    moves all = {0};
    for (size_t g = 0; g < sim->groups.count; g++)
        for (size_t i = sim->groups.group[g].first; i < sim->groups.group[g].end; i++) {
            size_t count;
            sb_f4 given = {0};
            const sb_f4 v = resolved(sim, &sim->groups.group[g], i, (sb_f4){0}, &count, &given);
            if (count == 0) continue;
            const bool beside = fabs(sb_sim_particle(sim, i).position.x - PLATE) < DR;
            all.beside += beside;
            all.away += !beside;
            all.speed = fmax(all.speed, sqrt((double)sb_sum3(v * v)));
        }
    return all;
}

static void only_settling_moves_out_water_at_rest(void **state)
{
    (void)state;
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++)
        for (int dimensions = 2; dimensions <= 3; dimensions++) {
            tank t;
            sb_sim *sim = crowded(&t, dimensions, preset);
            const size_t beside = 2 * 8 * (dimensions == 3 ? 8 : 1);
            assert_ptr_equal(sim->policy, &sb_policy_run);
            const moves running = moves_from_rest(sim);
            assert_true(running.speed < 1e-9);
            sim->policy = &sb_policy_creep;
            const moves settling = moves_from_rest(sim);
            printf("%dD, %s: %zu moved out in settling beside the plate, %zu away from it, %.3g m/s at most\n",
                   dimensions, tank_preset_names[preset], settling.beside, settling.away, settling.speed);
            assert_int_equal(settling.beside, beside);
            assert_int_equal(settling.away, 0);
            assert_true(settling.speed > 0 && settling.speed < 0.1); /* a hundredth of a spacing a step at most */
            sb_sim_destroy(sim);
            tank_free(&t);
        }
}

static void check_approach(sb_preset preset)
{
    tank t;
    sb_sim *sim = crowded(&t, 3, preset);
    size_t stopped = 0;
    double all_before = 0, all_after = 0;
    for (size_t g = 0; g < sim->groups.count; g++)
        for (size_t i = sim->groups.group[g].first; i < sim->groups.group[g].end; i++) {
            const sb_f4 start = {(float)(6 * sb_random(5, 3 * i) - 3), (float)(6 * sb_random(5, 3 * i + 1) - 3),
                                 (float)(6 * sb_random(5, 3 * i + 2) - 3), 0};
            sb_f4 sum = start;
            size_t count;
            const sb_f4 v = resolved(sim, &sim->groups.group[g], i, start, &count, &sum);
            if (count == 0) continue;
            stopped++;
            sum -= v;
            assert_true((double)sb_sum3(sum * sum) < 1e-10); /* (m/s)^2: bodies receive what the water loses */
            const double before = (double)sb_sum3(start * start), after = (double)sb_sum3(v * v);
            assert_true(after <= before * (1 + 1e-6));
            all_before += before;
            all_after += after;
        }
    printf("%s: %zu stopped, %.3g of their energy left\n", tank_preset_names[preset], stopped, all_after / all_before);
    assert_true(stopped > 50 && all_after < 0.8 * all_before);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void approaching_particles_are_stopped_without_energy_gain(void **state)
{
    (void)state;
    for (sb_preset preset = SB_PRESET_DEFAULT; preset <= SB_PRESET_PAPER; preset++) check_approach(preset);
}

/* ---- round a convex surface ---- */

enum { ROUND_STEPS = 60 };

/* Distance before the sides of an upright convex body that has `middle` in it, m. */
static double before_sides(const sb_sim *sim, sb_vec3 middle, sb_vec3 at)
{
    const sb_vec3 place = sb_scale(sb_sub(at, sim->space.origin), 1 / sim->space.quantum);
    const sb_vec3 inside = sb_scale(sb_sub(middle, sim->space.origin), 1 / sim->space.quantum);
    double most = -(double)INFINITY;
    for (size_t k = 0; k < sim->walls.mirrors.count; k++) {
        const sb_mirror *m = &sim->walls.mirrors.mirror[k];
        if (fabs(m->normal.z) < 0.1 && sb_dot(m->normal, inside) < m->distance)
            most = fmax(most, sb_dot(m->normal, place) - m->distance);
    }
    return most * sim->space.quantum;
}

/* Single particles run round a cylinder of which each side is as long as four of their steps or one, and are drawn
   towards it. None gets behind the surface, and none gains energy by contact. */
static void particles_follow_a_convex_surface(void **state)
{
    (void)state;
    static const double along[] = {0.1, 0.4, 0.8};
    /* A particle that ends right at an edge is before no facet: long steps end there. */
    static const double least[] = {0.09, 0.09, 0.02};
    const sb_vec3 middle = sb_vec(15, 15, 6);
    for (size_t k = 0; k < sizeof along / sizeof *along; k++) {
        basin b;
        basin_fill(&b, 3, "1", "[30, 30, 12]", "{boxes: [{min: [1, 1, 1], max: [7, 5, 5]}]}",
                   "[{name: pillar, shape: cylinder, center: [15, 15, -1], radius: 6, height: 20}]", "completed");
        sb_sim *sim = b.sim;
        assert_true(sim->state.n >= 40);
        double nearest = (double)INFINITY;
        for (size_t i = 0; i < sim->state.n; i++) {
            const double angle = 2 * M_PI * (double)i / (double)sim->state.n;
            const sb_vec3 at = sb_vec(15 + 6.2 * cos(angle), 15 + 6.2 * sin(angle), 6);
            sim->state.position[i] = sb_space_record(&sim->space, at);
            nearest = fmin(nearest, before_sides(sim, middle, at));
        }
        assert_true(nearest > 0.1);
        for (int step = 0; step < ROUND_STEPS; step++) {
            assert_int_equal(tank_prepare(sim, 1), 0);
            for (size_t g = 0; g < sim->groups.count; g++)
                for (size_t i = sim->groups.group[g].first; i < sim->groups.group[g].end; i++) {
                    const sb_vec3 at = sb_sim_particle(sim, i).position;
                    const double x = at.x - 15, y = at.y - 15, r = hypot(x, y);
                    const sb_f4 start = {(float)((-y * along[k] - 0.3 * x) / r), (float)((x * along[k] - 0.3 * y) / r),
                                         0, 0};
                    size_t count;
                    sb_f4 given = {0};
                    const sb_f4 v = resolved(sim, &sim->groups.group[g], i, start, &count, &given);
                    assert_true(sb_sum3(v * v) <= sb_sum3(start * start) * (1 + 1e-5f));
                    const sb_vec3 end = sb_add(at, sb_vec((double)v[0], (double)v[1], 0));
                    sim->state.position[i] = sb_space_record(&sim->space, end);
                    nearest = fmin(nearest, before_sides(sim, middle, end));
                }
        }
        printf("%g spacings per step: %.4f spacings before the surface\n", along[k], nearest);
        assert_true(nearest > least[k]);
        basin_free(&b);
    }
}

/* ---- where the surface turns towards the water ---- */

/* A closed body whose face begins on the floor at x = 20 and leans by `lean`, its run over its height. */
static void write_wedge(const char *path, double lean)
{
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    for (int y = -5; y <= 35; y += 40) {
        fprintf(out, "v 20 %d 0\nv 60 %d 0\nv 60 %d 10\n", y, y, y);
        fprintf(out, "v %g %d 10\n", 20 + 10 * lean, y);
    }
    fputs("f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n", out);
    assert_int_equal(fclose(out), 0);
}

/* Particles over a floor run at a face that leans away from them, stands upright, or overhangs by a hundredth. None
   comes nearer to it than contact permits or it was. */
static void check_face(double lean)
{
    char folder[] = "/tmp/sb_contact_XXXXXX", mesh[64], bodies[128];
    assert_non_null(mkdtemp(folder));
    snprintf(mesh, sizeof mesh, "%s/wedge.obj", folder);
    write_wedge(mesh, lean);
    snprintf(bodies, sizeof bodies, "[{name: wedge, shape: mesh, file: %s}]", mesh);
    basin b;
    basin_fill(&b, 3, "1", "[30, 30, 12]", "{boxes: [{min: [1, 1, 1], max: [7, 5, 5]}]}", bodies, "completed");
    sb_sim *sim = b.sim;
    const sb_vec3 normal = sb_normalize(sb_vec(-1, 0, lean));
    for (size_t i = 0; i < sim->state.n; i++) {
        const double height = 0.3 + 1.2 * sb_random(7, i), away = 0.05 + 0.4 * sb_random(8, i);
        const sb_vec3 foot = sb_vec(20 + height * lean, 5 + 20 * sb_random(9, i), height);
        sim->state.position[i] = sb_space_record(&sim->space, sb_madd(foot, away, normal));
    }
    assert_int_equal(tank_prepare(sim, 1), 0);
    size_t stopped = 0;
    for (size_t g = 0; g < sim->groups.count; g++)
        for (size_t i = sim->groups.group[g].first; i < sim->groups.group[g].end; i++) {
            const sb_vec3 at = sb_sim_particle(sim, i).position, foot = sb_vec(20, at.y, 0);
            const double before = sb_dot(normal, sb_sub(at, foot));
            size_t count;
            sb_f4 given = {0};
            const sb_f4 v = resolved(sim, &sim->groups.group[g], i, (sb_f4){0.8f, 0, -0.05f, 0}, &count, &given);
            const sb_vec3 end = sb_add(at, sb_vec((double)v[0], (double)v[1], (double)v[2]));
            const double after = sb_dot(normal, sb_sub(end, foot));
            stopped += count > 0;
            if (after < fmin(before, 0.1) - 1e-3) fail_msg("from %g to %g spacings before the face", before, after);
        }
    assert_true(stopped > 30);
    basin_free(&b);
    (void)remove(mesh);
    (void)remove(folder);
}

static void a_floor_does_not_hide_a_wall(void **state)
{
    (void)state;
    static const double leans[] = {5.67, 1, 0.58, 0.01, 0, -0.01}; /* 10, 45, 60 degrees and about 90 */
    for (size_t k = 0; k < sizeof leans / sizeof *leans; k++) check_face(leans[k]);
}

/* ---- behind an edge ---- */

enum { HELD_STEPS = 200 };

/* Particles that have got a little behind the three faces at a corner of a box, and are pressed on it. They do not sink
   deeper: faces that they only slide along leave contact with the others possible. */
static void particles_behind_a_corner_do_not_sink(void **state)
{
    (void)state;
    basin b;
    basin_fill(&b, 3, "1", "[30, 30, 24]", "{boxes: [{min: [1, 1, 1], max: [7, 5, 5]}]}",
               "[{name: block, shape: box, min: [15, 15, 0], max: [40, 40, 10]}]", "completed");
    sb_sim *sim = b.sim;
    for (size_t i = 0; i < sim->state.n; i++)
        sim->state.position[i] = sb_space_record(
            &sim->space, sb_vec(15 + 0.15 * sb_random(1, i), 15 + 0.15 * sb_random(2, i), 10 - 0.15 * sb_random(3, i)));
    for (int step = 0; step < HELD_STEPS; step++) {
        assert_int_equal(tank_prepare(sim, 1), 0);
        for (size_t g = 0; g < sim->groups.count; g++)
            for (size_t i = sim->groups.group[g].first; i < sim->groups.group[g].end; i++) {
                const uint64_t k = (uint64_t)step * 1000 + i;
                const sb_f4 start = {(float)(0.02 * sb_random(4, k)), (float)(0.02 * sb_random(5, k)), -0.3f, 0};
                size_t count;
                sb_f4 given = {0};
                const sb_f4 v = resolved(sim, &sim->groups.group[g], i, start, &count, &given);
                const sb_vec3 at = sb_sim_particle(sim, i).position;
                const sb_vec3 end = sb_add(at, sb_vec((double)v[0], (double)v[1], (double)v[2]));
                sim->state.position[i] = sb_space_record(&sim->space, end);
                if (end.z < 10 - 0.16 || end.x > 15.16 || end.y > 15.16)
                    fail_msg("step %d: at (%g, %g, %g)", step, end.x, end.y, end.z);
            }
    }
    basin_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(only_settling_moves_out_water_at_rest),
        cmocka_unit_test(approaching_particles_are_stopped_without_energy_gain),
        cmocka_unit_test(particles_follow_a_convex_surface),
        cmocka_unit_test(a_floor_does_not_hide_a_wall),
        cmocka_unit_test(particles_behind_a_corner_do_not_sink),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
