#include "app/run/files.h"

#include "app/checkpoint/names.h"
#include "base/memory.h"
#include "output/maps/maps.h"
#include "output/maps/vti.h"
#include "output/particles/foam_files.h"
#include "output/particles/particle_format.h"
#include "output/particles/pvtp.h"
#include "output/tables/csv_tables.h"
#include "output/tables/overtopping_rate.h"
#include "output/tables/wave_table.h"
#include "render/image/image.h"
#include "report/report.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define PNG "\x89PNG"

typedef enum place { CHECKPOINTS, PARTICLES, FOAM, GRIDS, MAPS, PLOTS, REQUESTED, CAMERA, STILLS, TOP } place;

/* Whether the folder has a folder of pictures for each camera. */
static bool by_camera(place in)
{
    return in == CAMERA || in == STILLS;
}

static const char *const folders[] = {[CHECKPOINTS] = "checkpoints",
                                      [PARTICLES] = SB_PARTICLE_FOLDER,
                                      [FOAM] = SB_FOAM_FOLDER,
                                      [GRIDS] = SB_VTI_FOLDER,
                                      [MAPS] = "maps",
                                      [PLOTS] = "plots",
                                      [REQUESTED] = "pictures",
                                      [CAMERA] = "frames",
                                      [STILLS] = "stills"};
enum { FOLDERS = sizeof folders / sizeof *folders };

enum {
    KEPT = 1 /* overwritten by the next run, not removed first */,
    GROWS = 2 /* written in place, so that a file with several names (hard links) would change under each name */
};

/* The files of a run besides particle files, pictures and films: their names, and the first bytes, by which a user's
   file of the same name is recognised. */
static const struct {
    place in;
    const char *name;               /* NULL: several */
    const char *(*names)(size_t i); /* all names, then NULL */
    const char *ending, *start;
    unsigned how;
} known[] = {
    {TOP, "run", NULL, ".jsonl", SB_RUN_LOG_START, KEPT | GROWS},
    {TOP, "scene", NULL, ".yaml", SB_SCENE_WRITTEN, KEPT},
    {TOP, "summary", NULL, ".json", "{", 0},
    {TOP, "report", NULL, ".html", SB_REPORT_START, 0},
    {TOP, "control", NULL, ".token", "", 0},
    {TOP, NULL, sb_csv_name, ".csv", "time_s,", GROWS},
    {TOP, "waves", NULL, ".csv", SB_WAVE_TABLE_START, 0},
    {TOP, "eurotop", NULL, ".csv", SB_EUROTOP_TABLE_START, 0},
    {TOP, SB_VTI_LIST, NULL, ".pvd", "<?xml", 0},
    {TOP, SB_FOAM_LIST, NULL, ".pvd", "<?xml", 0},
    {CHECKPOINTS, SB_CHECKPOINT_SETTLING, NULL, SB_CHECKPOINT_SUFFIX, SB_CHECKPOINT_KIND, 0},
    {MAPS, NULL, sb_map_name, ".asc", "ncols", 0},
    {MAPS, NULL, sb_map_name, ".png", PNG, 0},
    {MAPS, NULL, sb_grid_map_name, ".asc", "ncols", 0},
    {MAPS, NULL, sb_grid_map_name, ".png", PNG, 0},
    {PLOTS, NULL, sb_csv_name, ".png", PNG, 0},
    {PLOTS, NULL, sb_csv_name, ".dat", "", 0},
    {PLOTS, NULL, sb_csv_name, ".gp", "", 0},
    {PLOTS, NULL, sb_map_name, ".gp", "", 0},
    {PLOTS, NULL, sb_grid_map_name, ".gp", "", 0},
    {PLOTS, "part", NULL, ".png", "", 0},
};

static const char *known_name(size_t k, size_t i)
{
    if (known[k].names) return known[k].names(i);
    return i == 0 ? known[k].name : NULL;
}

/* What is known about a file from its name. */
typedef struct kind {
    bool named;        /* a run writes files of this name */
    const char *start; /* its first bytes; NULL: see own */
    bool own;
    unsigned how;
} kind;

typedef struct finder {
    const char *directory;
    const sb_scene *scene; /* may be NULL */
    const bool *only;      /* by camera of the scene: whether it is drawn; NULL: all are */
    char *earlier;         /* the earlier run's scene.yaml from its cameras on; NULL: none */
    sb_run_files *files;
    sb_error *error;
} finder;

/* An empty file counts as the run's, because a full disk leaves empty files. */
static bool begins_with(const char *path, const char *start)
{
    char bytes[64];
    const size_t got = sb_file_start(path, bytes, sizeof bytes), length = strlen(start);
    return memcmp(bytes, start, got < length ? got : length) == 0;
}

static bool is_folder(const char *path)
{
    struct stat found;
    return lstat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

/* ---- cameras ---- */

static bool has_camera(const finder *f, const char *name)
{
    const sb_scene *scene = f->scene;
    for (size_t c = 0; scene && c < scene->render.camera_count; c++)
        if ((!f->only || f->only[c]) && strcmp(scene->render.cameras[c].name, name) == 0) return true;
    return false;
}

/* Older versions did not mark their pictures. These are recognised by the camera. */
static bool earlier_camera(const finder *f, const char *name)
{
    char line[SB_RUN_NAME_MAX];
    snprintf(line, sizeof line, "name: \"%.255s\"\n", name);
    return f->earlier && strstr(f->earlier, line);
}

static bool is_marked(const char *path)
{
    char bytes[SB_PNG_MARK_WITHIN];
    return sb_png_is_own(bytes, sb_file_start(path, bytes, sizeof bytes));
}

/* Whether `run` or `render` has drawn pictures of this camera. */
static bool own_camera(const finder *f, const char *name)
{
    char folder[SB_PATH_MAX], path[SB_PATH_MAX];
    if (earlier_camera(f, name)) return true;
    const int length = snprintf(folder, sizeof folder, "%s/frames/%.255s", f->directory, name);
    if (length >= (int)sizeof folder || !is_folder(folder)) return false;
    DIR *entries = opendir(folder);
    const struct dirent *entry;
    bool own = false;
    while (entries && !own && (entry = readdir(entries)))
        own = sb_is_numbered(entry->d_name, ".png", 0) && sb_path_join(path, folder, entry->d_name, NULL) == SB_OK &&
              is_marked(path);
    if (entries) closedir(entries);
    return own;
}

/* <camera>.mp4, or .<camera>.part.mp4, an unfinished film. */
static kind kind_of_film(const finder *f, const char *name)
{
    const bool part = name[0] == '.';
    const char *ending = part ? ".part.mp4" : ".mp4";
    const size_t length = strlen(name), tail = strlen(ending);
    char camera[256];
    if (length <= tail + part || strcmp(name + length - tail, ending) != 0) return (kind){.named = false};
    snprintf(camera, sizeof camera, "%.*s", (int)(length - tail - part), name + part);
    const bool own = own_camera(f, camera);
    return (kind){.named = own || has_camera(f, camera), .own = own};
}

static kind kind_of_picture(const finder *f, const char *camera, const char *path, const char *name)
{
    if (!sb_is_numbered(name, ".png", 0)) return (kind){.named = false};
    const bool wanted = has_camera(f, camera);
    const bool own = earlier_camera(f, camera) || is_marked(path) || (wanted && strstr(name, ".tmp"));
    return (kind){.named = own || wanted, .own = own};
}

/* pictures/<camera>-<step>.png, which commands requested. */
static kind kind_of_requested(const char *path, const char *name)
{
    const size_t length = strlen(name);
    const bool temporary = length > 8 && strcmp(name + length - 8, ".png.tmp") == 0;
    const bool own = temporary || (length > 4 && strcmp(name + length - 4, ".png") == 0 && is_marked(path));
    return (kind){.named = own, .own = own};
}

/* ---- entries ---- */

/* Whether the first `length` characters of `name` are stem + ending. */
static bool is_name(const char *name, size_t length, const char *stem, const char *ending)
{
    const size_t begin = strlen(stem);
    return length == begin + strlen(ending) && strncmp(name, stem, begin) == 0 &&
           strncmp(name + begin, ending, length - begin) == 0;
}

/* A particle file, or a list of particle files, of any format. length: of the name without ".tmp". */
static kind kind_of_particles(place in, const char *name, size_t length)
{
    for (const sb_particle_format *const *row = sb_particle_formats; *row; row++) {
        const sb_particle_format *format = *row;
        if (in == PARTICLES &&
            (sb_is_numbered(name, format->ending, 0) || is_name(name, length, SB_PARTICLE_LAST_GOOD, format->ending)))
            return (kind){.named = true, .start = format->start};
        if (in == TOP && format->list_ending && is_name(name, length, SB_PARTICLE_LIST, format->list_ending))
            return (kind){.named = true, .start = format->list_start};
    }
    return (kind){.named = false};
}

/* A file that is not a particle file, a picture or a film. length: of the name without ".tmp". */
static kind kind_of_known(place in, const char *name, size_t length)
{
    if (in == CHECKPOINTS && sb_is_numbered(name, SB_CHECKPOINT_SUFFIX, 0))
        return (kind){.named = true, .start = SB_CHECKPOINT_KIND};
    if (in == FOAM && sb_is_numbered(name, SB_FOAM_ENDING, 0)) return (kind){.named = true, .start = "<?xml"};
    if (in == GRIDS && sb_is_numbered(name, ".vti", 0)) return (kind){.named = true, .start = SB_VTI_HEAD};
    for (size_t k = 0; k < sizeof known / sizeof *known; k++)
        for (size_t i = 0; known[k].in == in && known_name(k, i); i++)
            if (is_name(name, length, known_name(k, i), known[k].ending))
                return (kind){.named = true, .start = known[k].start, .how = known[k].how};
    return (kind){.named = false};
}

static kind kind_of(const finder *f, place in, const char *camera, const char *path, const char *name)
{
    const size_t whole = strlen(name);
    const bool temporary = whole > 4 && strcmp(name + whole - 4, ".tmp") == 0;
    const size_t length = whole - (temporary ? 4 : 0);
    if (by_camera(in)) return kind_of_picture(f, camera, path, name);
    if (in == REQUESTED) return kind_of_requested(path, name);
    kind found = kind_of_particles(in, name, length);
    if (!found.named) found = kind_of_known(in, name, length);
    if (!found.named) return in == TOP ? kind_of_film(f, name) : found;
    if (temporary) {
        found.start = "";
        found.how &= ~(unsigned)KEPT;
    }
    return found;
}

static void note_other(const finder *f, const char *path)
{
    if (f->files->others++ == 0)
        snprintf(f->files->first_other, SB_RUN_NAME_MAX, "%s", path + strlen(f->directory) + 1);
}

static sb_status note_own(const finder *f, const char *path)
{
    sb_run_files *files = f->files;
    char *copy = sb_strdup(path);
    if (!copy || sb_grow((void **)&files->own, &files->capacity, files->count + 1, sizeof *files->own) != 0) {
        sb_free(copy);
        return sb_fail_memory(f->error, "the list of an earlier run's files");
    }
    files->own[files->count++] = copy;
    return SB_OK;
}

static sb_status note(const finder *f, place in, const char *camera, const char *path, const char *name)
{
    struct stat found;
    if (lstat(path, &found) != 0) return SB_OK;
    const kind what = kind_of(f, in, camera, path, name);
    if (!what.named) {
        if (in == TOP && name[0] == '.') return SB_OK;
        note_other(f, path);
        return SB_OK;
    }
    const char *other = sb_file_kind(found.st_mode);
    if (other) return sb_fail(f->error, SB_FAILED, "%.500s: is %s, expected a file of a run or nothing", path, other);
    if (f->scene && what.how & GROWS && found.st_nlink > 1)
        return sb_fail(f->error, SB_FAILED,
                       "%.500s: has %lu names (hard links), and the run would change the file under each of them; "
                       "expected a file with one name: replace it by a copy",
                       path, (unsigned long)found.st_nlink);
    if (!(what.start ? begins_with(path, what.start) : what.own)) {
        if (!f->files->foreign[0]) snprintf(f->files->foreign, SB_RUN_NAME_MAX, "%s", path + strlen(f->directory) + 1);
        return SB_OK;
    }
    return what.how & KEPT ? SB_OK : note_own(f, path);
}

/* ---- folders ---- */

static sb_status look_into(const finder *f, place in, const char *camera, const char *folder);

static bool is_own_folder(const char *name)
{
    for (size_t k = 0; k < FOLDERS; k++)
        if (strcmp(name, folders[k]) == 0) return true;
    return false;
}

static sb_status look_at(const finder *f, place in, const char *camera, const char *folder, const char *name)
{
    char path[SB_PATH_MAX];
    sb_status status = sb_path_join(path, folder, name, f->error);
    if (status != SB_OK || (in == TOP && is_own_folder(name) && is_folder(path))) return status;
    if (by_camera(in) && !camera && is_folder(path)) return look_into(f, in, name, path);
    if (in == PARTICLES && !camera && sb_pvtp_is_piece_folder(name) && is_folder(path))
        return look_into(f, in, name, path);
    if (by_camera(in) && !camera) {
        note_other(f, path);
        return SB_OK;
    }
    return note(f, in, camera, path, name);
}

/* camera NULL: frames/ or stills/, which contain the cameras' folders. */
static sb_status look_into(const finder *f, place in, const char *camera, const char *folder)
{
    const struct dirent *entry;
    sb_status status = SB_OK;
    if (!is_folder(folder) && in != TOP) return SB_OK;
    DIR *entries = opendir(folder);
    if (!entries) return sb_fail(f->error, SB_FAILED, "%.500s: cannot read: %s", folder, strerror(errno));
    while (status == SB_OK && (entry = readdir(entries)))
        if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0)
            status = look_at(f, in, camera, folder, entry->d_name);
    closedir(entries);
    return status;
}

/* ---- the whole directory ---- */

/* Reads the cameras from the scene.yaml of the earlier run. */
static sb_status read_earlier(finder *f, char **text)
{
    char path[SB_PATH_MAX];
    struct stat found;
    size_t length;
    *text = NULL;
    if (sb_path_join(path, f->directory, "scene.yaml", NULL) != SB_OK || lstat(path, &found) != 0 ||
        !S_ISREG(found.st_mode) || found.st_size == 0 || !begins_with(path, SB_SCENE_WRITTEN))
        return SB_OK;
    sb_status status = sb_file_read(path, (size_t)1 << 24, text, &length, f->error);
    if (status == SB_OK) f->earlier = strstr(*text, "\n  cameras:");
    return status;
}

static sb_status look_at_folder(const finder *f, place in)
{
    char folder[SB_PATH_MAX];
    sb_status status = sb_path_join(folder, f->directory, folders[in], f->error);
    return status == SB_OK ? look_into(f, in, NULL, folder) : status;
}

sb_status sb_run_files_find(const char *directory, const sb_scene *scene, sb_run_files *files, sb_error *error)
{
    finder f = {.directory = directory, .scene = scene, .files = files, .error = error};
    char *text;
    *files = (sb_run_files){0};
    sb_status status = read_earlier(&f, &text);
    for (size_t k = 0; status == SB_OK && k < FOLDERS; k++) status = look_at_folder(&f, (place)k);
    if (status == SB_OK) status = look_into(&f, TOP, NULL, directory);
    sb_free(text);
    return status;
}

sb_status sb_run_files_find_pictures(const char *directory, const sb_scene *scene, const bool *only,
                                     sb_run_files *files, sb_error *error)
{
    finder f = {.directory = directory, .scene = scene, .only = only, .files = files, .error = error};
    char *text, film[128];
    *files = (sb_run_files){0};
    sb_status status = read_earlier(&f, &text);
    if (status == SB_OK) status = look_at_folder(&f, CAMERA);
    if (status == SB_OK && scene->render.still_count > 0) status = look_at_folder(&f, STILLS);
    for (size_t c = 0; status == SB_OK && c < scene->render.camera_count; c++) {
        if (only && !only[c]) continue;
        snprintf(film, sizeof film, "%.100s.mp4", scene->render.cameras[c].name);
        status = look_at(&f, TOP, NULL, directory, film);
    }
    sb_free(text);
    return status;
}
