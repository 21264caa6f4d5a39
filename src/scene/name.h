/* The rule for names: of a scene's bodies, wave makers, gauges, and of the parts of a mesh. A name becomes a field of a
   table, a file, a channel, and text on a terminal. */
#ifndef SB_SCENE_NAME_H
#define SB_SCENE_NAME_H

#include <stdbool.h>
#include <stddef.h>

/* Letters, digits, "_", "." and "-". */
extern const char sb_name_letters[];

/* Puts "_" for each character that the rule excludes, and for a dot or dash that is the first; blanks at both ends go.
   Whether a character was replaced. */
bool sb_name_fit(char *name);

/* The text in ASCII, for a message about a name: what is not printable, a quote or a backslash as "\xe2". Cut at the
   room, which is 16 or more. */
void sb_name_escape(const char *name, char *to, size_t room);

#endif
