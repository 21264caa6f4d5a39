/* The commands: each takes what follows its name and returns the process's exit status. */
#ifndef SB_APP_COMMANDS_H
#define SB_APP_COMMANDS_H

int sb_command_run(int count, char **arguments);
int sb_command_check(int count, char **arguments);
int sb_command_sample(int count, char **arguments);
int sb_command_render(int count, char **arguments);
int sb_command_list(int count, char **arguments);

#endif
