/* Sponges: zones in which water is slowed down by -strength v, or has a viscosity, which grows along the zone. */
#ifndef SB_PHYSICS_SPONGE_H
#define SB_PHYSICS_SPONGE_H

typedef enum sb_sponge_kind { SB_SPONGE_DAMPING, SB_SPONGE_VISCOUS } sb_sponge_kind;
typedef enum sb_sponge_profile { SB_SPONGE_LINEAR, SB_SPONGE_QUADRATIC, SB_SPONGE_CUBIC } sb_sponge_profile;

/* Share of the greatest strength at a share of the zone's length from its beginning: 0 before it, 1 behind its end. */
double sb_sponge_share(sb_sponge_profile profile, double along);

/* Reflected over incident amplitude of linear waves by a zone in front of a wall. strength: 1/s, at the end. Both
   velocities are slowed down, so that k tanh kd = omega^2/g (1 + i strength/omega) in each slice, and surface and flux
   are continuous between slices. */
double sb_sponge_reflection(sb_sponge_profile profile, double strength, double omega, double depth, double gravity,
                            double length);

/* Returns the strength with the least reflection, 1/s, to a per cent. */
double sb_sponge_best(sb_sponge_profile profile, double omega, double depth, double gravity, double length);

/* Kinematic viscosity, m^2/s, of Monaghan's artificial viscosity, which acts on particles that approach each other
   only: alpha h c/(4 (d + 2)) in d dimensions (docs/method.md, M14). support: m; sound_speed: m/s. */
double sb_sponge_viscosity(double alpha, double support, double sound_speed, int dimensions);

/* Reflected over incident amplitude of linear waves by a zone of viscosity in front of a wall: a wave loses 2 nu k^2 of
   its amplitude per second on the way there and back at its group speed. What the growing viscosity itself reflects is
   left out. viscosity: m^2/s, at the end. */
double sb_sponge_viscous_reflection(sb_sponge_profile profile, double viscosity, double omega, double depth,
                                    double gravity, double length);

#endif
