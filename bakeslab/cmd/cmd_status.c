/* cmd_status.c - bakeslab status: how far a bake is, for people, as JSON, or the shards that are
 * missing. The JSON has
 *   folder, lamp, bakeslab, povray (versions), plan, shards (0: none), planned, written,
 *   rounds: [{label, batches, done, claimed, missing, rays, rays_done}, ...],
 *   claims: [{key, round, host, process, seconds, heard}, ...]: whose, since how long, and how long
 *   ago they were heard of,
 *   workers: [{host, process, jobs, heard, dead}, ...], jobs, rays, rays_done,
 *   seconds_left (null: not known). */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "batch/bake_status.h"
#include "cmd/slab_options.h"
#include "file/json_text.h"

struct options {
  const char *folder;
  bool json, missing;
};

#define KEY(member) VALUE_KEY(struct options, member)
static const struct argp_option options_list[] = {
    {"json", 'j', NULL, 0, "Print JSON", 0},
    {"missing", KEY(missing), NULL, 0,
     "Print the shards that have something to bake, such as 1,4-6, and nothing else", 0},
    {0}};
static const struct value values[] = {
    {'j', VALUE_FLAG, offsetof(struct options, json), 0, 0},
    {KEY(missing), VALUE_FLAG, offsetof(struct options, missing), 0, 0},
    {0}};

static error_t parse(int key, char *argument, struct argp_state *state) {
  struct options *options = state->input;
  if (values_take(values, options_list, key, argument, options, state) == 0) return 0;
  return cli_parse_file(key, argument, state, "folder", &options->folder);
}

/* ---- JSON ---- */

static json_t *list_rounds(const struct bake_status *status) {
  json_t *list = json_array();
  for (int n = 0; n < status->round_count; ++n) {
    const struct bake_status_round *round = &status->rounds[n];
    json_array_append_new(
        list,
        json_pack("{s:s, s:I, s:I, s:I, s:I, s:f, s:f}", "label", round->list.label, "batches",
                  (json_int_t)round->list.count, "done", (json_int_t)round->done, "claimed",
                  (json_int_t)round->claimed, "missing", (json_int_t)round->missing, "rays",
                  round->rays, "rays_done", round->rays_done));
  }
  return list;
}

static json_t *list_claims(const struct bake_status *status) {
  json_t *list = json_array();
  for (int n = 0; n < status->claim_count; ++n) {
    const struct bake_status_claim *claim = &status->claims[n];
    json_array_append_new(list, json_pack("{s:s, s:i, s:o, s:I, s:f, s:f}", "key", claim->key,
                                          "round", claim->round + 1, "host",
                                          json_any_string(claim->holder.name.host), "process",
                                          (json_int_t)claim->holder.name.pid, "seconds",
                                          claim->since, "heard", claim->holder.age));
  }
  return list;
}

static json_t *list_workers(const struct bake_status *status) {
  json_t *list = json_array();
  for (int n = 0; n < status->worker_count; ++n) {
    const struct bake_worker_seen *worker = &status->workers[n];
    json_array_append_new(list, json_pack("{s:o, s:I, s:i, s:f, s:b}", "host",
                                          json_any_string(worker->name.host), "process",
                                          (json_int_t)worker->name.pid, "jobs", worker->name.jobs,
                                          "heard", worker->age, "dead", worker->dead));
  }
  return list;
}

static enum result print_json(const char *folder, const struct bake_status *status,
                              struct error *error) {
  const struct bake_ledger *ledger = &status->ledger;
  char *text;
  unsigned long mark = json_mark();
  json_t *root = json_pack(
      "{s:o, s:o, s:s, s:s, s:s, s:i, s:b, s:b, s:o, s:o, s:o, s:i, s:f, s:f, s:o}", "folder",
      json_any_string(folder), "lamp", json_any_string(ledger->lamp), "bakeslab", ledger->version,
      "povray", ledger->povray, "plan", ledger->plan, "shards", ledger->shards, "planned",
      status->planned, "written", status->written, "rounds", list_rounds(status), "claims",
      list_claims(status), "workers", list_workers(status), "jobs", status->jobs, "rays",
      status->rays, "rays_done", status->rays_done, "seconds_left",
      isfinite(status->seconds) ? json_real(status->seconds) : json_null());
  enum result result = json_text(root, mark, JSON_INDENT(2) | JSON_REAL_PRECISION(9), &text, error);
  if (result == RESULT_OK) puts(text);
  free(text);
  json_decref(root);
  return result;
}

/* ---- Text ---- */

static void print_time(const struct bake_status *status) {
  double left = status->seconds;
  printf("  %-10s", "time left");
  if (!isfinite(left))
    printf("not known yet");
  else if (left < 120)
    printf("about %.0f s", left);
  else if (left < 7200)
    printf("about %.0f min", left / 60);
  else
    printf("about %.1f h", left / 3600);
  printf(" with %d job%s%s\n", status->jobs > 0 ? status->jobs : 1, status->jobs > 1 ? "s" : "",
         status->jobs > 0 ? "" : "; nobody is at work");
}

static void print_text(const char *folder, const struct bake_status *status) {
  const struct bake_ledger *ledger = &status->ledger;
  printf("%s: %s, bakeslab %s, POV-Ray %s", folder, ledger->lamp, ledger->version, ledger->povray);
  if (ledger->shards > 0) printf(", %d shards", ledger->shards);
  printf("\n");
  for (int n = 0; n < status->round_count; ++n) {
    const struct bake_status_round *round = &status->rounds[n];
    printf("  %-10s%zu of %zu batches done, %zu claimed, %zu missing\n", round->list.label,
           round->done, round->list.count, round->claimed, round->missing);
  }
  if (!status->planned) printf("  what follows is planned once these are done\n");
  for (int n = 0; n < status->claim_count; ++n) {
    const struct bake_status_claim *claim = &status->claims[n];
    printf("  %-10s%.8s by process %ld on %s for %.0f s\n", "claimed", claim->key,
           claim->holder.name.pid, claim->holder.name.host, claim->since);
  }
  for (int n = 0; n < status->worker_count; ++n) {
    const struct bake_worker_seen *worker = &status->workers[n];
    printf("  %-10sprocess %ld on %s, %d job%s, heard of %.0f s ago\n",
           worker->dead ? "dead" : "at work", worker->name.pid, worker->name.host,
           worker->name.jobs, worker->name.jobs > 1 ? "s" : "", fmax(0, worker->age));
  }
  if (status->written)
    printf("  the slab is written\n");
  else
    print_time(status);
}

static enum result run(void *input, struct error *error) {
  const struct options *options = input;
  struct bake_status status;
  char *shards = NULL;
  enum result result = bake_status(options->folder, &status, error);
  if (result == RESULT_OK && options->missing)
    result = bake_status_shards(options->folder, &status, &shards, error);
  if (result == RESULT_OK && options->missing)
    printf(*shards ? "%s\n" : "%s", shards);
  else if (result == RESULT_OK && options->json)
    result = print_json(options->folder, &status, error);
  else if (result == RESULT_OK)
    print_text(options->folder, &status);
  free(shards);
  bake_status_free(&status);
  return result;
}

static const char doc[] =
    "Tells how far a bake is, by the folder that it keeps beside its slab: for each round, the "
    "batches that are done, claimed by a process at work (by whom, and since when) and missing; "
    "who is at work; and the time left, by what finished batches took."
    "\vA process is dead where it has ended on this machine, or was not heard of for a minute; "
    "others take over what it had claimed. What --missing prints is what Slurm takes: "
    "`sbatch --array=$(bakeslab status --missing SLAB.partial) ...`.\n\nExamples:\n"
    "  bakeslab status night.tif.partial\n"
    "  bakeslab status --missing night.tif.partial\n"
    "  bakeslab status --json night.tif.partial | jq '.rounds[-1].missing'\n";

static const struct argp argp = {options_list, parse, "SLAB.partial", doc, cli_options, NULL, NULL};

int cmd_status(int argc, char **argv) {
  struct options options = {0};
  return cli_run(&argp, argc, argv, run, &options);
}
