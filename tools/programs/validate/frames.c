#include "frames.h"

#include "base/file.h"
#include "output/vtp.h"

#include <stdio.h>
#include <unistd.h>

sb_status sb_run_frames(const sb_case_run *run, double first, double last,
                        void (*visit)(void *context, const sb_frame *frame), void *context, sb_error *error)
{
    char name[64], path[SB_PATH_MAX];
    size_t visited = 0;
    for (int i = 1;; i++) {
        sb_frame *frame = NULL;
        snprintf(name, sizeof name, "particles/%06d.vtp", i);
        sb_status status = sb_path_join(path, run->folder, name, error);
        if (status == SB_OK && access(path, R_OK) != 0) break;
        if (status == SB_OK) status = sb_vtp_read(path, &frame, error);
        if (status != SB_OK) return status;
        if (frame->status.time >= first && frame->status.time <= last) {
            visit(context, frame);
            visited++;
        }
        sb_frame_release(frame);
    }
    if (visited) return SB_OK;
    return sb_fail(error, SB_BAD_INPUT, "%.400s: no particle file between %g and %g s", run->folder, first, last);
}
