/* The depth-averaged model's state in checkpoints. */
#ifndef SB_OFFSHORE_SAVE_H
#define SB_OFFSHORE_SAVE_H

#include "base/archive.h"
#include "offshore/offshore.h"

/* Writes what the model's next steps depend on, into the open section. */
void sb_offshore_save(const sb_offshore *offshore, sb_archive_out *out);
/* Reads it into a model of the same options, which then continues with the same bits. Impossible values are refused. */
void sb_offshore_load(sb_offshore *offshore, sb_archive_in *in);
/* Continues a hash with the water of all cells and the time. */
uint64_t sb_offshore_hash(const sb_offshore *offshore, uint64_t hash);

#endif
