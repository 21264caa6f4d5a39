#include "compare/film.h"

#include "output/plots/video.h"
#include "report/pictures.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 1280 }; /* px, of all runs together */

const char *sb_film_camera(const sb_comparison *comparison, size_t *groups)
{
    const sb_scene *scene = &comparison->runs[0].run.scene;
    *groups = comparison->groups < SB_FILM_MAX ? comparison->groups : SB_FILM_MAX;
    for (size_t k = 0; k < scene->render.camera_count; k++) {
        size_t with = 0;
        for (size_t g = 0; g < *groups; g++) {
            sb_stored_pictures list;
            sb_stored_pictures_list(&comparison->runs[comparison->group[g].first].run, scene->render.cameras[k].name,
                                    &list);
            with += list.count > 0 && list.numbers[list.count - 1] == list.count;
            sb_stored_pictures_free(&list);
        }
        if (with == *groups) return scene->render.cameras[k].name;
    }
    return NULL;
}

sb_status sb_film_make(const sb_comparison *comparison, const char *folder, const char *name, sb_error *error)
{
    size_t groups;
    const char *camera = sb_film_camera(comparison, &groups);
    const sb_render_settings *render = &comparison->runs[0].run.scene.render;
    sb_video_part parts[SB_FILM_MAX];
    if (groups < 2) return sb_fail(error, SB_FAILED, "no film: all runs are of one scene");
    if (!camera)
        return sb_fail(error, SB_FAILED,
                       "no film: the runs have no complete series of pictures of one camera; "
                       "render.interval and a camera make them");
    for (size_t g = 0; g < groups; g++) {
        const sb_compared_run *run = &comparison->runs[comparison->group[g].first];
        /* Films of equal speed, whatever the intervals of their pictures. */
        parts[g] = (sb_video_part){run->path, render->video_rate * render->interval / run->run.scene.render.interval};
    }
    const int width = 2 * (WIDTH / 2 / (int)groups);
    const int height = 2 * (int)lround(0.5 * width * render->height / render->width);
    return sb_video_beside(parts, groups, camera, width, height, folder, name, error);
}
