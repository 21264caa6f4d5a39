#include "app/check/fit.h"
#include "app/check/team.h"
#include "app/commands/commands.h"
#include "app/commands/preview_marks.h"
#include "app/grid/water.h"
#include "app/options.h"
#include "base/file.h"
#include "base/memory.h"
#include "frame/frame.h"
#include "render/bodies/samples.h"
#include "render/camera/cameras.h"
#include "render/overlay/font.h"
#include "render/overlay/paint.h"
#include "render/renderer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

static const char help[] =
    "usage: shorebreak preview SCENE [-o FILE.png] [--preset NAME] [--set KEY=VALUE]... [--threads N]\n"
    "Draws the set-up of a scene without settling its water or running it: from above, from the side, the boundary\n"
    "particles coloured by how densely they lie, and the view of each camera at t = 0, in one picture. Bodies, wave\n"
    "makers, gauges, probes, planes and run-up lines have their names.\n\n"
    "  -o, --out FILE.png  the picture (default: preview.png)\n";

enum { TILE_WIDTH = 1200, TILE_HEIGHT = 675, COLUMNS = 2, CAMERAS_MAX = 17 };
/* More names than this are too many for one view: bodies and places of measurements have views of their own. */
enum { NAMES_MAX = 24, ALL = SB_MARK_BODIES | SB_MARK_PLACES };
static const double ASPECT = (double)TILE_WIDTH / TILE_HEIGHT;

/* What the tiles of the picture share. */
typedef struct preview {
    const sb_scene *scene;
    sb_poses poses; /* with the size and the title of a tile; the last camera is for views of no camera */
    const sb_model *model;
    sb_frame *frame;
    sb_renderer *renderer;
    sb_image sheet, tile;
    size_t tiles;
} preview;

/* The water as a run would begin, before it settles. */
static sb_frame *make_frame(const sb_scene *scene, const sb_model *model)
{
    sb_frame *frame = sb_frame_create(model->fluid_count, model->body_count);
    if (!frame) return NULL;
    frame->origin = model->min;
    frame->spacing = scene->resolution;
    frame->status.duration = scene->duration;
    for (size_t i = 0; i < model->fluid_count; i++) {
        const sb_vec3 at = sb_sub(model->fluid_position[i], model->min);
        const sb_vec3 v = model->fluid_velocity ? model->fluid_velocity[i] : sb_vec(0, 0, 0);
        const double place[3] = {at.x, at.y, at.z}, speed[3] = {v.x, v.y, v.z};
        for (size_t axis = 0; axis < 3; axis++) {
            frame->position[3 * i + axis] = (float)place[axis];
            frame->velocity[3 * i + axis] = (float)speed[axis];
        }
        frame->pressure[i] = (float)model->fluid_pressure[i];
        frame->id[i] = (uint32_t)i;
    }
    for (size_t b = 0; b < model->body_count; b++)
        snprintf(frame->bodies[b].name, sizeof frame->bodies[b].name, "%s", model->bodies[b].name);
    return frame;
}

/* Copies the tile to the next place of the picture. */
static void place_tile(preview *p)
{
    const size_t row = p->tiles / COLUMNS, column = p->tiles % COLUMNS, width = (size_t)p->sheet.width;
    for (size_t y = 0; y < TILE_HEIGHT; y++)
        memcpy(p->sheet.rgb + 3 * ((row * TILE_HEIGHT + y) * width + column * TILE_WIDTH),
               p->tile.rgb + 3 * y * TILE_WIDTH, 3 * (size_t)TILE_WIDTH);
    p->tiles++;
}

static sb_status write_note(preview *p, const char *text, double y, double letters, sb_error *error)
{
    static const float ink[3] = {0.97f, 0.98f, 0.99f};
    const double room = TILE_WIDTH - 56, wide = sb_font_width(text, letters);
    return sb_font_draw(&p->tile, 28, y, wide > room ? letters * room / wide : letters, ink, text, error);
}

static sb_view make_view(const preview *p, const sb_camera_key *key)
{
    return sb_view_create(key, ASPECT, p->model->min, p->model->max);
}

/* camera: whose look the view has; the number of the scene's cameras: that of a new camera. */
static sb_status draw_view(preview *p, const char *title, size_t camera, const sb_camera_key *key, unsigned marks,
                           sb_error *error)
{
    size_t left_out = 0;
    char note[64], copy[200];
    const sb_view view = make_view(p, key);
    snprintf(copy, sizeof copy, "%s", title);
    p->poses.scene.title = copy; /* the renderer draws it */
    p->poses.keys[camera] = *key;
    sb_status status = sb_renderer_draw(p->renderer, p->frame, camera, &p->tile, error);
    p->poses.scene.title = NULL;
    if (status == SB_OK) status = sb_preview_marks(p->scene, p->model, marks, &view, &p->tile, &left_out, error);
    snprintf(note, sizeof note, "%zu names are left out: there is no room", left_out);
    if (status == SB_OK && left_out > 0) status = write_note(p, note, TILE_HEIGHT - 16, 10, error);
    if (status == SB_OK) place_tile(p);
    return status;
}

static sb_status draw_sampling(preview *p, const sb_camera_key *key, sb_error *error)
{
    char title[100];
    const sb_view view = make_view(p, key);
    float *density = sb_alloc(p->model->wall_count, sizeof *density);
    if (!density) return sb_fail_memory(error, "the density of boundary particles");
    snprintf(title, sizeof title, "boundary particles: %zu", p->model->wall_count);
    const bool images = p->scene->numerics.walls == SB_WALLS_IMAGES;
    if (images)
        snprintf(title, sizeof title, "walls that reflect water: %zu facets, lines are their edges",
                 p->model->facets.count);
    sb_status status =
        sb_samples_density(p->model, p->scene->numerics.wall_spacing * p->scene->resolution, density, error);
    if (status == SB_OK) status = sb_samples_draw(p->model, density, &view, &p->tile, error);
    sb_free(density);
    if (status != SB_OK) return status;
    if (images) sb_preview_facets(p->model, &view, &p->tile);
    status = write_note(p, title, 41, 16, error);
    if (status == SB_OK) place_tile(p);
    return status;
}

static sb_status draw_cameras(preview *p, size_t count, unsigned marks, sb_error *error)
{
    sb_status status = SB_OK;
    for (size_t c = 0; c < count && status == SB_OK; c++) {
        char title[2 * SB_NAME_MAX];
        sb_camera_motion motion = {0};
        const sb_camera_key key = sb_cameras_at(p->scene, p->model, c, p->frame, ASPECT, &motion);
        snprintf(title, sizeof title, "camera %s at t = 0", p->scene->render.cameras[c].name);
        status = draw_view(p, title, c, &key, marks, error);
    }
    return status;
}

static bool is_crowded(const preview *p)
{
    const sb_measure_settings *measure = &p->scene->measure;
    return p->model->body_count + measure->gauge_count + measure->probe_count + measure->plane_count +
               measure->runup_count >
           NAMES_MAX;
}

static sb_status draw_tiles(preview *p, size_t cameras, sb_error *error)
{
    const bool flat = p->model->dimensions == 2;
    const sb_vec3 low = p->model->min, high = p->model->max;
    const sb_camera_key above = sb_cameras_fit(low, high, sb_vec(0, 0, 1), 20, ASPECT, 1.12);
    const sb_camera_key side = sb_cameras_fit(low, high, sb_vec(0, -1, flat ? 0 : 0.12), 20, ASPECT, 1.12);
    const sb_camera_key corner = sb_cameras_fit(low, high, sb_vec(-0.5, -0.8, 0.6), 35, ASPECT, 1.12);
    const bool crowded = is_crowded(p);
    const size_t other = p->scene->render.camera_count;
    char title[200];
    snprintf(title, sizeof title, "%s: %zu fluid particles, %g m apart", flat ? "from the side" : "from above",
             p->model->fluid_count, p->scene->resolution);
    const sb_camera_key *plan = flat ? &side : &above;
    sb_status status = draw_view(p, title, other, plan, crowded ? SB_MARK_BODIES : ALL, error);
    if (status == SB_OK && crowded) status = draw_view(p, "places of measurements", other, plan, SB_MARK_PLACES, error);
    if (status == SB_OK && !flat) status = draw_view(p, "from the side", other, &side, crowded ? 0 : ALL, error);
    if (status == SB_OK) status = draw_sampling(p, flat ? &side : &corner, error);
    if (status == SB_OK && !flat)
        status =
            draw_view(p, "from the corner of small x and y", other, &corner, crowded ? SB_MARK_BODIES : ALL, error);
    return status == SB_OK ? draw_cameras(p, cameras, crowded ? SB_MARK_BODIES : ALL, error) : status;
}

static sb_status draw(const sb_scene *scene, const sb_model *model, const char *path, size_t *tiles, sb_error *error)
{
    preview p = {.scene = scene, .model = model};
    size_t cameras = scene->render.camera_count;
    cameras = cameras < CAMERAS_MAX ? cameras : CAMERAS_MAX;
    const size_t count = cameras + (scene->dimensions == 2 ? 2 : 4) + is_crowded(&p);
    const int rows = (int)((count + COLUMNS - 1) / COLUMNS);
    sb_status status = sb_cameras_check(scene, model, error);
    if (status == SB_OK) status = sb_poses_create(&p.poses, scene, 1, error);
    p.poses.scene.render.width = TILE_WIDTH;
    p.poses.scene.render.height = TILE_HEIGHT;
    if (status == SB_OK) p.frame = make_frame(scene, model);
    if (status == SB_OK && !p.frame) status = sb_fail_memory(error, "the water");
    if (status == SB_OK) status = sb_image_resize(&p.sheet, COLUMNS * TILE_WIDTH, rows * TILE_HEIGHT, error);
    if (status == SB_OK) status = sb_image_resize(&p.tile, TILE_WIDTH, TILE_HEIGHT, error);
    if (status == SB_OK) {
        memset(p.sheet.rgb, 0x30, 3 * (size_t)p.sheet.width * (size_t)p.sheet.height);
        status = sb_renderer_create(&p.poses.scene, model, &p.renderer, error);
    }
    if (status == SB_OK) status = draw_tiles(&p, cameras, error);
    if (status == SB_OK) status = sb_png_write(path, &p.sheet, error);
    *tiles = p.tiles;
    sb_renderer_destroy(p.renderer);
    sb_poses_free(&p.poses);
    sb_frame_release(p.frame);
    sb_image_free(&p.sheet);
    sb_image_free(&p.tile);
    return status;
}

/* Refuses a path at which there is something else than an earlier picture, before the sampling starts. */
static sb_status check_path(const char *path, sb_error *error)
{
    struct stat found;
    char start[SB_PNG_MARK_WITHIN];
    sb_error reason = {0};
    const size_t length = strlen(path);
    if (length < 4 || strcasecmp(path + length - 4, ".png") != 0)
        return sb_fail(error, SB_BAD_INPUT, "--out %.500s: the picture is a PNG; expected a name that ends in .png",
                       path);
    if (sb_file_replaceable(path, &reason) != SB_OK) return sb_fail(error, SB_BAD_INPUT, "--out %s", reason.text);
    if (stat(path, &found) != 0 || sb_png_is_own(start, sb_file_start(path, start, sizeof start))) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.500s: was not written by shorebreak; name another file with -o", path);
}

static void warn(void *context, const char *text)
{
    (void)context;
    fprintf(stderr, "shorebreak: warning: %s\n", text);
}

static sb_status preview_scene(const sb_options *options, sb_error *error)
{
    const char *path = options->out ? options->out : "preview.png";
    sb_scene scene = {0};
    sb_model model = {0};
    size_t tiles = 0;
    sb_status status = check_path(path, error);
    if (status == SB_OK) status = sb_options_scene(options, options->positional, &scene, error);
    if (status == SB_OK) sb_team_warnings(warn, NULL);
    if (status == SB_OK) status = sb_grid_refuse(&scene, "preview", error);
    if (status == SB_OK) status = sb_fit_check(&scene, error);
    if (status == SB_OK) status = sb_model_build(&scene, &model, error);
    for (size_t w = 0; w < model.warning_count; w++) warn(NULL, model.warnings[w]);
    if (status == SB_OK) scene.render.speed_max = sb_model_speed_scale(&scene, &model);
    if (status == SB_OK) status = draw(&scene, &model, path, &tiles, error);
    if (status == SB_OK && scene.render.camera_count > CAMERAS_MAX)
        fprintf(stderr, "shorebreak: warning: %zu cameras, of which the first %d are drawn\n",
                scene.render.camera_count, CAMERAS_MAX);
    if (status == SB_OK) printf("%zu views in %s\n", tiles, path);
    sb_model_free(&model);
    sb_scene_free(&scene);
    return status;
}

int sb_command_preview(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_status status =
        sb_options_parse(count, arguments, SB_OPT_OUT | SB_OPT_SHORT_OUT | SB_OPT_PRESET | SB_OPT_SET | SB_OPT_THREADS,
                         "scene", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = preview_scene(&options, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_options_free(&options);
    return (int)status;
}
