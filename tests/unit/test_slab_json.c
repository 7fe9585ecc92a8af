/* test_slab_json.c - the JSON text of a page: keys of others are kept, and its provenance grows. */
#include <stdlib.h>
#include <string.h>

#include "helpers.h"

TEST(test_unknown_keys_are_kept) {
  const char *text =
      "{\"format\": \"light-slab\", \"version\": 1, \"samples\": [1, 1, 1, 1],"
      "\"center\": [0, 0, 0], \"u\": [1, 0, 0], \"v\": [0, 0, 1],"
      "\"normal\": [0, -1, 0], \"st_window\": [-1, 1, -1, 1], \"samples_are\": \"points\","
      "\"x-colour\": {\"deep\": [1, 2.5, null, \"\\u00e4\"]}, \"name\": \"old\"}";
  static const char *const names[] = {"k.tif", "k.exr"};
  struct slab slab;
  struct error error = {{0}};
  for (int k = 0; k < 4; ++k) {
    assert_ok(slab_json_parse(text, &slab, NULL, &error), &error);
    assert_ok(slab_alloc(&slab, &error), &error);
    strcpy(slab.name, "new");
    assert_ok(slab_json_set(&slab, "x-more", "[true]", &error), &error);
    struct slab *got = write_and_load(scratch(names[k % 2]), &slab, 1,
                                      k / 2 ? SLAB_PRECISION_HALF : SLAB_PRECISION_DEFAULT);
    char *deep = json_of(got, "x-colour", NULL), *more = json_of(got, "x-more", NULL);
    char *are = json_of(got, "samples_are", NULL);
    assert_string_equal(deep, "{\"deep\": [1, 2.5, null, \"\xc3\xa4\"]}");
    assert_string_equal(more, "[true]");
    assert_string_equal(are, "\"points\"");
    assert_string_equal(got->name, "new");
    free(deep), free(more), free(are);
    slab_file_free_all(got, 1);
    slab_free(&slab);
  }
}

/* A page's channel is a field of its own: it goes where the page goes, and only there. */
TEST(test_channel) {
  struct slab pages[2] = {slab_default(), slab_default()};
  struct error error = {{0}};
  strcpy(pages[1].channel, "warm");
  for (int n = 0; n < 2; ++n) assert_ok(slab_alloc(&pages[n], &error), &error);
  struct slab *got = write_and_load(scratch("c.tif"), pages, 2, SLAB_PRECISION_FLOAT);
  char *text = json_of(&got[1], "channel", NULL);
  assert_string_equal(text, "\"warm\"");
  assert_string_equal(got[0].channel, "");
  assert_string_equal(got[1].channel, "warm");
  assert_false(slab_same_channel(&got[0], &got[1]));
  got[1].channel[0] = 0;
  struct slab *again = write_and_load(scratch("d.tif"), got, 2, SLAB_PRECISION_FLOAT);
  assert_null(strstr(again[1].json, "channel"));
  assert_refused(slab_json_parse("{\"format\": \"light-slab\", \"version\": 1, \"samples\": "
                                 "[1, 1, 1, 1], \"center\": [0, 0, 0], \"u\": [1, 0, 0], \"v\": "
                                 "[0, 0, 1], \"normal\": [0, -1, 0], \"st_window\": [-1, 1, -1, "
                                 "1], \"channel\": 3}",
                                 &pages[0], NULL, &error),
                 &error, "\"channel\" must be a string", NULL);
  free(text);
  slab_file_free_all(got, 2);
  slab_file_free_all(again, 2);
  slab_free(&pages[1]);
}

TEST(test_provenance) {
  struct slab slab = slab_default();
  struct error error = {{0}};
  assert_ok(slab_json_set(&slab, "provenance",
                          "{\"command\": \"one\", \"tool\": \"t1\", \"effects\": {\"gloss\": 1}}",
                          &error),
            &error);
  assert_ok(slab_json_record(&slab, "two", "t2", false, &error), &error);
  assert_ok(slab_json_record(&slab, "three", "t3", false, &error), &error);
  char *text = json_of(&slab, "provenance", NULL);
  assert_string_equal(text,
                      "{\"command\": \"three\", \"tool\": \"t3\", \"effects\": {\"gloss\": 1}, "
                      "\"history\": [{\"command\": \"one\", \"tool\": \"t1\"}, "
                      "{\"command\": \"two\", \"tool\": \"t2\"}]}");
  free(text);
  assert_refused(slab_json_set(&slab, "provenance", "{", &error), &error, "malformed", NULL);
  slab_free(&slab);
}

/* Resampling makes other samples of them: what was known of the old ones is history. */
TEST(test_provenance_of_changed) {
  struct slab slab = awkward_slab((const int[]){1, 1, 1, 1}, 1);
  struct error error = {{0}};
  assert_ok(slab_json_set(&slab, "provenance",
                          "{\"command\": \"one\", \"tool\": \"t1\", \"rays\": 16, \"effects\": "
                          "{\"gloss\": 1}, \"noise\": {\"flux\": 0.5}, \"warnings\": [\"dark\"]}",
                          &error),
            &error);
  for (int changed = 0; changed < 2; ++changed)
    assert_ok(slab_json_record(&slab, "next", "t", changed, &error), &error);
  char *text = json_of(&slab, "provenance", NULL);
  assert_string_equal(text, "{\"command\": \"next\", \"tool\": \"t\", \"effects\": {\"gloss\": 1}, "
                            "\"history\": [{\"command\": \"one\", \"tool\": \"t1\"}, "
                            "{\"command\": \"next\", \"tool\": \"t\", \"rays\": 16, "
                            "\"noise\": {\"flux\": 0.5}, \"warnings\": [\"dark\"]}]}");
  free(text);
  slab_free(&slab);
}

int main(void) {
  return testing_run(NULL, NULL);
}
