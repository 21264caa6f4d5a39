/* Complete elliptic integrals and Jacobi's functions by the arithmetic-geometric mean. */
#include "physics/waves/elliptic.h"

#include <math.h>

sb_elliptic sb_elliptic_of(double logit)
{
    sb_elliptic e = {.m = 1 / (1 + exp(-logit)), .m1 = 1 / (1 + exp(logit))};
    double a = 1, b = sqrt(e.m1), c = sqrt(e.m), weight = 1;
    e.a[0] = a;
    e.c[0] = c;
    while (c > 1e-17 * a && e.steps + 1 < SB_ELLIPTIC_STEPS) {
        const double next = 0.5 * (a + b);
        /* (a - b)/2 without its cancellation: c^2 = a^2 - b^2 holds at each step. */
        c = c * c / (4 * next);
        b = sqrt(a * b);
        a = next;
        e.excess += weight * c * c;
        weight *= 2;
        e.steps++;
        e.a[e.steps] = a;
        e.c[e.steps] = c;
    }
    e.k = M_PI / (2 * a);
    return e;
}

void sb_elliptic_at(const sb_elliptic *e, double u, double *sn, double *cn, double *dn)
{
    double phi = ldexp(e->a[e->steps] * u, e->steps);
    for (int n = e->steps; n > 0; n--) phi = 0.5 * (phi + asin(e->c[n] / e->a[n] * sin(phi)));
    *sn = sin(phi);
    *cn = cos(phi);
    *dn = sqrt(e->m1 + e->m * *cn * *cn);
}

double sb_elliptic_zeta(const sb_elliptic *e, double u)
{
    double phi = ldexp(e->a[e->steps] * u, e->steps), sum = 0;
    for (int n = e->steps; n > 0; n--) {
        sum += e->c[n] * sin(phi);
        phi = 0.5 * (phi + asin(e->c[n] / e->a[n] * sin(phi)));
    }
    return sum;
}
