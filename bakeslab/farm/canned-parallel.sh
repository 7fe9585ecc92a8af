#!/usr/bin/env bash
# canned-parallel - a bake by GNU parallel, on machines that are reached by ssh.
#
# Where all see the working folder, each machine runs the same bake there. Where they do not
# (--copy), they bake shards in waves: each bakes its part of a round in a folder of its own, and
# what came back is brought together (bakeslab gather) before the next round is planned.
#
# O. Tange, GNU Parallel 2018, doi:10.5281/zenodo.1146014
set -euo pipefail
program=canned-parallel
# shellcheck source=bakeslab/farm/farm.sh
. "$(dirname -- "$(realpath -- "$0")")/../lib/canned/farm.sh"

help() {
  cat <<'END'
Usage: canned-parallel [OPTION...] [--] bakeslab bake LAMP.pov -o SLAB [OPTION...]
Bakes a lamp on several machines by GNU parallel and ssh, and waits for the slab.

  -S, --sshloginfile=FILE    The machines, a line each, as GNU parallel takes
                             them; : is this one, but not with --copy
                             (default: those of ~/.parallel/sshloginfile)
  -n, --workers=N            Bakes at a time (default: one a machine, with a
                             POV-Ray process for each of its processors)
      --copy                 The machines do not see the working folder: the
                             script and what it reads go there, and batches
                             come back
  -h, --help, --version

bakeslab and POV-Ray must be installed on all machines, and ssh must not ask for passwords. Without --copy the working folder must be there under the same name, as over NFS: workers share the bake's batches by the folder SLAB.partial, where what one that died had in hand is taken over. With --copy, lamps may read files of the working folder and folders below, and each machine bakes its part of each round; rsync is needed. The slab is the same, bit for bit, for any number of machines. A job that fails is tried three times; which are done is kept in SLAB.parallel until the slab is written, and the same command does the others again.

Examples:
  canned-parallel -S machines -- bakeslab bake lamp.pov -o lamp.tif
  canned-parallel -S machines --copy bakeslab bake lamp.pov -o lamp.tif \
    --rays 64
  make lamps CANNED_LAUNCH=parallel CANNED_LAUNCH_FLAGS='-S machines'

Exit status: 0 done, 1 failed, 2 usage.
END
}

machines=.. workers=0 copy=no
while [ $# -gt 0 ]; do
  case $1 in
    --?*=*) set -- "${1%%=*}" "${1#*=}" "${@:2}" ;;
  esac
  case $1 in
    -S | --sshloginfile | -n | --workers) [ $# -ge 2 ] || usage "$1: needs a value" ;;&
    -S | --sshloginfile) machines=$2 && shift 2 ;;
    -n | --workers) whole_number "$1" "$2" 4096 && workers=$2 && shift 2 ;;
    --copy) copy=yes && shift ;;
    -h | --help) help && exit 0 ;;
    --version) echo "$program $version" && exit 0 ;;
    --) shift && break ;;
    -*) usage "$1: no such option" ;;
    *) break ;;
  esac
done
take_bake "$@"
command -v parallel >/dev/null || fail 1 'GNU parallel is not here'
parallel --version 2>/dev/null | grep -q '^GNU parallel' || fail 1 'the parallel of this machine is not GNU parallel'
[ "$machines" != .. ] || machines=${PARALLEL_HOME:-$HOME/.parallel}/sshloginfile
[ -r "$machines" ] || fail 1 "$machines: cannot be read; it is to name a machine a line"
count=$(grep -cvE '^[[:space:]]*(#|$)' "$machines" || true)
[ "$count" -gt 0 ] || fail 1 "$machines: names no machine"
[ "$copy" = no ] || ! grep -qE '^[[:space:]]*([0-9]+/)?:[[:space:]]*$' "$machines" ||
  fail 1 "$machines: --copy: \`:' is this machine without ssh, to which nothing is copied; name it as ssh does"
[ "$workers" -gt 0 ] || workers=$count
[ "$copy" = no ] || [ "$workers" -gt 1 ] || workers=2 # one shard is no shard

# What is done is known of this bake only.
kept=$slab.parallel
mkdir -p -- "$kept" 2>/dev/null || fail 1 "$kept: this folder cannot be made"
told=$(printf '%q ' "$PWD" "$workers" "$copy" "${bake[@]}")
stale=no
for file in "${bake[@]:2}"; do
  if [ -f "$file" ] && [ "$file" != "$slab" ] && [ "$file" -nt "$kept/bake" ]; then stale=yes; fi
done
if [ "$(cat -- "$kept/bake" 2>/dev/null)" != "$told" ] || [ "$stale" = yes ]; then
  rm -rf -- "${kept:?}"/*
  printf '%s' "$told" >"$kept/bake"
fi

# each JOBLOG OPTION... TEXT: the text as a shell's command, once a worker, {} being its number.
# Whether the bake is well is seen by what it leaves.
each() {
  seq "$workers" | parallel --sshloginfile "$machines" --jobs "$(((workers + count - 1) / count))" \
    --joblog "$kept/$1" --resume-failed --retries 3 "${@:2}" 2>&1 | said_once || true
}

together() { each joblog --workdir "$PWD" ": {}; $(worker '')" >&2; }

# ---- Without a common folder ----

# Files of the working folder that the script reads, by a rule for make, with make's marks undone.
# Other files are those that programs bring along.
files_read() {
  sed -n '2,/^$/ { s/^  //; s/ \\$//; s/\$(if ,,=)/=/g; s/\\\([] #:*?[\\]\)/\1/g; s/\$\$/$/g; /^\//d; /./p }' "$1"
}

# The bake's words but -o and --depend, with their values.
other_words() {
  local n
  words=()
  for ((n = 2; n < ${#bake[@]}; ++n)); do
    case ${bake[n]} in
      -o | --depend) n=$((n + 1)) ;;
      -o?* | --depend=*) ;;
      *) words+=("${bake[n]}") ;;
    esac
  done
}

# wave NUMBER: each worker bakes its part of a round, as far as it is known, in a folder of its
# own; all that is whole of what comes back goes into SLAB.partial.
wave() {
  local n here=$kept/{}/${slab##*/} file quoted options=(--workdir ... --cleanup)
  quoted=$(printf '%q/{}/%q' "$kept" "${slab##*/}")
  for n in $(seq "$workers"); do
    mkdir -p -- "$kept/$n/${slab##*/}.partial"
    [ ! -d "$slab.partial" ] || cp -r -- "$slab.partial" "$kept/$n/"
  done
  while IFS= read -r file; do options+=(--transferfile "$file"); done < <(files_read "$kept/depend")
  options+=(--transferfile "$here.partial" --return "$here.partial")
  each "joblog.$1" "${options[@]}" "$(printf '%q ' "${bake[0]}" bake "${words[@]}") -q \
    -o $quoted --shard {}/$workers --round next" >"$kept/said"
  "${bake[0]}" gather "$kept"/*/"${slab##*/}.partial" -o "$slab.partial" -q || true
  rm -f -- "$kept/joblog.$1" # what is missing then is for the next wave
}

batches() { find "$slab.partial" -mindepth 1 -maxdepth 1 -name '????????????????????????????????' | wc -l; }

apart() {
  local number=0 had=-1 left=all file
  [[ ! $slab =~ ^/|(^|/)\.\./ ]] || fail 1 "$slab: --copy: is not below the working folder"
  command -v rsync >/dev/null || fail 1 '--copy: rsync is not here'
  other_words
  for file in "${words[@]}"; do
    [[ ! $file =~ (^/|(^|/)\.\./).*\.pov$ ]] || fail 1 "$file: --copy: is not below the working folder"
  done
  rm -f -- "$kept"/joblog.*
  # Small bakes that decide what the bake is to be: once, for all.
  "${bake[@]}" --dry-run --depend "$kept/depend" -q 2>"$kept/said" || { cat "$kept/said" >&2 && return; }
  while [ -n "$left" ] && mkdir -p -- "$slab.partial" && [ "$(batches)" -gt "$had" ]; do
    had=$(batches) number=$((number + 1))
    wave "$number"
    left=$("${bake[0]}" status --missing "$slab.partial") || break
  done
  if [ -n "$left" ]; then
    cat "$kept/said" >&2
    return
  fi
  "${bake[@]}" || true
}

if [ "$copy" = yes ]; then apart; else together; fi
is_written || fail 1 "$slab: was not written"
rm -rf -- "$kept"
