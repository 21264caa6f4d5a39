#include "base/agree.h"

#include <string.h>

sb_status sb_ranks_agree(sb_ranks *ranks, sb_status own, sb_error *error)
{
    typedef struct outcome {
        int32_t status;
        bool explained;
    } outcome;
    if (!sb_ranks_several(ranks)) return own;
    const outcome here = {(int32_t)own, own != SB_OK && error && error->text[0]};
    outcome all[SB_RANKS_MAX];
    int first = -1;
    sb_ranks_gather(ranks, &here, sizeof here, all);
    for (int r = ranks->count - 1; r >= 0; r--)
        if (all[r].status != SB_OK && (first < 0 || all[r].explained || !all[first].explained)) first = r;
    if (first < 0) return SB_OK;
    char text[sizeof error->text] = {0};
    if (first == ranks->rank && error) memcpy(text, error->text, sizeof text);
    sb_ranks_share(ranks, first, text, sizeof text);
    text[sizeof text - 1] = 0;
    return sb_fail(error, (sb_status)all[first].status, "%s", text);
}
