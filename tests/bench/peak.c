/* peak.c - runs a command and prints the most memory that it had in use, in kB:
 *   peak FILE COMMAND... */
#include <stdio.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

int main(int argc, char **argv) {
  struct rusage usage;
  int status = 1;
  if (argc < 3) return 2;
  pid_t child = fork();
  if (child == 0) {
    execvp(argv[2], argv + 2);
    _exit(127);
  }
  FILE *out = fopen(argv[1], "w");
  if (child < 0 || !out || wait4(child, &status, 0, &usage) < 0) return 1;
  fprintf(out, "%ld\n", usage.ru_maxrss);
  return fclose(out) || status != 0;
}
