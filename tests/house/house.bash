# What the house tests share. They call make in the repository with a build
# folder of their own, so that they never meet the build they are run from.
# shellcheck shell=bash
load ../testing
ROOT=$(cd "$BATS_TEST_DIRNAME/../.." && pwd)

# make as a user calls it, whatever make runs these tests.
house_make() {
  env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL -u MAKEOVERRIDES -u T \
    make --no-print-directory -C "$ROOT" SETUP=no "$@"
}

# The subcommands that `PROGRAM --help` lists.
commands() {
  "$1" --help | sed -n 's/^  \([a-z]\{1,\}\)  .*/\1/p' | grep -vx help
}
