/* Complete elliptic integrals and Jacobi's functions by the arithmetic-geometric mean. */
#ifndef SB_PHYSICS_ELLIPTIC_H
#define SB_PHYSICS_ELLIPTIC_H

enum { SB_ELLIPTIC_STEPS = 24 };

/* Constants for the parameter m and m1 = 1 - m, both in (0, 1). Both are given, because the one that is close to 1 has
   lost the digits of the other. */
typedef struct sb_elliptic {
    double m, m1;
    double k;      /* K(m) */
    double excess; /* S in E/K = 1 - m/2 - S, of the order of m^2/16 */
    int steps;
    double a[SB_ELLIPTIC_STEPS], c[SB_ELLIPTIC_STEPS];
} sb_elliptic;

/* Returns the constants of m = 1/(1 + exp(-logit)). |logit| <= 700. [Abramowitz and Stegun, 17.6] */
sb_elliptic sb_elliptic_of(double logit);

/* Sets sn, cn and dn of u, |u| <= K(m). [Abramowitz and Stegun, 16.4] */
void sb_elliptic_at(const sb_elliptic *e, double u, double *sn, double *cn, double *dn);

/* Returns Jacobi's zeta function E(u) - u E/K, |u| <= K(m). [Abramowitz and Stegun, 17.6.10] */
double sb_elliptic_zeta(const sb_elliptic *e, double u);

#endif
