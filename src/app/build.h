/* What one build's numerics are told from another's by. */
#ifndef SB_APP_BUILD_H
#define SB_APP_BUILD_H

enum { SB_BUILD_TEXT = 512 };

/* A hash of the sources that compute, compiler, kind of build, mathematical library and the instruction set in use, as
   one line: two programs for which it is the same give the same bits. */
void sb_build_numerics(char text[SB_BUILD_TEXT]);

#endif
