/* Agreement of the ranks of a run on a failure. */
#ifndef SB_BASE_AGREE_H
#define SB_BASE_AGREE_H

#include "base/ranks.h"
#include "base/status.h"

/* Gives all ranks the same failure: that of the first rank that has one with a message, else of the first that has one.
   All ranks call it with their own status. On one rank the status stays. */
sb_status sb_ranks_agree(sb_ranks *ranks, sb_status own, sb_error *error);

#endif
