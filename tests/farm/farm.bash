# farm.bash - a farm on this machine: Slurm with four nodes, sshd with four names, and two lamps.
# shellcheck shell=bash
load ../testing
FARM_NODES=4 FARM_PORT=${FARM_PORT:-46810}

# farm_begin: in a folder of its own; sets what programs find the farm by. farm_end ends it.
farm_begin() {
  export FARM=$BATS_FILE_TMPDIR/farm PATH=${BAKESLAB%/*}:$PATH SLURM_CONF=$BATS_FILE_TMPDIR/farm/slurm.conf
  mkdir "$FARM" && chmod 755 "$FARM"
  cd "$BATS_FILE_TMPDIR" || return 1
  stand_in
  lamps
}

# A POV-Ray that notes what it is to render, and by whom: width, height, frames.
stand_in() {
  cat >counted <<END
#!/bin/sh
[ "\$1" != --version ] || exec povray --version
echo \$(sed -n 's/^\(Width\|Height\|Final_Frame\)=//p' render.ini) 1 >>$PWD/rendered
exec povray "\$@"
END
  chmod +x counted
}

# Rays that were begun since the last count, whether or not they were ended: those of small bakes,
# too, but not of the trial run that each process begins with (pictures of a width of 16). Of a batch
# whose worker was killed that is more than was rendered, and a worker may be about to end one batch
# when it begins the next.
rendered() { awk '$1 != 16 { sum += $1 * $2 * $3 } END { print sum + 0 }' rendered && rm rendered; }

# within COUNT WANTED FACTOR: no more than so many times as much; told.
within() {
  awk -v got="$1" -v wanted="$2" -v most="$3" -v name="$BATS_TEST_DESCRIPTION" 'BEGIN {
    printf "# %s: %.4f times the rays of one process (at most %s)\n", name, got / wanted, most
    exit got > most * wanted }' >&3
}

lamps() {
  cat >cheap.pov <<'LAMP'
#version 3.7;
#include "canned.inc"
#include "part.inc"
Canned_Lamp("cheap")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, <2, 0, 0>, <0, 2, 0>, <0, 0, 1>, <-1, 1, -1, 1>, 0)
box { <-50, -50, -2.1>, <50, 50, -2> pigment { checker rgb 1 rgb <0.1, 0.4, 0> } finish { emission Part diffuse 0 } }
LAMP
  echo '#declare Part = 0.5;' >part.inc
  cp "$CANNED_INCLUDE/../lamps/desk_lamp.pov" tin.pov
}

# The two bakes, as words: of 80 batches without interreflection, of 32 and a pilot with it.
cheap() { echo "$BAKESLAB bake cheap.pov --povray $PWD/counted --uv 16 --st 32 --rays ${RAYS:-320} --uniform"; }
tin() { echo "$BAKESLAB bake tin.pov --povray $PWD/counted --uv 16 --st 32 --rays ${RAYS:-128}"; }

# alone LAMP: LAMP.tif and what it takes, by one process with two POV-Rays; once for all files.
alone() {
  local all=$BATS_RUN_TMPDIR
  if [ ! -e "$all/$1.rays" ]; then
    rm -f rendered
    $($1) -o "$all/$1.tif" --jobs 2 -q
    rendered >"$all/$1.rays"
  fi
  cp "$all/$1.tif" "$all/$1.rays" .
}

same() { "$BAKESLAB" diff --tolerance 0 "$1" "$2"; }

finished() { find "$1" -mindepth 1 -maxdepth 1 -type d -name '????????????????????????????????' 2>/dev/null | wc -l; }

# Waits, at most five minutes, until a bake has so many batches.
wait_for_batches() {
  local tries=3000
  while [ "$(finished "$1")" -lt "$2" ]; do
    [ "$((tries -= 1))" -gt 0 ] || { echo "$1: no $2 batches"; return 1; }
    sleep 0.1
  done
}

# ---- Slurm ----

slurm_begin() {
  local host node
  needs slurmctld slurmd sbatch munged
  host=$(hostname -s)
  mkdir -p "$FARM"/{state,log,munge}
  head -c 64 /dev/urandom >"$FARM/munge/key" && chmod 600 "$FARM/munge/key"
  munged --force --socket "$FARM/munge/socket" --key-file "$FARM/munge/key" --pid-file "$FARM/munged.pid" \
    --log-file "$FARM/munge/log" --seed-file "$FARM/munge/seed"
  cat >"$SLURM_CONF" <<END
ClusterName=farm
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$FARM_PORT
AuthType=auth/munge
AuthInfo=socket=$FARM/munge/socket
CredType=cred/munge
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$FARM/state
SlurmdSpoolDir=$FARM/spool.%n
SlurmctldPidFile=$FARM/slurmctld.pid
SlurmdPidFile=$FARM/slurmd.%n.pid
SlurmctldLogFile=$FARM/log/slurmctld
SlurmdLogFile=$FARM/log/slurmd.%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
ReturnToService=2
KillWait=2
CommunicationParameters=NoInAddrAny
SlurmdParameters=config_overrides
$(for ((node = 1; node <= FARM_NODES; ++node)); do
    echo "NodeName=node$node NodeHostname=$host NodeAddr=127.0.0.1 Port=$((FARM_PORT + node)) CPUs=2 RealMemory=1000 State=UNKNOWN"
  done)
PartitionName=main Nodes=node[1-$FARM_NODES] Default=YES MaxTime=INFINITE State=UP
END
  slurmctld
  for ((node = 1; node <= FARM_NODES; ++node)); do slurmd -N "node$node"; done
  watch_over
  wait_for_nodes || { tail -n 5 "$FARM"/log/*; return 1; }
}

wait_for_nodes() {
  local tries=300
  until [ "$(sinfo -h -t idle -o %D 2>/dev/null)" = "$FARM_NODES" ]; do
    [ "$((tries -= 1))" -gt 0 ] || return 1
    sleep 0.1
  done
}

# The number of the array job of a slab, once it is there.
array_of() {
  local job tries=600
  until job=$(squeue -h -r -n "bake-$1" -o %F | head -n 1) && [ -n "$job" ]; do
    [ "$((tries -= 1))" -gt 0 ] || return 1
    sleep 0.1
  done
  echo "$job"
}

# ---- Machines by ssh ----

ssh_begin() {
  local node
  needs ssh parallel rsync
  mkdir -p "$FARM/ssh" /run/sshd && chmod 700 "$FARM/ssh"
  for key in host user; do ssh-keygen -q -t ed25519 -N '' -f "$FARM/ssh/$key"; done
  cat >"$FARM/ssh/sshd_config" <<END
ListenAddress 127.0.0.1:$((FARM_PORT + 20))
HostKey $FARM/ssh/host
PidFile $FARM/sshd.pid
AuthorizedKeysFile $FARM/ssh/user.pub
StrictModes no
UsePAM no
PermitRootLogin prohibit-password
PasswordAuthentication no
MaxStartups 100
END
  cat >"$FARM/ssh/config" <<END
Host node*
  HostName 127.0.0.1
  Port $((FARM_PORT + 20))
  IdentityFile $FARM/ssh/user
  IdentitiesOnly yes
  UserKnownHostsFile $FARM/ssh/known
  StrictHostKeyChecking accept-new
  LogLevel ERROR
END
  "$(PATH=$PATH:/usr/sbin command -v sshd)" -f "$FARM/ssh/sshd_config"
  for ((node = 1; node <= FARM_NODES; ++node)); do echo "ssh -F $FARM/ssh/config node$node"; done >machines
  watch_over
  export PARALLEL_HOME=$FARM/parallel
}

daemons() { cat "$FARM"/*.pid 2>/dev/null; }

# Where the tests are interrupted bats removes their folder, and nobody calls farm_end.
watch_over() {
  # shellcheck disable=SC2046
  setsid sh -c 'while [ -e "$0" ]; do sleep 2; done; kill "$@"' "$FARM" $(daemons) >/dev/null 2>&1 3>&- &
}

# Ends the daemons that were begun here, by their numbers.
farm_end() {
  local pid
  [ ! -e "$FARM/slurmctld.pid" ] || scancel -u "$(id -un)" 2>/dev/null || true
  for pid in $(daemons); do kill "$pid" 2>/dev/null || true; done
  rm -rf "$FARM"
}
