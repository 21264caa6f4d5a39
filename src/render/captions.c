/* Draws title, time, legends, scale and north over a picture. */
#include "render/captions.h"

#include "render/marks.h"
#include "render/overlay.h"

static sb_status draw_legends(const sb_shot *shot, const sb_slice_job *job, sb_image *image, sb_error *error)
{
    const sb_camera *camera = shot->camera;
    const sb_legend water = {sb_fields[camera->color].label, sb_fields[camera->color].map, shot->range[0],
                             shot->range[1]};
    if (!job) return sb_overlay_legend(image, 0, &water, error);
    const sb_field *field = &sb_fields[camera->slice.field];
    const sb_legend cut = {field->label, field->map, job->range[0], job->range[1]};
    const bool same = camera->slice.field == camera->color && !(job->range[0] != shot->range[0]) &&
                      !(job->range[1] != shot->range[1]);
    const int slots = camera->slice.behind && !same ? 2 : 1;
    sb_status status = sb_overlay_legend(image, slots - 1, &cut, error);
    if (status == SB_OK && slots > 1) status = sb_overlay_legend(image, 0, &water, error);
    return status == SB_OK ? sb_slice_legend(image, job, shot->key.target, slots, error) : status;
}

sb_status sb_captions_draw(const sb_scene *scene, const sb_shot *shot, const sb_slice_job *job, sb_image *image,
                           sb_error *error)
{
    const sb_render_settings *settings = &scene->render;
    sb_status status = sb_overlay_title(image, scene->title, shot->frame->status.time, error);
    if (status == SB_OK) status = draw_legends(shot, job, image, error);
    if (status == SB_OK && settings->scale_bar) status = sb_marks_scale(image, &shot->view, shot->key.target, error);
    if (status == SB_OK) status = sb_marks_north(image, &shot->view, shot->key.target, settings->north, error);
    return status;
}
