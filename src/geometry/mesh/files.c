/* Opens files for assimp. A mesh may refer to other files (buffers, materials), and a file from an untrusted source
   could thereby read any file of this machine. Each name is therefore resolved, including links, and must lead to a
   regular file in the mesh's folder. */
#include "geometry/mesh/files.h"

#include "base/input.h"
#include "base/memory.h"
#include "geometry/mesh/stl.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct opened {
    struct aiFile file; /* first member, since assimp passes its address back */
    int descriptor;
    bool own;    /* the descriptor is closed together with the file */
    char *bytes; /* the content to deliver if it differs from the file's; else NULL */
    size_t size, at;
} opened;

static size_t read_bytes(opened *from, char *to, size_t wanted)
{
    size_t got = 0;
    if (from->at >= from->size) return 0;
    if (wanted > from->size - from->at) wanted = from->size - from->at;
    if (from->bytes) {
        memcpy(to, from->bytes + from->at, wanted);
        return wanted;
    }
    while (got < wanted) {
        const ssize_t part = pread(from->descriptor, to + got, wanted - got, (off_t)(from->at + got));
        if (part < 0 && errno == EINTR) continue;
        if (part <= 0) break;
        got += (size_t)part;
    }
    return got;
}

/* Like fread. */
static size_t read_items(struct aiFile *file, char *to, size_t size, size_t count)
{
    opened *from = (opened *)file;
    if (size == 0 || count > SIZE_MAX / size) return 0;
    const size_t got = read_bytes(from, to, size * count);
    from->at += got;
    return got / size;
}

static size_t write_nothing(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file;
    (void)from;
    (void)size;
    (void)count;
    return 0;
}

static size_t tell(struct aiFile *file)
{
    return ((opened *)file)->at;
}

static size_t size_of(struct aiFile *file)
{
    return ((opened *)file)->size;
}

/* Like fseek. Assimp passes negative offsets as unsigned numbers. */
static aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    opened *of = (opened *)file;
    const size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? of->at : of->size;
    const size_t to = from + offset;
    if (to > (size_t)INT64_MAX) return aiReturn_FAILURE;
    of->at = to;
    return aiReturn_SUCCESS;
}

static void flush_nothing(struct aiFile *file)
{
    (void)file;
}

static void refuse(sb_mesh_files *files, const char *name, const char *how, const char *kind)
{
    if (files->refusal[0]) return;
    snprintf(files->refusal, sizeof files->refusal, "it refers to the file \"%.200s\"%s%s", name, how, kind);
}

/* Returns the file's name as the mesh gives it, without the folder that assimp prepends. */
static const char *own_name(const sb_mesh_files *files, const char *name)
{
    const size_t length = strlen(files->folder);
    return strncmp(name, files->folder, length) == 0 && name[length] == '/' ? name + length + 1 : name;
}

/* Returns the descriptor of a file in the folder, or -1. A name that does not exist is not a refusal, because assimp
   tries several names and can do without a missing material. */
static int open_within(sb_mesh_files *files, const char *name)
{
    char joined[SB_PATH_MAX], resolved[SB_PATH_MAX];
    struct stat about;
    int file = -1;
    const char *own = own_name(files, name);
    const size_t length = strcmp(files->root, "/") == 0 ? 0 : strlen(files->root);
    if (sb_path_join(joined, files->root, own, NULL) != SB_OK || !realpath(joined, resolved)) return -1;
    if (strncmp(resolved, files->root, length) != 0 || (resolved[length] != '/' && resolved[length] != '\0')) {
        refuse(files, own, " outside of its folder, expected all files in that folder", "");
        return -1;
    }
    if (stat(resolved, &about) == 0 && !S_ISREG(about.st_mode))
        refuse(files, own, ", expected a regular file, not ", sb_file_kind(about.st_mode));
    return sb_input_descriptor(resolved, &file, NULL) == SB_OK ? file : -1;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *name, const char *mode)
{
    sb_mesh_files *files = (sb_mesh_files *)io;
    const bool mesh = strcmp(name, files->path) == 0;
    struct stat about;
    if (mode[0] != 'r' || strchr(mode, '+')) return NULL;
    const int file = mesh ? files->mesh : open_within(files, name);
    if (file < 0) return NULL;
    opened *made = fstat(file, &about) == 0 ? sb_alloc(1, sizeof *made) : NULL;
    if (!made) {
        if (!mesh) close(file);
        return NULL;
    }
    *made = (opened){.descriptor = file, .own = !mesh, .size = (size_t)about.st_size};
    made->file = (struct aiFile){.ReadProc = read_items,
                                 .WriteProc = write_nothing,
                                 .TellProc = tell,
                                 .FileSizeProc = size_of,
                                 .SeekProc = seek,
                                 .FlushProc = flush_nothing};
    if (mesh && sb_mesh_is_stl(name))
        sb_mesh_stl_content(file, &made->bytes, &made->size, files->refusal, sizeof files->refusal);
    return &made->file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    opened *of = (opened *)file;
    if (of->own) close(of->descriptor);
    sb_free(of->bytes);
    sb_free(of);
}

sb_status sb_mesh_files_begin(sb_mesh_files *files, const char *path, int mesh, sb_error *error)
{
    *files = (sb_mesh_files){.path = path, .mesh = mesh};
    files->io = (struct aiFileIO){.OpenProc = open_file, .CloseProc = close_file};
    sb_path_folder(files->folder, path);
    _Static_assert(SB_PATH_MAX >= 4096, "realpath needs PATH_MAX bytes");
    if (!realpath(files->folder, files->root))
        return sb_fail(error, SB_BAD_INPUT, "its folder cannot be found: %s", strerror(errno));
    return SB_OK;
}
