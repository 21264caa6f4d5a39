/* The parts of the simulation in plain double precision and by brute force, with which tests compare the fast code.
   Equations and signs are those of docs/method.md; the unknown is q = p/rho^2 in m^5/(kg s^2). */
#ifndef SB_TESTS_REFERENCE_H
#define SB_TESTS_REFERENCE_H

#include "base/vec.h"
#include "physics/kernels/kernel.h"

#include <stdbool.h>

#include <stddef.h>
#include <stdint.h>

/* Input; the caller keeps its arrays. All SI. In 2D every y is 0. */
typedef struct sb_reference_cloud {
    const sb_kernel *kernel;
    int dimension;
    double h, spacing;   /* m: support radius, particle spacing */
    double rest_density; /* kg/m^3 */
    double time_step;    /* s */
    size_t fluid_count;
    const sb_vec3 *position, *velocity;
    size_t wall_count; /* boundary particles */
    const sb_vec3 *wall_position, *wall_velocity;
    const sb_vec3 *wall_normal; /* unit, or zero if there is none; used for eddy viscosity and shear only */
    const double *psi;          /* kg, or kg/m in 2D */
    const uint32_t *body;       /* of each boundary particle */
    double sound_speed, artificial_viscosity, wall_friction; /* m/s, alpha, sigma */
    sb_vec3 period; /* m, period along each axis, at least h; 0: not periodic */
} sb_reference_cloud;

/* A neighbour of a fluid particle i. other: j or b; the pair may be with one of its images. */
typedef struct sb_reference_pair {
    size_t other;
    sb_vec3 offset;   /* x_i - x_other */
    double w;         /* W */
    sb_vec3 gradient; /* grad_i W */
} sb_reference_pair;

/* A cloud with all its pairs closer than h. Those of i are [start[i], start[i + 1]), in increasing order of `other`,
   without i itself. */
typedef struct sb_reference {
    sb_reference_cloud cloud;
    double mass; /* kg, or kg/m in 2D: rho0 spacing^d */
    sb_reference_pair *fluid, *wall;
    size_t *fluid_start, *wall_start;
} sb_reference;

/* psi_b = gamma rho0 / sum_k W_bk over all boundary particles, b included; times the factor of docs/method.md (M16a) if
   `curved`. Uses only the cloud's wall positions, normals (if `curved`),
   period, kernel, dimension, h and rest density. */
void sb_reference_psi(const sb_reference_cloud *cloud, double gamma, bool curved, double *psi);

/* Finds the pairs by testing all. Returns 0, or -1 without memory. The cloud's arrays must outlive the reference. */
int sb_reference_create(const sb_reference_cloud *cloud, sb_reference *reference);
void sb_reference_destroy(sb_reference *reference);

/* rho_i = m W(0) + sum_j m W_ij + sum_b psi_b W_ib */
void sb_reference_density(const sb_reference *reference, double *rho);

/* Monaghan's viscosity with its min switch [S16 eq. 14]: adds -sum_j m Pi_ij grad W_ij. */
void sb_reference_viscosity(const sb_reference *reference, const double *rho, sb_vec3 *acceleration);

/* Wall friction [S16 eq. 33]: adds -sum_b psi_b Pi_ib grad W_ib to acceleration, the opposite forces
   m psi_b Pi_ib grad W_ib in N to force[body], and their torques about center[body] to torque[body]. The last three
   arguments may be NULL together. */
void sb_reference_friction(const sb_reference *reference, const double *rho, sb_vec3 *acceleration,
                           const sb_vec3 *center, sb_vec3 *force, sb_vec3 *torque);

/* Shear of smooth walls, with the boundary surface `offset` (m) behind them: adds c |u| u psi_b grad W_ib.n / rho0
   where grad W_ib.n < 0. n is the boundary particle's normal, u the velocity along the wall relative to it, y the
   distance from the wall (at least a quarter of a spacing), and c the larger one of nu/(u y) and 0.0246 (nu/(u
   y))^(1/4). The other arguments are those of sb_reference_friction. */
void sb_reference_shear(const sb_reference *reference, double nu, double offset, sb_vec3 *acceleration,
                        const sb_vec3 *center, sb_vec3 *force, sb_vec3 *torque);

/* nu_t = min(C_s spacing, 0.4 d)^2 |S| in m^2/s. S follows from velocity gradients, which are corrected by the
   neighbours' second moments where their determinant (1 for isotropic moments) exceeds `thinnest`. d is the distance
   from the wall, which lies `offset` (m) in front of the plane of the nearest boundary particle. */
void sb_reference_eddy(const sb_reference *reference, const double *rho, double smagorinsky, double offset,
                       double thinnest, double *eddy);

/* Viscosity without a switch, nu_ij = nu + (eddy_i + eddy_j)/2: adds sum_j m 4 (d+2) nu_ij v.x /
   [(rho_i + rho_j)(r^2 + 0.01 h^2)] grad W_ij. eddy: NULL for none. */
void sb_reference_unswitched(const sb_reference *reference, const double *rho, double nu, const double *eddy,
                             sb_vec3 *acceleration);

/* div_i = sum_j m (v_i - v_j).grad W_ij + sum_b psi_b (v_i - v_b).grad W_ib, in kg/(m^3 s). moving == 0: with walls at
   rest. */
void sb_reference_divergence(const sb_reference *reference, const sb_vec3 *velocity, int moving, double *divergence);

/* b_i = beta (rho0 - rho_i) - dt div_i of the predicted velocity v*. */
void sb_reference_source(const sb_reference *reference, const double *rho, const sb_vec3 *predicted, double beta,
                         double *source);

/* a = G q: a_i = -[sum_j m (q_i + q_j) grad W_ij + q_i sum_b psi_b grad W_ib] */
void sb_reference_pressure_acceleration(const sb_reference *reference, const double *q, sb_vec3 *acceleration);

/* A q = dt^2 div(G q) with walls at rest. acceleration: receives G q. */
void sb_reference_apply(const sb_reference *reference, const double *q, sb_vec3 *acceleration, double *product);

/* a_ii = -dt^2 [|S_i|^2 + m sum_j m |grad W_ij|^2], S_i = sum_j m grad W_ij + sum_b psi_b grad W_ib */
void sb_reference_diagonal(const sb_reference *reference, double *diagonal);

/* a_ii in the middle of a full lattice, where S_i = 0. */
double sb_reference_lattice_diagonal(const sb_reference_cloud *cloud);

/* Solves q >= 0, e = A q - b <= 0, q e = 0: q is free or 0 for each particle; conjugate gradients solve e = 0 for the
   free ones, and then particles with q < 0, or with q = 0 and e > 0, change sides, until every particle's
   |min(q |a_ii|, -e)| <= tolerance rho0. Particles with |a_ii| < 1e-6 of the lattice's have q = 0. Returns the number
   of products A q; -1 without memory, -2 if max_products did not suffice. */
long sb_reference_solve(const sb_reference *reference, const double *source, double tolerance, long max_products,
                        double *q);

/* Adds the pressure forces m psi_b q_i grad W_ib in N to force[body], and their torques about
   center[body] to torque[body]. */
void sb_reference_pressure_forces(const sb_reference *reference, const double *q, const sb_vec3 *center, sb_vec3 *force,
                                  sb_vec3 *torque);

#endif
