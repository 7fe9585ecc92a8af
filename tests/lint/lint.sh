#!/usr/bin/env bash
# lint.sh - formatting, static analysis and house rules; quiet when clean.
# `make lint` calls it at the root with FLAGS and CXXFLAGS (as for compiling) and JOBS.
set -u
# The repository may be another user's.
export GIT_CONFIG_COUNT=1 GIT_CONFIG_KEY_0=safe.directory GIT_CONFIG_VALUE_0='*'
status=0
JOBS=${JOBS:-2}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# check WHAT COMMAND...: prints what it said, and a heading, only if it fails.
check() {
  local what=$1
  shift
  if ! "$@" >"$work/log" 2>&1; then
    echo "lint: $what"
    sed 's/^/  /' "$work/log"
    status=1
  fi
}

# The compilers' flags as words; both are quoted as for a shell.
flags=() cxxflags=()
eval "flags=(${FLAGS:-})" "cxxflags=(${CXXFLAGS:-})"
# What git would commit: tracked, and new but not ignored.
mapfile -t files < <(git ls-files --cached --others --exclude-standard | while read -r f; do [ -f "$f" ] && echo "$f"; done)
only() { printf '%s\n' "${files[@]}" | grep -E "$1"; }
mapfile -t sources < <(only '\.cc?$')
mapfile -t headers < <(only '\.h$')
mapfile -t cxx_headers < <(only '\.hh$')
mapfile -t bats < <(only '\.(bats|bash)$')
mapfile -t shells < <(for f in "${files[@]}"; do
  case $f in *.bats | *.bash | *.c | *.cc | *.h) continue ;; esac
  head -n 1 "$f" | grep -qaE '^#!.*[ /](ba)?sh( |$)' && echo "$f"
done)

formatted() {
  local file bad=0
  for file in "${sources[@]}" "${headers[@]}" "${cxx_headers[@]}"; do
    clang-format --dry-run -Werror "$file" 2>/dev/null || { echo "$file"; bad=1; }
  done
  return "$bad"
}

each_alone() { # every header compiles by itself, as C or, .hh, as C++
  local header bad=0
  for header in "${cxx_headers[@]}"; do
    g++ -x c++ "${cxxflags[@]}" -fsyntax-only -Werror -Wno-unused-function "$header" || bad=1
  done
  for header in "${headers[@]}"; do
    gcc -x c -std=c17 -fsyntax-only -Wall -Wextra -Wconversion -Werror -Ibakeslab -Irender -Itests -D_GNU_SOURCE "$header" || bad=1
  done
  return "$bad"
}

long_files() {
  only '\.(c|h|cc|hh|glsl|in|sh|bash|bats|inc|pov|mk|scd|py)$|^Makefile$' | xargs wc -l |
    awk '$2 != "total" && $1 > 400 { print $2 ": " $1 " lines; at most 400"; bad = 1 } END { exit bad }'
}

machine_paths() { # this checkout's folder, its neighbours, somebody's home
  local top=$PWD found=0 where
  for where in "$top/" "$(dirname "$top")/" "$HOME/"; do
    [ "${#where}" -ge 6 ] || continue
    case $where in /usr/* | /etc/* | /tmp/) continue ;; esac
    git grep -nIF -e "$where" -- . && found=1
  done
  git grep -nIE -e '/(home|Users)/[a-z]' -- . ':!tests/lint/lint.sh' && found=1
  return "$found"
}

unfinished() { ! git grep -nIwE 'TODO|FIXME|XXX|HACK' -- '*.c' '*.cc' '*.h' '*.glsl' '*.in' '*.inc' '*.pov' '*.mk' '*.sh' '*.bash' '*.bats' Makefile ':!tests/lint/lint.sh'; }

# One file with what it may assume; result.c defines what the others assume.
assuming() { # COMMAND... -- FILE: runs COMMAND with FILE put in place of FILE
  local file=$1 words=()
  shift
  for word in "$@"; do words+=("${word/#FILE/$file}"); done
  [ "$file" = bakeslab/base/result.c ] || words+=(-include tests/lint/assume.h)
  "${words[@]}" 2>&1
}
export -f assuming

tidy() {
  only '\.c$' | xargs -P "$JOBS" -I NAME bash -c 'assuming "$@"' _ NAME \
    clang-tidy --quiet FILE -- "${flags[@]}" -Itests >"$work/tidy"
  local bad=$?
  # Boost's numbers, which CGAL computes with, seem to outlive their parts.
  only '\.cc$' | xargs -r -P "$JOBS" -I NAME clang-tidy --quiet --checks=-clang-analyzer-core.StackAddressEscape \
    NAME -- "${cxxflags[@]}" -Itests >>"$work/tidy" 2>&1 || bad=1
  # Without the steps that lead there, and once where a header is to blame.
  grep -A 2 -E '(error|warning):' "$work/tidy" | grep -vE '(note|Suppressed):' | awk '!seen[$0]++'
  return "$bad"
}

# The other sources in C pass through `analyse`, which makes errors of warnings too; for C++
# gcc 12 has no analyser.
warnings() {
  only '^tests/.*\.c$' | xargs -P "$JOBS" -I NAME gcc "${flags[@]}" -Itests -Werror -fsyntax-only NAME || return
  only '\.cc$' | xargs -r -P "$JOBS" -I NAME g++ "${cxxflags[@]}" -Itests -Werror -fsyntax-only NAME
}

# No tests: assertions of cmocka confuse the analyser. Leaks and values
# never set are left to clang-tidy and the sanitizers: gcc 12 sees a leak in each
# `p->x = malloc(n)`, and sets only the first element of an array.
analyse() {
  only '^(bakeslab|render)/.*\.c$' | xargs -P "$JOBS" -I NAME bash -c 'assuming "$@"' _ NAME \
    gcc "${flags[@]}" -O0 -fanalyzer -Wno-analyzer-malloc-leak -Wno-analyzer-use-of-uninitialized-value \
    -fdiagnostics-path-format=none -Werror -c FILE -o /dev/null
}

check 'clang-format -i FILE would change' formatted
check 'headers compile alone' each_alone
check 'warnings in tests and C++' warnings
check 'rooms' bash tests/lint/rooms.sh
check 'files too long' long_files
check 'machine paths' machine_paths
check 'unfinished marks' unfinished
# SC2317: functions are called through check. SC2013, SC2016: loops over words
# and backticks in single quotes are meant. SC2030, SC2031: each bats test is a subshell.
check shellcheck shellcheck -x -e SC2013,SC2016,SC2317 "${shells[@]}"
[ "${#bats[@]}" -eq 0 ] || check 'shellcheck (bats)' shellcheck -s bats -e SC2013,SC2016,SC2030,SC2031 "${bats[@]}"
# Each kind of source has its own standard; headers are looked at from there.
check cppcheck cppcheck -q --std=c11 --std=c++17 --enable=warning,performance,portability --inline-suppr -j "$JOBS" \
  --suppress=missingIncludeSystem --suppress=varFuncNullUB --error-exitcode=1 -Ibakeslab -Irender -D_GNU_SOURCE \
  '-Djson_object_foreach(object, key, value)=while (next(&key, &value))' \
  '-Djson_array_foreach(array, index, value)=while (next(&index, &value))' "${sources[@]}"
check clang-tidy tidy
check 'gcc -fanalyzer' analyse
exit "$status"
