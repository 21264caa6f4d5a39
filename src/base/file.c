/* Files that are complete or absent, directories, and paths. */
#include "base/file.h"

#include "base/input.h"
#include "base/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const char *sb_file_kind(mode_t mode)
{
    return S_ISREG(mode)    ? NULL
           : S_ISLNK(mode)  ? "a symbolic link"
           : S_ISDIR(mode)  ? "a directory"
           : S_ISFIFO(mode) ? "a FIFO"
           : S_ISSOCK(mode) ? "a socket"
                            : "a device";
}

/* Fails because the file found at the path must not be written. errno EEXIST marks the message as complete. */
static sb_status refuse(const char *path, const struct stat *found, sb_error *error)
{
    const char *kind = sb_file_kind(found->st_mode);
    if (kind)
        sb_fail(error, SB_FAILED, "%.500s: is %s, expected a regular file or nothing", path, kind);
    else
        sb_fail(error, SB_FAILED,
                "%.500s: has %lu names (hard links), and writing would change the file under each of them; expected a "
                "file with one name: copy it",
                path, (unsigned long)found->st_nlink);
    errno = EEXIST;
    return SB_FAILED;
}

sb_status sb_file_replaceable(const char *path, sb_error *error)
{
    struct stat found;
    return lstat(path, &found) == 0 && sb_file_kind(found.st_mode) ? refuse(path, &found, error) : SB_OK;
}

/* Does not wait for the other end of a FIFO, and truncates only a regular file with one name. */
sb_status sb_file_open(const char *path, const char *mode, FILE **stream, sb_error *error)
{
    const int kind = mode[0] == 'w' ? O_WRONLY | O_CREAT : mode[0] == 'a' ? O_WRONLY | O_CREAT | O_APPEND : O_RDWR;
    struct stat found;
    *stream = NULL;
    const int file = open(path, kind | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
    int reason = errno;
    if (file < 0) {
        if (lstat(path, &found) == 0 && sb_file_kind(found.st_mode)) return refuse(path, &found, error);
    } else if (fstat(file, &found) == 0 && (sb_file_kind(found.st_mode) || found.st_nlink > 1)) {
        close(file);
        return refuse(path, &found, error);
    } else {
        if (mode[0] != 'w' || ftruncate(file, 0) == 0) *stream = fdopen(file, mode);
        if (*stream) return SB_OK;
        reason = errno;
        close(file);
    }
    sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", path, strerror(reason));
    errno = reason;
    return SB_FAILED;
}

sb_status sb_atomic_open(sb_atomic_file *file, const char *path, sb_error *error)
{
    file->stream = NULL;
    if (strlen(path) >= sizeof file->path)
        return sb_fail(error, SB_BAD_INPUT, "%.64s...: path longer than %d bytes", path, SB_PATH_MAX);
    snprintf(file->path, sizeof file->path, "%s", path);
    snprintf(file->temporary, sizeof file->temporary, "%s.tmp", path);
    if (sb_file_replaceable(path, error) != SB_OK) return SB_FAILED;
    if (sb_file_open(file->temporary, "w", &file->stream, error) == SB_OK) return SB_OK;
    return errno == EEXIST ? SB_FAILED : sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", path, strerror(errno));
}

sb_status sb_atomic_open_in(sb_atomic_file *file, const char *folder, const char *name, sb_error *error)
{
    char path[SB_PATH_MAX];
    *file = (sb_atomic_file){.stream = NULL};
    sb_status status = sb_path_join(path, folder, name, error);
    return status == SB_OK ? sb_atomic_open(file, path, error) : status;
}

/* Makes a rename survive a power failure. Not every file system supports this; the file is complete in either case. */
static void sync_folder_of(const char *path)
{
    char folder[SB_PATH_MAX];
    sb_path_folder(folder, path);
    (void)sb_file_sync(folder);
}

sb_status sb_atomic_commit(sb_atomic_file *file, int durable, sb_error *error)
{
    FILE *stream = file->stream;
    file->stream = NULL;
    errno = 0;
    int bad = fflush(stream) != 0 || ferror(stream) || (durable && fsync(fileno(stream)) != 0);
    int reason = errno ? errno : EIO; /* the errno of an earlier failed write is no longer available */
    if (fclose(stream) != 0 && !bad) {
        bad = 1;
        reason = errno;
    }
    if (!bad && rename(file->temporary, file->path) != 0) {
        bad = 1;
        reason = errno;
    }
    if (!bad && durable) sync_folder_of(file->path);
    if (!bad) return SB_OK;
    unlink(file->temporary);
    return sb_fail(error, SB_FAILED, "%.500s: cannot write: %s", file->path, strerror(reason));
}

void sb_atomic_abort(sb_atomic_file *file)
{
    if (!file->stream) return;
    fclose(file->stream);
    file->stream = NULL;
    unlink(file->temporary);
}

size_t sb_file_start(const char *path, char *bytes, size_t size)
{
    struct stat found;
    const int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return 0;
    const ssize_t got = fstat(file, &found) == 0 && S_ISREG(found.st_mode) ? pread(file, bytes, size, 0) : 0;
    close(file);
    return got > 0 ? (size_t)got : 0;
}

int sb_file_sync(const char *path)
{
    int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return -1;
    int status = fsync(file);
    close(file);
    return status;
}

/* Does not change errno. */
static int is_directory(const char *path)
{
    struct stat found;
    const int reason = errno, is = stat(path, &found) == 0 && S_ISDIR(found.st_mode);
    errno = reason;
    return is;
}

sb_status sb_make_directories(const char *path, sb_error *error)
{
    char part[SB_PATH_MAX];
    size_t length = strlen(path);
    if (length == 0 || length >= sizeof part)
        return sb_fail(error, SB_BAD_INPUT, "%.64s: not a usable directory name", path);
    memcpy(part, path, length + 1);
    for (size_t i = 1; i <= length; i++) {
        if (part[i] != '/' && part[i] != '\0') continue;
        char kept = part[i];
        part[i] = '\0';
        if (mkdir(part, 0777) != 0 && !is_directory(part)) {
            if (errno == EEXIST) return sb_fail(error, SB_BAD_INPUT, "%.500s: is not a directory, expected one", part);
            return sb_fail(error, SB_FAILED, "%.500s: cannot make directory: %s", part, strerror(errno));
        }
        part[i] = kept;
    }
    return SB_OK;
}

sb_status sb_make_folder(char path[SB_PATH_MAX], const char *directory, const char *name, sb_error *error)
{
    struct stat status;
    sb_status made = sb_make_directories(directory, error);
    if (made == SB_OK) made = sb_path_join(path, directory, name, error);
    if (made != SB_OK) return made;
    for (char *c = path + strlen(path) - strlen(name);; c++) {
        const char kept = *c;
        if (kept != '/' && kept != '\0') continue;
        *c = '\0';
        if (mkdir(path, 0777) != 0 && errno != EEXIST)
            return sb_fail(error, SB_FAILED, "%.500s: cannot make directory: %s", path, strerror(errno));
        if (lstat(path, &status) != 0 || !S_ISDIR(status.st_mode))
            return sb_fail(error, SB_FAILED, "%.500s: is %s, expected a directory of the run's own", path,
                           S_ISLNK(status.st_mode) ? "a symbolic link" : "not a directory");
        *c = kept;
        if (kept == '\0') return SB_OK;
    }
}

int sb_is_numbered(const char *name, const char *suffix, unsigned long long after)
{
    enum { DIGITS = 6 }; /* all numbers in file names are written with at least six digits */
    const size_t digits = strspn(name, "0123456789"), length = strlen(suffix);
    const char *rest = name + digits + length;
    if (digits < DIGITS || strncmp(name + digits, suffix, length) != 0 || (*rest && strcmp(rest, ".tmp") != 0))
        return 0;
    return *rest || strtoull(name, NULL, 10) > after;
}

sb_status sb_remove_numbered(const char *folder, const char *suffix, unsigned long long after, sb_error *error)
{
    DIR *directory = opendir(folder);
    if (!directory)
        return errno == ENOENT ? SB_OK : sb_fail(error, SB_FAILED, "%.500s: cannot read: %s", folder, strerror(errno));
    sb_status status = SB_OK;
    const struct dirent *entry;
    while (status == SB_OK && (entry = readdir(directory))) {
        if (!sb_is_numbered(entry->d_name, suffix, after)) continue;
        if (unlinkat(dirfd(directory), entry->d_name, 0) != 0)
            status =
                sb_fail(error, SB_FAILED, "%.500s/%.200s: cannot remove: %s", folder, entry->d_name, strerror(errno));
    }
    closedir(directory);
    return status;
}

sb_status sb_path_join(char out[SB_PATH_MAX], const char *base, const char *name, sb_error *error)
{
    int length =
        name[0] == '/' ? snprintf(out, SB_PATH_MAX, "%s", name) : snprintf(out, SB_PATH_MAX, "%s/%s", base, name);
    if (length < 0 || length >= SB_PATH_MAX)
        return sb_fail(error, SB_BAD_INPUT, "%.64s...: path longer than %d bytes", name, SB_PATH_MAX);
    return SB_OK;
}

void sb_path_folder(char out[SB_PATH_MAX], const char *path)
{
    const char *slash = strrchr(path, '/');
    if (!slash)
        snprintf(out, SB_PATH_MAX, ".");
    else
        snprintf(out, SB_PATH_MAX, "%.*s", slash == path ? 1 : (int)(slash - path), path);
}

static sb_status unreadable(const char *path, int reason, sb_error *error)
{
    sb_fail(error, SB_BAD_INPUT, "%.500s: cannot read: %s", path, strerror(reason));
    errno = reason;
    return SB_BAD_INPUT;
}

/* Checks a file's size before it is read. A sparse file can be larger than its disk, so a large size is also compared
   with the available memory. */
static sb_status check_size(const char *path, off_t size, size_t limit, sb_error *error)
{
    static const off_t small = (off_t)1 << 28;
    if ((uintmax_t)size > limit)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: larger than the %zu bytes allowed", path, limit);
    const size_t there = size > small ? sb_memory_available() : 0;
    if (there == 0 || (uintmax_t)size <= there) return SB_OK;
    return sb_fail(error, SB_FAILED, "%.500s: %.3g GB, expected no more than the %.3g GB of free memory", path,
                   (double)size / 1e9, (double)there / 1e9);
}

sb_status sb_file_read(const char *path, size_t limit, char **text, size_t *length, sb_error *error)
{
    *text = NULL;
    *length = 0;
    FILE *file;
    struct stat about;
    int reason = 0;
    sb_status status = sb_input_open(path, &file, error);
    if (status != SB_OK) return status;
    /* A file that is too large is refused before it is read. */
    if (fstat(fileno(file), &about) == 0 && about.st_size > 0) status = check_size(path, about.st_size, limit, error);
    if (status != SB_OK) {
        fclose(file);
        errno = 0;
        return status;
    }
    char *buffer = NULL;
    size_t capacity = 0, used = 0;
    for (;;) {
        if (sb_grow((void **)&buffer, &capacity, used + 65536 + 1, 1) != 0) {
            status = sb_fail_memory(error, path);
            break;
        }
        errno = 0;
        size_t got = fread(buffer + used, 1, 65536, file);
        used += got;
        if (used > limit) {
            status = sb_fail(error, SB_BAD_INPUT, "%.500s: larger than the %zu bytes allowed", path, limit);
            break;
        }
        if (got == 0) break;
    }
    if (status == SB_OK && ferror(file)) {
        reason = errno ? errno : EIO;
        status = unreadable(path, reason, error);
    }
    fclose(file);
    if (status != SB_OK) {
        sb_free(buffer);
        errno = reason;
        return status;
    }
    buffer[used] = '\0';
    *text = buffer;
    *length = used;
    return SB_OK;
}

sb_status sb_text_read(const char *path, size_t limit, char **text, size_t *length, sb_error *error)
{
    static const char mark[] = "\xef\xbb\xbf";
    const size_t size = sizeof mark - 1;
    sb_status status = sb_file_read(path, limit, text, length, error);
    if (status != SB_OK || strncmp(*text, mark, size) != 0) return status;
    *length -= size;
    memmove(*text, *text + size, *length + 1);
    return SB_OK;
}
