/* The commands. Each takes the arguments after its name and returns the exit status of the process. */
#ifndef SB_APP_COMMANDS_H
#define SB_APP_COMMANDS_H

int sb_command_run(int count, char **arguments);
int sb_command_check(int count, char **arguments);
int sb_command_sample(int count, char **arguments);
int sb_command_preview(int count, char **arguments);
int sb_command_render(int count, char **arguments);
int sb_command_report(int count, char **arguments);
int sb_command_compare(int count, char **arguments);
int sb_command_surface(int count, char **arguments);
int sb_command_replay(int count, char **arguments);
int sb_command_list(int count, char **arguments);

#endif
