/* slab_file.h - light slabs in files: LogLuv or float TIFF and EXR
 * (light-slab(5)). One slab a page.
 *
 * A file is opened with the geometry of all its pages; samples are read
 * lazily, a view or a page at a time. What a reader must refuse (malformed
 * JSON, sizes that contradict it, non-finite samples, ...) is refused with
 * file, page and reason. Not thread-safe for one file handle. */
#ifndef SLAB_FILE_H
#define SLAB_FILE_H

#include "file/slab_precision.h"
#include "slab/slab.h"

struct slab_file; /* owned by whoever opened it */

enum result slab_file_open(const char *path, struct slab_file **file, struct error *error);
void slab_file_close(struct slab_file *file); /* NULL allowed */

int slab_file_pages(const struct slab_file *file);
/* Geometry of a page, without samples; owned by the file. */
const struct slab *slab_file_page(const struct slab_file *file, int page);
enum slab_precision slab_file_precision(const struct slab_file *file, int page);
/* The lossy compression that has changed its samples, or NULL. */
const char *slab_file_lossy(const struct slab_file *file, int page);

/* Reads view (i,j): Nt rows of Ns pixels of 3 floats. Decodes only the tiles
 * that it touches. */
enum result slab_file_read_view(struct slab_file *file, int page, int i, int j, float *rgb,
                                struct error *error);

/* Reads a whole page into a slab that the caller frees with slab_free. */
enum result slab_file_load(struct slab_file *file, int page, struct slab *slab,
                           struct error *error);

/* Opens, loads all pages and closes. *slabs is an array of *count slabs; free
 * it with slab_file_free_all. */
enum result slab_file_load_all(const char *path, struct slab **slabs, int *count,
                               struct error *error);
void slab_file_free_all(struct slab *slabs, int count);

/* Refuses what slab_file_write would refuse whatever the samples: before the work. */
enum result slab_file_check_target(const char *path, enum slab_precision precision,
                                   struct error *error);

/* The precision that slab_file_write would use; DEFAULT where it would refuse. */
enum slab_precision slab_file_precision_of(const char *path, enum slab_precision precision);

/* Writes all pages, whole or not at all (a temporary name beside the target,
 * then rename). The container follows the name: .tif, .tiff or .exr; "-" is a TIFF on
 * standard output. */
enum result slab_file_write(const char *path, const struct slab *slabs, int count,
                            enum slab_precision precision, struct error *error);

#endif
