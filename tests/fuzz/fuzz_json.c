/* fuzz_json.c - the JSON text of a page, with its provenance: what is read is written again
 * and read alike. */
#include <stdlib.h>
#include <string.h>

#include "file/slab_json.h"
#include "fuzz.h"

static void write_again(struct slab *slab) {
  struct error error;
  struct slab copy;
  char *text = NULL;
  fuzz_check(slab_json_text(slab, NULL, &text, &error) == RESULT_OK);
  fuzz_check(slab_json_parse(text, &copy, NULL, &error) == RESULT_OK);
  fuzz_check(!memcmp(slab->samples, copy.samples, sizeof copy.samples));
  for (int k = 0; k < 4; ++k) fuzz_check(slab->st_window[k] == copy.st_window[k]);
  fuzz_check(!strcmp(slab->name, copy.name) && slab->st_distance == copy.st_distance);
  free(text);
  slab_free(&copy);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct slab slab;
  struct error error;
  double white[3];
  char *text = fuzz_text(data, size);
  if (slab_json_parse(text, &slab, white, &error) == RESULT_OK) {
    fuzz_check(slab_check(&slab, &error) == RESULT_OK);
    for (int c = 0; c < 3; ++c) fuzz_check(white[c] > 0);
    struct slab_sampling sampling;
    json_t *root = NULL;
    fuzz_check(slab_json_sampling(&slab, &sampling, &error) == RESULT_OK);
    fuzz_check(slab_json_record(&slab, "command", "tool", true, &error) == RESULT_OK);
    fuzz_check(slab_json_root(&slab, &root, &error) == RESULT_OK);
    const json_t *command = json_object_get(json_object_get(root, "provenance"), "command");
    fuzz_check(json_is_string(command) && !strcmp(json_string_value(command), "command"));
    json_decref(root);
    write_again(&slab);
  }
  slab_free(&slab);
  free(text);
  return 0;
}
