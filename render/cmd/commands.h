/* commands.h - renderslab's subcommands, each in its own cmd_NAME.c, for the table in main.c. */
#ifndef COMMANDS_H
#define COMMANDS_H

int cmd_image(int argc, char **argv);
int cmd_irradiance(int argc, char **argv);
int cmd_join(int argc, char **argv);
int cmd_pov(int argc, char **argv);
int cmd_tradeoff(int argc, char **argv);
int cmd_view(int argc, char **argv);

#endif
