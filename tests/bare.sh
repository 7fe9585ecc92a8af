#!/usr/bin/env bash
# bare.sh LOG [OPTION...] GOAL... - makes each GOAL, as a new user types it, in a clone of the
# committed HEAD on a bare Debian 12: git, make and what they need, no compiler, no library. The
# machine is a scratch folder below TMPDIR, which goes with all that was mounted in it, whatever
# happens. OPTIONs of make (-j1, T=...) go with each goal. All that is said is kept in LOG.
set -euo pipefail

fail() {
  echo "make bare: $*" >&2
  exit 1
}

# The source of Debian 12 that this machine's apt uses; where there is none, debootstrap knows one.
host_mirror() {
  # shellcheck disable=SC2016
  apt-get indextargets --format '$(CODENAME) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' 2>/dev/null |
    awk '$1 == "bookworm" && $2 == "main" && !found++ { print $3 }'
}

# How this machine reaches the network, and settings of its apt that are no Debian package's.
like_this_machine() {
  local file
  for file in /etc/resolv.conf /etc/hosts; do
    [ ! -e "$file" ] || cp -L "$file" "$root$file"
  done
  for file in /etc/apt/apt.conf.d/*; do
    dpkg -S "$file" >/dev/null 2>&1 || cp "$file" "$root$file"
  done
}

on_machine() {
  local variable kept=()
  for variable in http_proxy https_proxy no_proxy; do
    [ -z "${!variable-}" ] || kept+=("$variable=${!variable}")
  done
  env -i HOME=/root PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin TERM=dumb "${kept[@]}" \
    chroot "$root" "$@" </dev/null
}

debian() {
  local mirror
  mirror=$(host_mirror)
  debootstrap --variant=minbase --include=ca-certificates,git,make bookworm "$root" ${mirror:+"$mirror"} >"$scratch/debootstrap" 2>&1 ||
    { tail -n 20 "$scratch/debootstrap" && fail "debootstrap could not make a Debian 12${mirror:+ from $mirror}"; }
  like_this_machine
  # It is thrown away: its packages need not reach the disk.
  echo force-unsafe-io >"$root/etc/dpkg/dpkg.cfg.d/unsafe-io"
  mount --rbind /proc "$root/proc"
  mount --rbind /dev "$root/dev"
  if on_machine sh -c 'command -v cc || command -v gcc || command -v pkg-config'; then fail 'it has a compiler already'; fi
  # The repository may be another user's.
  printf '[safe]\n\tdirectory = *\n' >"$scratch/gitconfig"
  GIT_CONFIG_GLOBAL=$scratch/gitconfig git clone -q . "$root/srv/canned"
}

begin() {
  what=$1 start=$SECONDS
  echo "make bare: $what"
}

# end NOTE: how long it took goes to the summary.
end() {
  [ -z "$what" ] || printf 'make bare: %5d s  %s%s\n' $((SECONDS - start)) "$what" "$1" >>"$scratch/summary"
  what=
}

# In a namespace whose mounts nobody else sees, and end with the last process of it.
inside() {
  local word options=() goals=()
  for word in "$@"; do
    case $word in -* | *=*) options+=("$word") ;; *) goals+=("$word") ;; esac
  done
  what=
  trap 'end ": failed"' EXIT
  [ "${#goals[@]}" -gt 0 ] || fail 'BARE names no goal'
  begin 'a bare Debian 12'
  debian
  end ''
  for word in "${goals[@]}"; do
    begin "make ${options[*]}${options:+ }$word"
    # shellcheck disable=SC2016
    on_machine sh -c 'cd /srv/canned && exec make "$@"' make "${options[@]}" "$word"
    end ''
  done
}

# Ends whatever still runs there, and removes it.
leave() {
  local process
  # Disowned, so that bash does not tell of its end.
  [ -z "${session-}" ] || { disown "$session"; kill -KILL -- "-$session"; } 2>/dev/null || true
  for process in /proc/[0-9]*; do
    [ "$(readlink "$process/root" 2>/dev/null)" != "$root" ] || kill -KILL "${process##*/}" 2>/dev/null || true
  done
  wait
  rm -rf --one-file-system "$scratch" 2>/dev/null || { sleep 1 && rm -rf --one-file-system "$scratch"; }
}

if [ "$1" = --inside ]; then
  scratch=$2 root=$2/debian
  shift 2
  inside "$@"
  exit
fi

log=$1
shift
[ "$(id -u)" -eq 0 ] || fail 'only root can make a bare machine'
for tool in debootstrap git; do
  command -v "$tool" >/dev/null || fail "$tool is not here: run \`make setup\`"
done
unshare --mount true 2>/dev/null || fail 'root may not mount here: run it on a machine of its own'
mkdir -p "${log%/*}"
scratch=$(mktemp -d "${TMPDIR:-/tmp}/bare.XXXXXX") root=$scratch/debian
: >"$log"
trap leave EXIT
trap 'exit 1' HUP INT TERM
setsid unshare --mount bash "$0" --inside "$scratch" "$@" >"$log" 2>&1 </dev/null &
session=$!
tail -n +1 -s 0.5 -f --pid="$session" "$log" &
status=0
wait "$session" || status=$?
wait
[ ! -e "$scratch/summary" ] || tee -a "$log" <"$scratch/summary"
[ "$status" -eq 0 ] || fail "failed; all that was said is in $log"
