/* Where figures come from: the source's commit and the machine. */
#ifndef SB_VALIDATION_ORIGIN_H
#define SB_VALIDATION_ORIGIN_H

/* The commit of the source tree, with -dirty behind it when files differ; "unknown" where git
 * cannot tell. */
void sb_origin_commit(const char *source, char commit[64]);
/* Processor and number of cores. */
void sb_origin_machine(char machine[128]);

#endif
