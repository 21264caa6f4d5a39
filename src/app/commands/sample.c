#include "app/check/team.h"
#include "app/commands/commands.h"
#include "app/grid/water.h"
#include "app/options.h"
#include "base/file.h"
#include "base/memory.h"
#include "geometry/model/model.h"
#include "output/particles/vtp.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

static const char help[] =
    "usage: shorebreak sample SCENE --out FILE.vtp [--preset NAME] [--set KEY=VALUE]... [--threads N]\n"
    "Writes the boundary particles (body >= 0) and fluid particles (body -1) from which a run would start.\n"
    "Boundary particles lie numerics.wall_offset spacings behind the physical surfaces; with\n"
    "--set numerics.wall_offset=0 they lie on the surfaces.\n";

static sb_status write_model(const sb_model *model, const char *path, sb_error *error)
{
    size_t count = model->wall_count + model->fluid_count;
    sb_vec3 *positions = sb_alloc(count, sizeof *positions), *normals = sb_alloc(count, sizeof *normals);
    int32_t *bodies = sb_alloc(count, sizeof *bodies);
    sb_status status = SB_OK;
    if (!positions || !normals || !bodies) {
        status = sb_fail_memory(error, "the sample");
        goto done;
    }
    for (size_t b = 0; b < model->body_count; b++)
        for (size_t i = model->bodies[b].begin; i < model->bodies[b].begin + model->bodies[b].count; i++) {
            positions[i] = model->wall_position[i];
            normals[i] = model->wall_normal[i];
            bodies[i] = (int32_t)b;
        }
    for (size_t i = 0; i < model->fluid_count; i++) {
        positions[model->wall_count + i] = model->fluid_position[i];
        bodies[model->wall_count + i] = -1;
    }
    status = sb_vtp_write_points(path, count, positions, normals, bodies, error);
done:
    sb_free(positions);
    sb_free(normals);
    sb_free(bodies);
    return status;
}

/* Refuses an output path that would overwrite the scene or cannot be written, before the sampling starts. */
static sb_status check_output_path(const char *scene, const char *out, sb_error *error)
{
    struct stat from, to;
    sb_error reason = {0};
    if (sb_file_replaceable(out, &reason) != SB_OK) return sb_fail(error, SB_BAD_INPUT, "--out %s", reason.text);
    if (stat(scene, &from) != 0 || stat(out, &to) != 0 || from.st_dev != to.st_dev || from.st_ino != to.st_ino)
        return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "--out %.500s: is the scene file, expected another file", out);
}

static void warn(void *context, const char *text)
{
    (void)context;
    fprintf(stderr, "shorebreak: warning: %s\n", text);
}

int sb_command_sample(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_scene scene = {0};
    sb_model model = {0};
    sb_status status = sb_options_parse(count, arguments, SB_OPT_OUT | SB_OPT_PRESET | SB_OPT_SET | SB_OPT_THREADS,
                                        "scene", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK && !options.out) status = sb_fail(&error, SB_BAD_INPUT, "sample: no --out FILE.vtp given");
    if (status == SB_OK) status = sb_options_scene(&options, options.positional, &scene, &error);
    if (status == SB_OK) sb_team_warnings(warn, NULL);
    if (status == SB_OK) status = check_output_path(options.positional, options.out, &error);
    if (status == SB_OK) status = sb_grid_refuse(&scene, "sample", &error);
    if (status == SB_OK) status = sb_model_build(&scene, &model, &error);
    if (status == SB_OK) status = write_model(&model, options.out, &error);
    if (status == SB_OK)
        printf("%zu boundary and %zu fluid particles in %s\n", model.wall_count, model.fluid_count, options.out);
    else
        fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_model_free(&model);
    sb_scene_free(&scene);
    sb_options_free(&options);
    return (int)status;
}
