#include "app/grid/frame.h"

#include "app/run/parts.h"
#include "base/file.h"
#include "base/memory.h"
#include "output/maps/vti.h"
#include "output/particles/pvd.h"

#include <math.h>
#include <stdio.h>

enum { FRAME_VALUES = 6 }; /* bed, depth, surface, three components of velocity */

static void fill_frame(const sb_offshore_view *v, float *values)
{
    const size_t cells = v->columns * v->rows;
    float *bed = values, *depth = values + cells, *surface = values + 2 * cells, *velocity = values + 3 * cells;
    for (size_t j = 0; j < v->rows; j++)
        for (size_t i = 0; i < v->columns; i++) {
            const size_t from = j * v->stride + i, to = j * v->columns + i;
            const double h = v->h[from];
            const bool wet = h > v->dry_depth;
            bed[to] = (float)v->bed[from];
            depth[to] = (float)h;
            surface[to] = wet ? (float)(v->bed[from] + h) : NAN;
            velocity[3 * to] = wet ? (float)(v->hu[from] / h) : 0;
            velocity[3 * to + 1] = wet ? (float)(v->hv[from] / h) : 0;
        }
}

/* Names of the files are their numbers. */
static sb_status add_name(sb_particle_list *frames, double time, sb_error *error)
{
    char name[64];
    const int length = snprintf(name, sizeof name, SB_VTI_FOLDER "/%06zu.vti", frames->count + 1);
    return sb_particle_list_add(frames, time, name, (size_t)length, error);
}

sb_status sb_grid_frame_write(const char *directory, const sb_offshore *water, sb_particle_list *frames,
                              sb_error *error)
{
    const sb_offshore_view v = sb_offshore_read(water);
    const size_t cells = v.columns * v.rows;
    float *values = sb_alloc(FRAME_VALUES * cells, sizeof *values);
    if (!values) return sb_fail_memory(error, "a file for ParaView");
    fill_frame(&v, values);
    const sb_vti_array arrays[] = {{"bed", 1, values},
                                   {"depth", 1, values + cells},
                                   {"surface", 1, values + 2 * cells},
                                   {"velocity", 3, values + 3 * cells}};
    const sb_vti image = {v.time, v.columns, v.rows, v.x, v.y, v.cell, sizeof arrays / sizeof *arrays, arrays};
    char name[64], path[SB_PATH_MAX];
    snprintf(name, sizeof name, SB_VTI_FOLDER "/%06zu.vti", frames->count + 1);
    sb_status status = sb_make_folder(path, directory, SB_VTI_FOLDER, error);
    if (status == SB_OK) status = sb_path_join(path, directory, name, error);
    if (status == SB_OK) status = sb_vti_write(path, &image, error);
    if (status == SB_OK) status = add_name(frames, v.time, error);
    if (status == SB_OK) status = sb_path_join(path, directory, SB_VTI_LIST ".pvd", error);
    if (status == SB_OK) status = sb_pvd_write(path, frames, error);
    sb_free(values);
    return status;
}

sb_status sb_grid_frame_of_run(run *r, sb_error *error)
{
    const sb_offshore *water = sb_sim_grid(r->sim);
    const double interval = r->scene->output.particle_interval, time = sb_sim_report(r->sim)->time;
    if (!water || !(interval > 0) || time < (double)r->grid_frames.count * interval * (1 - 1e-12)) return SB_OK;
    return sb_grid_frame_write(r->directory, water, &r->grid_frames, error);
}

void sb_grid_frames_save(const run *r, sb_archive_out *out)
{
    if (!sb_sim_grid(r->sim)) return;
    sb_put_count(out, r->grid_frames.count);
    for (size_t i = 0; i < r->grid_frames.count; i++) sb_put_real(out, r->grid_frames.entries[i].time);
}

sb_status sb_grid_frames_load(run *r, sb_archive_in *in, sb_error *error)
{
    if (!sb_sim_grid(r->sim)) return SB_OK;
    const uint64_t count = sb_take_count(in, UINT32_MAX);
    sb_status status = SB_OK;
    sb_particle_list_free(&r->grid_frames);
    while (status == SB_OK && r->grid_frames.count < count && in->error.status == SB_OK)
        status = add_name(&r->grid_frames, sb_take_real(in), error);
    return status;
}
