#include "frames.h"

#include "base/file.h"
#include "output/particles/vtp.h"

#include <stdio.h>
#include <unistd.h>

void sb_run_frames(const sb_case_run *run, double first, double last,
                   void (*visit)(void *context, const sb_frame *frame), void *context)
{
    char name[64], path[SB_PATH_MAX];
    size_t visited = 0;
    for (int i = 1; run->error->status == SB_OK; i++) {
        sb_frame *frame = NULL;
        snprintf(name, sizeof name, "particles/%06d.vtp", i);
        if (sb_path_join(path, run->folder, name, run->error) != SB_OK || access(path, R_OK) != 0) break;
        if (sb_vtp_read(path, &frame, run->error) != SB_OK) break;
        if (frame->status.time >= first && frame->status.time <= last) {
            visit(context, frame);
            visited++;
        }
        sb_frame_release(frame);
    }
    if (!visited && run->error->status == SB_OK)
        sb_fail(run->error, SB_BAD_INPUT, "%.400s: no particle file between %g and %g s", run->folder, first, last);
}
