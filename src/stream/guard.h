/* Runs a subscriber in a child process that is restarted when it crashes. LCM assembles messages from several packets
   in a thread of its own, and at least versions up to 1.3.1 do not check the offset that a packet states: two forged
   packets can crash the process. */
#ifndef SB_STREAM_GUARD_H
#define SB_STREAM_GUARD_H

/* Runs work(argument) in a child process, and again after each crash; after_crash is called first, to inform the user
   and to restore the terminal. SIGINT, SIGTERM and SIGHUP are forwarded to the child. Returns the exit code of the last
   child. If no child can be created, the work runs in this process, and its exit code is returned. */
int sb_guard(int (*work)(void *), void *argument, void (*after_crash)(void));

#endif
