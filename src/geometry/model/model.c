/* Builds a model from a scene, stage by stage. */
#include "base/stop.h"
#include "geometry/model/parts.h"

sb_status sb_model_build(const sb_scene *scene, sb_model *model, sb_error *error)
{
    return sb_model_build_for(scene, NULL, model, error);
}

sb_status sb_model_build_for(const sb_scene *scene, sb_model_need *need, sb_model *model, sb_error *error)
{
    return sb_model_build_part(scene, need, &(sb_model_team){.ranks = NULL}, model, error);
}

sb_status sb_model_failure(sb_status own, sb_error *error)
{
    if (own == SB_OK || !sb_stop_signal()) return own;
    return sb_stop_fail(error, "while the model was built: nothing is computed yet");
}

sb_status sb_model_build_part(const sb_scene *scene, sb_model_need *need, const sb_model_team *team, sb_model *model,
                              sb_error *error)
{
    const sb_fill_share share = {(size_t)sb_ranks_own(team->ranks), (size_t)sb_ranks_count(team->ranks)};
    const bool divides = sb_ranks_several(team->ranks) && sb_model_divides_walls(scene);
    sb_model made = {.dimensions = 0};
    sb_model_space space = {.count = 0};
    sb_status status = sb_model_import_bodies(scene, &made, error);
    if (status == SB_OK) status = sb_model_room(scene, &made, need, error);
    if (status == SB_OK) status = sb_model_space_create(&made, scene, &space, error);
    /* The sea comes first: if it escapes, the walls need not be sampled. */
    if (status == SB_OK) status = sb_model_fill(scene, &share, &space, &made, error);
    if (status == SB_OK) status = sb_model_know_water(&space, &made, error);
    if (status == SB_OK) status = sb_model_sea_sides(scene, &space, &made, error);
    if (divides)
        status = sb_model_sample_part(scene, team, &space, status, &made, error);
    else if (status == SB_OK)
        status = sb_model_sample(scene, &space, &made, error);
    if (status == SB_OK) status = sb_model_check_sides(scene, &space, &made, error);
    /* The ranks give each other what they have found, so that each must be there, whatever has failed. */
    status = sb_model_check(scene, divides ? team : NULL, &space, status, &made, error);
    if (status == SB_OK) status = sb_model_facets(scene, &space, &made, error);
    sb_model_space_free(&space);
    if (status != SB_OK) {
        sb_model_free(&made);
        return sb_model_failure(status, error);
    }
    *model = made;
    return SB_OK;
}
