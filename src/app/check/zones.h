/* Warnings about the places of sponges, and what they reflect. */
#ifndef SB_APP_CHECK_ZONES_H
#define SB_APP_CHECK_ZONES_H

#include "app/check/warning_visit.h"
#include "scene/scene.h"

/* Warns of sponges that begin outside of the domain, of those that overlap, and of those that reflect waves of the
   scene. sound: speed of sound of the run, m/s. */
void sb_zone_warnings(const sb_scene *scene, double sound, sb_warning_visit *visit, void *context);

/* Viscosity at the end of a viscous sponge, m^2/s; 0 of a damping one. sound: speed of sound, m/s. */
double sb_zone_viscosity(const sb_scene *scene, const sb_sponge *sponge, double sound);

/* Reflected over incident amplitude of waves of this period (s) at a sponge, by linear theory. sound: speed of sound
   (m/s), from which the viscosity of a viscous sponge follows. */
double sb_zone_reflection(const sb_scene *scene, const sb_sponge *sponge, double period, double sound);

#endif
