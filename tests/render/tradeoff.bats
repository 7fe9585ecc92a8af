#!/usr/bin/env bats
# renderslab tradeoff: what the table says, and what is refused. Never how long anything took.
load letter

# tradeoff OPTION...: the floor and what stands on it, lit from above.
tradeoff() {
  "$RENDERSLAB" tradeoff occluder.obj --light 'letter_f.tif at=0,1,0' --size 24x18 --repeats 1 \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' "$@"
}

# column FILE NAME [AWK CONDITION ON f["NAME"]]: the numbers of the rows that meet it.
column() {
  awk -F'\t' -v name="$2" "/^#/ { next } !n { n = NF; for (k = 1; k <= NF; ++k) at[k] = \$k; next }
    { for (k = 1; k <= NF; ++k) f[at[k]] = \$k } ${3:-1} { print f[name] }" "$1"
}

@test "the table: a head, columns, a row for each method and setting" {
  tradeoff -o t.tsv
  grep -qF '# command: renderslab tradeoff occluder.obj ' t.tsv
  grep -q '^# picture: 24x18, of which [1-9][0-9]* pixels gather light$' t.tsv
  [ "$(grep -v '^#' t.tsv | head -n 1 | tr '\t' ' ')" = "method tolerance level shadows cpu cpu_low cpu_high wall wall_low wall_high rms max sum_rms sum_max predicted microlights nodes shadow_rays aids_bytes aids_cpu" ]
  # As many fields in each row, numbers or -.
  grep -v '^#' t.tsv | awk -F'\t' 'NF != 20 { exit 1 }
    NR > 1 { for (k = 2; k <= NF; ++k) if ($k !~ /^(-|auto|[0-9]+\/[0-9]+|[0-9.]+(e[-+][0-9]+)?)$/) exit 1 }'
  # Each method that --method knows, but closed, which has no shadows, and gl, which needs OpenGL.
  run --separate-stderr tradeoff -o - --methods nonsense
  for method in $("$RENDERSLAB" image x --method '?' 2>&1 | sed 's/.*there are //; s/,//g'); do
    [ "$method" = closed ] || [ "$method" = gl ] || grep -q "^$method	" t.tsv || { echo "no $method"; return 1; }
  done
  run ! grep -q '^closed' t.tsv
  # Columns that machines agree on come out again.
  tradeoff -o again.tsv --threads 1
  for name in rms max sum_rms sum_max predicted microlights nodes shadow_rays; do
    [ "$(column t.tsv $name)" = "$(column again.tsv $name)" ] || { echo "$name differs"; return 1; }
  done
}

@test "errors: the reference has none, and they fall with the tolerance and the level" {
  tradeoff -o t.tsv --no-shadows --finest 1e-3
  below "$(column t.tsv sum_max 'f["method"] == "reference"' | sort -g | tail -n 1)" 1e-6
  column t.tsv max 'f["method"] == "closed"' | awk '{ exit !($1 < 1e-6) }'
  for method in auto reference; do
    column t.tsv rms "f[\"method\"] == \"$method\"" | awk 'NR > 1 && $1 > last*1.001 + 1e-12 { exit 1 } { last = $1 }'
  done
  paste <(column t.tsv sum_rms 'f["method"] == "auto"') <(column t.tsv tolerance 'f["method"] == "auto"') |
    awk '!($1 <= $2) { print "more than the tolerance:", $0; exit 1 }'
  column t.tsv rms 'f["method"] == "levels" && f["level"] != "auto"' | awk 'NR > 1 && $1 < last { exit 1 } { last = $1 }'
  [ -z "$(column t.tsv shadow_rays 'f["shadow_rays"] != 0')" ]
  column t.tsv aids_bytes 'f["method"] == "levels"' | awk '{ exit !($1 >= 0) }'
}

@test "shadows: finer edges leave less error" {
  tradeoff -o t.tsv --methods auto
  column t.tsv rms 'f["sum_rms"] == "-"' >errors
  [ "$(wc -l <errors)" -ge 5 ]
  awk 'NR == 1 { first = $1 } END { exit !($1 < first/4) }' errors
}

@test "chosen methods only; standard output" {
  tradeoff -o - --methods pi,levels --levels 1 >t.tsv
  [ "$(column t.tsv method | tr '\n' ' ')" = "pi levels levels levels " ]
  [ "$(column t.tsv level | tr '\n' ' ')" = "- 0 1 auto " ]
}

@test "a plot, SVG or PNG" {
  needs gnuplot
  cp occluder.obj "it's.obj"
  "$RENDERSLAB" tradeoff "it's.obj" --light 'letter_f.tif at=0,1,0' --size 16x12 --repeats 1 \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1 fov=50' --finest 0.01 -o t.tsv --plot t.svg
  head -c 300 t.svg | grep -q '<svg'
  grep -qF "it's.obj" t.svg || grep -qF 'it&apos;s.obj' t.svg
  tradeoff -o t.tsv --plot t.png --methods reference --no-shadows --finest 0.1
  [ "$(head -c 4 t.png | tail -c 3)" = PNG ]
}

# rejects PIECE OPTION...: refused, and nothing is left.
rejects() { harmless "$1" env "PATH=${SEARCH:-$PATH}" "$RENDERSLAB" tradeoff "${@:2}"; }

@test "bad input" {
  view=(--camera 'from=0.3,2,-2.2 at=0,0,0.1')
  good=(occluder.obj --light 'letter_f.tif at=0,1,0' "${view[@]}" --size 16x12 --repeats 1)
  mkdir folder
  remember
  rejects 'add -o' "${good[@]}"
  rejects 'no mesh' "${good[@]:1}" -o t.tsv
  rejects 'no camera' occluder.obj --light letter_f.tif -o t.tsv
  rejects 'no light' occluder.obj "${view[@]}" -o t.tsv
  rejects nothere.obj nothere.obj "${good[@]:1}" -o t.tsv
  rejects nothere.tif occluder.obj "${view[@]}" --light nothere.tif -o t.tsv
  for value in 0 -1 nan inf 1e-13 0.2 x ''; do rejects finest "${good[@]}" -o t.tsv "--finest=$value"; done
  for value in 0 100 1.5 x ''; do rejects repeats "${good[@]}" -o t.tsv "--repeats=$value"; done
  for value in -1 31 1.5 x ''; do rejects levels "${good[@]}" -o t.tsv "--levels=$value"; done
  rejects threads "${good[@]}" -o t.tsv --threads 0
  rejects size "${good[@]}" -o t.tsv --size 0x3
  for value in nonsense '' 'pi,,' pi,best; do rejects 'there is no method' "${good[@]}" -o t.tsv "--methods=$value"; done
  rejects folder "${good[@]}" -o folder
  rejects nowhere "${good[@]}" -o nowhere/t.tsv
  rejects occluder.obj "${good[@]}" -o occluder.obj
  rejects letter_f.tif "${good[@]}" -o letter_f.tif
  rejects t.svg "${good[@]}" -o t.svg --plot t.svg
  rejects '.svg or .png' "${good[@]}" -o t.tsv --plot t.jpg
  rejects '.svg or .png' "${good[@]}" -o t.tsv --plot .svg
  # Lamps below the floor light nothing.
  rejects 'no light reaches' occluder.obj --light 'letter_f.tif at=0,-1,0' "${view[@]}" --size 16x12 -o t.tsv
  # Nothing but closed, which cannot do shadows.
  rejects 'no method' "${good[@]}" -o t.tsv --methods closed
}

@test "without gnuplot there is one line, before the work" {
  remember
  SEARCH=$PWD/nowhere rejects gnuplot occluder.obj --light 'letter_f.tif at=0,1,0' --size 16x12 \
    --camera 'from=0.3,2,-2.2 at=0,0,0.1' -o t.tsv --plot t.svg
}
