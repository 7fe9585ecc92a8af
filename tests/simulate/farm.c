#include "simulate/farm.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "batch/bake_worker.h"

/* How bake_run.c and bake_rounds.c wait. */
static const double least_pause = 0.05, most_pause = 1, slab_pause = 0.2;

struct batch_state {
  double done; /* when it was; INFINITY */
  int holder;  /* worker, or -1 */
};

struct lamp_state {
  const struct farm_lamp *lamp;
  struct batch_state *batches[FARM_ROUNDS];         /* owned */
  size_t begun[FARM_ROUNDS], finished[FARM_ROUNDS]; /* batches */
  double left;                                      /* seconds of batches that nobody has begun */
  double done;                                      /* when its slab was; INFINITY */
  int holder, at_work;                              /* who sums the last round; workers */
};

struct worker {
  double next;         /* when it is free, or looks again */
  double speed, death; /* INFINITY: lives */
  double pause, idle;
  int lamp, round;   /* -1: none any more */
  size_t batch;      /* in hand, where busy */
  bool joined, busy; /* busy: renders */
  bool *read;        /* batches of this round; owned */
  size_t read_count;
};

struct farm {
  const struct farm_workers *size;
  struct lamp_state *lamps;
  struct worker *workers; /* owned, as are lamps */
  int *queue;             /* [queued]: a heap of those who go on, whose next is first; owned */
  int lamp_count, queued;
};

/* Uniform in 0 to 1: splitmix64 of two numbers. */
static double chance(uint64_t of, uint64_t what) {
  uint64_t z = (of << 8 ^ what) + 0x9e3779b97f4a7c15;
  z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
  z = (z ^ z >> 27) * 0x94d049bb133111eb;
  return (double)((z ^ z >> 31) >> 11) * 0x1p-53;
}

void farm_lamp_free(struct farm_lamp *lamp) {
  for (int n = 0; n < lamp->round_count; ++n) free(lamp->rounds[n].batches);
}

/* ---- Who holds what ---- */

static bool seems_alive(const struct farm *farm, int who, int to, double now) {
  const struct worker *worker = &farm->workers[who];
  bool same = who / farm->size->machine == to / farm->size->machine;
  return now < worker->death + (same ? 0 : BAKE_WORKER_LEASE);
}

static bool is_free(const struct farm *farm, const struct batch_state *batch, int to, double now) {
  return isinf(batch->done) && (batch->holder < 0 || !seems_alive(farm, batch->holder, to, now));
}

/* Batches from one on that are more than half as large: bake_order.c. */
static size_t end_of_size(const struct farm_round *round, size_t from) {
  size_t end = from;
  while (end < round->count && 2 * round->batches[end].rays > round->batches[from].rays) ++end;
  return end;
}

static bool find_batch(const struct farm *farm, int who, double now, size_t *batch) {
  const struct worker *worker = &farm->workers[who];
  const struct lamp_state *lamp = &farm->lamps[worker->lamp];
  const struct farm_round *round = &lamp->lamp->rounds[worker->round];
  if (lamp->begun[worker->round] == round->count && !(farm->size->dying > 0)) return false;
  size_t own = who == 0 ? 0 : (size_t)(1e6 * chance((uint64_t)who, 1));
  for (size_t from = 0, end; from < round->count; from = end) {
    end = end_of_size(round, from);
    for (size_t k = from; k < end; ++k) {
      *batch = from + (k - from + own) % (end - from);
      if (is_free(farm, &lamp->batches[worker->round][*batch], who, now)) return true;
    }
  }
  return false;
}

/* ---- What a worker does next ---- */

static void wait_for(struct worker *worker, double seconds) {
  worker->idle += seconds;
  worker->next += seconds;
}

static bool is_last(const struct lamp_state *lamp, int round) {
  return round == lamp->lamp->round_count - 1;
}

/* Goes to the lamp that has most left for each of its workers; none: all are done. */
static void choose_lamp(struct farm *farm, struct worker *worker) {
  int best = -1;
  double most = -1;
  if (worker->lamp >= 0) --farm->lamps[worker->lamp].at_work;
  for (int n = 0; n < farm->lamp_count; ++n) {
    const struct lamp_state *lamp = &farm->lamps[n];
    double left = lamp->left / (lamp->at_work + 1);
    if (!isinf(lamp->done) && lamp->done <= worker->next) continue;
    if (left > most) most = left, best = n;
  }
  worker->lamp = best;
  worker->round = 0;
  worker->joined = false;
  if (best >= 0) ++farm->lamps[best].at_work;
}

/* Reads what others have finished. Returns whether all of the round is read. */
static bool read_batches(struct farm *farm, struct worker *worker) {
  const struct lamp_state *lamp = &farm->lamps[worker->lamp];
  const struct farm_round *round = &lamp->lamp->rounds[worker->round];
  double rays = 0;
  for (size_t n = 0; n < round->count && worker->read_count < lamp->finished[worker->round]; ++n) {
    if (worker->read[n] || isinf(lamp->batches[worker->round][n].done)) continue;
    worker->read[n] = true;
    ++worker->read_count;
    rays += round->batches[n].rays;
    worker->pause = 0;
  }
  worker->next += rays * lamp->lamp->read / worker->speed;
  return worker->read_count == round->count;
}

/* Who comes to the last round and finds nobody alive who sums it does so. */
static void begin_round(struct farm *farm, int who, int round) {
  struct worker *worker = &farm->workers[who];
  struct lamp_state *lamp = &farm->lamps[worker->lamp];
  worker->round = round;
  worker->pause = 0;
  worker->read_count = 0;
  for (size_t n = 0; n < lamp->lamp->rounds[round].count; ++n) worker->read[n] = false;
  if (is_last(lamp, round) &&
      (lamp->holder < 0 || !seems_alive(farm, lamp->holder, who, worker->next)))
    lamp->holder = who;
}

/* All batches of the last round are there. */
static void end_lamp(struct farm *farm, int who) {
  struct worker *worker = &farm->workers[who];
  struct lamp_state *lamp = &farm->lamps[worker->lamp];
  if (lamp->done <= worker->next) {
    choose_lamp(farm, worker);
  } else if (lamp->holder == who) {
    double end = worker->next + lamp->lamp->finish / worker->speed;
    if (end < worker->death) lamp->done = end;
    worker->next = end;
  } else if (isinf(lamp->done) && !seems_alive(farm, lamp->holder, who, worker->next)) {
    lamp->holder = who; /* and sums all that the dead one did */
    read_batches(farm, worker);
  } else {
    wait_for(worker, slab_pause);
  }
}

static void start_batch(struct farm *farm, int who, size_t batch) {
  struct worker *worker = &farm->workers[who];
  struct lamp_state *lamp = &farm->lamps[worker->lamp];
  const struct farm_batch *work = &lamp->lamp->rounds[worker->round].batches[batch];
  struct batch_state *state = &lamp->batches[worker->round][batch];
  if (state->holder < 0) lamp->left -= work->seconds, ++lamp->begun[worker->round];
  state->holder = who;
  worker->batch = batch;
  worker->busy = true;
  /* It reads what it has rendered. */
  worker->next += (work->seconds + work->rays * lamp->lamp->read) / worker->speed;
}

static void work_on_round(struct farm *farm, int who) {
  struct worker *worker = &farm->workers[who];
  struct lamp_state *lamp = &farm->lamps[worker->lamp];
  bool last = is_last(lamp, worker->round);
  bool sums = !last || lamp->holder == who;
  double before = worker->next;
  bool all = sums ? read_batches(farm, worker)
                  : lamp->finished[worker->round] == lamp->lamp->rounds[worker->round].count;
  size_t batch;
  if (all && last) {
    end_lamp(farm, who);
  } else if (all) {
    begin_round(farm, who, worker->round + 1);
    worker->next += lamp->lamp->plan / worker->speed;
  } else if (find_batch(farm, who, worker->next, &batch)) {
    start_batch(farm, who, batch);
  } else if (worker->next == before) {
    worker->pause = fmin(fmax(2 * worker->pause, least_pause), most_pause);
    wait_for(worker, worker->pause);
  }
}

static void act(struct farm *farm, int who) {
  struct worker *worker = &farm->workers[who];
  struct lamp_state *lamp = &farm->lamps[worker->lamp];
  if (worker->busy) {
    lamp->batches[worker->round][worker->batch].done = worker->next;
    worker->read[worker->batch] = true;
    ++worker->read_count;
    ++lamp->finished[worker->round];
    worker->busy = false;
  }
  if (lamp->done <= worker->next) {
    choose_lamp(farm, worker);
  } else if (!worker->joined) {
    worker->joined = true;
    begin_round(farm, who, 0);
    worker->next += lamp->lamp->join / worker->speed;
  } else {
    work_on_round(farm, who);
  }
}

/* ---- The farm ---- */

static bool open_farm(struct farm *farm, const struct farm_lamp *lamps) {
  size_t most = 1;
  farm->lamps = calloc((size_t)farm->lamp_count, sizeof *farm->lamps);
  farm->workers = calloc((size_t)farm->size->count, sizeof *farm->workers);
  farm->queue = calloc((size_t)farm->size->count, sizeof *farm->queue);
  if (farm->lamp_count < 1 || !farm->lamps || !farm->workers || !farm->queue) return false;
  for (int n = 0; n < farm->lamp_count; ++n) {
    struct lamp_state *lamp = &farm->lamps[n];
    *lamp = (struct lamp_state){.lamp = &lamps[n], .done = INFINITY, .holder = -1};
    for (int r = 0; r < lamps[n].round_count; ++r) {
      size_t count = lamps[n].rounds[r].count;
      if (count > most) most = count;
      lamp->batches[r] = malloc(count * sizeof *lamp->batches[r]);
      if (!lamp->batches[r]) return false;
      for (size_t k = 0; k < count; ++k) {
        lamp->batches[r][k] = (struct batch_state){INFINITY, -1};
        lamp->left += lamps[n].rounds[r].batches[k].seconds;
      }
    }
  }
  for (int n = 0; n < farm->size->count; ++n) {
    const struct farm_workers *size = farm->size;
    bool dies = chance((uint64_t)n, 3) < size->dying;
    farm->workers[n] =
        (struct worker){.lamp = n % farm->lamp_count,
                        .speed = 1 + size->unevenness * (2 * chance((uint64_t)n, 2) - 1),
                        .death = dies ? size->until * chance((uint64_t)n, 4) : INFINITY,
                        .read = calloc(most, sizeof *farm->workers[n].read)};
    if (!farm->workers[n].read) return false;
    ++farm->lamps[farm->workers[n].lamp].at_work;
    farm->queue[farm->queued++] = n; /* all at 0 */
  }
  return true;
}

static void close_farm(struct farm *farm) {
  for (int n = 0; farm->lamps && n < farm->lamp_count; ++n)
    for (int r = 0; r < FARM_ROUNDS; ++r) free(farm->lamps[n].batches[r]);
  for (int n = 0; farm->workers && n < farm->size->count; ++n) free(farm->workers[n].read);
  free(farm->lamps);
  free(farm->workers);
  free(farm->queue);
}

static double time_of(const struct farm *farm, int place) {
  return farm->workers[farm->queue[place]].next;
}

/* Moves the first of the heap down to where it belongs. */
static void sift(struct farm *farm) {
  for (int place = 0, below; (below = 2 * place + 1) < farm->queued; place = below) {
    if (below + 1 < farm->queued && time_of(farm, below + 1) < time_of(farm, below)) ++below;
    if (time_of(farm, place) <= time_of(farm, below)) return;
    int who = farm->queue[place];
    farm->queue[place] = farm->queue[below];
    farm->queue[below] = who;
  }
}

/* Until nobody who lives has anything to do. */
static void work(struct farm *farm) {
  while (farm->queued > 0) {
    int who = farm->queue[0];
    struct worker *worker = &farm->workers[who];
    if (worker->lamp < 0 || worker->next >= worker->death)
      farm->queue[0] = farm->queue[--farm->queued];
    else
      act(farm, who);
    sift(farm);
  }
}

bool farm_run(const struct farm_lamp *lamps, int lamp_count, const struct farm_workers *workers,
              struct farm_result *result) {
  struct farm farm = {.size = workers, .lamp_count = lamp_count};
  bool good = open_farm(&farm, lamps);
  *result = (struct farm_result){0};
  if (good) work(&farm);
  double time = 0, idle = 0;
  for (int n = 0; good && n < lamp_count; ++n)
    result->wall = fmax(result->wall, farm.lamps[n].done);
  for (int n = 0; good && n < workers->count; ++n) {
    const struct worker *worker = &farm.workers[n];
    double end = fmin(worker->death, result->wall);
    time += end;
    /* Who found nothing more to do waits, too. */
    idle += worker->idle + (worker->lamp < 0 ? fmax(0, end - worker->next) : 0);
  }
  result->idle = time > 0 ? idle / time : 0;
  close_farm(&farm);
  return good;
}
