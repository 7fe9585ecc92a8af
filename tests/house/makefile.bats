#!/usr/bin/env bats
# The Makefile's own behaviour; setup.bats has its set-up.
load house

@test "make help lists the targets" {
  run -0 house_make help
  for target in all setup demo test bare bench lint sanitize install uninstall clean man help; do
    grep -q "^make $target  *[a-z]" <<<"$output"
  done
}

@test "an unknown configuration is refused in one line" {
  run -2 house_make config=fast all
  [ "${#lines[@]}" -eq 1 ]
  [[ $output == *"config=fast is none of release, debug, sanitize, thread and fuzz"* ]]
}

@test "a test that does not exist is refused with a list" {
  run ! house_make B="$BATS_TEST_TMPDIR" test T=unit/test_nonsense
  [[ $output == *"T=unit/test_nonsense names no test"*"house/makefile"* ]]
}

# says LINE VARIABLE=VALUE...: `make all` with these stops with that one line.
says() {
  local line=$1
  shift
  run ! house_make B="$BATS_TEST_TMPDIR/b" "$@" all
  [ "$(grep -vE '^(make:|[A-Z]+) ' <<<"$output")" = "$line" ] || { echo "$output"; return 1; }
}

# A compiler that finds no header, as $BATS_TEST_TMPDIR/cc.
blind_compiler() {
  printf '#!/bin/sh\ncase $* in *" -E "*) exit 1 ;; esac\nexec gcc "$@"\n' >"$BATS_TEST_TMPDIR/cc"
  chmod +x "$BATS_TEST_TMPDIR/cc"
}

@test "without a compiler, make all says make setup" {
  says 'The C compiler no-such-gcc, or the C library, is not here: run `make setup`.' CC=no-such-gcc
  says 'The C++ compiler no-such-g++, or its library, is not here: run `make setup`.' CXX=no-such-g++
}

@test "without the libraries, make all says make setup" {
  PKG_CONFIG_LIBDIR=/nowhere PKG_CONFIG_PATH='' says \
    'Not here (pkg-config names): libtiff-4 OpenEXR jansson libxxhash libpng epoxy egl glfw3 OpenImageIO: run `make setup`.'
}

@test "without OpenImageIO, or with an old OpenEXR, make all says so" {
  mkdir "$BATS_TEST_TMPDIR/pc" "$BATS_TEST_TMPDIR/old"
  pkg-config --variable pc_path pkg-config | tr : '\n' | while read -r folder; do
    find "$folder" -name '*.pc' -exec ln -sf -t "$BATS_TEST_TMPDIR/pc" {} + 2>/dev/null || true
  done
  rm "$BATS_TEST_TMPDIR/pc/OpenImageIO.pc"
  PKG_CONFIG_LIBDIR=$BATS_TEST_TMPDIR/pc says 'Not here (pkg-config names): OpenImageIO: run `make setup`.'
  printf 'Name: OpenEXR\nDescription: old\nVersion: 2.5.7\n' >"$BATS_TEST_TMPDIR/old/OpenEXR.pc"
  PKG_CONFIG_PATH=$BATS_TEST_TMPDIR/old says 'OpenEXR 2.5.7 is here, but 3.1 or newer is needed, as Debian 12 has.'
}

@test "without Embree or CGAL, make all says make setup" {
  blind_compiler
  says 'The library Embree 3 (embree3/rtcore.h) is not here: run `make setup`.' CC="$BATS_TEST_TMPDIR/cc"
  says 'The library CGAL (CGAL/version.h) is not here: run `make setup`.' CXX="$BATS_TEST_TMPDIR/cc"
}

@test "other flags rebuild, the same flags do not" {
  b=$BATS_TEST_TMPDIR/b
  one=$b/bakeslab/base/result.o
  house_make B="$b" CFLAGS=-O0 "$one"
  run house_make B="$b" CFLAGS=-O0 "$one"
  [[ $output != *CC* ]]
  run house_make B="$b" CFLAGS=-O1 "$one"
  [[ $output == *"CC    bakeslab/base/result.c"* ]]
}

@test "a failing, a crashing and a silent test are counted and shown" {
  log=$BATS_TEST_TMPDIR/x.log
  sh "$ROOT/tests/run.sh" "$log" printf '1..3\nok 1 a\nnot ok 2 b\nok 3 c # skip no reason\n'
  [ "$(cat "$log.count")" = "1 1 1" ]
  run -1 sh "$ROOT/tests/summary.sh" "$log"
  [ "${lines[0]}" = "skipped: ok 3 c # skip no reason" ]
  [ "${lines[1]}" = "1 passed, 1 failed" ]

  run sh "$ROOT/tests/run.sh" "$log" sh -c 'echo 1..2; echo "ok 1 a"; kill -9 $$'
  [[ $output == FAIL* ]]
  [ "$(cat "$log.count")" = "1 1 0" ]

  sh "$ROOT/tests/run.sh" "$log" true
  [ "$(cat "$log.count")" = "0 1 0" ]

  TEST_TIMEOUT=1 sh "$ROOT/tests/run.sh" "$log" sleep 20
  [ "$(cat "$log.count")" = "0 1 0" ]
}
