/* The rule for names of bodies, wave makers, gauges and other items of a scene, and of the parts of a mesh. Names are
   used in tables, file names, channel names and terminal output. */
#ifndef SB_SCENE_NAME_H
#define SB_SCENE_NAME_H

#include <stdbool.h>
#include <stddef.h>

/* The allowed characters: letters, digits, "_", "." and "-". */
extern const char sb_name_letters[];

/* Replaces each character that is not allowed, and a dot or dash at the start, by "_". Removes blanks at both ends.
   Returns whether a character was replaced. */
bool sb_name_fit(char *name);

/* Copies the name in ASCII for a message: bytes that are not printable, quotes and backslashes become "\xe2" and so on.
   The text is cut at `room` bytes, which must be 16 or more. */
void sb_name_escape(const char *name, char *to, size_t room);

#endif
