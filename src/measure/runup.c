/* Run-up: the highest point of the water that hangs together along a line, and its front. */
#include "measure/parts.h"

/* Spacings below which particles hang together here. In the film at a front, one layer thick, they
   drift apart: 2 spacings are a film of half a layer. (With the 1.5 of other measures a dam break's
   front jumped back and forth by several spacings as its foremost particles came off and were met
   again.) */
#define FILM_LINK 2.0

/* Of the line, in plan. */
typedef struct course {
    double ax, ay, length, ux, uy; /* first end, m, unit direction */
} course;

static course course_of(const sb_runup_line *line, bool flat)
{
    double dx = line->bx - line->ax, dy = flat ? 0 : line->by - line->ay, length = hypot(dx, dy);
    return (course){line->ax, flat ? 0 : line->ay, length, dx / length, dy / length};
}

/* How far along the line, from its first end. */
static double along(const course *c, sb_vec3 at)
{
    return (at.x - c->ax) * c->ux + (at.y - c->ay) * c->uy;
}

static double distance_to(const course *c, sb_vec3 at)
{
    double t = along(c, at);
    t = t < 0 ? 0 : t > c->length ? c->length : t;
    return hypot(at.x - c->ax - t * c->ux, at.y - c->ay - t * c->uy);
}

/* Keeps the particles within one spacing of the line that hang together. */
static sb_status look_along(const sb_sight *sight, const course *c, sb_error *error)
{
    double spacing = sight->scene->resolution;
    double bx = c->ax + c->length * c->ux, by = c->ay + c->length * c->uy;
    sb_vec3 min = sb_vec(fmin(c->ax, bx) - spacing, fmin(c->ay, by) - spacing, sight->min.z - spacing);
    sb_vec3 max = sb_vec(fmax(c->ax, bx) + spacing, fmax(c->ay, by) + spacing, sight->max.z + spacing);
    sb_cloud *cloud = sight->cloud;
    sb_status status = sb_cloud_query(cloud, sight->sim, min, max, sight->lag, error);
    if (status != SB_OK) return status;
    size_t kept = 0;
    for (size_t i = 0; i < cloud->count; i++)
        if (distance_to(c, cloud->samples[i].position) <= spacing) cloud->samples[kept++] = cloud->samples[i];
    cloud->count = kept;
    return sb_cloud_keep_largest(cloud, FILM_LINK * spacing, error);
}

sb_status sb_runup_read(const sb_sight *sight, const sb_runup_line *line, sb_runup_record *record, sb_error *error)
{
    course c = course_of(line, sight->scene->dimensions == 2);
    const sb_cloud *cloud = sight->cloud;
    record->place = sb_vec((double)NAN, (double)NAN, (double)NAN);
    record->front = (double)NAN;
    sb_status status = look_along(sight, &c, error);
    if (status != SB_OK || cloud->count < (size_t)sight->scene->dimensions + 1) return status;
    sb_vec3 highest = cloud->samples[0].position;
    double front = along(&c, highest), half = 0.5 * sight->scene->resolution;
    for (size_t i = 1; i < cloud->count; i++) {
        sb_vec3 place = cloud->samples[i].position;
        if (place.z > highest.z) highest = place;
        front = fmax(front, along(&c, place));
    }
    highest.z += half; /* the upper face of that particle's volume */
    record->place = highest;
    record->front = fmin(front + half, c.length);
    return SB_OK;
}
