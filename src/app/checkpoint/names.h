/* The names of the files of checkpoints. Private to src/app. */
#ifndef SB_APP_CHECKPOINT_NAMES_H
#define SB_APP_CHECKPOINT_NAMES_H

#define SB_CHECKPOINT_KIND "SBSTATE" /* the first bytes of each file */
#define SB_CHECKPOINT_SUFFIX ".state"
#define SB_CHECKPOINT_SETTLING "settling" /* file and section of a state during settling */

#endif
