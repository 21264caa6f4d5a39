/* Accelerations, rates of the density and boundary pressures of wcsph: compared with sums over all pairs in double
   precision, for all forms of walls but images, whose passes are those of implicit steps. */
#include "base/memory.h"
#include "base/random.h"
#include "check.h"
#include "physics/kernels/tait.h"
#include "sim/passes/passes.h"
#include "sim/step/stages.h"
#include "sim/tank.h"
#include "sim/terms/turbulence.h"
#include "sim/twin.h"
#include "sim/walls/drag.h"
#include "sim/wcsph/boundary.h"
#include "sim/wcsph/wcsph.h"

#include <stdio.h>

/* What all pairs give. */
typedef struct expected {
    sb_vec3 *acceleration;
    double *rate, *wall_rate, *wall_load;
} expected;

static double pressure_at(const sb_sim *sim, double excess)
{
    const double ratio = 1 + excess / (double)sim->constant.rest_density;
    return (double)sim->constant.stiffness * (pow(ratio, 7) - 1);
}

/* The number of the twin's boundary particle in sb_boundary. */
static uint32_t number_of(const sb_sim *sim, const twin *t, size_t wall)
{
    const uint32_t set = wall >= t->static_count;
    size_t left = wall - (set ? t->static_count : 0);
    for (size_t k = 0;; k++)
        if (!(sim->walls.set[set].number[k] & SB_BOUNDARY_IMAGE) && left-- == 0) return sim->walls.set[set].number[k];
}

/* Pressures of boundary particles [W, eqs. 13, 15], and rates of their densities. */
static void expect_boundary(const sb_sim *sim, const twin *t, const float *before, expected *e)
{
    const sb_reference *r = &t->reference;
    const double beta = sim->scene->numerics.wall_beta, g = (double)sim->constant.gravity, rest = r->cloud.rest_density;
    double *weight = sb_alloc(r->cloud.wall_count, sizeof *weight);
    assert_non_null(weight);
    for (size_t i = 0; i < r->cloud.fluid_count; i++)
        for (size_t p = r->wall_start[i]; p < r->wall_start[i + 1]; p++) {
            const sb_reference_pair *pair = &r->wall[p];
            const sb_vec3 approach = sb_sub(t->wall_velocity[pair->other], t->velocity[i]);
            const double there = pressure_at(sim, (double)sim->state.excess[i]) + rest * g * pair->offset.z;
            weight[pair->other] += pair->w;
            e->wall_load[pair->other] += pair->w * there;
            e->wall_rate[pair->other] -= r->mass * sb_dot(approach, pair->gradient);
        }
    for (size_t b = 0; b < r->cloud.wall_count; b++) {
        if (!(weight[b] > 0)) continue;
        const double near = e->wall_load[b] / weight[b], kept = (double)before[number_of(sim, t, b)];
        const double own = pressure_at(sim, kept), p = beta * near + (1 - beta) * own;
        e->wall_load[b] = p > 0 ? p / ((rest + kept) * (rest + kept)) : 0;
    }
    sb_free(weight);
}

/* Inverse of a symmetric matrix by cofactors; false if it is nearly singular, as in sim/wcsph/gradients.c. */
static bool invert(double m[3][3], int dimensions, double out[3][3])
{
    const double t = (m[0][0] + m[1][1] + m[2][2]) / dimensions;
    if (dimensions == 2) m[1][1] = t;
    double det = 0;
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const int a1 = (b + 1) % 3, a2 = (b + 2) % 3, b1 = (a + 1) % 3, b2 = (a + 2) % 3;
            out[a][b] = m[a1][b1] * m[a2][b2] - m[a1][b2] * m[a2][b1];
        }
    for (int b = 0; b < 3; b++) det += m[0][b] * out[b][0];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) out[a][b] /= det;
    return t > 0.7 && det > (double)SB_THINNEST * t * t * t;
}

/* Sums of one particle: pressure, velocity gradient and second moments, over rho_0. */
typedef struct one {
    sb_vec3 a;
    double g[3][3], m[3][3], diffusion;
} one;

static void add_pair(one *s, double mass, double q, sb_vec3 gradient, sb_vec3 x, sb_vec3 v)
{
    const double d[3] = {gradient.x, gradient.y, gradient.z}, place[3] = {x.x, x.y, x.z}, u[3] = {v.x, v.y, v.z};
    s->a = sb_madd(s->a, -mass * q, gradient);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            s->g[a][b] -= mass * u[a] * d[b];
            s->m[a][b] -= mass * place[a] * d[b];
        }
}

static one sum_pairs(const sb_sim *sim, const twin *t, const expected *e, size_t i)
{
    const sb_reference *r = &t->reference;
    const double rest = r->cloud.rest_density, c = (double)sim->constant.sound_speed, g = (double)sim->constant.gravity;
    const double delta = sim->scene->numerics.density_diffusion * (r->cloud.h / 2) * c;
    const double own = (double)sim->state.excess[i], rho = rest + own, q = pressure_at(sim, own) / (rho * rho);
    one s = {0};
    for (size_t p = r->fluid_start[i]; p < r->fluid_start[i + 1]; p++) {
        const sb_reference_pair *pair = &r->fluid[p];
        const double other = (double)sim->state.excess[pair->other], rho_j = rest + other;
        const double r2 = sb_dot(pair->offset, pair->offset), hydrostatic = rest * g * pair->offset.z / (c * c);
        add_pair(&s, r->mass, q + pressure_at(sim, other) / (rho_j * rho_j), pair->gradient, pair->offset,
                 sb_sub(t->velocity[i], t->velocity[pair->other]));
        s.diffusion -=
            delta * r->mass / rest * 2 * (other - own - hydrostatic) * sb_dot(pair->offset, pair->gradient) / r2;
    }
    for (size_t p = r->wall_start[i]; p < r->wall_start[i + 1]; p++) {
        const sb_reference_pair *pair = &r->wall[p];
        add_pair(&s, t->psi[pair->other], q + (sim->needs.dynamic_walls ? e->wall_load[pair->other] : 0),
                 pair->gradient, pair->offset, sb_sub(t->velocity[i], t->wall_velocity[pair->other]));
    }
    return s;
}

static void expect_water(const sb_sim *sim, const twin *t, expected *e)
{
    const int d = sim->constant.dimension;
    const bool cspm = sim->scene->numerics.kernel_correction == SB_CORRECTION_CSPM;
    for (size_t i = 0; i < sim->state.n; i++) {
        one s = sum_pairs(sim, t, e, i);
        const double rho = (double)sim->constant.rest_density + (double)sim->state.excess[i];
        const double a[3] = {s.a.x, s.a.y, s.a.z};
        double inverse[3][3], m[3][3], out[3] = {0}, divergence = 0;
        for (int k = 0; k < 9; k++) m[k / 3][k % 3] = s.m[k / 3][k % 3] / rho;
        const bool corrected = cspm && invert(m, d, inverse);
        for (int k = 0; k < 9; k++) {
            const double l = corrected ? inverse[k / 3][k % 3] : k / 3 == k % 3;
            out[k / 3] += l * a[k % 3];
            divergence += l * s.g[k % 3][k / 3];
        }
        e->acceleration[i] = sb_vec(out[0], d == 2 ? 0 : out[1], out[2]);
        e->rate[i] = -divergence + s.diffusion;
    }
}

/* Jittered water with densities and velocities at random beside walls, one of which moves unless the tank repeats. */
static sb_sim *prepare(tank *t, int dimensions, bool repeats, sb_wall_form walls, sb_kernel_correction correction)
{
    const sb_wavemaker_parameters law = {
        .kind = sb_wavemaker_find("stroke"), .stroke = 0.5, .speed = 0.8, .gravity = 9.81};
    sb_error error = {0};
    tank_of_particles(t, dimensions, 0.1, sb_vec(1.3, 0.7, 1.2), 1.3, 0.9, 0.2);
    t->form.particles = false;
    tank_use(t, SB_PRESET_WEN);
    if (repeats) tank_repeat(t, 0);
    if (!repeats) tank_add_plate(t, "paddle", 0.3, 0, 0.7, sb_vec(1, 0, 0), &law);
    t->scene.numerics.walls = walls;
    t->scene.numerics.kernel_correction = correction;
    for (size_t i = 0; i < t->model.fluid_count; i++)
        t->model.fluid_velocity[i] = sb_vec(
            sb_random(3, 3 * i) - 0.5, dimensions == 2 ? 0 : sb_random(3, 3 * i + 1) - 0.5, sb_random(3, 3 * i + 2));
    sb_sim *sim = tank_sim(t);
    assert_non_null(sim);
    sim->state.time = 0.4;
    assert_int_equal(tank_prepare(sim, 0.001), 0);
    for (size_t i = 0; i < sim->state.n; i++) sim->state.excess[i] += (float)(8 * sb_random(5, i) - 2);
    for (size_t k = 0; k < sim->walls.boundary.count; k++)
        sim->walls.boundary.excess[k] = (float)(8 * sb_random(7, k) - 2);
    assert_int_equal(sb_stage_wcsph_densities(sim, &error), SB_OK);
    return sim;
}

static void compare(const sb_sim *sim, const twin *t, const expected *e, const char *name)
{
    twin_gap rate = {0}, acceleration = {0}, load = {0}, wall_rate = {0};
    for (size_t i = 0; i < sim->state.n; i++) {
        const sb_f4 a = sim->work.acceleration[i];
        twin_compare(&acceleration, i, (double)a[0], e->acceleration[i].x);
        twin_compare(&acceleration, i, (double)a[1], e->acceleration[i].y);
        twin_compare(&acceleration, i, (double)a[2], e->acceleration[i].z);
        twin_compare(&rate, i, (double)sim->work.rate[i], e->rate[i]);
    }
    for (size_t b = 0; sim->needs.dynamic_walls && b < t->reference.cloud.wall_count; b++) {
        const uint32_t number = number_of(sim, t, b);
        twin_compare(&load, b, (double)sim->walls.boundary.load[number], e->wall_load[b]);
        twin_compare(&wall_rate, b, (double)sim->walls.boundary.rate[number], e->wall_rate[b]);
    }
    printf("%s: acceleration %.2g, rate %.2g; boundary: pressure %.2g, rate %.2g\n", name, twin_relative(&acceleration),
           twin_relative(&rate), load.scale > 0 ? twin_relative(&load) : 0,
           wall_rate.scale > 0 ? twin_relative(&wall_rate) : 0);
    assert_true(acceleration.scale > 10 && twin_relative(&acceleration) < 3e-6);
    assert_true(rate.scale > 100 && twin_relative(&rate) < 3e-6);
    if (!sim->needs.dynamic_walls) return;
    assert_true(load.scale > 0 && twin_relative(&load) < 3e-6);
    assert_true(wall_rate.scale > 0 && twin_relative(&wall_rate) < 3e-6);
}

static void check(int dimensions, bool repeats, sb_wall_form walls, sb_kernel_correction correction)
{
    char name[80];
    tank t;
    twin copy;
    sb_error error = {0};
    sb_sim *sim = prepare(&t, dimensions, repeats, walls, correction);
    assert_int_equal(twin_make(sim, &copy), 0);
    const size_t n = sim->state.n, count = copy.reference.cloud.wall_count, all = sim->walls.boundary.count;
    expected e = {sb_alloc(n, sizeof(sb_vec3)), sb_alloc(n, sizeof(double)), sb_alloc(count, sizeof(double)),
                  sb_alloc(count, sizeof(double))};
    float *before = sb_alloc(all, sizeof *before);
    assert_true(e.acceleration && e.rate && e.wall_rate && e.wall_load && before);
    for (size_t k = 0; k < all; k++) before[k] = sim->walls.boundary.excess[k];
    if (sim->needs.dynamic_walls) {
        assert_int_equal(sb_stage_boundary(sim, &error), SB_OK);
        expect_boundary(sim, &copy, before, &e);
    }
    assert_int_equal(sb_stage_wcsph_rates(sim, &error), SB_OK);
    expect_water(sim, &copy, &e);
    snprintf(name, sizeof name, "%dD%s, %s%s", dimensions, repeats ? ", periodic" : "",
             walls == SB_WALLS_DYNAMIC ? "dynamic" : "particles", correction ? ", cspm" : "");
    compare(sim, &copy, &e, name);
    sb_free(e.acceleration);
    sb_free(e.rate);
    sb_free(e.wall_rate);
    sb_free(e.wall_load);
    sb_free(before);
    twin_free(&copy);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void all_pairs_give_the_same(void **state)
{
    (void)state;
    for (int dimensions = 2; dimensions <= 3; dimensions++)
        for (int repeats = 0; repeats < 2; repeats++)
            for (int correction = 0; correction < 2; correction++) {
                check(dimensions, repeats, SB_WALLS_PARTICLES, (sb_kernel_correction)correction);
                check(dimensions, repeats, SB_WALLS_DYNAMIC, (sb_kernel_correction)correction);
            }
}

/* The works of a step are those of velocities at its ends: with opposite ones there is none, whatever the velocity in
   the middle is. */
static void works_take_the_velocity_at_the_start(void **state)
{
    (void)state;
    tank t;
    sb_error error = {0};
    tank_of_particles(&t, 3, 0.1, sb_vec(1.3, 0.7, 1.2), 1.3, 0.9, 0.05);
    t.form.particles = false;
    tank_use(&t, SB_PRESET_WEN);
    t.scene.numerics.walls = SB_WALLS_PARTICLES;
    t.scene.numerics.wall_friction = 0.1;
    for (size_t i = 0; i < t.model.fluid_count; i++) t.model.fluid_velocity[i] = sb_vec(0.3, 0.1, 0);
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 0.001), 0);
    assert_int_equal(sb_stage_wcsph_densities(sim, &error), SB_OK);
    const sb_wall_drag law = sb_wall_drag_make(sim);
    assert_true(law.on);
    assert_int_equal(sb_stage_forces(sim, &error), SB_OK);
    assert_int_equal(sb_stage_wcsph_rates(sim, &error), SB_OK);
    double friction[2];
    for (int same = 0; same < 2; same++) {
        sb_body_sums sums = {.force = sim->work.body_force};
        for (size_t i = 0; i < sim->state.n; i++) {
            sim->work.end_velocity[i] = (sb_f4){0.001f, 0, 0.002f, 0};
            sim->state.step_begin[i] = sb_splat(same ? 1.0f : -1.0f) * sim->work.end_velocity[i];
        }
        assert_int_equal(sim->passes->bodies(sim, &law, &sums), 0);
        friction[same] = sums.friction;
    }
    printf("work of friction: %.3g with opposite velocities, %.3g with equal ones\n", friction[0], friction[1]);
    assert_true(friction[0] == 0 && friction[1] != 0);
    sb_sim_destroy(sim);
    tank_free(&t);
}

/* With corrected gradients the rate of a linear flow is -rho div v wherever gradients are corrected. */
static void corrected_rates_are_exact_for_linear_flows(void **state)
{
    (void)state;
    const double g[3][3] = {{1.5, 0, 0.4}, {0, 0, 0}, {-0.7, 0, 0.8}};
    sb_error error = {0};
    tank t;
    tank_make(&t, 2, 0.05, sb_vec(1, 0, 1), 1, 0.8, 0.2);
    tank_use(&t, SB_PRESET_WEN);
    tank_repeat(&t, 0); /* walls above and below, farther from the middle than the support radius */
    t.scene.numerics.density_diffusion = 0;
    sb_sim *sim = tank_sim(&t);
    assert_non_null(sim);
    assert_int_equal(tank_prepare(sim, 0.001), 0);
    for (size_t i = 0; i < sim->state.n + sim->ghosts.count; i++) {
        const sb_vec3 at = sb_space_position(&sim->space, sim->state.position[i]);
        sim->state.velocity[i] =
            (sb_f4){(float)(g[0][0] * at.x + g[0][2] * at.z), 0, (float)(g[2][0] * at.x + g[2][2] * at.z), 0};
    }
    assert_int_equal(sb_stage_wcsph_densities(sim, &error), SB_OK);
    assert_int_equal(sb_stage_boundary(sim, &error), SB_OK);
    assert_int_equal(sb_stage_wcsph_rates(sim, &error), SB_OK);
    size_t found = 0;
    double worst = 0;
    for (size_t i = 0; i < sim->state.n; i++) {
        const double z = sb_space_position(&sim->space, sim->state.position[i]).z;
        if (z < 0.2 || z > 0.75) continue; /* the second layer below the surface is at 0.73 */
        const double exact = -(double)sim->work.density[i] * (g[0][0] + g[2][2]);
        worst = fmax(worst, fabs((double)sim->work.rate[i] / exact - 1));
        found++;
    }
    printf("%zu particles: rate off by at most %.2g\n", found, worst);
    assert_true(found > 200 && worst < 2e-5);
    sb_sim_destroy(sim);
    tank_free(&t);
}

static void the_equation_of_state_can_be_inverted(void **state)
{
    (void)state;
    const double stiffness = sb_tait_stiffness(1000, 30);
    static const double pressures[] = {-5e4, -100, 1, 1000, 1e5, 5e5};
    for (size_t k = 0; k < sizeof pressures / sizeof *pressures; k++) {
        const double p = pressures[k], s = sb_tait_excess(stiffness, p);
        assert_true(fabs((double)sb_tait_pressure((float)stiffness, (float)s) - p) < 1e-5 * fabs(p));
        assert_true(fabs(stiffness * (pow(1 + s, 7) - 1) - p) < 1e-9 * stiffness);
    }
    /* c^2 = dp/drho at rest */
    assert_true(fabs((double)sb_tait_pressure((float)stiffness, 1e-6f) / (900 * 1e-3) - 1) < 1e-4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_pairs_give_the_same),
        cmocka_unit_test(works_take_the_velocity_at_the_start),
        cmocka_unit_test(corrected_rates_are_exact_for_linear_flows),
        cmocka_unit_test(the_equation_of_state_can_be_inverted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
