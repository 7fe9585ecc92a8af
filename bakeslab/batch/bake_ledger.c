#include "batch/bake_ledger.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/files.h"
#include "base/version.h"
#include "batch/bake_claim.h"
#include "file/json_text.h"

static const char file_name[] = "bake";

/* ---- What this process bakes ---- */

static void print_numbers(FILE *out, const double *numbers, int count) {
  for (int n = 0; n < count; ++n) fprintf(out, "%.17g ", numbers[n]);
}

static void print_page(FILE *out, const struct slab *page) {
  print_numbers(out, page->center, 3);
  print_numbers(out, page->u, 3);
  print_numbers(out, page->v, 3);
  print_numbers(out, page->normal, 3);
  print_numbers(out, page->st_window, 4);
  print_numbers(out, &page->st_distance, 1);
  for (int n = 0; n < SLAB_AXES; ++n) fprintf(out, "%d ", page->samples[n]);
  fprintf(out, "%s ", page->channel);
}

/* All that decides the samples and their file, but what has a key of its own. */
static char *print_settings(const struct bake_work *work) {
  const struct bake_options *options = work->options;
  const struct bake_effort *effort = &work->effort;
  char *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (!out) return NULL;
  for (int n = 0; n < work->lamp->slab_count; ++n) print_page(out, &work->slabs[n]);
  for (int n = 0; n < EFFECTS; ++n) fprintf(out, "%d ", work->look.effects->setting[n]);
  fprintf(out, "%d %d %d %d %d %d %d %d %d ", BAKE_PLAN_CUT_VERSION, effort->rays, effort->rays_max,
          effort->adaptive, work->look.form, work->look.defect_rows, work->look.offsets,
          work->look.dark, options->precision);
  print_numbers(
      out, (double[]){work->look.gain, options->noise, options->tolerance, options->for_distance},
      4);
  if (fclose(out) == 0) return text;
  free(text);
  return NULL;
}

enum result bake_ledger_make(const struct bake_work *work, struct bake_ledger *ledger,
                             struct error *error) {
  char *settings = print_settings(work);
  if (!settings) return result_no_memory(error);
  *ledger = (struct bake_ledger){.version = CANNED_VERSION,
                                 .shards = work->effort.shards > 1 ? work->effort.shards : 0};
  snprintf(ledger->povray, sizeof ledger->povray, "%s", work->povray->version);
  snprintf(ledger->files, sizeof ledger->files, "%s", work->lamp->reads.key);
  snprintf(ledger->lamp, sizeof ledger->lamp, "%s", work->options->lamp);
  for (int n = 0; n < work->lamp->slab_count; ++n)
    ledger->rays += (double)slab_sample_count(&work->slabs[n]) * work->effort.rays;
  bake_store_key(ledger->settings, settings, NULL);
  bake_store_key(ledger->plan, ledger->version, ledger->povray, ledger->files, ledger->settings,
                 NULL);
  free(settings);
  return RESULT_OK;
}

void bake_ledger_difference(const struct bake_ledger *ledger, const struct bake_ledger *other,
                            char text[BAKE_LEDGER_DIFFERENCE]) {
  if (strcmp(ledger->version, other->version) != 0)
    snprintf(text, BAKE_LEDGER_DIFFERENCE, "bakeslab %s, not %s", other->version, ledger->version);
  else if (strcmp(ledger->povray, other->povray) != 0)
    snprintf(text, BAKE_LEDGER_DIFFERENCE, "POV-Ray %s, not %s", other->povray, ledger->povray);
  else if (strcmp(ledger->files, other->files) != 0)
    snprintf(text, BAKE_LEDGER_DIFFERENCE, "another script, or other files that it reads");
  else
    snprintf(text, BAKE_LEDGER_DIFFERENCE, "other options");
}

/* ---- The file ---- */

enum result bake_ledger_read(const char *folder, struct bake_ledger *ledger, struct error *error) {
  *ledger = (struct bake_ledger){0};
  char *text = files_read(folder, file_name);
  if (!text && errno == ENOENT)
    return result_fail(error, RESULT_BAD, "%s: no bake's folder: it has no file `%s`", folder,
                       file_name);
  if (!text) return result_fail(error, RESULT_IO, "%s/%s: %s", folder, file_name, strerror(errno));
  json_t *root = NULL;
  enum result result = json_read(text, 0, &root, error);
  const char *plan, *version, *povray, *files, *settings, *lamp;
  if (result == RESULT_OK &&
      (json_unpack(root, "{s:s, s:s, s:s, s:s, s:s, s:s, s:i, s:F}", "plan", &plan, "bakeslab",
                   &version, "povray", &povray, "files", &files, "settings", &settings, "lamp",
                   &lamp, "shards", &ledger->shards, "rays", &ledger->rays) != 0 ||
       !bake_store_is_key(plan) || ledger->shards < 0))
    result = result_fail(error, RESULT_BAD, "not what bakeslab writes there");
  if (result == RESULT_OK) {
    snprintf(ledger->plan, sizeof ledger->plan, "%s", plan);
    snprintf(ledger->version, sizeof ledger->version, "%s", version);
    snprintf(ledger->povray, sizeof ledger->povray, "%s", povray);
    snprintf(ledger->files, sizeof ledger->files, "%s", files);
    snprintf(ledger->settings, sizeof ledger->settings, "%s", settings);
    snprintf(ledger->lamp, sizeof ledger->lamp, "%s", lamp);
  }
  json_decref(root);
  free(text);
  return result_at(result, error, "%s/%s", folder, file_name);
}

/* Puts a text into the folder: under a name of our own first, then by a rename; with `fresh` by a
 * link, which leaves a file that is there. */
static enum result put(const char *folder, const char *whose, const char *name, const char *text,
                       bool fresh, struct error *error) {
  char own[64], *from = NULL, *to = files_join(folder, name);
  snprintf(own, sizeof own, "scratch.%s.%s", whose, file_name);
  from = files_join(folder, own);
  enum result result = from && to ? files_write(folder, own, text, error) : result_no_memory(error);
  if (result == RESULT_OK && fresh &&
      (access(to, F_OK) == 0 || link(from, to) == 0 || errno == EEXIST))
    unlink(from);
  else if (result == RESULT_OK && rename(from, to) != 0)
    result = result_fail(error, RESULT_IO, "%s: %s", to, strerror(errno));
  free(from);
  free(to);
  return result;
}

static enum result write_ledger(const char *folder, const char *whose, bool fresh,
                                const struct bake_ledger *ledger, struct error *error) {
  char *text = NULL;
  unsigned long mark = json_mark();
  json_t *object = json_pack(
      "{s:s, s:s, s:s, s:s, s:s, s:o, s:i, s:f}", "plan", ledger->plan, "bakeslab", ledger->version,
      "povray", ledger->povray, "files", ledger->files, "settings", ledger->settings, "lamp",
      json_any_string(ledger->lamp), "shards", ledger->shards, "rays", ledger->rays);
  enum result result = json_text(object, mark, JSON_INDENT(2), &text, error);
  if (result == RESULT_OK) result = put(folder, whose, file_name, text, fresh, error);
  json_decref(object);
  free(text);
  return result;
}

enum result bake_ledger_write(const char *folder, const char *whose,
                              const struct bake_ledger *ledger, struct error *error) {
  return write_ledger(folder, whose, false, ledger, error);
}

/* ---- Joining ---- */

/* Is somebody at work on a plan? Says who. */
static enum result find_worker(const struct bake_store *store, const char *plan, bool *found,
                               char who[128], struct error *error) {
  struct bake_worker_seen *list = NULL;
  int count = 0;
  enum result result =
      bake_worker_list(store->directory, bake_worker_now(store->worker), &list, &count, error);
  *found = false;
  for (int n = 0; n < count; ++n)
    if (!list[n].dead && !strcmp(list[n].name.plan, plan)) {
      *found = true;
      snprintf(who, 128, "process %ld on %s", list[n].name.pid, list[n].name.host);
    }
  free(list);
  return result;
}

/* The store is of another plan: makes it one of ours, where it may be; *again: somebody else just
 * does. */
static enum result take_over(const struct bake_store *store, const struct bake_ledger *ledger,
                             const struct bake_ledger *there, bool *again, struct error *error) {
  char difference[BAKE_LEDGER_DIFFERENCE], who[128];
  bool found;
  int claim;
  bake_ledger_difference(ledger, there, difference);
  enum result result = find_worker(store, there->plan, &found, who, error);
  if (result == RESULT_OK && found)
    return result_fail(error, RESULT_IO,
                       "%s: another bake of this output is at work (%s: %s); wait for it",
                       store->directory, who, difference);
  if (result == RESULT_OK && there->shards > 0)
    return result_fail(error, RESULT_IO,
                       "%s: holds shards of another bake (%s); take another output, or remove that "
                       "folder",
                       store->directory, difference);
  if (result == RESULT_OK) result = bake_claim_take(store->worker, there->plan, &claim, error);
  if (result != RESULT_OK) return result;
  struct bake_ledger now;
  *again = true;
  if (claim == BAKE_CLAIM_OTHERS) return RESULT_OK;
  result = bake_ledger_read(store->directory, &now, error);
  if (result == RESULT_OK && !strcmp(now.plan, there->plan)) {
    bake_store_drop_lists(store);
    result = bake_ledger_write(store->directory, store->worker->name.id, ledger, error);
  }
  bake_claim_end(store->worker, there->plan, claim);
  return result;
}

/* The store is of our plan. */
static enum result join_same(const struct bake_store *store, const struct bake_ledger *ledger,
                             const struct bake_ledger *there, struct error *error) {
  if (ledger->shards == 0 || ledger->shards == there->shards) return RESULT_OK;
  if (there->shards > 0)
    return result_fail(error, RESULT_IO,
                       "%s: is shared out into %d shards, not %d; go on with --shard K/%d, or "
                       "without",
                       store->directory, there->shards, ledger->shards, there->shards);
  return bake_ledger_write(store->directory, store->worker->name.id, ledger, error);
}

enum result bake_ledger_join(const struct bake_store *store, const struct bake_ledger *ledger,
                             struct error *error) {
  enum { MOST_TRIES = 6000 }; /* a minute */
  enum result result = bake_worker_tell_plan(store->worker, ledger->plan, error);
  for (int tries = 0; result == RESULT_OK && tries < MOST_TRIES; ++tries) {
    struct bake_ledger there;
    bool again = false;
    result = write_ledger(store->directory, store->worker->name.id, true, ledger, error);
    if (result == RESULT_OK) result = bake_ledger_read(store->directory, &there, error);
    if (result != RESULT_OK) return result;
    if (!strcmp(there.plan, ledger->plan)) return join_same(store, ledger, &there, error);
    result = take_over(store, ledger, &there, &again, error);
    if (again) nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
  }
  return result != RESULT_OK ? result
                             : result_fail(error, RESULT_IO, "%s: others keep changing what it is",
                                           store->directory);
}

/* ---- Lists of rounds ---- */

static void name_list(int number, char name[24]) {
  snprintf(name, 24, "round.%d", number);
}

enum result bake_ledger_list(const struct bake_store *store, int number,
                             const struct bake_round *round, struct error *error) {
  char name[24], *text = NULL;
  size_t size;
  FILE *out = open_memstream(&text, &size);
  if (!out) return result_no_memory(error);
  name_list(number, name);
  fprintf(out, "%s %zu\n", round->label, round->batch_count);
  for (size_t n = 0; n < round->batch_count; ++n)
    fprintf(out, "%s %zu\n", round->batches[n].key, round->batches[n].rays);
  enum result result = fclose(out) == 0 ? RESULT_OK : result_no_memory(error);
  if (result == RESULT_OK)
    result = put(store->directory, store->worker->name.id, name, text, true, error);
  free(text);
  return result;
}

enum result bake_ledger_copy_list(const struct bake_store *store, const char *folder, int number,
                                  struct error *error) {
  char name[24];
  name_list(number, name);
  char *text = files_read(folder, name);
  if (!text) return result_fail(error, RESULT_IO, "%s/%s: %s", folder, name, strerror(errno));
  enum result result = put(store->directory, store->worker->name.id, name, text, true, error);
  free(text);
  return result;
}

/* Reads the lines of batches. */
static bool parse_list(const char *text, struct bake_list *list) {
  int used = 0;
  if (sscanf(text, "%15s %zu%n", list->label, &list->count, &used) != 2) return false;
  if (list->count > strlen(text) / 34) return false; /* a line each */
  list->batches = calloc(list->count + 1, sizeof *list->batches);
  for (size_t n = 0; n < list->count && list->batches; ++n) {
    text += used;
    struct bake_list_batch *batch = &list->batches[n];
    if (sscanf(text, " %32s %zu%n", batch->key, &batch->rays, &used) != 2) return false;
    if (!bake_store_is_key(batch->key)) return false;
  }
  return true;
}

enum result bake_ledger_read_list(const char *folder, int number, struct bake_list *list,
                                  struct error *error) {
  char name[24];
  *list = (struct bake_list){0};
  name_list(number, name);
  char *text = files_read(folder, name);
  if (!text && errno == ENOENT) return RESULT_OK;
  enum result result = RESULT_OK;
  if (!text)
    result = result_fail(error, RESULT_IO, "%s/%s: %s", folder, name, strerror(errno));
  else if (!parse_list(text, list))
    result =
        result_fail(error, RESULT_BAD, "%s/%s: not a list of batches, or cut off", folder, name);
  else if (!list->batches)
    result = result_no_memory(error);
  free(text);
  return result;
}
