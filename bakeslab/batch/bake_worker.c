#include "batch/bake_worker.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/files.h"
#include "base/progress.h"

static const char mark[] = "worker.", no_plan[] = "00000000000000000000000000000000";

static double seconds(struct timespec time) {
  return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* ---- Processes of this machine ---- */

/* The first word of a file, or "-". */
static void read_word(const char *folder, const char *name, char *word, size_t size) {
  char *text = files_read(folder, name);
  snprintf(word, size, "%.*s", text ? (int)strcspn(text, " \n") : 1, text ? text : "-");
  free(text);
}

static void name_machine(char machine[BAKE_WORKER_MACHINE]) {
  char boot[48], space[32] = "-";
  read_word("/proc/sys/kernel/random", "boot_id", boot, sizeof boot);
  ssize_t length = readlink("/proc/self/ns/pid", space, sizeof space - 1);
  if (length > 0) space[length] = 0;
  snprintf(machine, BAKE_WORKER_MACHINE, "%s/%s", boot, space);
}

/* When a process began, the 22nd field of its stat; 0 where it has ended, or none is told. */
static unsigned long long find_start(long pid) {
  char folder[32], state = 'Z';
  unsigned long long start = 0;
  snprintf(folder, sizeof folder, "/proc/%ld", pid);
  char *text = files_read(folder, "stat");
  const char *rest = text ? strrchr(text, ')') : NULL; /* the program's name may hold blanks */
  if (rest)
    sscanf(rest,
           ") %c %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %llu",
           &state, &start);
  free(text);
  return state == 'Z' || state == 'X' ? 0 : start;
}

/* Whether a worker ran on this machine and has ended; nothing is known of others. */
static bool has_ended(const struct bake_worker_name *name) {
  char machine[BAKE_WORKER_MACHINE];
  name_machine(machine);
  if (strcmp(machine, name->machine) != 0 || name->pid < 1) return false;
  if (kill((pid_t)name->pid, 0) != 0 && errno == ESRCH) return true;
  return name->start > 0 && find_start(getpid()) > 0 && find_start(name->pid) != name->start;
}

/* ---- One's own file ---- */

static enum result fail(const struct bake_worker *worker, struct error *error) {
  int reason = errno;
  if (reason == ENOENT || reason == ESTALE)
    return result_fail(error, RESULT_IO,
                       "%s: was removed, as by others after an hour without a sign of this "
                       "process; run the same command again",
                       worker->path);
  return result_fail(error, RESULT_IO, "%s: %s", worker->path, strerror(reason));
}

/* Always of the same length. Closes the file. */
static bool write_name(int file, const struct bake_worker_name *name) {
  bool written = dprintf(file, "%s\n%s\n%s\n%s\n%ld %llu %d\n", name->id, name->host, name->machine,
                         name->plan, name->pid, name->start, name->jobs) > 0;
  return (close(file) == 0) & written;
}

static enum result read_clock(struct bake_worker *worker, struct error *error) {
  struct stat status;
  if (stat(worker->path, &status) != 0) return fail(worker, error);
  worker->file = status.st_ino;
  worker->time = seconds(status.st_mtim);
  worker->renewed = progress_now();
  return RESULT_OK;
}

/* Once it says who it is, it gets its name: who is killed before is no worker. */
static bool appear(const char *folder, int file, struct bake_worker *worker) {
  char name[16];
  snprintf(name, sizeof name, "%s%s", mark, worker->name.id);
  if (!write_name(file, &worker->name)) return false;
  char *path = files_join(folder, name);
  bool named = path && rename(worker->path, path) == 0;
  if (!named) unlink(worker->path);
  free(worker->path);
  worker->path = path;
  return named;
}

static void introduce(struct bake_worker *worker) {
  struct bake_worker_name *name = &worker->name;
  memcpy(name->id, worker->path + strlen(worker->path) - 6, sizeof name->id);
  if (gethostname(name->host, sizeof name->host - 1) != 0 || !name->host[0])
    snprintf(name->host, sizeof name->host, "localhost");
  name_machine(name->machine);
  memcpy(name->plan, no_plan, sizeof name->plan);
  name->start = find_start(getpid());
}

enum result bake_worker_join(const char *folder, int jobs, struct bake_worker *worker,
                             bool *missing, struct error *error) {
  *worker = (struct bake_worker){.name = {.jobs = jobs, .pid = getpid()},
                                 .path = files_join(folder, "scratch.XXXXXX"),
                                 .lock = PTHREAD_MUTEX_INITIALIZER};
  if (!worker->path) return result_no_memory(error);
  int file = mkostemp(worker->path, O_CLOEXEC);
  if (file >= 0) introduce(worker);
  bool joined = file >= 0 && appear(folder, file, worker) && read_clock(worker, NULL) == RESULT_OK;
  *missing = !joined && errno == ENOENT; /* the folder, or only the file, which others removed */
  if (joined) return RESULT_OK;
  enum result result =
      result_fail(error, RESULT_IO, "%s: cannot be written to: %s", folder, strerror(errno));
  bake_worker_leave(worker);
  return result;
}

enum result bake_worker_tell_plan(struct bake_worker *worker, const char *plan,
                                  struct error *error) {
  snprintf(worker->name.plan, sizeof worker->name.plan, "%s", plan);
  int file = open(worker->path, O_WRONLY | O_CLOEXEC); /* in place: claims are links to it */
  return file >= 0 && write_name(file, &worker->name) ? RESULT_OK : fail(worker, error);
}

enum result bake_worker_renew(struct bake_worker *worker, struct error *error) {
  enum result result = RESULT_OK;
  pthread_mutex_lock(&worker->lock);
  if (progress_now() - worker->renewed >= BAKE_WORKER_RENEWAL) {
    /* Without a time: NFS servers then take their own. */
    result = utimensat(AT_FDCWD, worker->path, NULL, 0) == 0 ? read_clock(worker, error)
                                                             : fail(worker, error);
  }
  pthread_mutex_unlock(&worker->lock);
  return result;
}

double bake_worker_now(struct bake_worker *worker) {
  pthread_mutex_lock(&worker->lock);
  double now = worker->time + progress_now() - worker->renewed;
  pthread_mutex_unlock(&worker->lock);
  return now;
}

bool bake_worker_hold(struct bake_worker *worker, const char *key) {
  pthread_mutex_lock(&worker->lock);
  size_t count = (size_t)worker->held_count;
  bool free_yet = true;
  for (size_t n = 0; n < count; ++n) free_yet &= strcmp(worker->held[n], key) != 0;
  char(*grown)[BAKE_WORKER_KEY] =
      free_yet ? realloc(worker->held, (count + 1) * sizeof *worker->held) : NULL;
  if (grown) {
    worker->held = grown;
    snprintf(grown[worker->held_count++], BAKE_WORKER_KEY, "%s", key);
  }
  pthread_mutex_unlock(&worker->lock);
  return grown != NULL;
}

void bake_worker_let_go(struct bake_worker *worker, const char *key) {
  pthread_mutex_lock(&worker->lock);
  for (int n = 0; n < worker->held_count; ++n)
    if (!strcmp(worker->held[n], key))
      memmove(worker->held[n], worker->held[--worker->held_count], BAKE_WORKER_KEY);
  pthread_mutex_unlock(&worker->lock);
}

double bake_worker_clock(const char *folder) {
  struct timespec now = {.tv_sec = time(NULL)}; /* of a folder that cannot be written to */
  char *path = files_join(folder, "scratch.clock.XXXXXX");
  int file = path ? mkostemp(path, O_CLOEXEC) : -1;
  struct stat status;
  if (file >= 0 && fstat(file, &status) == 0) now = status.st_mtim;
  if (file >= 0) close(file);
  if (file >= 0) unlink(path);
  free(path);
  return seconds(now);
}

void bake_worker_leave(struct bake_worker *worker) {
  if (worker->path) unlink(worker->path);
  free(worker->path);
  free(worker->held);
  *worker = (struct bake_worker){0};
}

/* ---- Others ---- */

bool bake_worker_look(const char *path, double now, struct bake_worker_seen *seen) {
  char text[512] = "";
  struct stat status;
  struct bake_worker_name name = {0};
  *seen = (struct bake_worker_seen){0};
  int file = open(path, O_RDONLY | O_CLOEXEC); /* which makes NFS ask for the time anew */
  bool there = file >= 0 && fstat(file, &status) == 0;
  if (there && read(file, text, sizeof text - 1) > 0 &&
      sscanf(text, "%6s %64s %95s %32s %ld %llu %d", name.id, name.host, name.machine, name.plan,
             &name.pid, &name.start, &name.jobs) == 7)
    seen->name = name;
  if (file >= 0) close(file);
  if (!there) return false;
  seen->age = now - seconds(status.st_mtim);
  seen->file = status.st_ino;
  bool ended = has_ended(&seen->name);
  seen->dead = ended || seen->age > BAKE_WORKER_LEASE;
  seen->forgotten = ended || seen->age > BAKE_WORKER_FORGOTTEN;
  return true;
}

enum result bake_worker_list(const char *folder, double now, struct bake_worker_seen **list,
                             int *count, struct error *error) {
  *list = NULL;
  *count = 0;
  DIR *directory = opendir(folder);
  if (!directory) return result_fail(error, RESULT_IO, "%s: %s", folder, strerror(errno));
  enum result result = RESULT_OK;
  for (struct dirent *entry; result == RESULT_OK && (entry = readdir(directory));) {
    if (strncmp(entry->d_name, mark, strlen(mark)) != 0) continue;
    struct bake_worker_seen *grown = realloc(*list, (size_t)(*count + 1) * sizeof *grown);
    if (grown) *list = grown;
    char *path = files_join(folder, entry->d_name);
    if (!grown || !path)
      result = result_no_memory(error);
    else
      *count += bake_worker_look(path, now, &grown[*count]);
    free(path);
  }
  closedir(directory);
  return result;
}
