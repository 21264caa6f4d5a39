#include "base/memory.h"
#include "sim/sea/strip.h"

#include <math.h>

static double level_of(const sb_sim *sim, const sb_strip_side *s, double inwards, double along)
{
    sb_given at;
    sb_strip_given(sim, s, 0, inwards, along, sim->scene->sea.level, &at);
    return at.surface;
}

/* Rows of particles in a column of water at rest. */
static void count_rows(const sb_sim *sim, sb_strip_side *s)
{
    const double dr = sim->scene->resolution;
    const sb_model_sea *ground = &sim->model->sea[s->side];
    for (size_t c = 0; c < s->columns; c++) {
        const double along = ((double)c + 0.5) * ground->pitch, bed = sb_strip_bed(sim, s, 0, along);
        const double depth = fmin(level_of(sim, s, 0, along), sim->model->max.z) - bed;
        s->still_rows[c] = s->row_count[c] = depth > 0.5 * dr ? (int)fmax(round(depth / dr), 1) : 0;
    }
}

static int create_side(const sb_sim *sim, int side, sb_strip_side *s)
{
    const sb_model *model = sim->model;
    const sb_model_sea *ground = &model->sea[side];
    const double quantum = sim->space.quantum, dr = sim->scene->resolution;
    const sb_record first = sb_space_record(&sim->space, model->min), last = sb_space_record(&sim->space, model->max);
    const double length = ground->pitch * (double)ground->along;
    *s = (sb_strip_side){.side = side, .axis = side / 2, .other = 1 - side / 2, .strip = ground->strip};
    s->edge = (side % 2 ? last : first)[side / 2];
    s->width = (int64_t)nearbyint(ground->strip / quantum);
    const double low = model->sea[2 * s->other].strip, high = model->sea[2 * s->other + 1].strip;
    const double free = model->dimensions == 2 ? dr : fmax(length - low - high, dr);
    /* The outgoing wave is measured at places one width of the strip apart. */
    s->stations = model->dimensions == 2 ? 1 : (size_t)fmax(round(free / ground->strip), 1);
    s->station_from = low;
    s->station_pitch = free / (double)s->stations;
    s->columns = ground->along;
    s->rows = (size_t)ceil((model->max.z - model->min.z) / dr) + 1;
    s->station = sb_alloc(s->stations, sizeof *s->station);
    s->sums = sb_alloc(s->stations * SB_STATION_SUMS, sizeof *s->sums);
    s->row_count = sb_alloc(s->columns, sizeof *s->row_count);
    s->still_rows = sb_alloc(s->columns, sizeof *s->still_rows);
    s->owed = sb_alloc(s->columns * s->rows, sizeof *s->owed);
    s->correction = sb_alloc(s->columns * s->rows, sizeof *s->correction);
    s->left = sb_alloc(s->columns * s->rows, sizeof *s->left);
    if (!s->station || !s->sums || !s->row_count || !s->still_rows || !s->owed || !s->correction || !s->left) return -1;
    for (size_t k = 0; k < s->columns * s->rows; k++) s->correction[k] = NAN;
    count_rows(sim, s);
    return 0;
}

sb_status sb_strip_create(sb_sim *sim, sb_error *error)
{
    if (!sim->needs.sea) return SB_OK;
    sim->strip = sb_alloc(1, sizeof *sim->strip);
    if (!sim->strip) return sb_fail_memory(error, "strips of given water");
    sim->strip->still = sb_model_start_speed(sim->model) == 0;
    const sb_status status = sb_sea_create(sim->scene, &sim->model->grid, &sim->strip->sea, error);
    for (int side = 0; side < 4 && status == SB_OK; side++) {
        if (!sb_scene_sea_side(sim->scene, side)) continue;
        sb_strip_side *made = &sim->strip->side[sim->strip->count++];
        if (create_side(sim, side, made) != 0) return sb_fail_memory(error, "strips of given water");
        made->far = sb_strip_to_line(sim, made);
    }
    return status;
}

void sb_strip_destroy(sb_sim *sim)
{
    if (!sim->strip) return;
    for (size_t k = 0; k < sim->strip->count; k++) {
        const sb_strip_side *s = &sim->strip->side[k];
        sb_free(s->station);
        sb_free(s->sums);
        sb_free(s->row_count);
        sb_free(s->still_rows);
        sb_free(s->owed);
        sb_free(s->correction);
        sb_free(s->left);
    }
    sb_sea_destroy(sim->strip->sea);
    sb_free(sim->strip->held);
    sb_free(sim->strip->jumps);
    sb_free(sim->strip);
    sim->strip = NULL;
}

size_t sb_strip_bytes(const sb_sim *sim)
{
    if (!sim->strip) return 0;
    const sb_offshore *grid = sb_sea_grid(sim->strip->sea);
    size_t bytes = sizeof *sim->strip + sim->strip->held_capacity * sizeof *sim->strip->held +
                   sim->strip->jump_capacity * sizeof *sim->strip->jumps;
    for (size_t k = 0; k < sim->strip->count; k++) {
        const sb_strip_side *s = &sim->strip->side[k];
        bytes += s->stations * (sizeof *s->station + SB_STATION_SUMS * sizeof *s->sums) +
                 s->columns * (2 * sizeof(int) + s->rows * (sizeof *s->owed + sizeof *s->correction + sizeof *s->left));
    }
    if (!grid) return bytes;
    const sb_offshore_view v = sb_offshore_read(grid);
    return bytes + sb_offshore_held(grid) +
           (sb_sea_maps(sim->strip->sea) ? sb_offshore_maps_bytes(v.columns * v.rows) : 0);
}

const sb_strip_side *sb_strip_side_of(const sb_strip *strip, sb_record at)
{
    const sb_strip_side *found = NULL;
    int64_t nearest = INT64_MAX;
    for (size_t k = 0; k < strip->count; k++) {
        const int64_t inwards = sb_strip_inwards(&strip->side[k], at);
        if (inwards >= strip->side[k].width || inwards >= nearest) continue;
        found = &strip->side[k];
        nearest = inwards;
    }
    return found;
}

double sb_strip_along(const sb_sim *sim, const sb_strip_side *s, sb_record at)
{
    if (sim->constant.dimension == 2) return 0;
    return (double)((int64_t)at[s->other] - (int64_t)sb_space_low(&sim->space)) * sim->space.quantum;
}

size_t sb_strip_column(const sb_sim *sim, const sb_strip_side *s, double along)
{
    const double column = floor(along / sim->model->sea[s->side].pitch);
    return (size_t)fmin(fmax(column, 0), (double)(s->columns - 1));
}

size_t sb_strip_row(double z, double bed, double surface, int rows)
{
    const double row = floor((z - bed) / fmax(surface - bed, 1e-9) * rows);
    return (size_t)fmin(fmax(row, 0), rows - 1);
}
