#include "physics/waves/stokes.h"

#include "physics/waves/breaking.h"
#include "physics/waves/dispersion.h"
#include "physics/waves/regular_wave.h"

#include <math.h>
#include <stdbool.h>

/* a[0] + a[1] s + ... */
static double polynomial(const double *a, int count, double s)
{
    double sum = 0;
    for (int k = count - 1; k >= 0; k--) sum = sum * s + a[k];
    return sum;
}

#define POLYNOMIAL(s, ...)                                                                                             \
    polynomial((const double[]){__VA_ARGS__}, (int)(sizeof((double[]){__VA_ARGS__}) / sizeof(double)), s)

/* kd beyond which the coefficients are those of infinite depth to rounding. */
static const double DEEP = 60;

/* Table 1 of Fenton 1985 in S = sech 2kd. */
typedef struct table {
    double a11, a22, a31, a33, a42, a44, a51, a53, a55;
    double b22, b31, b42, b44, b53, b55;
    double c0, c2, c4;
} table;

static table coefficients(double kd)
{
    const double s = 1 / cosh(2 * kd), sh = sinh(kd), th = tanh(kd), l = 1 - s;
    const double l2 = l * l, l3 = l2 * l, l4 = l3 * l, l5 = l4 * l, l6 = l5 * l, p = 3 + 2 * s, q = p * (4 + s);
    return (table){
        .a11 = 1 / sh,
        .a22 = POLYNOMIAL(s, 0, 0, 3) / (2 * l2),
        .a31 = POLYNOMIAL(s, -4, -20, 10, -13) / (8 * sh * l3),
        .a33 = POLYNOMIAL(s, 0, 0, -2, 11) / (8 * sh * l3),
        .a42 = POLYNOMIAL(s, 0, 12, -14, -264, -45, -13) / (24 * l5),
        .a44 = POLYNOMIAL(s, 0, 0, 0, 10, -174, 291, 278) / (48 * p * l5),
        .a51 = POLYNOMIAL(s, -1184, 32, 13232, 21712, 20940, 12554, -500, -3341, -670) / (64 * sh * q * l6),
        .a53 = POLYNOMIAL(s, 0, 4, 105, 198, -1376, -1302, -117, 58) / (32 * sh * p * l6),
        .a55 = POLYNOMIAL(s, 0, 0, 0, -6, 272, -1552, 852, 2029, 430) / (64 * sh * q * l6),
        .b22 = POLYNOMIAL(s, 1, 2) / (2 * th * l),
        .b31 = -3 * POLYNOMIAL(s, 1, 3, 3, 2) / (8 * l3),
        .b42 = POLYNOMIAL(s, 6, -26, -182, -204, -25, 26) / (6 * th * p * l4),
        .b44 = POLYNOMIAL(s, 24, 92, 122, 66, 67, 34) / (24 * th * p * l4),
        .b53 = 9 * POLYNOMIAL(s, 132, 17, -2216, -5897, -6292, -2687, 194, 467, 82) / (128 * q * l6),
        .b55 = 5 * POLYNOMIAL(s, 300, 1579, 3176, 2949, 1188, 675, 1326, 827, 130) / (384 * q * l6),
        .c0 = sqrt(th),
        .c2 = sqrt(th) * POLYNOMIAL(s, 2, 0, 7) / (4 * l2),
        .c4 = sqrt(th) * POLYNOMIAL(s, 4, 32, -116, -400, -71, 146) / (32 * l5),
    };
}

static sb_status check(const sb_stokes *wave, sb_error *error)
{
    const double most = sb_breaking_height(wave->number, wave->depth), d = wave->depth;
    const double ursell = wave->height * wave->length * wave->length / (d * d * d);
    const double limit = wave->order == 1 ? (double)INFINITY : wave->order == 2 ? SB_URSELL_LIMIT : SB_STOKES_URSELL;
    if (!(wave->height <= most))
        return sb_fail(error, SB_BAD_INPUT,
                       "a wave of %g m with a length of %g m on %g m breaks, expected a height of at most %.3g m",
                       wave->height, wave->length, d, sb_breaking_shown(most));
    if (!(ursell < limit))
        return sb_fail(
            error, SB_BAD_INPUT,
            "a wave of %g m with a length of %g m on %g m has H L^2/d^3 = %.4g, too long for a Stokes wave of "
            "this order, expected less than %.3g",
            wave->height, wave->length, d, ursell, limit);
    return SB_OK;
}

/* The wave, whether the theory is valid for it or not. */
static sb_stokes evaluate(int order, double height, double length, double depth, double gravity)
{
    sb_stokes made = {.order = order, .height = height, .length = length, .depth = depth, .number = 2 * M_PI / length};
    const double k = made.number, kd = fmin(k * depth, DEEP), e = 0.5 * k * height;
    const table t = coefficients(kd);
    /* Powers of e beyond the order are left out. */
    const double e2 = order > 1 ? e * e : 0, e3 = order > 2 ? e2 * e : 0, e4 = order > 3 ? e3 * e : 0;
    const double e5 = order > 4 ? e4 * e : 0;
    const double surface[] = {e + e3 * t.b31 - e5 * (t.b53 + t.b55), e2 * t.b22 + e4 * t.b42, -e3 * t.b31 + e5 * t.b53,
                              e4 * t.b44, e5 * t.b55};
    const double potential[] = {e * t.a11 + e3 * t.a31 + e5 * t.a51, e2 * t.a22 + e4 * t.a42, e3 * t.a33 + e5 * t.a53,
                                e4 * t.a44, e5 * t.a55};
    for (int j = 0; j < SB_STOKES_ORDERS; j++) {
        made.surface[j] = surface[j] / k;
        made.velocity[j] = t.c0 * sqrt(gravity / k) * (j + 1) * potential[j] * cosh((j + 1) * kd);
    }
    made.celerity = sqrt(gravity / k) * (t.c0 + (order > 2 ? e * e * t.c2 : 0) + e4 * t.c4);
    return made;
}

sb_status sb_stokes_create(int order, double height, double length, double depth, double gravity, sb_stokes *wave,
                           sb_error *error)
{
    const sb_stokes made = evaluate(order, height, length, depth, gravity);
    const sb_status status = check(&made, error);
    if (status == SB_OK) *wave = made;
    return status;
}

sb_status sb_stokes_of_period(int order, double height, double period, double depth, double gravity, sb_stokes *wave,
                              sb_error *error)
{
    enum { HALVINGS = 60 };
    /* Waves are as long as the linear wave of the period, or longer, by a fifth at the limits of height and length. */
    double low = 2 * M_PI / sb_wave_number(period, depth, gravity), high = 1.5 * low;
    for (int i = 0; i < HALVINGS && order > 2; i++) {
        const double middle = 0.5 * (low + high);
        const sb_stokes tried = evaluate(order, height, middle, depth, gravity);
        *(tried.celerity * period > middle ? &low : &high) = middle;
    }
    return sb_stokes_create(order, height, low, depth, gravity, wave, error);
}

double sb_stokes_elevation(const sb_stokes *wave, double ahead)
{
    const double theta = 2 * M_PI * remainder(ahead / wave->length, 1);
    double sum = 0;
    for (int j = 0; j < wave->order; j++) sum += wave->surface[j] * cos((j + 1) * theta);
    return sum;
}

void sb_stokes_velocity(const sb_stokes *wave, double ahead, double z, double *u, double *w)
{
    const double theta = 2 * M_PI * remainder(ahead / wave->length, 1), d = wave->depth;
    z = fmin(fmax(z, 0), wave->order > 1 ? d + sb_stokes_elevation(wave, ahead) : d);
    *u = *w = 0;
    for (int j = 0; j < wave->order; j++) {
        const double k = (j + 1) * wave->number, up = exp(k * (z - d)), down = exp(-k * (z + d));
        const double scale = wave->velocity[j] / (1 + exp(-2 * k * d));
        *u += scale * (up + down) * cos((j + 1) * theta);
        *w += scale * (up - down) * sin((j + 1) * theta);
    }
}
