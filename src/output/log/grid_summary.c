#include "output/log/grid_summary.h"

#include "scene/scene.h"

void sb_grid_volume_put(sb_json *json, const sb_grid_volume *volume, bool beside)
{
    sb_json_open(json, "volume", '{');
    sb_json_number(json, "start_m3", volume->first);
    sb_json_number(json, "end_m3", volume->now);
    sb_json_open(json, "entered_m3", '{');
    for (int s = 0; s < SB_GRID_SIDES; s++) sb_json_number(json, sb_side_names[s], volume->entered[s]);
    sb_json_close(json);
    if (beside) sb_json_number(json, "from_particles_m3", volume->added);
    sb_json_number(json, "repaired_m3", volume->repaired);
    sb_json_number(json, "imbalance_m3", volume->imbalance);
    sb_json_close(json);
}

void sb_grid_beside_put(sb_json *json, const sb_grid_facts_beside *grid)
{
    sb_json_open(json, "grid", '{');
    sb_json_number(json, "cell_m", grid->cell);
    sb_json_count(json, "columns", grid->columns);
    sb_json_count(json, "rows", grid->rows);
    sb_json_count(json, "steps", grid->steps);
    sb_grid_volume_put(json, &grid->volume, true);
    sb_json_close(json);
}
