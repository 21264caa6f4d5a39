/* A text that identifies the numerics of a build. */
#ifndef SB_APP_BUILD_H
#define SB_APP_BUILD_H

enum { SB_BUILD_TEXT = 512 };

/* Writes one line: a hash of the sources that compute, the compiler, the kind of build, the mathematical library and
   the instruction set in use. Two programs with the same line compute the same bits. */
void sb_build_numerics(char text[SB_BUILD_TEXT]);

#endif
