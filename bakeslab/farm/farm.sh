# shellcheck shell=bash
# farm.sh - what canned-slurm and canned-parallel share. They set `program`, their name. A bake's
# command comes in; what each worker runs leaves: the same bake, on the same folder, which is the
# queue (bake_claim.h).
# shellcheck disable=SC2034,SC2154 # set here and read there, or the other way round
version=@VERSION@

fail() { # STATUS WORD...
  local status=$1
  shift
  echo "$program: $*" >&2
  exit "$status"
}

usage() { fail 2 "$*; see \`$program --help\`"; }

# What says whether a file was written anew, without a clock of this machine.
stamp() { stat -c '%s %.9Y' -- "$1" 2>/dev/null || echo none; }

# take_bake WORD...: sets bake, the words of a command `BAKESLAB bake ...`, slab, what it writes,
# and before, the stamp of the slab that is there.
take_bake() {
  local n
  [ $# -gt 0 ] || usage 'no command given'
  [ "${2-}" = bake ] || usage "$*: not a command such as \`bakeslab bake lamp.pov -o lamp.tif\`"
  bake=("$@") slab=
  for ((n = 2; n < $#; ++n)); do
    case ${bake[n]} in
      -o) slab=${bake[n + 1]-} ;;
      -o?*) slab=${bake[n]#-o} ;;
      --shard | --shard=*) usage "${bake[n]}: workers share the work by themselves" ;;
    esac
  done
  [ -n "$slab" ] || usage 'the command has no -o SLAB'
  [ "$slab" != - ] || usage '-o -: workers need a file'
  [ -d "$(dirname -- "$slab")" ] || fail 1 "$slab: its folder is not there"
  before=$(stamp "$slab")
}

whole_number() { # OPTION VALUE MOST
  if [[ ! $2 =~ ^[1-9][0-9]{0,6}$ ]] || [ "$2" -gt "$3" ]; then
    usage "$1 $2: not a whole number from 1 to $3"
  fi
}

# worker JOBS: a text for bash or, if no name is odd, any shell: the bake with so many POV-Ray processes (a word of the
# shell, or nothing), unless others have written the slab by then. Listing the folder makes NFS
# look at it anew.
worker() {
  printf 'cd %q || exit 1\n' "$PWD"
  printf 'ls -- %q >/dev/null\n' "$(dirname -- "$slab")"
  printf '[ "$(stat -c "%%s %%.9Y" -- %q 2>/dev/null || echo none)" = %q ] || exit 0\n' "$slab" "$before"
  printf 'exec %q bake%s' "${bake[0]}" "${1:+ --jobs $1}"
  printf ' %q' "${bake[@]:2}"
  printf '\n'
}

# What the workers said, on stdin, each line once; who waited for others says nothing new.
said_once() { awk '!/: was written by another bake of it; / && !seen[$0]++ { print; fflush() }'; }

# Whether the slab is there that was to be written.
is_written() {
  ls -- "$(dirname -- "$slab")" >/dev/null
  [ "$(stamp "$slab")" != "$before" ] && [ -e "$slab" ]
}
