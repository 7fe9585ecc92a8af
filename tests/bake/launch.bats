#!/usr/bin/env bats
# canned-slurm and canned-parallel as a user meets them, with a stand-in for sbatch; `make farm-test`
# runs them with Slurm and ssh.
# shellcheck disable=SC2154 # run sets stderr
load bake

setup() {
  bake_setup
  PATH=${BAKESLAB%/*}:$PWD:$PATH
}

# An sbatch that notes its options and runs a job's tasks at once, one after the other.
stand_in() {
  cat >sbatch <<'END'
#!/bin/bash
echo "$*" >>asked
tasks=1 log=/dev/null
for word; do case $word in --array=1-*) tasks=${word#--array=1-} ;; --output=*) log=${word#*=} ;; esac; done
cat >task
for ((k = 1; k <= tasks; ++k)); do SLURM_CPUS_PER_TASK=3 bash task >>"${log/\%a/$k}" 2>&1; done
echo 7
END
  chmod +x sbatch
}

@test "an array of tasks bakes, a second job looks whether it did; what they say is said once" {
  stand_in
  run -0 --separate-stderr canned-slurm -n 3 -c 3 -s --time=9 -- "$BAKESLAB" bake flat.pov -o x.tif --uv 2 --st 4 --rays 4
  [ -z "$output" ]
  [ "$(grep -c 'x.tif: 1 batches' <<<"$stderr")" -eq 1 ]
  [[ $(sed -n 1p asked) == *"--array=1-3 --requeue --cpus-per-task=3 --signal=B:USR1@30 "*"--output=x.tif.slurm/%a.log --time=9" ]]
  [[ $(sed -n 2p asked) == *"--dependency=afterany:7 "*"--time=9" ]]
  [ ! -e x.tif.slurm ]
  # A lamp that cannot be baked: each task says so.
  run -1 --separate-stderr canned-slurm -n 2 -- "$BAKESLAB" bake none.pov -o z.tif
  [ "$(grep -c 'none.pov' <<<"$stderr")" -eq 1 ]
  [[ $stderr == *"canned-slurm: z.tif: was not written; what the workers said is in z.tif.slurm" ]]
}

# says STATUS LINE COMMAND...: one line on stderr.
says() {
  run "-$1" --separate-stderr "${@:3}"
  [ "$stderr" = "$2" ] || { echo "$stderr" && false; }
}

@test "what cannot be done is told in one line" {
  local it
  for it in canned-slurm canned-parallel; do
    says 2 "$it: no command given; see \`$it --help\`" "$it"
    says 2 "$it: --nodes: no such option; see \`$it --help\`" "$it" --nodes 3 bakeslab bake
    says 2 "$it: --workers 0: not a whole number from 1 to 4096; see \`$it --help\`" "$it" --workers=0
    says 2 "$it: bakeslab info: not a command such as \`bakeslab bake lamp.pov -o lamp.tif\`; see \`$it --help\`" "$it" bakeslab info
    says 2 "$it: the command has no -o SLAB; see \`$it --help\`" "$it" -- bakeslab bake a.pov
    says 2 "$it: --shard: workers share the work by themselves; see \`$it --help\`" "$it" bakeslab bake a.pov -o a.tif --shard 1/2
    says 1 "$it: no/a.tif: its folder is not there" "$it" bakeslab bake a.pov -o no/a.tif
  done
  if command -v parallel >/dev/null; then
    printf 'far\n2/:\n' >machines
    says 1 "canned-parallel: machines: --copy: \`:' is this machine without ssh, to which nothing is copied; name it as ssh does" \
      canned-parallel -S machines --copy bakeslab bake flat.pov -o a.tif
    [ ! -e a.tif.parallel ]
  fi
  printf '#!/bin/sh\necho "sbatch: error: invalid partition specified: x" >&2; exit 1\n' >sbatch
  chmod +x sbatch
  says 1 'canned-slurm: sbatch: invalid partition specified: x' canned-slurm bakeslab bake flat.pov -o a.tif
  [ ! -e a.tif.slurm ]
}
