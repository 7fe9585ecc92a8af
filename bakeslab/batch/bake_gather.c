/* bake_gather.c - see bake_gather.h.
 *
 * 1. All folders, and the one that they are to go into, are of the same plan (bake_ledger.h).
 * 2. Each batch is read: its frames are there, of the size that its render.ini asks for.
 * 3. It is copied to a scratch folder, and moved in place when it is whole; or compared with what
 * is there, pixel by pixel.
 * 4. So are the lists of rounds. */
#include "batch/bake_gather.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/files.h"
#include "batch/bake_claim.h"

/* ---- 2. Batches ---- */

static int number_after(const char *text, const char *key) {
  const char *at = strstr(text, key);
  return at ? atoi(at + strlen(key)) : 0;
}

/* The frames that a batch must have. */
static enum result find_frames(const char *directory, struct povray_job *job, struct error *error) {
  char *text = files_read(directory, "render.ini");
  *job = (struct povray_job){.directory = directory};
  if (text) {
    job->width = number_after(text, "\nWidth=");
    job->height = number_after(text, "\nHeight=");
    job->frames = number_after(text, "\nFinal_Frame=");
    if (job->frames == 0) job->frames = 1; /* a still */
  }
  free(text);
  if (job->width > 0 && job->height > 0 && job->frames > 0) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s: render.ini is missing or cut off", directory);
}

static bool is_finite(const struct picture *picture) {
  size_t count = 3 * (size_t)picture->width * (size_t)picture->height;
  for (size_t n = 0; n < count; ++n)
    if (!isfinite(picture->rgb[n])) return false;
  return true;
}

/* Reads a batch; *same: whether `other`, or NULL, has the same pixels. */
static enum result read_batch(const char *directory, const char *other, bool *same,
                              struct error *error) {
  struct povray_job job, second = {0};
  enum result result = find_frames(directory, &job, error);
  *same = true;
  if (result == RESULT_OK && other) *same = find_frames(other, &second, NULL) == RESULT_OK;
  *same &= !other || (second.width == job.width && second.height == job.height &&
                      second.frames == job.frames);
  for (int frame = 0; frame < job.frames && result == RESULT_OK; ++frame) {
    struct picture one = {0}, two = {0};
    result = povray_read_frame(&job, frame, &one, error);
    if (result == RESULT_OK && !is_finite(&one))
      result = result_fail(error, RESULT_BAD, "%s: has numbers that are not finite", directory);
    if (result == RESULT_OK && other && *same)
      *same = povray_read_frame(&second, frame, &two, NULL) == RESULT_OK &&
              memcmp(one.rgb, two.rgb,
                     3 * sizeof *one.rgb * (size_t)job.width * (size_t)job.height) == 0;
    picture_free(&one);
    picture_free(&two);
  }
  return result;
}

/* ---- 3. Copies ---- */

static enum result copy_file(const char *from, const char *to, struct error *error) {
  char block[1 << 16];
  ssize_t got = -1;
  int in = open(from, O_RDONLY | O_CLOEXEC);
  int out = in < 0 ? -1 : open(to, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (in < 0) {
    return result_fail(error, RESULT_IO, "%s: %s", from, strerror(errno));
  }
  while (out >= 0 && (got = read(in, block, sizeof block)) > 0)
    for (ssize_t put = 0, n; got > 0 && put < got; put += n)
      if ((n = write(out, block + put, (size_t)(got - put))) < 0) n = 0, got = -1;
  int reason = errno;
  close(in);
  if (out >= 0 && close(out) != 0) got = -1, reason = errno;
  if (out >= 0 && got == 0) return RESULT_OK;
  return result_fail(error, RESULT_IO, "%s: %s", to, strerror(reason));
}

/* The files of a folder, but links, which lead to the lamp's machine. */
static enum result copy_files(const char *from, const char *to, struct error *error) {
  DIR *list = opendir(from);
  enum result result = RESULT_OK;
  if (!list) return result_fail(error, RESULT_IO, "%s: %s", from, strerror(errno));
  for (struct dirent *entry; result == RESULT_OK && (entry = readdir(list));) {
    struct stat status;
    char *source = files_join(from, entry->d_name), *target = files_join(to, entry->d_name);
    if (!source || !target)
      result = result_no_memory(error);
    else if (lstat(source, &status) == 0 && S_ISREG(status.st_mode))
      result = copy_file(source, target, error);
    free(source);
    free(target);
  }
  closedir(list);
  return result;
}

static enum result copy_batch(const struct bake_store *store, const char *from, const char *key,
                              struct error *error) {
  char *scratch = NULL;
  enum result result = bake_store_scratch(store, key, &scratch, error);
  if (result == RESULT_OK) result = copy_files(from, scratch, error);
  if (result == RESULT_OK)
    result = bake_store_commit(store, scratch, key, error);
  else if (scratch)
    files_remove_tree(scratch);
  free(scratch);
  return result;
}

static void tell(struct bake_gather *gather, const char *line) {
  if (gather->warn) gather->warn(line);
}

/* A batch of ours that is there already: one that is damaged gives way. */
static enum result compare(const struct bake_store *store, const char *from, const char *key,
                           const char *there, struct bake_gather *gather, struct error *error) {
  bool same, whole;
  enum result result = read_batch(from, there, &same, error);
  if (result != RESULT_OK) return result;
  gather->had += same;
  if (same) return RESULT_OK;
  whole = read_batch(there, NULL, &same, NULL) == RESULT_OK;
  if (!whole) {
    files_remove_tree(there);
    ++gather->batches;
    return copy_batch(store, from, key, error);
  }
  char line[1024];
  ++gather->differ;
  snprintf(line, sizeof line, "%s: has other pixels than %s, which stays", from, there);
  tell(gather, line);
  return RESULT_OK;
}

static enum result take_batch(const struct bake_store *store, const char *folder, const char *key,
                              struct bake_gather *gather, struct error *error) {
  char *from = files_join(folder, key), *there = bake_store_path(store, key);
  struct error why = {""};
  bool same;
  enum result result = from && there ? RESULT_OK : result_no_memory(error);
  if (result == RESULT_OK && read_batch(from, NULL, &same, &why) != RESULT_OK) {
    char line[sizeof why.text + 64];
    ++gather->damaged;
    snprintf(line, sizeof line, "%s; left out, to be copied or baked again", why.text);
    tell(gather, line);
  } else if (result == RESULT_OK && access(there, F_OK) == 0) {
    result = compare(store, from, key, there, gather, error);
  } else if (result == RESULT_OK) {
    ++gather->batches;
    result = copy_batch(store, from, key, error);
  }
  free(from);
  free(there);
  return result;
}

/* ---- 4. Lists ---- */

static enum result take_lists(const struct bake_store *store, const char *folder,
                              struct error *error) {
  enum result result = RESULT_OK;
  for (int number = 1; result == RESULT_OK; ++number) {
    struct bake_list list;
    result = bake_ledger_read_list(folder, number, &list, error);
    bool there = list.label[0] != 0;
    if (result == RESULT_OK && there) result = bake_ledger_copy_list(store, folder, number, error);
    free(list.batches);
    if (!there) break;
  }
  return result;
}

static enum result take_folder(const struct bake_store *store, const char *folder,
                               struct bake_gather *gather, struct error *error) {
  DIR *list = opendir(folder);
  if (!list) return result_fail(error, RESULT_IO, "%s: %s", folder, strerror(errno));
  enum result result = RESULT_OK;
  for (struct dirent *entry; result == RESULT_OK && (entry = readdir(list));) {
    if (bake_store_is_key(entry->d_name))
      result = take_batch(store, folder, entry->d_name, gather, error);
    if (result == RESULT_OK) result = bake_worker_renew(store->worker, error);
  }
  closedir(list);
  return result == RESULT_OK ? take_lists(store, folder, error) : result;
}

/* ---- 1. Plans ---- */

/* Makes `ledger` that of all folders. */
static enum result check_plans(const char *const *folders, int count, struct bake_ledger *ledger,
                               struct error *error) {
  enum result result = bake_ledger_read(folders[0], ledger, error);
  for (int n = 1; n < count && result == RESULT_OK; ++n) {
    struct bake_ledger other;
    char difference[BAKE_LEDGER_DIFFERENCE];
    result = bake_ledger_read(folders[n], &other, error);
    if (result != RESULT_OK) break;
    if (strcmp(ledger->plan, other.plan) != 0) {
      bake_ledger_difference(ledger, &other, difference);
      result = result_fail(error, RESULT_BAD,
                           "%s: is of another bake than %s (%s); nothing is "
                           "copied",
                           folders[n], folders[0], difference);
    } else if (ledger->shards > 0 && other.shards > 0 && ledger->shards != other.shards) {
      result = result_fail(error, RESULT_BAD,
                           "%s: is shared out into %d shards, not %d as %s; nothing is copied",
                           folders[n], other.shards, ledger->shards, folders[0]);
    }
    if (ledger->shards == 0) ledger->shards = other.shards;
  }
  return result;
}

enum result bake_gather(const char *const *folders, int count, const char *output,
                        struct bake_gather *gather, struct error *error) {
  struct bake_ledger ledger;
  struct bake_store store = {0};
  enum result result = check_plans(folders, count, &ledger, error);
  if (result == RESULT_OK) result = bake_store_open(output, 0, &store, error);
  if (result == RESULT_OK) result = bake_ledger_join(&store, &ledger, error);
  for (int n = 0; n < count && result == RESULT_OK; ++n)
    result = take_folder(&store, folders[n], gather, error);
  bake_store_close(&store, result == RESULT_OK ? BAKE_STORE_SHARD : BAKE_STORE_KEPT);
  return result;
}
