/* Imports a text grid with all of its nodes. */
#include "base/memory.h"
#include "geometry/grid/tell.h"

/* Describes the file as the only layer of a terrain that has the same nodes. */
static sb_status tell(const sb_body *body, const sb_grid *grid, sb_mesh *made, sb_error *error)
{
    sb_layer layer = {
        .path = body->file,
        .about = {
            .columns = grid->columns, .rows = grid->rows, .x = grid->x, .y = grid->y, .dx = grid->dx, .dy = grid->dy}};
    layer.area = sb_layer_cells(&layer.about);
    const sb_terrain ground = {.count = 1, .layers = &layer, .grid = *grid, .voids = made->hole_count};
    return sb_terrain_tell(body, &ground, &made->told, error);
}

sb_status sb_mesh_import_grid(const sb_body *body, sb_mesh *mesh, sb_error *error)
{
    sb_grid grid = {0};
    sb_mesh made = {0};
    sb_status status = sb_grid_read_text(body->file, &grid, error);
    if (status == SB_OK) status = sb_grid_mesh(body->file, &grid, &made, error);
    if (status == SB_OK) status = tell(body, &grid, &made, error);
    sb_free(grid.heights);
    if (status == SB_OK)
        *mesh = made;
    else
        sb_mesh_free(&made);
    return status;
}
