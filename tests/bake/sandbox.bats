#!/usr/bin/env bats
# --sandbox: POV-Ray reads what it likes, and can do no harm.
load bake

setup() {
  bake_setup
  # A POV-Ray that tries to do harm first, and renders only if it could not.
  cat >nosy <<'NOSY'
#!/bin/bash
[ "$1" = --version ] && exec povray --version
harm=
: 2>/dev/null >"$NOSY_TOP/harm" && harm+=' writes elsewhere'
: 2>/dev/null >"$PWD/../harm" && harm+=' writes beside its folder'
[ "$(grep -c : /proc/net/dev)" -le 1 ] || harm+=' network'
[ -z "$(ls -A /run)" ] || [ "$(ls -A /run)" = media ] || harm+=' services'
[ "$(find /proc -maxdepth 1 -name '[0-9]*' | wc -l)" -lt 10 ] || harm+=' processes'
[ -z "$harm" ] || { echo "Fatal error: $harm"; exit 1; }
exec povray "$@"
NOSY
  chmod +x nosy
  export NOSY_TOP=$PWD
}

needs_walls() {
  needs bwrap
  run bwrap --unshare-all --ro-bind / / --dev /dev --proc /proc true
  [ "$status" -eq 0 ] || skip "bubblewrap cannot make a sandbox here: $output"
}

@test "the same bits, from a POV-Ray that can neither write elsewhere nor reach a network" {
  needs_walls
  small flat.pov -o plain.exr
  small flat.pov -o walled.exr --sandbox --povray ./nosy
  same plain.exr walled.exr
  [ ! -e harm ]
  refused 1 'writes elsewhere' out.exr small flat.pov -o out.exr --povray ./nosy
  [ -e harm ]
}

@test "a script cannot write outside its folder" {
  needs_walls
  flat_lamp write.pov "#fopen F \"$PWD/written\" write
#write (F, \"harm\")"
  refused 1 'write.pov.*written' out.exr small write.pov -o out.exr --sandbox
  [ ! -e written ]
}

@test "interrupted, no process is left" {
  needs_walls
  slow_lamp
  begin_slow --sandbox
  kill -KILL $!
  wait $! || true
  no_process_left 40
}

@test "without bubblewrap, or where it may make nothing: one clear line" {
  mkdir empty small-rights
  refused 1 'install bubblewrap' out.exr env PATH="$PWD/empty" "$BAKESLAB" bake flat.pov -o out.exr --sandbox \
    --povray "$(command -v povray)"
  printf '#!/bin/sh\necho "bwrap: No permissions to create new namespace" >&2\nexit 1\n' >small-rights/bwrap
  chmod +x small-rights/bwrap
  refused 1 'cannot make one here.*No permissions' out.exr env PATH="$PWD/small-rights:$PATH" "$BAKESLAB" bake \
    flat.pov -o out.exr --sandbox
}
