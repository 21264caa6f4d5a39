/* Where the cameras of a scene are at the time of a frame: on their path or circle, beside the crest, close to a body.
 */
#ifndef SB_RENDER_CAMERAS_H
#define SB_RENDER_CAMERAS_H

#include "frame/frame.h"
#include "geometry/model/model.h"
#include "scene/scene.h"

/* The motion of a camera that follows the water. A zeroed struct has not begun: the next frame places it at its aim. */
typedef struct sb_camera_motion {
    bool begun;
    double time;         /* s, of the last frame */
    double place, speed; /* m along the line from its first end, and m/s */
} sb_camera_motion;

/* Refuses a camera whose body the model does not have: SB_BAD_INPUT. Call it once the names of split meshes are known.
 */
sb_status sb_cameras_check(const sb_scene *scene, const sb_model *model, sb_error *error);

/* Returns where a camera of the scene is at the frame's time. aspect: width over height of the picture. Of the model
   only meshes and names are read. motion: of this camera, changed if it follows; the frames must be in the order of
   their times. The result depends on the frames alone, and is the same for any number of threads. */
sb_camera_key sb_cameras_at(const sb_scene *scene, const sb_model *model, size_t camera, const sb_frame *frame,
                            double aspect, sb_camera_motion *motion);

/* A copy of a scene for a renderer, whose cameras stand where their keys are put before each picture: a renderer knows
   cameras with keys only. A zeroed struct is empty. It must not be moved while a renderer uses it. */
typedef struct sb_poses {
    sb_scene scene;      /* shallow, but for its cameras */
    sb_camera_key *keys; /* of its cameras */
} sb_poses;

/* Makes the copy with the scene's cameras and `more` cameras named "view" after them. */
sb_status sb_poses_create(sb_poses *poses, const sb_scene *scene, size_t more, sb_error *error);
void sb_poses_free(sb_poses *poses);

/* Returns a camera in this direction from the middle of a box, `margin` times as far away as the box just fits into a
   picture of this shape. */
sb_camera_key sb_cameras_fit(sb_vec3 low, sb_vec3 high, sb_vec3 direction, double fov, double aspect, double margin);

/* Finds the crest: the distance (m) along the line at which the water is highest. The line is cut into columns of two
   spacings; the level of a column is the height above which it has half a layer of particles, so that spray does not
   count. False: no level is more than a spacing above the median of those of all columns with water. */
bool sb_cameras_crest(const sb_follow *follow, const sb_frame *frame, int dimensions, double *place);

#endif
