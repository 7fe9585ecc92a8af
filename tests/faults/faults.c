/* faults.c - every command, with memory that runs out at the n-th allocation and disks that are
 * full from the n-th write on, or only at it. Whatever happens, a command either does all that
 * it does undisturbed, or fails: exit status 1 (only diff: 2), one line on stderr that begins with
 * its name, and each file as it was or whole; a bake then goes on to the same slab.
 *
 *   faults NAME...      the commands of faults_commands.h so called, or all of a program
 *
 * FAULTS is how many n are tried for each command and kind of fault, spread evenly (4); 0 tries
 * all. Commands that take long get fewer, or none.
 * BAKESLAB, RENDERSLAB and TOOLS (of this folder) are needed. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/files.h"
#include "export/export_folder.h"
#include "faults_commands.h"
#include "left.h"
#include "supervise.h"

enum kind {
  NO_FAULT,
  MEMORY_ONCE,
  MEMORY_GONE,
  DISK_ONCE,
  DISK_FULL,
  CHILD_DISK,
  CLOSED_PIPE,
  KINDS
};
static const char *const kind_names[KINDS] = {"none",
                                              "allocation",
                                              "allocation and all later ones",
                                              "write",
                                              "write and all later ones",
                                              "write of a child",
                                              "closed pipe"};

enum { MOST_WORDS = 40, SECONDS = 120 };

struct run {
  int status; /* exit status, -1 for a signal */
  long calls; /* that could fail */
  struct left left;
  char line[1024]; /* the first on stderr */
  int lines;       /* on stderr */
};

/* A folder is one that bakeslab export may replace. */
static const char old_content[] = "old content \"bakeslab \" \"export\"\n";
static char top[64]; /* of the test; holds in/, run/, out, err, calls */
static long faults_tried, faults_told, faults_of_jansson;

static void must(bool done, const char *what) {
  if (done) return;
  printf("Bail out! %s: %s\n", what, strerror(errno));
  exit(1);
}

/* The command's words; programs by the environment's paths. */
static void split(const char *text, char *room, char *argv[MOST_WORDS]) {
  int count = 0;
  strcpy(room, text);
  for (char *word = strtok(room, " "); word && count < MOST_WORDS - 1; word = strtok(NULL, " "))
    argv[count++] = word;
  argv[count] = NULL;
  argv[0] = getenv(strncmp(text, "bakeslab ", 9) ? "RENDERSLAB" : "BAKESLAB");
}

static void read_lines(struct run *run) {
  FILE *file = fopen("../err", "re");
  char line[sizeof run->line];
  run->lines = 0;
  *run->line = 0;
  while (file && fgets(line, sizeof line, file)) {
    if (!run->lines++) strcpy(run->line, line);
  }
  run->line[strcspn(run->line, "\n")] = 0;
  if (file) fclose(file);
}

static long told_calls(void) {
  long calls = 0;
  FILE *file = fopen("../calls", "re");
  if (file && fscanf(file, "%ld", &calls) != 1) calls = 0;
  if (file) fclose(file);
  return calls;
}

/* Runs a command in the run folder as it is. */
static struct run run_once(const struct faults_command *command, enum kind kind, long number) {
  char words[1024], *argv[MOST_WORDS], text[32];
  bool memory = kind == MEMORY_ONCE || kind == MEMORY_GONE;
  split(command->line, words, argv);
  struct supervised program = {.argv = argv,
                               .in = command->in,
                               .out = "../out",
                               .err = "../err",
                               .closed_pipe = kind == CLOSED_PIPE,
                               .of_children = kind == CHILD_DISK,
                               .renames_too = !command->together,
                               .seconds = SECONDS};
  if (kind == DISK_ONCE || kind == DISK_FULL || kind == CHILD_DISK) {
    program.fail_from = number;
    program.fail_to = kind == DISK_ONCE ? number : 1 << 30;
  }
  if (memory) {
    snprintf(text, sizeof text, "%ld%s", number, kind == MEMORY_GONE ? "+" : "");
    setenv("FAULT_MALLOC", text, 1);
    setenv("LD_PRELOAD", "../nomem.so", 1);
  }
  unlink("../calls");
  struct outcome outcome = supervise(&program);
  unsetenv("LD_PRELOAD");
  struct run run = {.calls = memory ? told_calls() : outcome.calls,
                    .left = left_look("../out", command->timed)};
  run.status = WIFEXITED(outcome.status) && !outcome.timeout ? WEXITSTATUS(outcome.status) : -1;
  read_lines(&run);
  return run;
}

static void make_old(const char *name) {
  const char *folder = ".", *file = name;
  if (name[strlen(name) - 1] == '/') {
    must(mkdir(name, 0777) == 0, name);
    folder = name;
    file = export_folder_mark;
  }
  must(files_write(folder, file, old_content, NULL) == RESULT_OK, name);
}

/* An empty run folder; with old files of the names of the outputs, or without. */
static void clear(const struct faults_command *command, bool old) {
  char names[256];
  must(chdir(top) == 0, top);
  files_remove_tree("run");
  must(mkdir("run", 0777) == 0 && chdir("run") == 0, "run");
  snprintf(names, sizeof names, "%s", command->outputs ? command->outputs : "");
  for (char *name = strtok(names, " "); old && name; name = strtok(NULL, " ")) make_old(name);
}

/* jansson 2.14 aborts by itself where the buffer of a word cannot grow: an assertion in load.c,
 * or what is left of its text without memory. It is jansson's to mend. */
static bool is_jansson(const struct run *run) {
  return run->status < 0 &&
         (strstr(run->line, "load.c:") || !strcmp(run->line, "Unexpected error."));
}

/* Why a run under a fault was not as it must be, or NULL. */
static const char *judge(const struct faults_command *command, const struct run *run,
                         const struct left *before, const struct run *whole) {
  char name[16];
  snprintf(name, sizeof name, "%.*s: ", (int)strcspn(command->line, " "), command->line);
  if (is_jansson(run) && left_is_old_or_new(&run->left, before, &whole->left, false)) return NULL;
  if (run->status < 0) return "crashed or did not end";
  if (run->status == 0) {
    if (!left_is_same(&run->left, &whole->left)) return "succeeded with other files";
    return run->left.output == whole->left.output ? NULL : "succeeded with another output";
  }
  if (run->status != (command->fails_with ? command->fails_with : 1))
    return "has another exit status";
  if (!left_is_old_or_new(&run->left, before, &whole->left, command->together))
    return "failed, and left files that are neither old nor whole";
  if (run->lines != 1) return "did not say one line";
  return strncmp(run->line, name, strlen(name)) ? "did not begin with its name" : NULL;
}

/* What was interrupted goes on. */
static const char *go_on(const struct faults_command *command, const struct run *whole) {
  struct run run = run_once(command, NO_FAULT, 0);
  if (run.status != 0 || !left_is_same(&run.left, &whole->left))
    return "does not go on to the same slab";
  return NULL;
}

static bool try_fault(const struct faults_command *command, enum kind kind, long number,
                      const struct run *whole) {
  clear(command, number % 2 != 0);
  struct left before = left_look("../out", command->timed);
  struct run run = run_once(command, kind, number);
  const char *wrong = judge(command, &run, &before, whole);
  ++faults_tried;
  faults_told += run.status != 0;
  faults_of_jansson += is_jansson(&run);
  if (!wrong && command->goes_on && run.status) wrong = go_on(command, whole);
  if (wrong)
    printf("# %s: %s %ld: %s (status %d, %d lines: %s)\n", command->name, kind_names[kind], number,
           wrong, run.status, run.lines, run.line);
  return !wrong;
}

/* Tries `most` numbers of a kind, from 1 to the last call that there is. */
static int try_kind(const struct faults_command *command, enum kind kind, long most,
                    const struct run *whole) {
  int failures = 0;
  clear(command, false);
  struct run count = run_once(command, kind, kind == CLOSED_PIPE ? 0 : 1 << 30);
  if (kind == CLOSED_PIPE) return whole->left.output && !try_fault(command, kind, 0, whole);
  if (count.status != 0) {
    printf("# %s: fails without a fault: %s\n", command->name, count.line);
    return 1;
  }
  long tries = most > 0 && most < count.calls ? most : count.calls;
  for (long k = 0; k < tries; ++k)
    failures += !try_fault(command, kind, 1 + k * count.calls / tries, whole);
  return failures;
}

static int try_command(const struct faults_command *command, long most) {
  int failures = 0;
  clear(command, false);
  struct run whole = run_once(command, NO_FAULT, 0);
  if (whole.status != 0) {
    printf("# %s: fails without a fault: %s\n", command->name, whole.line);
    return 1;
  }
  setenv("FAULT_PROGRAM", strncmp(command->line, "bakeslab", 8) ? "renderslab" : "bakeslab", 1);
  /* Sanitizers have an allocator of their own, which nothing may be preloaded before. */
  const char *config = getenv("CONFIG");
  bool own = config && (!strcmp(config, "sanitize") || !strcmp(config, "thread"));
  for (enum kind kind = own || command->driver ? DISK_ONCE : MEMORY_ONCE; kind < KINDS; ++kind)
    if (kind != CHILD_DISK || command->children) failures += try_kind(command, kind, most, &whole);
  return failures;
}

/* Copies of what the commands read. */
static void prepare(void) {
  const char *temporary = getenv("TMPDIR"), *tools = getenv("TOOLS");
  char line[4096];
  snprintf(top, sizeof top, "%s/faults.XXXXXX", temporary ? temporary : "/tmp");
  must(tools && mkdtemp(top), "TOOLS, and a folder for temporary files");
  snprintf(line, sizeof line,
           "mkdir %s/in && cp tests/fuzz/seeds/tiff/little.tif tests/faults/in/* %s/in && "
           "cp %s/nomem.so %s/fake_povray %s && cd %s/in && "
           "\"$BAKESLAB\" include little.tif --name lamp -o little.inc 2>/dev/null",
           top, top, tools, tools, top, top);
  must(system(line) == 0, line);
  setenv("FAULT_TELL", "../calls", 1);
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); /* files of the driver's own */
}

int main(int argc, char **argv) {
  const char *text = getenv("FAULTS");
  long most = text ? atol(text) : 4;
  int number = 0, all = 0;
  prepare();
  struct supervised nothing = {.argv = (char *[]){"/bin/true", NULL},
                               .out = "/dev/null",
                               .err = "/dev/null",
                               .seconds = SECONDS};
  bool no_means = supervise(&nothing).no_means;
  for (size_t k = 0; k < faults_command_count; ++k) {
    const struct faults_command *command = &faults_commands[k];
    bool wanted = argc < 2;
    for (int n = 1; n < argc; ++n)
      wanted |= !strcmp(argv[n], command->name) ||
                !strncmp(argv[n], command->line, strcspn(command->line, " "));
    if (!wanted) continue;
    if (most > 0 && most < command->cost) {
      printf("# %s takes long: only with FAULTS=%d and more\n", command->name, command->cost);
      continue;
    }
    int failures = no_means ? 0 : try_command(command, command->cost ? most / command->cost : most);
    all += failures;
    printf("%sok %d - %s%s\n", failures ? "not " : "", ++number, command->name,
           no_means ? " # SKIP seccomp cannot ask here" : "");
    fflush(stdout);
  }
  printf("1..%d\n# %ld faults, %ld of them told, %ld aborted by jansson, %d failures\n", number,
         faults_tried, faults_told, faults_of_jansson, all);
  must(chdir("/") == 0, "/");
  files_remove_tree(top);
  return all > 0;
}
