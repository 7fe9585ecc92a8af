/* bake_worker.h - the processes at work in a folder that they share, on one machine or over NFS.
 *
 * Each has a file there, `worker.XXXXXX`, that says who it is. Its time of modification, renewed
 * now and then, is the lease of all that the process claims (bake_claim.h): claims are links to the
 * file. Time is the folder's own, which its file system gives to what is written there, so that
 * clocks of machines may differ. A worker is dead where its lease is over, or at once where it ran
 * on this machine and is no more. */
#ifndef BAKE_WORKER_H
#define BAKE_WORKER_H

#include <pthread.h>
#include <stdbool.h>
#include <sys/types.h>

#include "base/result.h"

/* Seconds: a lease; after how many it is renewed; without a sign, after which its files go. */
enum { BAKE_WORKER_LEASE = 60, BAKE_WORKER_RENEWAL = 5, BAKE_WORKER_FORGOTTEN = 3600 };

enum { BAKE_WORKER_ID = 7, BAKE_WORKER_HOST = 65, BAKE_WORKER_MACHINE = 96, BAKE_WORKER_KEY = 33 };

/* What its file says. */
struct bake_worker_name {
  char id[BAKE_WORKER_ID]; /* the X of the file's name */
  char host[BAKE_WORKER_HOST];
  char machine[BAKE_WORKER_MACHINE]; /* this boot of it, and its space of process numbers */
  char plan[BAKE_WORKER_KEY];        /* key of what it bakes; or of 0 only, while that is open */
  long pid;
  unsigned long long start; /* of the process, in ticks since the boot */
  int jobs;
};

/* Threads share one; its functions may be called by several at once, but for joining and leaving.
 */
struct bake_worker {
  struct bake_worker_name name;
  char *path;                    /* owned */
  ino_t file;                    /* number of its inode */
  pthread_mutex_t lock;          /* for all that follows */
  double time;                   /* of the folder, at the last renewal */
  double renewed;                /* the same moment by progress_now() */
  char (*held)[BAKE_WORKER_KEY]; /* [held_count]: what its threads have claimed; owned */
  int held_count;
};

/* Makes the file. ENOENT in *missing: the folder is not there (any more). Free with
 * bake_worker_leave in any case. */
enum result bake_worker_join(const char *folder, int jobs, struct bake_worker *worker,
                             bool *missing, struct error *error);
/* Tells others what it bakes: 32 digits. */
enum result bake_worker_tell_plan(struct bake_worker *worker, const char *plan,
                                  struct error *error);
/* Renews the lease when it is time to. Fails where the file is gone. */
enum result bake_worker_renew(struct bake_worker *worker, struct error *error);
/* The folder's time. */
double bake_worker_now(struct bake_worker *worker);
/* The same for who does not work there, by a file that is made and removed. */
double bake_worker_clock(const char *folder);
/* Notes that a thread claims a key; false where one has it already, or there is no memory. */
bool bake_worker_hold(struct bake_worker *worker, const char *key);
void bake_worker_let_go(struct bake_worker *worker, const char *key);
/* Removes the file. */
void bake_worker_leave(struct bake_worker *worker);

struct bake_worker_seen {
  struct bake_worker_name name; /* empty where it is just being written */
  double age;                   /* seconds since it was renewed */
  ino_t file;
  bool dead;
  bool forgotten; /* dead for sure, or for long */
};

/* Looks at a worker's file, or a claim; false where there is none. */
bool bake_worker_look(const char *path, double now, struct bake_worker_seen *seen);

/* All files of workers in a folder; the caller frees the list. */
enum result bake_worker_list(const char *folder, double now, struct bake_worker_seen **list,
                             int *count, struct error *error);

#endif
