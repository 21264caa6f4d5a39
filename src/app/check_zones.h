/* Warnings about the places of sponges. */
#ifndef SB_APP_CHECK_ZONES_H
#define SB_APP_CHECK_ZONES_H

#include "app/warning_visit.h"
#include "scene/scene.h"

/* Warns of sponges that begin outside of the domain, of those that overlap, and of those that reflect waves of the
   scene. */
void sb_zone_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

#endif
