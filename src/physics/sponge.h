/* Sponges: zones in which water is slowed down by -strength v, with a strength that grows along the zone. */
#ifndef SB_PHYSICS_SPONGE_H
#define SB_PHYSICS_SPONGE_H

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

#endif
