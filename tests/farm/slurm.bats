#!/usr/bin/env bats
# Bakes by array jobs of Slurm on four nodes: the same slab as by one process, each ray once, but
# for what killed jobs had in hand.
load farm

setup_file() {
  load farm
  farm_begin
  slurm_begin
  alone cheap
  alone tin
}
teardown_file() { load farm && farm_end; }
setup() { cd "$BATS_FILE_TMPDIR" && rm -f rendered; }

# kills SLAB TASK...: as the batches grow, tasks are killed or put into the queue again, in turn.
kills() {
  local slab=$1 job task done=4 turn=0
  shift
  job=$(array_of "$slab")
  for task; do
    wait_for_batches "$slab.partial" "$done"
    case $((turn++ % 2)) in
      0) scontrol requeue "${job}_$task" ;;
      1) scancel --signal=KILL "${job}_$task" ;;
    esac
    echo "${job}_$task with $done batches"
    done=$((done + 20))
  done
}

@test "an array of eight tasks: cheap lamp" {
  # shellcheck disable=SC2046
  canned-slurm -n 8 -- $(cheap) -o array.tif
  same array.tif cheap.tif
  within "$(rendered)" "$(cat cheap.rays)" 1.01
  [ ! -e array.tif.slurm ] && [ ! -e array.tif.partial ]
}

@test "an array of four tasks of two processors: interreflection" {
  # shellcheck disable=SC2046
  canned-slurm -n 4 -c 2 -- $(tin) -o array2.tif
  same array2.tif tin.tif
  within "$(rendered)" "$(cat tin.rays)" 1.01
}

@test "every third task killed: cheap lamp" {
  # shellcheck disable=SC2046
  canned-slurm -n 6 -- $(cheap) -o killed.tif 2>log 3>&- &
  kills killed.tif 2 5 >killed.log 2>&1 || { cat killed.log log && false; }
  wait "$!" || { cat log && false; }
  same killed.tif cheap.tif
  within "$(rendered)" "$(cat cheap.rays)" 1.05
}

@test "every third task killed: interreflection" {
  # shellcheck disable=SC2046
  canned-slurm -n 3 -- $(tin) -o killed2.tif 2>log 3>&- &
  kills killed2.tif 2 >killed.log 2>&1 || { cat killed.log log && false; }
  wait "$!" || { cat log && false; }
  same killed2.tif tin.tif
  within "$(rendered)" "$(cat tin.rays)" 1.05
}

@test "jobs that depend on a slab: its number without waiting, and what it says where it fails" {
  local job
  # shellcheck disable=SC2046
  job=$(canned-slurm -n 2 --no-wait -- $(RAYS=2 cheap) -o later.tif)
  sbatch --wait --dependency="afterok:$job" --output=next.log --wrap="$BAKESLAB info $PWD/later.tif"
  grep -q 'later.tif: page 1' next.log
  [ -e later.tif ]
  run -1 canned-slurm -n 2 -- "$BAKESLAB" bake missing.pov -o x.tif
  [ "$(grep -c missing.pov <<<"$output")" -eq 1 ] # both tasks said so
  [[ $output == *"canned-slurm: x.tif: was not written"* ]]
}

@test "make lamps CANNED_LAUNCH=slurm" {
  mkdir -p shelf lamps
  cp cheap.pov part.inc lamps
  env -u MAKEFLAGS -u MFLAGS -u MAKELEVEL -u MAKEOVERRIDES make --no-print-directory -C "$CANNED_INCLUDE/.." SETUP=no lamps SHELF="$PWD/shelf" SHELF_LAMPS="$PWD/lamps/cheap.pov" \
    SHELF_FLAGS='--uv 2 --st 4 --rays 4' CANNED_LAUNCH=slurm CANNED_LAUNCH_FLAGS='-n 2'
  grep -q 'cheap' shelf/index.html
  [ -s shelf/cheap.tif ] && [ ! -e shelf/cheap.error ]
}
