#include "app/check/team.h"
#include "app/checkpoint/lock.h"
#include "app/commands/commands.h"
#include "app/commands/times.h"
#include "app/options.h"
#include "app/run/files.h"
#include "base/clock.h"
#include "base/memory.h"
#include "base/nearest.h"
#include "base/stop.h"
#include "output/log/progress.h"
#include "output/particles/particle_format.h"
#include "output/particles/pvd.h"
#include "surface/make.h"
#include "surface/mesh_format.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char help[] =
    "usage: shorebreak surface RUN_DIR [--out DIR] [--format ply|vtp] [--times LIST] [--cell X] [--smooth N]\n"
    "                          [--threads N] [--overwrite] [--quiet]\n"
    "Writes the surface of the water of each particle file of a run (output.particle_interval) as a closed mesh of\n"
    "triangles, with the water's velocity (m/s) and pressure (Pa) at its vertices. Meshes that an earlier call "
    "completed\n"
    "with the same options are kept, so that a stopped call can be repeated.\n\n"
    "  --out DIR        folder of the meshes (default: RUN_DIR/surface)\n"
    "  --format ply     PLY, for Blender (default)\n"
    "  --format vtp     VTK PolyData, with the list surface.pvd, for ParaView\n"
    "  --times LIST     only the particle files at these times in s, e.g. 30,45.5 or ranges 30:60 (default: all)\n"
    "  --cell X         edge of the cells of the background grid in particle spacings, 0.25 to 1 (default: 0.5)\n"
    "  --smooth N       rounds of smoothing, 0 to 1000 (default: 10)\n"
    "  --threads N      threads; any number gives the same files (default: one per core)\n"
    "  --overwrite      make all meshes again, also those with other options\n"
    "  --quiet          print no progress\n";

enum { MADE_MAX = 200, PATHS = SB_PATH_MAX };

typedef struct job {
    const sb_options *options;
    char directory[PATHS];
    const sb_mesh_format *mesh;
    const sb_particle_format *particles;
    sb_particle_list list;
    bool *chosen; /* entries of the list that are still to be made */
    size_t kept, todo;
    int lock;
} job;

static sb_status choose_format(const char *name, const sb_mesh_format **format, sb_error *error)
{
    sb_nearest nearest = sb_nearest_to(name ? name : "");
    *format = sb_mesh_formats[0];
    for (size_t f = 0; name && sb_mesh_formats[f]; f++) {
        if (strcmp(sb_mesh_formats[f]->name, name) == 0) {
            *format = sb_mesh_formats[f];
            return SB_OK;
        }
        sb_nearest_try(&nearest, sb_mesh_formats[f]->name);
    }
    return !name ? SB_OK
                 : sb_fail(error, SB_BAD_INPUT, "--format %.100s: expected ply or vtp%s%s%s", name,
                           nearest.found ? "; did you mean " : "", nearest.found ? nearest.found : "",
                           nearest.found ? "?" : "");
}

/* How the mesh of an entry is made; the first line of its file. */
static void describe(const job *j, size_t entry, char made[MADE_MAX])
{
    snprintf(made, MADE_MAX, SB_MESH_MADE ", " SB_MESH_METHOD ", time %.9g s, cell %g, smooth %d",
             j->list.entries[entry].time, j->options->cell, j->options->smooth);
}

/* The mesh's path: the number of the particle file and the format's ending. */
static sb_status path_of(const job *j, size_t entry, char path[PATHS], sb_error *error)
{
    char name[300];
    const char *file = j->list.entries[entry].file, *slash = strrchr(file, '/');
    file = slash ? slash + 1 : file;
    snprintf(name, sizeof name, "%.*s%s", (int)strcspn(file, "."), file, j->mesh->ending);
    return sb_path_join(path, j->directory, name, error);
}

/* A particle file that is newer than its mesh belongs to a later run. */
static bool is_newer(const job *j, size_t entry, const char *mesh)
{
    char path[PATHS];
    struct stat particles, there;
    return sb_path_join(path, j->options->positional, j->list.entries[entry].file, NULL) != SB_OK ||
           stat(path, &particles) != 0 || stat(mesh, &there) != 0 || particles.st_mtim.tv_sec > there.st_mtim.tv_sec ||
           (particles.st_mtim.tv_sec == there.st_mtim.tv_sec && particles.st_mtim.tv_nsec > there.st_mtim.tv_nsec);
}

/* Removes complete meshes from the choice, and refuses to overwrite other files, before the work begins. */
static sb_status look_at_meshes(job *j, sb_error *error)
{
    for (size_t i = 0; i < j->list.count; i++) {
        char path[PATHS], made[MADE_MAX];
        if (!j->chosen[i]) continue;
        describe(j, i, made);
        const sb_status status = path_of(j, i, path, error);
        if (status != SB_OK) return status;
        const sb_mesh_there there = sb_mesh_look(j->mesh, path, made);
        if (there == SB_MESH_FOREIGN)
            return sb_fail(error, SB_BAD_INPUT,
                           "%.500s: was not written by shorebreak surface; name another directory with --out", path);
        if (there == SB_MESH_DIFFERENT && !j->options->overwrite)
            return sb_fail(error, SB_BAD_INPUT,
                           "%.500s: was made with other options, by another version or from another run; expected "
                           "--overwrite or another "
                           "directory with --out",
                           path);
        j->chosen[i] = j->options->overwrite || there != SB_MESH_SAME || is_newer(j, i, path);
        j->todo += j->chosen[i];
        j->kept += !j->chosen[i];
    }
    return SB_OK;
}

static sb_status open_run(job *j, sb_error *error)
{
    const char *run = j->options->positional;
    char path[PATHS];
    sb_run_files files = {0};
    sb_scene scene = {0};
    sb_status status = sb_path_join(path, run, "scene.yaml", error);
    /* Before any of the run's files is read: reading a FIFO among them would block. */
    if (status == SB_OK && access(run, F_OK) == 0) status = sb_run_files_find(run, NULL, &files, error);
    sb_run_files_free(&files);
    if (status == SB_OK) status = sb_options_scene(j->options, path, &scene, error);
    const bool flat = status == SB_OK && scene.dimensions == 2;
    sb_scene_free(&scene);
    if (flat)
        return sb_fail(
            error, SB_BAD_INPUT,
            "%.500s: is a run in two dimensions, whose water has no surface in space; expected a run in three, "
            "or use `shorebreak render`",
            run);
    j->particles = sb_particle_format_in(run);
    if (status == SB_OK) status = sb_particle_format_read_list(j->particles, run, &j->list, error);
    if (status == SB_OK && j->list.count == 0)
        status = sb_fail(error, SB_BAD_INPUT, "%.500s: lists no particle files; set output.particle_interval", run);
    return status;
}

static void report(const job *j, size_t entry, size_t made, double begun, const sb_water_mesh *mesh, double water)
{
    char left[32], volume[32];
    sb_progress_percent(volume, water > 0 ? 100 * (sb_water_mesh_volume(mesh) / water - 1) : 0);
    sb_progress_duration(left, (sb_clock() - begun) / (double)made * (double)(j->todo - made));
    printf("t = %g s: mesh %zu of %zu, %zu triangles, volume %s %% of the particles', %s left\n",
           j->list.entries[entry].time, made, j->todo, mesh->triangles, volume, left);
    fflush(stdout);
}

static sb_status make_mesh(const job *j, size_t entry, size_t made, double begun, sb_error *error)
{
    char path[PATHS], how[MADE_MAX];
    sb_frame *frame = NULL;
    sb_water_mesh mesh = {0};
    sb_status status = sb_path_join(path, j->options->positional, j->list.entries[entry].file, error);
    if (status == SB_OK) status = j->particles->read(path, &frame, error);
    if (status != SB_OK) return status;
    sb_error reason = {0};
    status = sb_water_mesh_make(frame, j->options->cell, j->options->smooth, &mesh, &reason);
    if (status != SB_OK) status = sb_fail(error, status, "%.400s: %.500s", path, reason.text);
    describe(j, entry, how);
    if (status == SB_OK) status = path_of(j, entry, path, error);
    if (status == SB_OK) status = sb_mesh_write(j->mesh, path, &mesh, j->list.entries[entry].time, how, error);
    if (status == SB_OK && !j->options->quiet)
        report(j, entry, made + 1, begun, &mesh,
               (double)frame->count * frame->spacing * frame->spacing * frame->spacing);
    sb_water_mesh_free(&mesh);
    sb_frame_release(frame);
    return status;
}

/* Lists all meshes of the run that are there, also those of earlier calls. */
static sb_status write_list(const job *j, sb_error *error)
{
    sb_particle_list meshes = {0};
    char path[PATHS], made[MADE_MAX];
    sb_status status = SB_OK;
    for (size_t i = 0; i < j->list.count && status == SB_OK; i++) {
        describe(j, i, made);
        status = path_of(j, i, path, error);
        if (status != SB_OK || sb_mesh_look(j->mesh, path, made) != SB_MESH_SAME) continue;
        const char *name = strrchr(path, '/') + 1;
        status = sb_particle_list_add(&meshes, j->list.entries[i].time, name, strlen(name), error);
    }
    if (status == SB_OK) status = sb_path_join(path, j->directory, "surface.pvd", error);
    if (status == SB_OK) status = sb_pvd_write(path, &meshes, error);
    sb_particle_list_free(&meshes);
    return status;
}

static sb_status make_all(job *j, sb_error *error)
{
    const double begun = sb_clock();
    size_t made = 0;
    sb_status status = SB_OK;
    if (!j->options->quiet && j->kept > 0) printf("%zu complete meshes are kept\n", j->kept);
    sb_stop_watch();
    for (size_t i = 0; i < j->list.count && status == SB_OK; i++) {
        if (!j->chosen[i]) continue;
        status = sb_stop_signal() ? sb_stop_fail(error, "while meshes were made; the same command continues")
                                  : make_mesh(j, i, made++, begun, error);
    }
    if (j->mesh == &sb_mesh_vtp && (status == SB_OK || status == SB_INTERRUPTED)) {
        const sb_status listed = write_list(j, status == SB_OK ? error : NULL);
        if (status == SB_OK) status = listed;
    }
    return status;
}

static void warn(void *context, const char *text)
{
    (void)context;
    fprintf(stderr, "shorebreak: warning: %s\n", text);
}

static sb_status surface(const sb_options *options, sb_error *error)
{
    job j = {.options = options, .lock = -1};
    sb_status status = choose_format(options->format, &j.mesh, error);
    if (status == SB_OK) status = open_run(&j, error);
    if (status == SB_OK && !(j.chosen = sb_alloc(j.list.count, sizeof *j.chosen)))
        status = sb_fail_memory(error, "list of particle files");
    if (status == SB_OK) status = sb_times_choose(options->times, &j.list, j.chosen, error);
    if (status == SB_OK)
        status = options->out ? sb_path_join(j.directory, ".", options->out, error)
                              : sb_path_join(j.directory, options->positional, "surface", error);
    if (status == SB_OK) sb_team_warnings(warn, NULL);
    if (status == SB_OK) status = sb_make_directories(j.directory, error);
    if (status == SB_OK) status = sb_lock_directory(j.directory, "another directory given with --out", &j.lock, error);
    if (status == SB_OK) status = look_at_meshes(&j, error);
    if (status == SB_OK) status = make_all(&j, error);
    if (j.lock >= 0) close(j.lock);
    sb_free(j.chosen);
    sb_particle_list_free(&j.list);
    return status;
}

int sb_command_surface(int count, char **arguments)
{
    sb_options options;
    sb_error error = {0};
    sb_status status = sb_options_parse(count, arguments,
                                        SB_OPT_OUT | SB_OPT_FORMAT | SB_OPT_TIMES | SB_OPT_CELL | SB_OPT_SMOOTH |
                                            SB_OPT_THREADS | SB_OPT_OVERWRITE | SB_OPT_QUIET,
                                        "run directory", &options, &error);
    if (status == SB_OK && options.help) {
        fputs(help, stdout);
        return 0;
    }
    if (status == SB_OK) status = surface(&options, &error);
    if (status != SB_OK) fprintf(stderr, "shorebreak: %s\n", error.text);
    sb_options_free(&options);
    return status == SB_INTERRUPTED ? 128 + sb_stop_signal() : (int)status;
}
