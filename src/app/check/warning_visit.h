/* What is called for each warning about a scene, a line without its newline. */
#ifndef SB_APP_WARNING_VISIT_H
#define SB_APP_WARNING_VISIT_H

typedef void sb_warning_visit(void *context, const char *text);

#endif
