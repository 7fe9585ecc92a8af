/* occlusion_embree.c - Embree 3, robust mode (watertight at edges).
 *
 * Embree sees the scene moved to the origin and scaled by a power of two, so that its half
 * diagonal is between 1/2 and 1, and only the part of a ray that is inside the scene's
 * (slightly larger) box. The error of single precision is then the same, known share of the
 * scene's size whatever the unit of length, the distance from the origin or that of the light. */
#include "shadow/occlusion.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/vector.h"
#include "scene/scene.h"
#include "shadow/shaft.h"

enum { PACKET = 16 };

/* In the scaled scene. Single precision misplaces intersections by no more than 2^-22: with a
 * lift of 2^-23 there is still no acne in tests/render/test_visible.c, with 2^-24 there is. */
static const double LIFT = 0x1p-20;
static const double STOP = 0x1p-18; /* a ray ends that far before its point */
static const double MARGIN = 0x1p-4;

struct occlusion {
  RTCDevice device;
  RTCScene scene;
  double center[3];
  double scale;  /* from scene units */
  double box[3]; /* half edges, scaled, with the margin */
  bool empty;
  struct shaft_tree *shafts; /* owned */
};

/* Keeps Embree from printing; rtcGetDeviceError has the error. */
static void be_quiet(void *context, enum RTCError code, const char *text) {
  (void)context;
  (void)code;
  (void)text;
}

static bool measure(const struct scene *scene, struct occlusion *occlusion) {
  double low[3], high[3], half[3];
  vector_box(low, high);
  for (size_t t = 0; t < scene->triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const double *x = scene->position[scene->corners[t][k]];
      if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2])) return false;
      vector_widen(low, high, x);
    }
  for (int c = 0; c < 3; ++c) {
    occlusion->center[c] = low[c] / 2 + high[c] / 2;
    half[c] = high[c] / 2 - low[c] / 2;
  }
  double radius = vector_length(half);
  if (!(radius > 0) || !isfinite(radius)) return false;
  int exponent;
  frexp(radius, &exponent);
  occlusion->scale = ldexp(1, -exponent);
  if (!isfinite(occlusion->scale)) return false;
  for (int c = 0; c < 3; ++c) occlusion->box[c] = half[c] * occlusion->scale + MARGIN;
  return true;
}

static void to_box(const struct occlusion *occlusion, const double position[3], double out[3]) {
  for (int c = 0; c < 3; ++c) out[c] = (position[c] - occlusion->center[c]) * occlusion->scale;
}

static bool fill(RTCGeometry geometry, const struct scene *scene,
                 const struct occlusion *occlusion) {
  float *vertex = (float *)rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene->vertices);
  uint32_t *index = (uint32_t *)rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(uint32_t), scene->triangles);
  if (!vertex || !index) return false;
  for (size_t v = 0; v < scene->vertices; ++v) {
    double x[3];
    to_box(occlusion, scene->position[v], x);
    for (int c = 0; c < 3; ++c) vertex[3 * v + (size_t)c] = (float)x[c];
  }
  for (size_t t = 0; t < scene->triangles; ++t)
    for (size_t k = 0; k < 3; ++k) index[3 * t + k] = (uint32_t)scene->corners[t][k];
  return true;
}

static enum result build(const struct scene *scene, struct occlusion *occlusion,
                         struct error *error) {
  if (!measure(scene, occlusion))
    return result_fail(error, RESULT_BAD,
                       "the scene has no size or coordinates that are not finite");
  occlusion->device = rtcNewDevice(NULL);
  if (!occlusion->device)
    return result_fail(error, RESULT_IO, "Embree does not run on this processor (error %d)",
                       (int)rtcGetDeviceError(NULL));
  rtcSetDeviceErrorFunction(occlusion->device, be_quiet, NULL);
  occlusion->scene = rtcNewScene(occlusion->device);
  RTCGeometry geometry = rtcNewGeometry(occlusion->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  if (!occlusion->scene || !geometry || !fill(geometry, scene, occlusion)) {
    if (geometry) rtcReleaseGeometry(geometry);
    return result_fail(error, RESULT_MEMORY, "out of memory for %zu triangles", scene->triangles);
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(occlusion->scene, geometry, 0);
  rtcReleaseGeometry(geometry); /* the scene holds it now */
  rtcSetSceneFlags(occlusion->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(occlusion->scene, RTC_BUILD_QUALITY_HIGH);
  rtcCommitScene(occlusion->scene);
  enum RTCError code = rtcGetDeviceError(occlusion->device);
  if (code == RTC_ERROR_OUT_OF_MEMORY)
    return result_fail(error, RESULT_MEMORY, "out of memory for %zu triangles", scene->triangles);
  if (code != RTC_ERROR_NONE)
    return result_fail(error, RESULT_IO, "Embree failed with error %d", (int)code);
  return RESULT_OK;
}

enum result occlusion_create(const struct scene *scene, struct occlusion **occlusion,
                             struct error *error) {
  *occlusion = NULL;
  if (scene->triangles > UINT32_MAX - 1 || scene->vertices > INT32_MAX)
    return result_fail(error, RESULT_BAD, "%zu triangles are more than Embree takes",
                       scene->triangles);
  struct occlusion *made = calloc(1, sizeof *made);
  if (!made) return result_no_memory(error);
  made->empty = scene->triangles == 0;
  enum result result = made->empty ? RESULT_OK : build(scene, made, error);
  if (result == RESULT_OK) result = shaft_tree_create(scene, &made->shafts, error);
  if (result != RESULT_OK)
    occlusion_free(made);
  else
    *occlusion = made;
  return result;
}

void occlusion_free(struct occlusion *occlusion) {
  if (!occlusion) return;
  shaft_tree_free(occlusion->shafts);
  if (occlusion->scene) rtcReleaseScene(occlusion->scene);
  if (occlusion->device) rtcReleaseDevice(occlusion->device);
  free(occlusion);
}

/* The part of origin + t direction, t in range, that is inside the box. */
static bool clip(const struct occlusion *occlusion, const double origin[3],
                 const double direction[3], double range[2]) {
  for (int c = 0; c < 3; ++c) {
    double box = occlusion->box[c];
    if (direction[c] == 0) {
      if (!(fabs(origin[c]) <= box)) return false;
      continue;
    }
    double side = direction[c] > 0 ? box : -box;
    double enter = (-side - origin[c]) / direction[c], leave = (side - origin[c]) / direction[c];
    if (enter > range[0]) range[0] = enter;
    if (leave < range[1]) range[1] = leave;
  }
  return range[0] < range[1];
}

bool occlusion_between(const struct occlusion *occlusion, const double (*lifted)[3], int count,
                       const double corners[4][3]) {
  return shaft_may_block(occlusion->shafts, lifted, count, corners);
}

bool occlusion_nearest(const struct occlusion *occlusion, const double origin[3],
                       const double direction[3], struct occlusion_hit *hit) {
  double start[3], along[3], range[2] = {0, INFINITY};
  if (occlusion->empty) return false;
  to_box(occlusion, origin, start);
  for (int c = 0; c < 3; ++c) along[c] = direction[c] * occlusion->scale;
  if (!clip(occlusion, start, along, range) || !isfinite(range[1])) return false;
  float at[3], to[3];
  for (int c = 0; c < 3; ++c) {
    at[c] = (float)(start[c] + range[0] * along[c]);
    to[c] = (float)((range[1] - range[0]) * along[c]);
  }
  struct RTCRayHit query = {.ray = {.org_x = at[0],
                                    .org_y = at[1],
                                    .org_z = at[2],
                                    .dir_x = to[0],
                                    .dir_y = to[1],
                                    .dir_z = to[2],
                                    .tfar = 1,
                                    .mask = UINT32_MAX},
                            .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
  struct RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(occlusion->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;
  *hit =
      (struct occlusion_hit){.triangle = query.hit.primID,
                             .distance = range[0] + (double)query.ray.tfar * (range[1] - range[0]),
                             .share = {query.hit.u, query.hit.v}};
  return true;
}

void occlusion_lift(const struct occlusion *occlusion, const double position[3],
                    const double normal[3], double lifted[3]) {
  double lift = occlusion->empty ? 0 : LIFT / occlusion->scale;
  for (int c = 0; c < 3; ++c) lifted[c] = position[c] + lift * normal[c];
}

/* Lanes of one packet; `slot` says whose answer each is. */
struct packet {
  struct RTCRay16 rays;
  int valid[PACKET];
  int slot[PACKET];
  int count;
};

static void packet_trace(const struct occlusion *occlusion, struct packet *packet, bool *blocked) {
  struct RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  for (int k = 0; k < PACKET; ++k) packet->valid[k] = k < packet->count ? -1 : 0;
  rtcOccluded16(packet->valid, occlusion->scene, &context, &packet->rays);
  for (int k = 0; k < packet->count; ++k) blocked[packet->slot[k]] = packet->rays.tfar[k] < 0;
  packet->count = 0;
}

static void packet_add(struct packet *packet, int slot, const double at[3], const double to[3]) {
  int k = packet->count++;
  packet->slot[k] = slot;
  packet->rays.org_x[k] = (float)at[0];
  packet->rays.org_y[k] = (float)at[1];
  packet->rays.org_z[k] = (float)at[2];
  packet->rays.dir_x[k] = (float)to[0];
  packet->rays.dir_y[k] = (float)to[1];
  packet->rays.dir_z[k] = (float)to[2];
  packet->rays.tfar[k] = 1;
}

void occlusion_blocked(const struct occlusion *occlusion, const double lifted[3],
                       const double (*points)[3], int count, bool *blocked) {
  _Alignas(64) struct packet packet;
  double start[3];
  if (count > 0) memset(blocked, 0, (size_t)count * sizeof *blocked);
  if (occlusion->empty) return;
  memset(&packet, 0, sizeof packet);
  for (int k = 0; k < PACKET; ++k) packet.rays.mask[k] = UINT32_MAX;
  to_box(occlusion, lifted, start);
  for (int p = 0; p < count; ++p) {
    double along[3], at[3], to[3], range[2] = {0, 1};
    for (int c = 0; c < 3; ++c) along[c] = (points[p][c] - lifted[c]) * occlusion->scale;
    range[1] -= STOP / sqrt(vector_dot(along, along)); /* 0 or overflow: no part is left, or all */
    if (!clip(occlusion, start, along, range)) continue;
    for (int c = 0; c < 3; ++c) {
      at[c] = start[c] + range[0] * along[c];
      to[c] = (range[1] - range[0]) * along[c];
    }
    packet_add(&packet, p, at, to);
    if (packet.count == PACKET) packet_trace(occlusion, &packet, blocked);
  }
  if (packet.count > 0) packet_trace(occlusion, &packet, blocked);
}
