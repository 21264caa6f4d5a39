#include "output/tables/hashed_file.h"

#include "base/input.h"

#include <errno.h>
#include <stdbool.h>
#include <unistd.h>

/* Writes to the file. Only bytes that were written count in the length and the hash. */
static ssize_t take(void *cookie, const char *bytes, size_t count)
{
    sb_hashed_file *file = cookie;
    size_t done = 0;
    /* After an error the stream drops what it could not write; later text would be joined to an incomplete line. */
    if (file->failed) {
        errno = file->failed;
        return 0;
    }
    while (done < count) {
        const ssize_t written = write(fileno(file->file), bytes + done, count - done);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) {
            file->failed = written < 0 && errno ? errno : EIO;
            break;
        }
        done += (size_t)written;
    }
    sb_hash_add(&file->hash, bytes, done);
    for (size_t i = done; i > 0; i--)
        if (bytes[i - 1] == '\n') {
            file->complete = file->length + i;
            break;
        }
    file->length += done;
    return (ssize_t)done; /* fewer than it was given: the stream's error */
}

static sb_status cannot(const char *what, const char *path, sb_status status, sb_error *error)
{
    return sb_fail(error, status, "%.500s: cannot %s: %s", path, what, strerror(errno ? errno : EIO));
}

static sb_status make_stream(sb_hashed_file *file, const char *path, sb_error *error)
{
    file->stream = fopencookie(file, "w", (cookie_io_functions_t){.write = take});
    return file->stream ? SB_OK : cannot("write", path, SB_FAILED, error);
}

/* Hashes the first `length` bytes; *found is smaller if the file is shorter. Returns 0, or -1 with errno. */
static int hash_start(FILE *file, uint64_t length, sb_running_hash *hash, uint64_t *found)
{
    char bytes[16384];
    size_t got = 1;
    *hash = (sb_running_hash){0};
    for (*found = 0; *found < length && got > 0; *found += got) {
        const uint64_t left = length - *found;
        got = fread(bytes, 1, left < sizeof bytes ? (size_t)left : sizeof bytes, file);
        sb_hash_add(hash, bytes, got);
    }
    return ferror(file) ? -1 : 0;
}

sb_status sb_hashed_open(sb_hashed_file *file, const char *path, sb_error *error)
{
    *file = (sb_hashed_file){0};
    sb_status status = sb_file_open(path, "w", &file->file, error);
    if (status == SB_OK) status = make_stream(file, path, error);
    if (status != SB_OK) sb_hashed_close(file);
    return status;
}

sb_status sb_hashed_check(const char *path, uint64_t length, uint64_t hash, sb_error *error)
{
    sb_running_hash there;
    uint64_t found;
    FILE *file;
    sb_status status = sb_input_open(path, &file, error);
    if (status != SB_OK) return status;
    errno = 0;
    if (hash_start(file, length, &there, &found) != 0) status = cannot("read", path, SB_BAD_INPUT, error);
    fclose(file);
    if (status != SB_OK) return status;
    if (length == 0 || found < length)
        return sb_fail(error, SB_BAD_INPUT, "%.500s: has %llu bytes, expected the %llu that the checkpoint recorded",
                       path, (unsigned long long)found, (unsigned long long)length);
    if (sb_hash_sum(&there) != hash)
        return sb_fail(error, SB_BAD_INPUT,
                       "%.500s: was changed since the run wrote it, expected its first %llu bytes unchanged", path,
                       (unsigned long long)length);
    return SB_OK;
}

sb_status sb_hashed_resume(sb_hashed_file *file, const char *path, uint64_t length, sb_error *error)
{
    *file = (sb_hashed_file){0};
    sb_status status = sb_file_open(path, "r+", &file->file, error);
    if (status != SB_OK) return status;
    errno = 0;
    if (hash_start(file->file, length, &file->hash, &file->length) != 0)
        status = cannot("read", path, SB_FAILED, error);
    else if (file->length < length)
        status = sb_fail(error, SB_FAILED, "%.500s: became shorter than %llu bytes after it was checked", path,
                         (unsigned long long)length);
    else if (ftruncate(fileno(file->file), (off_t)length) != 0 || lseek(fileno(file->file), 0, SEEK_END) < 0)
        status = cannot("write", path, SB_FAILED, error);
    else
        status = make_stream(file, path, error);
    file->complete = length;
    if (status != SB_OK) sb_hashed_close(file);
    return status;
}

int sb_hashed_close(sb_hashed_file *file)
{
    int result = 0, reason = 0;
    if (file->stream && fclose(file->stream) != 0) {
        result = EOF;
        reason = errno;
    }
    if (file->failed) {
        result = EOF;
        reason = file->failed;
    }
    /* Shortening a file succeeds on a full disk. If it does not, the first reason is kept. */
    if (result != 0 && file->file && ftruncate(fileno(file->file), (off_t)file->complete) != 0 && reason == 0)
        reason = errno;
    if (file->file && fclose(file->file) != 0 && result == 0) {
        result = EOF;
        reason = errno;
    }
    file->stream = file->file = NULL;
    if (result != 0) errno = reason;
    return result;
}
