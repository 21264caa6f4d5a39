/* Solution of the pressure problem by an active set, in double precision. */
#include "reference/reference.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

typedef struct problem {
    const sb_reference *reference;
    const double *source;
    size_t n;
    double *q;
    double *diagonal;                    /* -a_ii; 0: no pressure here */
    double *error, *direction, *product; /* e = A q - b */
    unsigned char *set;                  /* FREE, ZERO */
    sb_vec3 *acceleration;
    long products, max_products;
} problem;

enum { ZERO, FREE };

static void multiply(problem *p, const double *argument, double *out)
{
    sb_reference_apply(p->reference, argument, p->acceleration, out);
    p->products++;
}

/* Computes e. Returns its largest value on the free set. */
static double find_error(problem *p)
{
    double worst = 0;
    multiply(p, p->q, p->error);
    for (size_t i = 0; i < p->n; i++) {
        p->error[i] -= p->source[i];
        if (p->set[i] == FREE) worst = fmax(worst, fabs(p->error[i]));
    }
    return worst;
}

/* Conjugate gradients, scaled by the diagonal, until |e| <= limit on the free set. */
static void solve_free(problem *p, double limit)
{
    double worst = find_error(p), last = 0;
    memset(p->direction, 0, p->n * sizeof *p->direction);
    while (worst > limit && p->products < p->max_products) {
        double size = 0, curvature = 0;
        for (size_t i = 0; i < p->n; i++)
            if (p->set[i] == FREE) size += p->error[i] * p->error[i] / p->diagonal[i];
        const double keep = last > 0 ? size / last : 0;
        for (size_t i = 0; i < p->n; i++)
            p->direction[i] = p->set[i] == FREE ? p->error[i] / p->diagonal[i] + keep * p->direction[i] : 0;
        multiply(p, p->direction, p->product);
        for (size_t i = 0; i < p->n; i++) curvature -= p->direction[i] * p->product[i];
        const double length = size / curvature;
        worst = 0;
        for (size_t i = 0; i < p->n; i++) {
            p->q[i] += length * p->direction[i];
            p->error[i] += length * p->product[i];
            if (p->set[i] == FREE) worst = fmax(worst, fabs(p->error[i]));
        }
        last = size;
    }
    find_error(p);
}

static bool is_wrong(const problem *p, size_t i, double limit)
{
    return p->set[i] == FREE ? p->q[i] * p->diagonal[i] < -limit : p->diagonal[i] > 0 && p->error[i] > limit;
}

/* Moves particles on the wrong side to the other: all of them, or the last one only. Returns how many were wrong. */
static size_t exchange(problem *p, double limit, bool all)
{
    size_t wrong = 0;
    for (size_t i = p->n; i-- > 0;) {
        if (!is_wrong(p, i, limit)) continue;
        if (wrong++ > 0 && !all) continue;
        p->set[i] = p->set[i] == FREE ? ZERO : FREE;
        p->q[i] = 0;
    }
    return wrong;
}

/* Exchanges all until that has not lowered the number of wrong particles for TRIES times; then one at a time until it
   is lower, which cannot go round in circles [Judice and Pires 1994]. */
static void find_sets(problem *p, double limit)
{
    enum { TRIES = 10 };
    size_t least = p->n + 1, wrong = 1;
    for (int tries = TRIES; wrong > 0 && p->products < p->max_products;) {
        solve_free(p, limit);
        size_t now = 0;
        for (size_t i = 0; i < p->n; i++) now += is_wrong(p, i, limit);
        tries = now < least ? TRIES : tries - 1;
        least = now < least ? now : least;
        wrong = exchange(p, limit, tries > 0);
    }
}

/* Largest |min(q |a_ii|, -e)| after q < 0, which is round-off, is set to 0. */
static double natural_residual(problem *p)
{
    double worst = 0;
    for (size_t i = 0; i < p->n; i++) p->q[i] = fmax(p->q[i], 0);
    find_error(p);
    for (size_t i = 0; i < p->n; i++)
        if (p->diagonal[i] > 0) worst = fmax(worst, fabs(fmin(p->q[i] * p->diagonal[i], -p->error[i])));
    return worst;
}

static void begin(problem *p)
{
    const double smallest = 1e-6 * fabs(sb_reference_lattice_diagonal(&p->reference->cloud));
    sb_reference_diagonal(p->reference, p->diagonal);
    for (size_t i = 0; i < p->n; i++) {
        p->diagonal[i] = -p->diagonal[i] < smallest ? 0 : -p->diagonal[i];
        p->set[i] = p->diagonal[i] > 0 ? FREE : ZERO;
        p->q[i] = 0;
    }
}

long sb_reference_solve(const sb_reference *reference, const double *source, double tolerance, long max_products,
                        double *q)
{
    const size_t n = reference->cloud.fluid_count;
    problem p = {.reference = reference, .source = source, .n = n, .q = q, .max_products = max_products};
    double **fields[] = {&p.diagonal, &p.error, &p.direction, &p.product};
    p.set = sb_alloc(n, 1);
    p.acceleration = sb_alloc(n, sizeof *p.acceleration);
    bool all = p.set && p.acceleration;
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) all = (*fields[f] = sb_alloc(n, sizeof(double))) && all;
    if (all) begin(&p);
    /* Coarse limits first: few iterations find most of the sets. */
    const double last = 0.1 * tolerance * reference->cloud.rest_density;
    for (double limit = 1e-5 * reference->cloud.rest_density; all && limit > last; limit *= 0.01) find_sets(&p, limit);
    if (all) find_sets(&p, last);
    const bool solved = all && natural_residual(&p) <= 10 * last;
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) sb_free(*fields[f]);
    sb_free(p.set);
    sb_free(p.acceleration);
    return !all ? -1 : solved ? p.products : -2;
}
