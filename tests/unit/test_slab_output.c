/* test_slab_output.c - where slabs are written to: links, targets that are refused, and that a
 * failure leaves nothing behind. */
#include <signal.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/files.h"
#include "base/output.h"
#include "base/temporary.h"
#include "helpers.h"

/* A link is followed, and stays; or is refused where it leads nowhere. */
TEST(test_links) {
  static const char *const names[2][2] = {{"link.exr", "linked.exr"}, {"link.tif", "linked.tif"}};
  struct slab slab = awkward_slab((const int[]){1, 1, 2, 2}, 1);
  struct error error = {{0}};
  struct stat status;
  fill_colours(&slab, 1);
  for (int k = 0; k < 2; ++k) {
    const char *link = scratch(names[k][0]), *target = scratch(names[k][1]);
    assert_int_equal(symlink(k ? target : names[k][1], link), 0); /* relative, absolute */
    int before = scratch_entries();
    assert_refused(slab_file_write(link, &slab, 1, SLAB_PRECISION_FLOAT, &error), &error, link,
                   "is a link to what is not there", NULL);
    assert_int_equal(scratch_entries(), before);
    write_bytes(target, "old", 3);
    assert_ok(slab_file_write(link, &slab, 1, SLAB_PRECISION_DEFAULT, &error), &error);
    assert_int_equal(lstat(link, &status), 0);
    assert_true(S_ISLNK(status.st_mode));
    assert_int_equal(stat(target, &status), 0);
    assert_true(status.st_size > 100);
  }
  slab_free(&slab);
}

TEST(test_refused_targets) {
  struct slab slab = awkward_slab((const int[]){1, 1, 1, 1}, 1);
  struct error error = {{0}};
  int before = scratch_entries();
  assert_refused(slab_file_write(scratch("a.png"), &slab, 1, SLAB_PRECISION_DEFAULT, &error),
                 &error, ".exr", NULL);
  assert_refused(slab_file_write(scratch("a.exr"), &slab, 1, SLAB_PRECISION_LOGLUV, &error), &error,
                 "LogLuv", NULL);
  assert_refused(slab_file_write(scratch("no/a.tif"), &slab, 1, SLAB_PRECISION_DEFAULT, &error),
                 &error, "No such file", NULL);
  assert_refused(slab_file_write(scratch("none.tif"), &slab, 0, SLAB_PRECISION_DEFAULT, &error),
                 &error, "no slabs", NULL);
  slab.st_window[1] = slab.st_window[0];
  assert_refused(slab_file_write(scratch("a.tif"), &slab, 1, SLAB_PRECISION_DEFAULT, &error),
                 &error, "page 1", "empty", NULL);
  const char *directory = scratch("directory.tif");
  slab.st_window[1] += 1;
  mkdir(directory, 0777);
  assert_refused(slab_file_write(directory, &slab, 1, SLAB_PRECISION_DEFAULT, &error), &error,
                 "not a regular file", NULL);
  rmdir(directory);
  assert_int_equal(scratch_entries(), before);
  slab_free(&slab);
}

/* A signal that ends a program removes its temporary files and folders, and nothing else. */
TEST(test_signals_leave_nothing) {
  static const int signals[] = {SIGINT, SIGTERM, SIGHUP};
  write_bytes(scratch("target"), "old", 3);
  int before = scratch_entries();
  for (int k = 0; k < 3; ++k) {
    pid_t child = fork();
    if (child == 0) {
      struct output kept, pending;
      struct error error;
      temporary_mind_signals();
      bool made = output_begin(&kept, scratch("kept"), &error) == RESULT_OK &&
                  output_commit(&kept, &error) == RESULT_OK &&
                  output_begin(&pending, scratch("target"), &error) == RESULT_OK;
      const char *folder = temporary_folder(scratch("folder"));
      made = made && folder && files_write(folder, "file", "text", &error) == RESULT_OK;
      if (made) raise(signals[k]);
      _exit(1);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    assert_int_equal(WTERMSIG(status), signals[k]);
    assert_int_equal(unlink(scratch("kept")), 0);
    assert_int_equal(scratch_entries(), before);
  }
}

/* A write that fails half-way (here: beyond a limit on file size) leaves the
 * old file as it was, and no other. */
TEST(test_failure_leaves_nothing) {
  static const char *const names[] = {"whole.tif", "whole.exr"};
  struct rlimit old, small = {16384, 16384};
  signal(SIGXFSZ, SIG_IGN);
  getrlimit(RLIMIT_FSIZE, &old);
  for (int k = 0; k < 2; ++k)
    for (int limit = 16384; limit > 0; limit -= 1800) {
      struct slab slab = awkward_slab((const int[]){4, 4, 16, 16}, 1);
      struct error error = {{0}};
      fill_colours(&slab, 9);
      const char *path = scratch(names[k]);
      write_bytes(path, "old", 3);
      int before = scratch_entries();
      small.rlim_cur = (rlim_t)limit;
      small.rlim_max = old.rlim_max;
      setrlimit(RLIMIT_FSIZE, &small);
      enum result result = slab_file_write(path, &slab, 1, SLAB_PRECISION_FLOAT, &error);
      setrlimit(RLIMIT_FSIZE, &old);
      assert_refused(result, &error, path, "cannot be written", NULL);
      assert_int_equal(result, RESULT_IO);
      assert_int_equal(scratch_entries(), before);
      struct stat status;
      assert_int_equal(stat(path, &status), 0);
      assert_int_equal(status.st_size, 3);
      slab_free(&slab);
    }
}

int main(void) {
  return testing_run(NULL, NULL);
}
