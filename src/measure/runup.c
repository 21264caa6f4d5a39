/* Run-up: the highest point of the water that hangs together along a line. */
#include "measure/parts.h"

static double distance_to_line(const sb_runup_line *line, double x, double y)
{
    double dx = line->bx - line->ax, dy = line->by - line->ay, square = dx * dx + dy * dy;
    double t = square > 0 ? ((x - line->ax) * dx + (y - line->ay) * dy) / square : 0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return hypot(x - line->ax - t * dx, y - line->ay - t * dy);
}

sb_status sb_runup_read(const sb_sight *sight, const sb_runup_line *line, sb_vec3 *place,
                        sb_error *error)
{
    bool flat = sight->scene->dimensions == 2;
    double spacing = sight->scene->resolution;
    sb_runup_line at = *line;
    if (flat) at.ay = at.by = 0;
    *place = sb_vec((double)NAN, (double)NAN, (double)NAN);
    sb_vec3 min =
        sb_vec(fmin(at.ax, at.bx) - spacing, fmin(at.ay, at.by) - spacing, sight->min.z - spacing);
    sb_vec3 max =
        sb_vec(fmax(at.ax, at.bx) + spacing, fmax(at.ay, at.by) + spacing, sight->max.z + spacing);
    sb_cloud *cloud = sight->cloud;
    sb_status status = sb_cloud_query(cloud, sight->sim, min, max, sight->lag, error);
    if (status != SB_OK) return status;
    size_t kept = 0;
    for (size_t i = 0; i < cloud->count; i++)
        if (distance_to_line(&at, cloud->samples[i].position.x, cloud->samples[i].position.y) <=
            spacing)
            cloud->samples[kept++] = cloud->samples[i];
    cloud->count = kept;
    status = sb_cloud_keep_largest(cloud, SB_LINK * spacing, error);
    if (status != SB_OK || cloud->count < (size_t)sight->scene->dimensions + 1) return status;
    sb_vec3 highest = cloud->samples[0].position;
    for (size_t i = 1; i < cloud->count; i++)
        if (cloud->samples[i].position.z > highest.z) highest = cloud->samples[i].position;
    highest.z += 0.5 * spacing; /* the upper face of that particle's volume */
    *place = highest;
    return SB_OK;
}
