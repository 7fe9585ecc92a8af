#!/usr/bin/env bash
# canned-slurm - a bake by an array job of Slurm.
#
# 1. The array's tasks are workers: the same bake, on the folder that all nodes see. A task that
#    is killed, preempted or whose node fails begins again (--requeue), and so does one whose time
#    is up: half a minute before, it stops, and puts itself into the queue again.
# 2. A second job, which begins when all of these have ended, fails unless the slab was written.
#    Others may depend on it.
set -euo pipefail
program=canned-slurm
# shellcheck source=bakeslab/farm/farm.sh
. "$(dirname -- "$(realpath -- "$0")")/../lib/canned/farm.sh"

help() {
  cat <<'END'
Usage: canned-slurm [OPTION...] [--] bakeslab bake LAMP.pov -o SLAB [OPTION...]
Bakes a lamp by an array job of Slurm, and waits for the slab.

  -n, --workers=N            Tasks of the array, at most (default 16): each
                             helps when it gets its turn, and those that get
                             none before the slab is written end at once
  -c, --cpus=N               Processors of each (default 1)
  -s, --sbatch=OPTION        An option for sbatch, such as --time=2:00:00; may
                             be repeated. The environment is heard too
                             (SBATCH_PARTITION, SBATCH_ACCOUNT)
      --no-wait              Print the number of a job and end: it ends well
                             when the slab is written, so that other jobs may
                             depend on it (afterok)
  -h, --help, --version

All nodes must see the working folder, as over NFS. Workers share the bake's batches by the folder SLAB.partial: what one that died had in hand is taken over, and the slab is the same, bit for bit, for any number of them. Tasks that are killed with their node, preempted, or run out of time are put into the queue again. What they say is kept in SLAB.slurm until this program has seen the slab; `bakeslab status SLAB.partial` tells how far they are. When this program is interrupted it cancels its jobs; the same command goes on from there.

Examples:
  canned-slurm --workers 64 -- bakeslab bake lamp.pov -o lamp.tif
  canned-slurm -n 16 -c 8 -s --time=2:00:00 \
    bakeslab bake lamp.pov -o lamp.tif --rays 64
  make -j12 lamps CANNED_LAUNCH=slurm CANNED_LAUNCH_FLAGS='-n 32'

Exit status: 0 done, 1 failed, 2 usage.
END
}

workers=16 cpus=1 wait=yes options=()
while [ $# -gt 0 ]; do
  case $1 in
    --?*=*) set -- "${1%%=*}" "${1#*=}" "${@:2}" ;;
  esac
  case $1 in
    -n | --workers | -c | --cpus | -s | --sbatch) [ $# -ge 2 ] || usage "$1: needs a value" ;;&
    -n | --workers) whole_number "$1" "$2" 4096 && workers=$2 && shift 2 ;;
    -c | --cpus) whole_number "$1" "$2" 1024 && cpus=$2 && shift 2 ;;
    -s | --sbatch) options+=("$2") && shift 2 ;;
    --no-wait) wait=no && shift ;;
    -h | --help) help && exit 0 ;;
    --version) echo "$program $version" && exit 0 ;;
    --) shift && break ;;
    -*) usage "$1: no such option" ;;
    *) break ;;
  esac
done
take_bake "$@"
command -v sbatch >/dev/null || fail 1 'sbatch is not here: this is no machine of a Slurm cluster'

logs=$slab.slurm
mkdir -p -- "$logs" 2>/dev/null || fail 1 "$logs: this folder cannot be made"
rm -f -- "$logs"/*.log

# submit OPTION...: a job by its text on stdin; its number on stdout.
submit() {
  local said
  said=$(sbatch --parsable --open-mode=append "$@" 2>&1) ||
    fail 1 "sbatch: $(grep -m 1 . <<<"$said" | sed 's/^sbatch: *\(error: \)*//')"
  sed -n 's/^\([0-9][0-9]*\)\(;.*\)*$/\1/p' <<<"$said"
}

# shellcheck disable=SC2016 # for the task's shell
task() {
  printf '#!/bin/bash\nagain() {\n  kill -TERM "$!"; wait "$!"\n'
  printf '  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"\n  exit 1\n}\ntrap again USR1\n'
  printf '(\n%s) &\nwait "$!"\n' "$(worker '"${SLURM_CPUS_PER_TASK:-1}"')"$'\n'
}

# shellcheck disable=SC2016
closing() {
  printf '#!/bin/bash\ncd %q || exit 1\nls -- %q >/dev/null\n' "$PWD" "$(dirname -- "$slab")"
  printf '[ -e %q ] && [ "$(stat -c "%%s %%.9Y" -- %q)" != %q ]\n' "$slab" "$slab" "$before"
}

# Ctrl-C ends the wait at once, since a shell waits for what is in the background only.
array=
# shellcheck disable=SC2317
cancel() {
  trap - INT TERM HUP EXIT
  [ -z "$array" ] || scancel "$array" 2>/dev/null || true
  exit 1
}
trap cancel INT TERM HUP

# A number of a log of an array is the task's.
name=bake-$(basename -- "$slab")
array=$(task | submit --array="1-$workers" --requeue --cpus-per-task="$cpus" --signal=B:USR1@30 \
  --job-name="$name" --output="${logs//%/%%}/%a.log" ${options[@]+"${options[@]}"}) || {
  rmdir -- "$logs"
  exit 1
}
closing_options=(--dependency="afterany:$array" --job-name="$name-end" --output=/dev/null
  ${options[@]+"${options[@]}"})
if [ "$wait" = no ]; then
  closing | submit "${closing_options[@]}" || cancel
  exit
fi
closing | sbatch --wait --parsable "${closing_options[@]}" >"$logs/closing" 2>&1 &
wait "$!" || true
if ! grep -q '^[0-9]' "$logs/closing"; then
  echo "$program: sbatch: $(grep -m 1 . "$logs/closing" | sed 's/^sbatch: *\(error: \)*//')" >&2
  cancel
fi
cat -- "$logs"/*.log 2>/dev/null | said_once >&2
is_written || fail 1 "$slab: was not written; what the workers said is in $logs"
rm -rf -- "$logs"
