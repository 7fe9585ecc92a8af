/* claims.c - what sharing a folder costs: CPU microseconds a batch, of looking for those that are
 * there, claiming, looking once more, putting the batch there and giving the claim up.
 *
 * claims WORKERS BATCHES OUTPUT: so many processes share all the batches, which take no time, on
 * the empty folder OUTPUT.partial, each from a place of its own, as bake_order.c has it. */
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "batch/bake_claim.h"
#include "batch/bake_store.h"

/* As find_batch() in bake_run.c does it. */
static enum result share(const struct bake_store *store, int batch) {
  char key[33], text[16];
  int claim = BAKE_CLAIM_OTHERS;
  snprintf(text, sizeof text, "%d", batch);
  bake_store_key(key, text, NULL);
  char *path = bake_store_path(store, key);
  enum result result = path ? bake_worker_renew(store->worker, NULL) : RESULT_MEMORY;
  if (result == RESULT_OK && access(path, F_OK) != 0)
    result = bake_claim_take(store->worker, key, &claim, NULL);
  if (result == RESULT_OK && claim != BAKE_CLAIM_OTHERS) {
    if (access(path, F_OK) != 0 && mkdir(path, 0777) != 0) result = RESULT_IO;
    bake_claim_end(store->worker, key, claim);
  }
  free(path);
  return result;
}

static int work(int worker, int workers, int batches, const char *output) {
  struct bake_store store;
  bool good = bake_store_open(output, 1, &store, NULL) == RESULT_OK;
  for (int k = 0; k < batches && good; ++k)
    good = share(&store, (k + worker * batches / workers) % batches) == RESULT_OK;
  bake_store_close(&store, BAKE_STORE_KEPT);
  return good ? 0 : 1;
}

int main(int argc, char **argv) {
  int failed = argc < 4, workers = failed ? 0 : atoi(argv[1]), batches = failed ? 1 : atoi(argv[2]);
  for (int k = 0; k < workers; ++k)
    if (fork() == 0) _exit(work(k, workers, batches, argv[3]));
  for (int status; wait(&status) > 0;) failed |= status;
  struct rusage usage;
  getrusage(RUSAGE_CHILDREN, &usage);
  double seconds = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                   1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  printf("%.1f\n", 1e6 * seconds / batches);
  return failed ? 1 : 0;
}
