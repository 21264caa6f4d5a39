#include "app/check/room.h"

#include "app/grid/picture.h"
#include "base/memory.h"
#include "geometry/grid/start.h"
#include "measure/measure.h"

#include <math.h>

/* Memory measured with tools/bench: of the program without particles and of its graphics library; per fluid particle,
   per neighbour of a fluid particle, and per ghost particle; of numerics.stress_memory and of surface tension. */
static const double IMPULSE_BYTES = 9 * 8 / 1024.0; /* per particle and body: nine sums per block of 1024 */
static const double PROGRAM_BYTES = 1e7, GRAPHICS_BYTES = 5e7, FLUID_BYTES = 166, PAIR_BYTES = 4.3, GHOST_BYTES = 90,
                    STEADY_BYTES = 24, TENSION_BYTES = 16;

/* Per pixel of a picture: two layers of water at 16 bytes, colour, depth, the pixels that are read back, their kinds,
   the depths of the bodies, and the rows that are written, plain and packed. Per node of the two grids in which
   pictures find the surface: nodes are 1.5 spacings apart, or farther where there would be too many; the arrays grow by
   doubling. Per cell of a map, without what finds standing water. */
static const double PIXEL_BYTES = 61, NODE_BYTES = 16, NODE_SPACINGS = 1.5, NODES_MAX = 2.5e7, MAP_CELL_BYTES = 48;

/* The part of FLUID_BYTES that is the model, and the model per boundary particle. */
static const double MODEL_FLUID_BYTES = 56, MODEL_WALL_BYTES = 48;

/* Per particle of a frame; the largest size and number of the frames that may wait; per particle of the stream's copy.
 */
static const double FRAME_BYTES = 32, DENSITY_ERROR_BYTES = 4, WAITING_BYTES = 256e6, STREAM_BYTES = 12;
enum { MOST_WAITING = 3 };

static int sharing = 1;

void sb_room_share(int ranks)
{
    sharing = ranks;
}

size_t sb_room_waiting(size_t fluid_count)
{
    const double fit = WAITING_BYTES / (FRAME_BYTES * (double)fluid_count + 1);
    return fit < 1 ? 1 : fit < MOST_WAITING ? (size_t)fit : MOST_WAITING;
}

size_t sb_room_graphics(void)
{
    return (size_t)GRAPHICS_BYTES;
}

double sb_room_ghosts(const sb_scene *scene, const sb_model *model)
{
    const double h = scene->numerics.support * scene->resolution;
    const sb_vec3 size = sb_sub(model->max, model->min);
    double all = 1;
    for (int axis = 0; axis < 2; axis++)
        if (sb_scene_repeats(scene, axis)) all *= 1 + 2 * h / (axis == 0 ? size.x : size.y);
    return (all - 1) * (double)model->fluid_count;
}

/* Neighbours of a fluid particle away from the water's boundaries. */
static double count_neighbours(const sb_scene *scene)
{
    const double s = scene->numerics.support, pi = 3.14159265358979;
    return scene->dimensions == 2 ? pi * s * s : 4 * pi / 3 * s * s * s;
}

/* Frames that exist at once: those in the queue, the one that is written or drawn, the one that waits for the queue.
   Pictures have frames of their own. */
static double count_frames(const sb_scene *scene, const sb_model *model)
{
    const bool others = scene->output.particle_interval > 0 || scene->stream.enabled;
    return ((double)sb_room_waiting(model->fluid_count) + 2) * (others + sb_scene_draws(scene));
}

static double count_nodes(const sb_scene *scene, const sb_model *model)
{
    const double cell = NODE_SPACINGS * scene->resolution;
    const sb_vec3 size = sb_sub(model->max, model->min);
    return fmin(NODES_MAX, (size.x / cell + 1) * (size.y / cell + 1) * (size.z / cell + 1));
}

static double picture_bytes(const sb_scene *scene, const sb_model *model)
{
    const sb_render_settings *settings = &scene->render;
    if (!sb_scene_draws(scene)) return 0;
    /* A still is drawn while the renderer of the film waits. */
    const double still = settings->still_count > 0 ? (double)settings->still_width * settings->still_height : 0;
    const double pixels = (double)settings->width * settings->height + still;
    return GRAPHICS_BYTES + PIXEL_BYTES * pixels + NODE_BYTES * count_nodes(scene, model) * (still > 0 ? 2 : 1);
}

/* Upper bound of the particles by which a picture shows the grid's water. */
static double count_drawn(const sb_scene *scene, const sb_model *model)
{
    const sb_offshore_settings *o = &scene->offshore;
    const double dr = scene->resolution, x = model->max.x - model->min.x, y = model->max.y - model->min.y;
    if (!sb_scene_nested(scene) || !sb_scene_draws(scene) || !(o->drawn > 0)) return 0;
    const double wide = fmin(o->x_max, model->max.x + o->drawn) - fmax(o->x_min, model->min.x - o->drawn);
    const double tall = fmin(o->y_max, model->max.y + o->drawn) - fmax(o->y_min, model->min.y - o->drawn);
    const double columns = scene->dimensions == 2 ? (wide - x) / dr : (wide * tall - x * y) / (dr * dr);
    return SB_GRID_PICTURE_LAYERS * fmax(columns, 0);
}

/* Foam: arrays that grow by doubling. */
static double foam_bytes(const sb_scene *scene)
{
    enum { PARTICLE = 48, WORDS = 16, MARK = 28 };
    return scene->foam.enabled ? 2 * (PARTICLE + WORDS + MARK) * (double)scene->foam.most : 0;
}

/* What foam needs in frames, pictures and the water. */
static double foam_bytes_beside(const sb_scene *scene, const sb_model *model)
{
    enum { FRAME = 33, FLUID = 20, PIXEL = 36 };
    if (!scene->foam.enabled) return 0;
    return PIXEL * (double)scene->render.width * scene->render.height +
           FRAME * (double)scene->foam.most * count_frames(scene, model) + FLUID * (double)model->fluid_count;
}

static double map_bytes(const sb_scene *scene)
{
    const sb_map *map = &scene->measure.map;
    if (!map->present) return 0;
    const double rows = scene->dimensions == 2 ? 1 : ceil((map->y_max - map->y_min) / map->cell);
    const double height = scene->domain.max.z - scene->domain.min.z;
    return (MAP_CELL_BYTES + sb_measure_cell_bytes(height, scene->resolution)) *
           ceil((map->x_max - map->x_min) / map->cell) * rows;
}

/* Of surface tension: per node of the grid around the water, two nodes per support radius. */
static double node_bytes(const sb_scene *scene, const sb_model *model)
{
    enum { EACH_NODE_BYTES = 88, MARGIN = 10 };
    sb_vec3 low, high;
    if (!(scene->fluid.surface_tension > 0) || !sb_model_extent(model, &low, &high)) return 0;
    const double width = 0.5 * scene->numerics.support * scene->resolution;
    const sb_vec3 size = sb_sub(high, low);
    const double across = scene->dimensions == 2 ? 1 : size.y / width + MARGIN;
    return EACH_NODE_BYTES * (size.x / width + MARGIN) * across * (size.z / width + MARGIN);
}

/* The model, in all ranks of this host. */
static double model_bytes(const sb_scene *scene, const sb_model *model)
{
    const double fluid = (double)model->fluid_count * MODEL_FLUID_BYTES;
    const double walls = (double)model->wall_count * MODEL_WALL_BYTES;
    return (sb_model_divides(scene) ? 1 : sharing) * fluid + (sb_model_divides_walls(scene) ? 1 : sharing) * walls;
}

/* What each rank of a run holds whole besides the model, however many there are. */
static double whole_bytes(const sb_scene *scene, const sb_model *model)
{
    return PROGRAM_BYTES + map_bytes(scene) + foam_bytes(scene) + node_bytes(scene, model) +
           (sb_scene_nested(scene) ? sb_grid_bytes(scene) : 0);
}

double sb_room_needed(const sb_scene *scene, const sb_model *model)
{
    const double frame = FRAME_BYTES + (sb_scene_shows_density_error(scene) ? DENSITY_ERROR_BYTES : 0);
    const bool steady = scene->numerics.stress_correction > 0 && scene->numerics.stress_memory > 0;
    const bool tense = scene->fluid.surface_tension > 0 && model->fluid_position;
    const double fluid = FLUID_BYTES - MODEL_FLUID_BYTES + (tense ? TENSION_BYTES : 0) + (steady ? STEADY_BYTES : 0) +
                         PAIR_BYTES * count_neighbours(scene) + frame * count_frames(scene, model) +
                         (scene->stream.enabled ? STREAM_BYTES : 0);
    return model_bytes(scene, model) + sharing * whole_bytes(scene, model) + picture_bytes(scene, model) +
           foam_bytes_beside(scene, model) +
           (double)model->fluid_count * (fluid + IMPULSE_BYTES * (double)model->body_count) +
           sb_room_ghosts(scene, model) * GHOST_BYTES + FRAME_BYTES * count_drawn(scene, model) * (MOST_WAITING + 3);
}

sb_status sb_room_check(const sb_scene *scene, const sb_model *model, sb_error *error)
{
    const double needed = sb_room_needed(scene, model), there = (double)sb_memory_available();
    const double held = model_bytes(scene, model);
    if (!(there > 0) || needed <= (1 - SB_MEMORY_SPARE) * (held + there)) return SB_OK;
    return sb_fail(error, SB_FAILED,
                   "needs about %.3g GB of memory for %zu fluid and %zu boundary particles, and %.3g GB are available, "
                   "of which a fifth is left free: expected a coarser resolution%s",
                   needed / 1e9, model->fluid_count, model->wall_count, (held + there) / 1e9,
                   sharing > 1 ? " or fewer ranks" : "");
}
