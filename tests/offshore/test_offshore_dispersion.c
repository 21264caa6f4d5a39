/* The Serre-Green-Naghdi option: exact waves, a reference with another formulation, and breaking. */
#include "grid_case.h"

#include <stdlib.h>

static const double G = 9.81;

static double floor_1m(double x, double y)
{
    (void)x;
    (void)y;
    return -1;
}

/* The exact solitary wave of these equations on depth 1: C^2 = g (1 + H), eta = H sech^2(k x), k^2 = 3 H / (4 (1 + H)).
 */
static double height;

static double celerity(void)
{
    return sqrt(G * (1 + height));
}

static grid_water solitary(double x, double y, double time)
{
    (void)y;
    const double k = sqrt(3 * height / (4 * (1 + height))), s = 1 / cosh(k * (x - 25 - celerity() * time));
    const double eta = height * s * s;
    return (grid_water){.h = 1 + eta, .u = celerity() * eta / (1 + eta)};
}

/* Height and place of the crest, by a parabola through the highest cell and its neighbours. */
static double crest_of(const sb_offshore *offshore, double *place)
{
    const sb_offshore_view v = sb_offshore_read(offshore);
    size_t top = 1;
    for (size_t i = 1; i + 1 < v.columns; i++) top = v.h[i] > v.h[top] ? i : top;
    const double a = v.h[top - 1], b = v.h[top], c = v.h[top + 1], shift = 0.5 * (a - c) / (a - 2 * b + c);
    *place = v.x + ((double)top + 0.5 + shift) * v.cell;
    return b - 0.25 * (a - c) * shift - 1;
}

/* Over 50 depths with ten cells per depth: height within 0.2 %, crest within 0.02 depths, and the mean difference from
   the exact form, which is 2.3 % of the mean elevation for the highest wave, falls with the square of the cell. */
static void solitary_wave_keeps_its_form(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        height = (double[]){0.1, 0.3, 0.5}[k];
        double error[2], place, crest = 0;
        for (int fine = 0; fine < 2; fine++) {
            sb_offshore_options options = {
                .columns = 550u << fine, .rows = 1, .cell = fine ? 0.1 : 0.2, .gravity = G, .dispersion = true};
            sb_offshore *offshore = grid_create(&options, floor_1m, solitary);
            grid_run(offshore, 50 / celerity());
            error[fine] = grid_error(offshore, solitary) * 110 / (2 * height / sqrt(3 * height / (4 * (1 + height))));
            crest = crest_of(offshore, &place);
            assert_near(grid_imbalance(offshore), 0, 1e-13);
            assert_int_equal(sb_offshore_find_effort(offshore).breaking, 0);
            sb_offshore_destroy(offshore);
        }
        print_message("H/h %.1f: height %.2f %%, crest %.3f depths late, form %.2f %% and %.2f %%\n", height,
                      100 * (crest / height - 1), 75 - place, 100 * error[0], 100 * error[1]);
        assert_near(crest / height, 1, 0.002);
        assert_near(place, 75, 0.02);
        assert_near(error[1], 0, 0.03);
        assert_true(error[1] < 0.4 * error[0]);
    }
}

/* Of a solitary wave that leaves through an open side, at most 3 % of its height comes back, of low ones 1 %. */
static void solitary_wave_leaves(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        height = (double[]){0.1, 0.3, 0.5}[k];
        const sb_offshore_options options = {.columns = 500,
                                             .rows = 1,
                                             .cell = 0.1,
                                             .gravity = G,
                                             .side = {SB_OFFSHORE_OPEN, SB_OFFSHORE_OPEN},
                                             .dispersion = true};
        sb_offshore *offshore = grid_create(&options, floor_1m, solitary);
        grid_run(offshore, 40 / celerity());
        const sb_offshore_view v = sb_offshore_read(offshore);
        double left = 0;
        for (size_t i = 0; i < v.columns; i++) left = fmax(left, fabs(v.h[i] - 1) / height);
        print_message("H/h %.1f: %.2f %% comes back\n", height, 100 * left);
        assert_near(left, 0, k == 0 ? 0.01 : 0.03);
        sb_offshore_destroy(offshore);
    }
}

/* A low standing wave across both axes of a closed square of 8 depths, k h = 1.11. */
static const double LOW = 1e-4, SIDE = 4;

static grid_water standing(double x, double y, double time)
{
    (void)time;
    return (grid_water){.h = 1 + LOW * cos(M_PI * x / SIDE) * cos(M_PI * y / SIDE)};
}

/* Frequency of the linear equations: w^2 = g h k^2 / (1 + k^2 h^2 / 3). After a quarter period the surface is flat. */
static void frequency_is_dispersive(void **state)
{
    (void)state;
    const double k2 = 2 * (M_PI / SIDE) * (M_PI / SIDE), w = sqrt(G * k2 / (1 + k2 / 3));
    const sb_offshore_options options = {
        .columns = 80, .rows = 80, .cell = SIDE / 80, .gravity = G, .dispersion = true};
    sb_offshore *offshore = grid_create(&options, floor_1m, standing);
    const double early = 0.98 * 2.5 * M_PI / w, late = 1.02 * 2.5 * M_PI / w;
    grid_run(offshore, early);
    const double before = sb_offshore_read(offshore).h[0] - 1;
    grid_run(offshore, late);
    const double after = sb_offshore_read(offshore).h[0] - 1;
    sb_offshore_destroy(offshore);
    /* cos(w t) crosses 0 within 1 % of this time, rising. */
    const double crossing = 0.98 + 0.04 * before / (before - after);
    print_message("frequency: exact %.4f /s, crossing at %.4f of its time\n", w, crossing);
    assert_true(before * after < 0);
    assert_near(crossing, 1, 0.01);
}

/* A wave over an uneven bed, smooth, with slopes up to 0.12. */
static double uneven(double x, double y)
{
    (void)y;
    return -1 + 0.3 * cos(0.4 * x);
}

static grid_water over_uneven(double x, double y, double time)
{
    (void)time;
    return (grid_water){.h = 0.2 * exp(-0.5 * (x - 9) * (x - 9)) - uneven(x, y),
                        .u = 0.8 * exp(-0.5 * (x - 9.5) * (x - 9.5))};
}

/* Dispersive force of the classical form, in which the acceleration a of the water is unknown:
   h a = -g h H_x - P_x - p b_x,  P = h^2 (b''/2 + h''/3),  p = h (b'' + h''/2),
   h'' = -h a_x + 2 h u_x^2,  b'' = a b_x + u^2 b_xx  (0 < x < 20, a = 0 at both ends), by finite differences: P at the
   middles, a at the nodes, solved as a dense system. force[i] = -P_x - p b_x at the nodes i d. */
static void reference_force(size_t n, double *force)
{
    const double d = 20 / (double)n;
    const size_t size = n - 1; /* nodes 1 ... n - 1 */
    double *m = calloc(size * size, sizeof *m), *a = calloc(n + 1, sizeof *a);
    assert_true(m && a);
    const double f = 1e-4; /* for derivatives of the given functions */
    /* The residual of the momentum equation is linear in a: column k of the matrix is its change with a[k]. */
    for (size_t k = 0; k <= size; k++) { /* k = size: a = 0, the constant part */
        for (size_t i = 0; i <= n; i++) a[i] = 0;
        if (k < size) a[k + 1] = 1;
        const bool constant = k == size;
        const size_t from = constant || k < 2 ? 1 : k - 1, to = constant || k + 4 > n - 1 ? n - 1 : k + 4;
        for (size_t i = from; i <= to; i++) {
            double pressure[2];
            const double x = (double)i * d, b0 = uneven(x, 0);
            for (int side = 0; side < 2; side++) {
                const size_t low = side ? i : i - 1;
                const double xm = ((double)low + 0.5) * d, h = over_uneven(xm, 0, 0).h, u = over_uneven(xm, 0, 0).u;
                const double ux = (over_uneven(xm + f, 0, 0).u - over_uneven(xm - f, 0, 0).u) / (2 * f);
                const double bx = (uneven(xm + f, 0) - uneven(xm - f, 0)) / (2 * f);
                const double bxx = (uneven(xm + f, 0) - 2 * uneven(xm, 0) + uneven(xm - f, 0)) / (f * f);
                const double h2 = -h * (a[low + 1] - a[low]) / d + constant * 2 * h * ux * ux;
                const double b2 = 0.5 * (a[low] + a[low + 1]) * bx + constant * u * u * bxx;
                pressure[side] = h * h * (b2 / 2 + h2 / 3);
            }
            const double h = over_uneven(x, 0, 0).h, u = over_uneven(x, 0, 0).u;
            const double ux = (over_uneven(x + f, 0, 0).u - over_uneven(x - f, 0, 0).u) / (2 * f);
            const double bx = (uneven(x + f, 0) - uneven(x - f, 0)) / (2 * f);
            const double bxx = (uneven(x + f, 0) - 2 * b0 + uneven(x - f, 0)) / (f * f);
            const double surface = (over_uneven(x + f, 0, 0).h - over_uneven(x - f, 0, 0).h) / (2 * f) + bx;
            const double h2 = -h * (a[i + 1] - a[i - 1]) / (2 * d) + constant * 2 * h * ux * ux;
            const double b2 = a[i] * bx + constant * u * u * bxx;
            const double value = -(pressure[1] - pressure[0]) / d - h * (b2 + h2 / 2) * bx - h * a[i];
            if (constant)
                force[i] = value - G * h * surface;
            else
                m[(i - 1) * size + k] = value;
        }
    }
    /* m a = -force, by elimination in a band of two. */
    for (size_t i = 0; i < size; i++) a[i + 1] = -force[i + 1];
    for (size_t i = 0; i < size; i++)
        for (size_t r = i + 1; r < size && r <= i + 2; r++) {
            const double share = m[r * size + i] / m[i * size + i];
            for (size_t c = i; c < size && c <= i + 4; c++) m[r * size + c] -= share * m[i * size + c];
            a[r + 1] -= share * a[i + 1];
        }
    for (size_t i = size; i-- > 0;) {
        for (size_t c = i + 1; c < size && c <= i + 4; c++) a[i + 1] -= m[i * size + c] * a[c + 1];
        a[i + 1] /= m[i * size + i];
    }
    /* h a = -g h H_x + force */
    for (size_t i = 1; i < n; i++) {
        const double x = (double)i * d, h = over_uneven(x, 0, 0).h;
        const double surface =
            (over_uneven(x + f, 0, 0).h - over_uneven(x - f, 0, 0).h + uneven(x + f, 0) - uneven(x - f, 0)) / (2 * f);
        force[i] = h * a[i] + G * h * surface;
    }
    free(m);
    free(a);
}

/* The change of momentum in a short step, less that without dispersion. */
static void model_force(double *force, size_t columns)
{
    const double dt = 1e-7;
    for (int on = 0; on < 2; on++) {
        const sb_offshore_options options = {
            .columns = columns, .rows = 1, .cell = 20 / (double)columns, .gravity = G, .dispersion = on};
        sb_offshore *offshore = grid_create(&options, uneven, over_uneven);
        grid_run(offshore, dt);
        const sb_offshore_view v = sb_offshore_read(offshore);
        for (size_t i = 0; i < columns; i++) force[i] = on ? (v.hu[i] - force[i]) / dt : v.hu[i];
        sb_offshore_destroy(offshore);
    }
}

/* The model leaves out squares of the bed's slope in the coupling, here 0.4 %. */
static void force_agrees_with_the_classical_form(void **state)
{
    (void)state;
    enum { COLUMNS = 200, NODES = 800 };
    double force[COLUMNS], reference[NODES + 1] = {0}, greatest = 0, difference = 0;
    reference_force(NODES, reference);
    model_force(force, COLUMNS);
    for (size_t i = 20; i < COLUMNS - 20; i++) {
        const double exact = reference[4 * i + 2]; /* at the cell's centre */
        greatest = fmax(greatest, fabs(exact));
        difference = fmax(difference, fabs(force[i] - exact));
    }
    print_message("force: up to %.4f m2/s2, difference up to %.4f\n", greatest, difference);
    assert_near(difference / greatest, 0, 0.015);
}

/* A wave of 0.9 of the depth, too high to stay whole, breaks: its pressure is left out, and it stays finite. */
static grid_water too_high(double x, double y, double time)
{
    (void)y;
    (void)time;
    const double h = 1 + 1.5 / (1 + exp(8 * (x - 20)));
    return (grid_water){.h = h, .u = 2 * (sqrt(G * h) - sqrt(G))};
}

static void steep_front_breaks(void **state)
{
    (void)state;
    const sb_offshore_options options = {.columns = 600,
                                         .rows = 1,
                                         .cell = 0.1,
                                         .gravity = G,
                                         .side = {SB_OFFSHORE_OPEN, SB_OFFSHORE_OPEN},
                                         .dispersion = true};
    sb_offshore *offshore = grid_create(&options, floor_1m, too_high);
    grid_run(offshore, 3);
    assert_true(sb_offshore_find_effort(offshore).breaking > 0);
    const sb_offshore_view v = sb_offshore_read(offshore);
    double top = 0;
    for (size_t i = 0; i < v.columns; i++) top = fmax(top, v.h[i]);
    assert_true(top < 2.75); /* 10 % above the water behind it; without breaking, undulations rise to twice the bore */
    sb_offshore_destroy(offshore);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solitary_wave_keeps_its_form), cmocka_unit_test(solitary_wave_leaves),
        cmocka_unit_test(frequency_is_dispersive),      cmocka_unit_test(force_agrees_with_the_classical_form),
        cmocka_unit_test(steep_front_breaks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
