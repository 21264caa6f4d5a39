#include "output/particles/pvtp.h"

#include "base/memory.h"
#include "output/particles/particle_format.h"
#include "output/particles/vtp.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <string.h>
#include <sys/stat.h>

#define HEAD "<?xml version=\"1.0\"?>\n<VTKFile type=\"PPolyData\""
#define PIECE "<Piece Source=\""

enum { NAME_MAX_LENGTH = 64 };

bool sb_pvtp_is_piece_folder(const char *name)
{
    const size_t head = strlen(SB_PIECE_FOLDER), digits = strlen(name) - head;
    return strncmp(name, SB_PIECE_FOLDER, head) == 0 && digits > 0 && digits < 10 &&
           strspn(name + head, "0123456789") == digits;
}

/* Writes the name of a piece, relative to the folder of the particle files. */
static void name_piece(int rank, uint64_t number, char name[NAME_MAX_LENGTH])
{
    if (number == 0)
        snprintf(name, NAME_MAX_LENGTH, SB_PIECE_FOLDER "%d/" SB_PARTICLE_LAST_GOOD ".vtp", rank);
    else
        snprintf(name, NAME_MAX_LENGTH, SB_PIECE_FOLDER "%d/%06" PRIu64 ".vtp", rank, number);
}

sb_status sb_pvtp_piece_path(const char *folder, int rank, uint64_t number, char path[SB_PATH_MAX], sb_error *error)
{
    char name[NAME_MAX_LENGTH];
    name_piece(rank, number, name);
    return sb_path_join(path, folder, name, error);
}

/* A symbolic link is none: it may lead to another run's pieces. */
static bool is_folder(const char *path)
{
    struct stat found;
    return lstat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

/* ---- writing ---- */

sb_status sb_pvtp_write_piece(const char *folder, int rank, const sb_frame *frame, uint64_t number, sb_error *error)
{
    char path[SB_PATH_MAX], own[SB_PATH_MAX];
    sb_status status = sb_pvtp_piece_path(folder, rank, number, path, error);
    if (status != SB_OK) return status;
    sb_path_folder(own, path);
    if (mkdir(own, 0777) != 0 && errno != EEXIST)
        return sb_fail(error, SB_FAILED, "%.500s: cannot make directory: %s", own, strerror(errno));
    if (!is_folder(own))
        return sb_fail(error, SB_FAILED, "%.500s: is not a directory, expected one of the run's own", own);
    return sb_vtp_write(path, frame, number, error);
}

static void put_array(FILE *stream, const char *type, const char *name, int components)
{
    fprintf(stream, "<PDataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\"/>\n", type, name, components);
}

static void put_list(FILE *stream, const sb_frame *frame, uint64_t number, int ranks)
{
    char name[NAME_MAX_LENGTH];
    fputs(HEAD " version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
               "<PPolyData GhostLevel=\"0\">\n<PPointData>\n",
          stream);
    put_array(stream, "Float32", "velocity", 3);
    put_array(stream, "Float32", "pressure", 1);
    put_array(stream, "UInt32", "id", 1);
    if (frame->density_error) put_array(stream, "Float32", "density_error", 1);
    fputs("</PPointData>\n<PPoints>\n", stream);
    put_array(stream, "Float64", "Points", 3);
    fputs("</PPoints>\n", stream);
    for (int r = 0; r < ranks; r++) {
        name_piece(r, number, name);
        fprintf(stream, PIECE "%s\"/>\n", name);
    }
    fputs("</PPolyData>\n</VTKFile>\n", stream);
}

sb_status sb_pvtp_write(const char *path, const sb_frame *frame, uint64_t number, int ranks, sb_error *error)
{
    char folder[SB_PATH_MAX];
    sb_atomic_file out;
    sb_status status = sb_atomic_open(&out, path, error);
    if (status != SB_OK) return status;
    sb_path_folder(folder, path);
    status = sb_pvtp_write_piece(folder, 0, frame, number, error);
    if (status != SB_OK) {
        sb_atomic_abort(&out);
        return status;
    }
    put_list(out.stream, frame, number, ranks);
    return sb_atomic_commit(&out, 0, error);
}

/* ---- reading ---- */

static sb_status refuse(const char *path, const char *what, sb_error *error)
{
    return sb_fail(error, SB_BAD_INPUT, "%.500s: %s, expected a list of pieces of shorebreak", path, what);
}

/* Adds the particles of a piece. */
static sb_status append(sb_frame *all, const sb_frame *piece, const char *path, sb_error *error)
{
    const size_t before = all->count, more = piece->count;
    if (piece->status.step != all->status.step || memcmp(&piece->origin, &all->origin, sizeof all->origin) != 0 ||
        !piece->density_error != !all->density_error)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: is of step %" PRIu64 ", expected one of step %" PRIu64
                       " with the same origin and arrays, as the first piece",
                       path, piece->status.step, all->status.step);
    if (more == 0) return SB_OK;
    if (sb_frame_extend(all, more) != 0) return sb_fail_memory(error, path);
    memcpy(all->position + 3 * before, piece->position, 3 * more * sizeof *all->position);
    memcpy(all->velocity + 3 * before, piece->velocity, 3 * more * sizeof *all->velocity);
    memcpy(all->pressure + before, piece->pressure, more * sizeof *all->pressure);
    memcpy(all->id + before, piece->id, more * sizeof *all->id);
    if (all->density_error)
        memcpy(all->density_error + before, piece->density_error, more * sizeof *all->density_error);
    return SB_OK;
}

/* Reads one piece: the first one becomes the frame. */
static sb_status add_piece(const char *path, sb_frame **all, sb_error *error)
{
    sb_frame *piece = NULL;
    sb_status status = sb_vtp_read(path, &piece, error);
    if (status != SB_OK) return status;
    if (!*all) {
        *all = piece;
        return SB_OK;
    }
    status = append(*all, piece, path, error);
    sb_frame_release(piece);
    return status;
}

/* Whether a piece lies in a folder of a rank beside its list, so that a list leads to no other files. */
static bool is_piece(char *name)
{
    char *slash = strchr(name, '/');
    if (!slash) return false;
    *slash = '\0';
    const bool good = sb_pvtp_is_piece_folder(name) && !strstr(slash + 1, ".tmp") &&
                      (sb_is_numbered(slash + 1, ".vtp", 0) || strcmp(slash + 1, SB_PARTICLE_LAST_GOOD ".vtp") == 0);
    *slash = '/';
    return good;
}

static sb_status read_pieces(const char *path, const char *text, sb_frame **all, sb_error *error)
{
    char folder[SB_PATH_MAX], piece[SB_PATH_MAX], name[NAME_MAX_LENGTH];
    sb_path_folder(folder, path);
    if (strncmp(text, HEAD, strlen(HEAD)) != 0 || !strstr(text, "</PPolyData>"))
        return refuse(path, "is no complete list", error);
    for (const char *at = text; (at = strstr(at, PIECE));) {
        at += strlen(PIECE);
        const char *end = strchr(at, '"');
        const size_t length = end ? (size_t)(end - at) : 0;
        if (length == 0 || length >= sizeof name) return refuse(path, "has a damaged entry", error);
        memcpy(name, at, length);
        name[length] = '\0';
        if (!is_piece(name)) return refuse(path, "names a file outside of " SB_PIECE_FOLDER "<R>", error);
        sb_status status = sb_path_join(piece, folder, name, error);
        if (status == SB_OK) status = add_piece(piece, all, error);
        if (status != SB_OK) return status;
    }
    return *all ? SB_OK : refuse(path, "names no piece", error);
}

sb_status sb_pvtp_read(const char *path, sb_frame **frame, sb_error *error)
{
    char *text;
    size_t length;
    sb_frame *all = NULL;
    sb_status status = sb_file_read(path, (size_t)1 << 24, &text, &length, error);
    if (status != SB_OK) return status;
    status = read_pieces(path, text, &all, error);
    sb_free(text);
    if (status == SB_OK)
        *frame = all;
    else
        sb_frame_release(all);
    return status;
}

/* ---- removing ---- */

sb_status sb_pvtp_remove_pieces(const char *folder, uint64_t after, sb_error *error)
{
    char own[SB_PATH_MAX];
    DIR *entries = opendir(folder);
    const struct dirent *entry;
    sb_status status = SB_OK;
    if (!entries && errno != ENOENT)
        return sb_fail(error, SB_FAILED, "%.500s: cannot read: %s", folder, strerror(errno));
    while (entries && status == SB_OK && (entry = readdir(entries))) {
        if (!sb_pvtp_is_piece_folder(entry->d_name)) continue;
        status = sb_path_join(own, folder, entry->d_name, error);
        if (status == SB_OK && is_folder(own)) status = sb_remove_numbered(own, ".vtp", after, error);
    }
    if (entries) closedir(entries);
    return status;
}
