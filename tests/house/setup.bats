#!/usr/bin/env bats
# Set-up, against stand-ins for apt and for whatever builds: it comes first and ends before anything
# else begins, installs what is missing, and tells in one line what it could not.
load house

set_up() { house_make SETUP=yes B="$BATS_TEST_TMPDIR/b" "$@"; }

# A folder that comes first in PATH: a dpkg-query that knows every package but
# those in MISSING, and apt-get and sudo that write down how they were called.
fake_debian() {
  fake=$BATS_TEST_TMPDIR/fake
  mkdir -p "$fake"
  fake_tool dpkg-query 'for p in "$@"; do
  case " $MISSING " in *" $p "*) continue ;; esac
  case $p in -*) ;; *) echo "installed $p" ;; esac
done'
  fake_tool apt-get "echo \"apt-get \$*\" >>'$fake/called'"
  fake_tool sudo '"$@"'
  PATH=$fake:$PATH
}

fake_tool() { # NAME TEXT
  printf '#!/bin/sh\n%s\n' "$2" >"$fake/$1"
  chmod +x "$fake/$1"
}

# An apt-get that takes its time, and programs that build, which fail, and tell when they were
# called: early or late. What is in the build folder when set-up ends came early too.
fake_builders() {
  local tool
  fake_tool apt-get "case \$1 in install) ;; *) exit ;; esac
sleep 0.3
find '$BATS_TEST_TMPDIR/b' -type f ! -name setup.log >>'$fake/early'
touch '$fake/ended'"
  for tool in gcc g++ clang clang++ pkg-config ar povray scdoc help2man bats gnuplot jq oiiotool; do
    fake_tool "$tool" "if [ -e '$fake/ended' ]; then when=late; else when=early; fi
echo \"$tool \$*\" >>'$fake/'\$when
exit 1"
  done
}

# Whoever sets up by himself, but for those that build nothing.
goals() { sed -n 's/^SETS_UP := //p' "$ROOT/setup.mk" | tr ' ' '\n' | grep -vxE 'setup|bare'; }

@test "nothing is made, compiled or asked of pkg-config before set-up has ended" {
  local goal jobs
  fake_debian
  fake_builders
  [ "$(goals | wc -l)" -ge 13 ]
  while read -r goal; do
    for jobs in -j1 -j8; do
      rm -rf "$fake"/{ended,early,late} "$BATS_TEST_TMPDIR/b"
      # shellcheck disable=SC2086
      MISSING=gcc run ! set_up $jobs FIGURES="$BATS_TEST_TMPDIR/b/figures" $goal
      echo "$jobs $goal: $output"
      [ -e "$fake/ended" ]
      [ ! -s "$fake/early" ] || { cat "$fake/early"; false; }
      [ -s "$fake/late" ]
      [[ $output != *jobserver* ]]
    done
  done < <(goals && printf '%s\n' 'demo test' 'setup all' 'all man' "$BATS_TEST_TMPDIR/b/bin/bakeslab test")
}

@test "where set-up fails nothing else begins" {
  fake_debian
  fake_builders
  fake_tool apt-get 'exit 100'
  MISSING=gcc run ! set_up -j8 demo test
  [ ! -e "$fake/early" ]
  [ "$(find "$BATS_TEST_TMPDIR/b" -type f)" = "$BATS_TEST_TMPDIR/b/setup.log" ]
}

@test "what a command line says reaches the second make" {
  fake_debian
  run ! set_up test T='unit/none cli/none'
  [[ $output == *"T=unit/none cli/none names no test"* ]]
  run set_up -j1 config=fast test
  [[ $output == *"config=fast is none of"* ]]
}

@test "set-up installs what is missing, named first, and nothing twice" {
  fake_debian
  MISSING='bats povray' run -0 set_up setup
  [ "${lines[0]}" = "make setup: apt installs bats povray" ]
  [ "$(cat "$fake/called")" = "apt-get update -qq
apt-get install -y -q --no-install-recommends bats povray" ]

  rm "$fake/called"
  MISSING='' run -0 set_up setup
  [ -z "$output" ]
  [ ! -e "$fake/called" ]
}

@test "SETUP=no asks nobody" {
  fake_debian
  MISSING='bats povray' run -0 house_make SETUP=no setup
  [ ! -e "$fake/called" ]
}

@test "without network set-up names the packages and the reason in one line" {
  fake_debian
  fake_tool apt-get "case \$1 in
  update) echo 'W: Failed to fetch http://mirror/InRelease  Temporary failure resolving mirror' ;;
  *) echo 'E: Unable to locate package libtiff-dev' >&2; exit 100 ;;
esac"
  MISSING='libtiff-dev bats' run ! set_up test
  [ "$(grep -c 'could not' <<<"$output")" -eq 1 ]
  [[ $output == *"make setup: apt could not install bats libtiff-dev: Failed to fetch http://mirror/InRelease "*"resolving mirror; "*setup.log* ]]
}

@test "what apt says of a package that it does not have is told" {
  fake_debian
  fake_tool apt-get "[ \$1 = update ] || { echo 'E: Unable to locate package bats'; exit 100; }"
  MISSING=bats run ! set_up test
  [[ $output == *"make setup: apt could not install bats: Unable to locate package bats; "* ]]
}

# A PATH with what the Makefile needs and nothing else.
bare_path() {
  bare=$BATS_TEST_TMPDIR/bare
  mkdir -p "$bare"
  for tool in sh bash env make sed grep mkdir awk find nproc tail cat rm id uname; do
    ln -s "$(command -v "$tool")" "$bare/$tool"
  done
  PATH=$bare
}

@test "where there is no apt, set-up names what is needed in one line" {
  bare_path
  run ! set_up setup
  [[ ${lines[0]} == *"no apt here: install C and C++ compilers"*libtiff*OpenEXR*jansson*xxhash*CGAL*OpenImageIO*Embree*libpng*POV-Ray* ]]
}

@test "neither root nor sudo: set-up says what to ask for" {
  fake_debian
  rm "$fake/sudo"
  fake_tool id 'echo 1000'
  bare_path
  PATH=$fake:$bare
  MISSING='povray' run ! set_up setup
  [[ $output == *"neither root nor sudo: as root, apt-get install povray"* ]]
  [ ! -e "$fake/called" ]
}

@test "each goal asks for its own packages only, and make -n for none" {
  fake_debian
  export MISSING='gcc povray libcmocka-dev debootstrap'
  run set_up -n demo
  [[ $output == *povray* && $output != *libcmocka-dev* ]]
  run set_up -n test
  [[ $output == *povray* && $output == *libcmocka-dev* && $output != *clang-tidy* ]]
  run set_up -n demo lint
  [[ $output == *povray* && $output == *clang-tidy* ]]
  run set_up -n bare
  [[ $output == *debootstrap* && $output != *povray* ]]
  run set_up -n all
  [[ $output != *setup.sh* ]]
  [ ! -e "$fake/called" ]
}

@test "make bare says what it lacks, and fails" {
  fake_debian
  fake_tool id 'echo 1000'
  run -1 bash "$ROOT/tests/bare.sh" "$BATS_TEST_TMPDIR/log" demo
  [ "$output" = 'make bare: only root can make a bare machine' ]
  fake_tool id 'echo 0'
  bare_path
  PATH=$fake:$bare run -1 bash "$ROOT/tests/bare.sh" "$BATS_TEST_TMPDIR/log" demo
  [ "$output" = 'make bare: debootstrap is not here: run `make setup`' ]
}
