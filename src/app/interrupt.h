/* Ctrl-C and SIGTERM as a wish that the run reads between steps. */
#ifndef SB_APP_INTERRUPT_H
#define SB_APP_INTERRUPT_H

/* From now on the two signals are only noted; a second one of the same kind ends the process at once. */
void sb_interrupt_watch(void);

/* The signal noted, or 0. */
int sb_interrupt_signal(void);

#endif
