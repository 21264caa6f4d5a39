/* Warnings about the places of sponges. */
#ifndef SB_APP_CHECK_ZONES_H
#define SB_APP_CHECK_ZONES_H

#include "app/warning_visit.h"
#include "scene/scene.h"

/* Warns of sponges that begin outside of the domain, and of those that overlap. */
void sb_zone_warnings(const sb_scene *scene, sb_warning_visit *visit, void *context);

#endif
