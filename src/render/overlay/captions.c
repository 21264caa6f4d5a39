/* Draws title, time, legends, scale and north over a picture. */
#include "render/overlay/captions.h"

#include "render/overlay/colormap.h"
#include "render/overlay/marks.h"
#include "render/overlay/overlay.h"

/* Draws the legends of the water, of the cut water, of loads and of the greatest depth from the lowest one up. */
static sb_status draw_legends(const sb_shot *shot, const sb_slice_job *job, sb_image *image, sb_error *error)
{
    const sb_camera *camera = shot->camera;
    const sb_field *water = &sb_fields[camera->color], *cut = &sb_fields[camera->slice.field];
    const bool same = job && cut == water && !(job->range[0] != shot->range[0]) && !(job->range[1] != shot->range[1]);
    sb_legend legends[4];
    int count = 0;
    if (!job || (job->slice->behind && !same))
        legends[count++] = (sb_legend){water->label, water->map, shot->range[0], shot->range[1]};
    if (job) legends[count++] = (sb_legend){cut->label, cut->map, job->range[0], job->range[1]};
    const bool bodies = !job || job->slice->behind;
    if (bodies && shot->load_max > 0)
        legends[count++] = (sb_legend){"mean pressure on faces  Pa", SB_COLORMAP_FIRE, 0, shot->load_max};
    if (bodies && shot->paint_max > 0)
        legends[count++] = (sb_legend){"greatest depth so far  m", SB_COLORMAP_DEEP, 0, shot->paint_max};
    sb_status status = SB_OK;
    for (int k = 0; k < count && status == SB_OK; k++) status = sb_overlay_legend(image, k, &legends[k], error);
    return status == SB_OK && job ? sb_slice_legend(image, job, shot->key.target, count, error) : status;
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
