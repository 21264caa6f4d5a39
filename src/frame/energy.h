/* The energy of the water, and the ledger of its changes. */
#ifndef SB_FRAME_ENERGY_H
#define SB_FRAME_ENERGY_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

/* Kinetic and potential energy (J, potential from z = domain min), momentum (kg m/s), mass (kg). */
typedef struct sb_energy {
    double kinetic, potential, mass;
    sb_vec3 momentum;
} sb_energy;

/* Changes of the water's kinetic plus potential energy since t = 0, without settling; J (J/m in 2D). Each entry is an
   addition to the energy, so that a loss is negative. Their sum is the change of energy, to round-off. */
typedef struct sb_ledger {
    double bodies;      /* work of moving bodies on the water */
    double viscosity;   /* artificial, physical and eddy viscosity; and the hydrostatic push of images (method.md) */
    double friction;    /* wall friction and wall shear */
    double pressure;    /* energy that the solve adds or removes; not physical: water of constant density stores none */
    double contact;     /* contact resolution */
    double integration; /* change of potential energy plus the work of gravity: the error of the time integration */
    double left;        /* minus the energy of particles that left the domain */
    double stress;      /* deviatoric stress correction */
    double sea;         /* water that crosses sides of kind sea, and what holds their water to the given sea */
    double sponge;      /* what sponges take */
    double tension;     /* surface tension: minus the change of the surface's energy, to the order of the method */
} sb_ledger;

/* What has crossed the sides of kind sea since t = 0. All members are of eight bytes. */
typedef struct sb_crossing {
    uint64_t in, out; /* particles */
    double energy;    /* J, kinetic and potential from z = domain min, net inwards */
    double held;      /* J, work of what holds the water of the strips to the given sea */
    sb_vec3 momentum; /* kg m/s, of the particles, net inwards */
    sb_vec3 push;     /* kg m/s, by what holds the water of the strips */
} sb_crossing;

/* What an absorbing paddle has done. */
typedef struct sb_absorption {
    bool absorbs;
    double law;              /* m, displacement by its law at the end of the step */
    double offset, farthest; /* m, distance from its law: at the end of the step, and the largest so far */
    uint64_t limited;        /* steps in which its reach stopped it; of plates, their sum */
    uint64_t plates;         /* push-plates, of which offset is the mean; 0: the paddle is one */
    double apart;            /* m, between the farthest and the nearest plate at the end of the step */
    /* m, mean of offset over the last whole ten periods (before them since the start), and its largest magnitude over
       whole ten periods; of plates the mean, and the largest of any. */
    double drift, drift_most;
} sb_absorption;

#endif
