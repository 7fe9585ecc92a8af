# letter.bash - for tests of pictures lit by the letter lamp (render.bash): each runs in an empty
# folder that holds the lamp, its include, and the scenes.
# shellcheck shell=bash
load render

setup_file() {
  needs oiiotool
  cd "$BATS_FILE_TMPDIR" || return
  letter_lamp
}

setup() {
  mkdir "$BATS_TEST_TMPDIR/work" && cd "$BATS_TEST_TMPDIR/work" || return
  cp "$BATS_FILE_TMPDIR"/letter_f.* "$BATS_TEST_DIRNAME"/scenes/* .
}
