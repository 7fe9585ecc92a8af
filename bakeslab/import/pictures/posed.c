/* posed.c
 *
 * 1. Pages are laid at the apertures. Where no window is given, it holds all directions in which
 *    the cameras stand, as seen from the page's middle, up to slopes of 2.
 * 2. Positions, where they were not asked for, are as many as pixels of the pictures lie across the
 *    page, but 16 to 32: what is a few pixels wide, as a bulb, blurs where they are fewer.
 *    Directions are found at as many as there are cameras within the window: more would be filled
 *    in, not measured; those of the slab are interpolated.
 * 3. Pictures are read one after the other, and their pixels become rays (posed_rays.h).
 * 4. Each page's rays are rebinned, at the depth where the lamp shines (focus.h). */
#include "import/pictures/posed.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/files.h"
#include "import/pictures/focus.h"
#include "import/pictures/light_picture.h"
#include "import/pictures/posed_rays.h"

enum { LEAST_UV = 16, MOST_UV = 32, LEAST_ST = 4, MOST_ST = 64 };
static const double widest = 2; /* slope */

struct work {
  const struct import_wish *wish;
  const char *path; /* of transforms.json */
  double metres;    /* per unit of lengths */
  struct poses poses;
  struct ray_pages pages;
  struct posed_rays rays;
  struct slab_images images;
  int first[2]; /* size of the first picture, once it was read */
};

/* ---- Pictures ---- */

/* A picture's path: beside the file, unless it is absolute. To be freed. */
static char *find_picture(const struct work *work, const struct pose *pose) {
  const char *slash = strrchr(work->path, '/');
  if (pose->file[0] == '/' || !slash) return strdup(pose->file);
  char *folder = strndup(work->path, (size_t)(slash - work->path));
  char *path = folder ? files_join(folder, pose->file) : NULL;
  free(folder);
  return path;
}

/* Pictures are as large as their poses say, or as the first. */
static enum result check_size(const struct pose *pose, const struct picture *picture, int first[2],
                              const char *path, struct error *error) {
  double width = pose->width > 0 ? pose->width : first[0];
  double height = pose->height > 0 ? pose->height : first[1];
  if (first[0] == 0) {
    first[0] = picture->width;
    first[1] = picture->height;
  }
  if ((width == 0 || width == picture->width) && (height == 0 || height == picture->height))
    return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s: is %d x %d pixels, not %g x %g as %s", path,
                     picture->width, picture->height, width > 0 ? width : picture->width,
                     height > 0 ? height : picture->height,
                     pose->width > 0 || pose->height > 0 ? "its pose says" : "the first picture");
}

/* `picture` is to be freed in any case. */
static enum result read_picture(struct work *work, int n, struct picture *picture,
                                struct error *error) {
  const struct import_wish *wish = work->wish;
  const struct pose *pose = &work->poses.pose[n];
  char *path = find_picture(work, pose);
  *picture = (struct picture){0};
  if (!path) return result_no_memory(error);
  double exposure = wish->exposure > 0 ? wish->exposure : 1;
  enum result result = light_picture_read(&work->images, path, exposure, picture, error);
  if (result == RESULT_OK) result = check_size(pose, picture, work->first, path, error);
  free(path);
  return result_at(result, error, "%s: frame %d", work->path, n + 1);
}

static enum result look_at_first(struct work *work, struct error *error) {
  struct picture picture;
  enum result result = read_picture(work, 0, &picture, error);
  picture_free(&picture);
  return result;
}

/* ---- Steps 1 and 2 ---- */

/* The slopes of a camera as seen from the middle of a page; false where it is not before it. */
static bool find_slopes(const struct ray_page *page, const struct pose *pose, double slope[2]) {
  double away[3], height = 0;
  slope[0] = slope[1] = 0;
  for (int n = 0; n < 3; ++n) {
    away[n] = pose->origin[n] - page->geometry.center[n];
    height += away[n] * page->geometry.normal[n];
    slope[0] += away[n] * page->u[n];
    slope[1] += away[n] * page->v[n];
  }
  for (int k = 0; k < 2; ++k) slope[k] /= height;
  return height > 0;
}

static enum result choose_window(const struct work *work, struct ray_page *page,
                                 struct error *error) {
  double *window = page->geometry.st_window, slope[2];
  for (int k = 0; k < 4; ++k) window[k] = k % 2 ? -INFINITY : INFINITY;
  for (int n = 0; n < work->poses.count; ++n)
    if (find_slopes(page, &work->poses.pose[n], slope))
      for (int k = 0; k < 2; ++k) {
        window[2 * k] = fmin(window[2 * k], fmax(slope[k], -widest));
        window[2 * k + 1] = fmax(window[2 * k + 1], fmin(slope[k], widest));
      }
  if (window[0] < window[1] && window[2] < window[3]) return RESULT_OK;
  return result_fail(error, RESULT_BAD, "%s",
                     window[0] > window[1] ? "no camera stands before it: look at --normal"
                                           : "all cameras stand in one direction: give --window");
}

static int count_within(const struct work *work, const struct ray_page *page) {
  const double *window = page->geometry.st_window;
  double slope[2];
  int count = 0;
  for (int n = 0; n < work->poses.count; ++n)
    count += find_slopes(page, &work->poses.pose[n], slope) && slope[0] >= window[0] &&
             slope[0] <= window[1] && slope[1] >= window[2] && slope[1] <= window[3];
  return count;
}

/* Pixels per lamp unit at a page, square to the line of sight: the mean of the cameras before it.
 */
static double find_pixels(const struct work *work, const struct ray_page *page) {
  double sum = 0, slope[2];
  int count = 0;
  for (int n = 0; n < work->poses.count; ++n) {
    struct pose pose = work->poses.pose[n];
    double square = 0;
    if (!find_slopes(page, &pose, slope)) continue;
    poses_complete(&pose, work->first[0], work->first[1]);
    for (int c = 0; c < 3; ++c) square += pow(pose.origin[c] - page->geometry.center[c], 2);
    sum += pose.focal[0] / sqrt(square);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

static enum result lay_page(struct work *work, int n, struct error *error) {
  const struct import_wish *wish = work->wish;
  struct ray_page *page = &work->pages.page[n];
  struct slab *slab = &page->geometry;
  enum result result = RESULT_OK;
  if (wish->distance > 0) slab->st_distance = wish->distance * work->metres;
  if (wish->window[0] < wish->window[1])
    memcpy(slab->st_window, wish->window, sizeof slab->st_window);
  else
    result = choose_window(work, page, error);
  double pixels = find_pixels(work, page);
  int side = (int)fmin(MOST_ST, fmax(LEAST_ST, round(sqrt(count_within(work, page)))));
  for (int k = 0; k < 2; ++k) {
    double across = round(2 * page->half[k] * pixels);
    slab->samples[SLAB_U + k] =
        wish->uv[k] ? wish->uv[k] : (int)fmin(MOST_UV, fmax(LEAST_UV, across));
    slab->samples[SLAB_S + k] = wish->st[k] && wish->st[k] < side ? wish->st[k] : side;
  }
  if (result == RESULT_OK) result = slab_check(slab, error);
  return result_at(result, error, "page %d", n + 1);
}

static enum result lay_pages(struct work *work, struct error *error) {
  const struct import_wish *wish = work->wish;
  enum result result = RESULT_OK;
  if (wish->aperture_count == 0)
    result = result_fail(error, RESULT_BAD,
                         "pictures do not say where the lamp's opening is: give --center, --u, --v "
                         "and --normal");
  for (int n = 0; n < wish->aperture_count && result == RESULT_OK; ++n) {
    const struct import_aperture *aperture = &wish->apertures[n];
    double scaled[3][3];
    for (int c = 0; c < 3; ++c) {
      scaled[0][c] = aperture->center[c] * work->metres;
      scaled[1][c] = aperture->u[c] * work->metres;
      scaled[2][c] = aperture->v[c] * work->metres;
    }
    result = ray_pages_add(&work->pages, scaled[0], scaled[1], scaled[2], aperture->normal, error);
    if (result == RESULT_OK) result = lay_page(work, n, error);
  }
  return result_at(result, error, "%s", work->path);
}

/* ---- Step 3 ---- */

static enum result read_poses(struct work *work, struct error *error) {
  /* files_read joins; an absolute path has its folder already */
  const char *name = work->path[0] == '/' ? work->path + 1 : work->path;
  char *text = files_read(work->path[0] == '/' ? "" : ".", name);
  if (!text)
    return result_fail(error, RESULT_IO, "%s: cannot be read: %s", work->path, strerror(errno));
  enum result result = poses_read(text, &work->poses, error);
  free(text);
  for (int n = 0; n < work->poses.count; ++n)
    for (int c = 0; c < 3; ++c) work->poses.pose[n].origin[c] *= work->metres;
  return result_at(result, error, "%s", work->path);
}

static enum result add_picture(struct work *work, int n, struct error *error) {
  const struct pose *pose = &work->poses.pose[n];
  struct picture picture;
  enum result result = read_picture(work, n, &picture, error);
  if (result == RESULT_OK) {
    result =
        posed_rays_add(&work->rays, pose, &picture, work->wish->vignetting, (uint32_t)n, error);
    result_at(result, error, "%s: frame %d: %s", work->path, n + 1, pose->file);
  }
  picture_free(&picture);
  return result;
}

static enum result add_pictures(struct work *work, struct error *error) {
  enum result result = RESULT_OK;
  work->rays.pages = &work->pages;
  for (int n = 0; n < work->poses.count && result == RESULT_OK; ++n)
    result = add_picture(work, n, error);
  return result;
}

/* ---- Step 4 ---- */

/* What the pages tell, together. */
struct told {
  double samples, holes, flux, flux_holes, square, wrong, bright, error;
};

static double mean_square(const struct slab *slab) {
  size_t count = slab_sample_count(slab);
  double sum = 0;
  for (size_t n = 0; n < count; ++n) {
    double luminance = slab_luminance(slab->rgb + 3 * n);
    sum += luminance * luminance;
  }
  return sum / (double)count;
}

static enum result add_page(struct work *work, int n, struct slab *slab, struct told *told,
                            struct error *error) {
  const struct import_wish *wish = work->wish;
  struct focus_report report;
  double rgb[3];
  if (work->rays.page[n].count == 0)
    return result_fail(error, RESULT_BAD,
                       "%s: page %d: no picture shows it: look at --center, --u, --v, --normal and "
                       "--window",
                       work->path, n + 1);
  enum result result = slab_copy_geometry(&work->pages.page[n].geometry, slab, error);
  if (result == RESULT_OK)
    result = focus_rebin(work->rays.page[n].ray, work->rays.page[n].count, wish->st, slab, &report,
                         error);
  if (result == RESULT_OK) result = slab_flux_metric(slab, rgb, error);
  if (result != RESULT_OK) return result;
  double flux = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
  double samples = (double)slab_sample_count(slab), square = flux * flux;
  if (report.depth > 0)
    warnings_add(
        wish->notes,
        "page %d: between pictures, light is interpolated on a plane %.3g behind it, where "
        "those that were held out are told best",
        n + 1, report.depth);
  told->samples += samples;
  told->holes += samples * report.holes;
  told->flux += flux;
  told->flux_holes += flux * report.flux_holes;
  told->square += square;
  told->wrong += square * report.rebin.error * report.rebin.error;
  told->bright += samples * mean_square(slab);
  told->error += square * report.rebin.mean_error * report.rebin.mean_error;
  return RESULT_OK;
}

static void tell(const struct work *work, const struct told *told, struct import_story *story) {
  const struct posed_rays *rays = &work->rays;
  struct warnings *notes = work->wish->notes;
  double filled = 100 * told->holes / told->samples;
  double filled_flux = told->flux > 0 ? 100 * told->flux_holes / told->flux : 0;
  if (told->holes > 0)
    warnings_add(notes,
                 "no picture shows %.3g %% of the samples, with %.3g %% of the flux; they "
                 "are filled in from their neighbours",
                 filled, filled_flux);
  if (rays->missed > 0.001 * rays->seen)
    warnings_add(notes, "%.3g %% of the pictures' light comes from beside the pages",
                 100 * rays->missed / rays->seen);
  if (rays->beyond > 0.001 * rays->seen)
    warnings_add(notes, "%.3g %% of the pictures' light leaves the pages outside their windows",
                 100 * rays->beyond / rays->seen);
  story->flux_in = NAN;
  story->flux_out = told->flux;
  story->error = sqrt(told->wrong / told->square);
  story->sample_error = story->error * sqrt(told->bright / told->samples);
  /* Of the light in one direction, which all positions share: more than the flux's own. */
  story->flux_error = sqrt(told->error / told->square);
  story->points = true;
  snprintf(story->assumptions, sizeof story->assumptions,
           "Pixels are radiance along their lines of sight, up to one factor, and nothing stands "
           "between lamp and cameras; %.3g %% of the samples, with %.3g %% of the flux, are shown "
           "by none of the %d pictures and are filled in.",
           filled, filled_flux, work->poses.count);
  int period = work->poses.count < REBIN_HELD_OUT ? work->poses.count : REBIN_HELD_OUT;
  if (isfinite(story->error))
    snprintf(story->error_is, sizeof story->error_is,
             "RMS error in every %dth picture, held out, over the RMS of its light, weighted as it "
             "shines; of these pictures as a whole, by one number each, %.2g.",
             period, story->flux_error);
  else
    snprintf(story->error_is, sizeof story->error_is,
             "Not known: fewer than two pictures show a page.");
}

static enum result fill_pages(struct work *work, struct import_light *light, struct error *error) {
  struct told told = {0};
  enum result result = RESULT_OK;
  light->slabs = calloc((size_t)work->pages.count, sizeof *light->slabs);
  if (!light->slabs) return result_no_memory(error);
  for (int n = 0; n < work->pages.count && result == RESULT_OK; ++n) {
    light->count = n + 1;
    result = add_page(work, n, &light->slabs[n], &told, error);
  }
  if (result == RESULT_OK) tell(work, &told, &light->story);
  return result;
}

enum result posed_slabs(const struct import_wish *wish, struct import_light *light,
                        struct error *error) {
  if (wish->file_count > 1)
    return result_fail(error, RESULT_BAD, "%s: give one file of poses at a time", wish->files[1]);
  struct work *work = calloc(1, sizeof *work);
  if (!work) return result_no_memory(error);
  work->wish = wish;
  work->path = wish->files[0];
  work->metres = wish->metres > 0 ? wish->metres : 1;
  enum result result = read_poses(work, error);
  if (result == RESULT_OK) result = look_at_first(work, error);
  if (result == RESULT_OK) result = lay_pages(work, error);
  if (result == RESULT_OK) result = add_pictures(work, error);
  if (result == RESULT_OK) result = fill_pages(work, light, error);
  slab_images_close(&work->images);
  posed_rays_free(&work->rays);
  poses_free(&work->poses);
  free(work);
  return result;
}
