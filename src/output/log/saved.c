#include "output/log/saved.h"

#include <string.h>

sb_saved sb_saved_sum(const sb_skipped *const *lists, size_t count, const sb_stage_time *stages, size_t stage_count)
{
    sb_saved saved = {.passes = 0};
    for (size_t l = 0; l < count; l++)
        for (const sb_skipped *of = lists[l]; of && of->what; of++) {
            saved.passes += of->passes;
            saved.bytes += of->bytes;
        }
    for (size_t s = 0; s < stage_count; s++)
        if (strcmp(stages[s].name, "source") == 0) saved.seconds = saved.passes * stages[s].seconds;
    return saved;
}
