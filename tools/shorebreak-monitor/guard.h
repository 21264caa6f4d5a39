/* LCM puts messages of several packets together in a thread of its own, and versions up to 1.3.1 at least take a
   packet's word for where its bytes belong: a stranger's two packets end the process. So the watching is done in a
   child. */
#ifndef SB_MONITOR_GUARD_H
#define SB_MONITOR_GUARD_H

/* Runs work(argument) in a child process, anew each time a crash ends it; after_crash then tells the user and mends the
   terminal. Signals that ask for an end reach the child. The exit code of the last child; without a process to be had
   that of the work done here. */
int sb_guard(int (*work)(void *), void *argument, void (*after_crash)(void));

#endif
