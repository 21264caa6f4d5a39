/* Files into which all ranks of one host write, by MPI-IO. Each rank opens the file on its own, so that no rank waits
   for another one within MPI, where its deadline would not count. */
#include "base/memory.h"
#include "mpi/parts.h"

#include <errno.h>
#include <string.h>

enum { PIECE = 1 << 30 }; /* bytes: the length of a write is an int */

/* errno for an error of MPI. Open MPI prints the system's reason, and returns only that there is one. */
static int reason_of(int code)
{
    static const struct {
        int class, reason;
    } reasons[] = {{MPI_ERR_NO_SPACE, ENOSPC},
                   {MPI_ERR_QUOTA, EDQUOT},
                   {MPI_ERR_READ_ONLY, EROFS},
                   {MPI_ERR_ACCESS, EACCES},
                   {MPI_ERR_NO_SUCH_FILE, ENOENT}};
    int class = MPI_ERR_IO;
    if (code == MPI_SUCCESS) return 0;
    MPI_Error_class(code, &class);
    for (size_t k = 0; k < sizeof reasons / sizeof *reasons; k++)
        if (reasons[k].class == class) return reasons[k].reason;
    return EIO;
}

int sb_world_open(sb_ranks *ranks, const char *path, void **file)
{
    /* Rank 0 writes the edges of ranges by the system's calls, into pages that other hosts may hold as well: not tried
       on a file system that hosts share. */
    if (sb_world_hosts(ranks) > 1) return ENOTSUP;
    MPI_File *opened = sb_alloc(1, sizeof *opened);
    if (!opened) return ENOMEM;
    const int reason = reason_of(MPI_File_open(MPI_COMM_SELF, path, MPI_MODE_WRONLY, MPI_INFO_NULL, opened));
    if (reason == 0)
        *file = opened;
    else
        sb_free(opened);
    return reason;
}

/* An error of the file system, such as EFBIG, may show as fewer bytes only. */
int sb_world_write_at(void *file, uint64_t at, const void *bytes, size_t size)
{
    for (size_t done = 0; done < size; done += PIECE) {
        const int length = (int)(size - done < PIECE ? size - done : PIECE);
        MPI_Status status;
        int written = 0;
        const int code = MPI_File_write_at(*(MPI_File *)file, (MPI_Offset)(at + done), (const char *)bytes + done,
                                           length, MPI_BYTE, &status);
        if (code != MPI_SUCCESS) return reason_of(code);
        MPI_Get_count(&status, MPI_BYTE, &written);
        if (written != length) return EIO;
    }
    return 0;
}

int sb_world_close(void *file)
{
    const int synced = reason_of(MPI_File_sync(*(MPI_File *)file));
    const int closed = reason_of(MPI_File_close(file));
    sb_free(file);
    return synced ? synced : closed;
}
