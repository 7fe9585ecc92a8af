#!/usr/bin/env bats
# bakeslab include: its modes, what they write and what they refuse.

load slab

setup() {
  cd "$BATS_TEST_TMPDIR" || return
  one=3f800000
  raw_slab even.tif '[2, 2, 4, 4]' 8 8 ', "name": "even"' "$one" "$one" "$one"
}

@test "a cluster has no image; a point has one; the header tells their errors" {
  run -0 --separate-stderr "$BAKESLAB" include even.tif -o c.inc --mode cluster --lights 2
  [ -z "$stderr" ]
  [ ! -e c.exr ]
  grep -q '^#macro Even_Canned(Scale, Gain)' c.inc
  grep -qE 'away: [0-9.e-]+ % at 1, [0-9.e-]+ % at 4, [0-9.e-]+ % at 16' c.inc
  run -0 "$BAKESLAB" include even.tif -o p.inc --mode point
  [ -s p.exr ]
  grep -qE 'away: [0-9.e-]+ % at 1, [0-9.e-]+ % at 4, [0-9.e-]+ % at 16' p.inc
}

@test "auto says what it chose and why, also in the header" {
  run -0 --separate-stderr "$BAKESLAB" include even.tif -o a.inc --mode auto --tolerance 0.05 --distance 80
  [[ $stderr == "bakeslab: even.tif: note: at 80 aperture widths, with 5 % allowed, point: "*"sheet of 1x1"*"cluster of"* ]]
  grep -q '^// Chosen:  at 80 aperture widths, with 5 % allowed, point: ' a.inc
}

@test "auto looks at shadows: no point for an opening under a wide angle, unless it says so" {
  # A point is 1.5 % off on the plane, and 6.6 % in the shadow.
  run -0 --separate-stderr "$BAKESLAB" include even.tif -o a.inc --mode auto --tolerance 0.05 --distance 40
  [[ $stderr == *"with 5 % allowed, sheet of 2x2 lights: "*"point: 1."*"% in the shadow of an edge half way"* ]]
  run -0 --separate-stderr "$BAKESLAB" include even.tif -o a.inc --mode auto --tolerance 0.4 --distance 4
  [[ $stderr == *"point: "*"(hard shadows, though the opening is seen under 14 degrees)"* ]]
}

@test "a tolerance that nothing meets: which comes closest" {
  refuses 1 "even.tif: no light is within 1e-09 at 0.5 aperture widths; closest is the sheet of 2x2 lights" "ask for --tolerance 0." -- "$BAKESLAB" include even.tif -o a.inc --mode sheet --tolerance 1e-9 --distance 0.5
  [ ! -e a.inc ]
  refuses 1 "closest is the point: " -- "$BAKESLAB" include even.tif -o a.inc --mode point --tolerance 1e-9 --distance 1
}

@test "radiance that lights cannot give" {
  for mode in cluster point; do
    raw_slab black.tif '[1, 1, 2, 2]' 2 2 '' 00000000
    refuses 1 "black.tif: all radiance is zero" -- "$BAKESLAB" include black.tif -o a.inc --name x --mode $mode
    raw_slab negative.tif '[1, 1, 2, 2]' 2 2 '' "$one" "$one" bf800000
    refuses 1 "negative.tif: page 1: radiance -1 of sample (0, 0, 0, 0) is negative" -- "$BAKESLAB" include negative.tif -o a.inc --name x --mode $mode
    [ ! -e a.inc ]
  done
}

@test "a faint lamp: how far POV-Ray shows its light, which drops what is below 1e-10" {
  # 2x2 lights of 1e-8 on 0.2 x 0.2 units: 0.1 sqrt(1e-8 / pi / 1e-10) units; one light: twice.
  raw_slab faint.tif '[2, 2, 4, 4]' 8 8 ', "name": "faint"' 322bcc77 322bcc77 322bcc77
  for mode in "sheet 0.56" "point 1.1"; do
    run -0 "$BAKESLAB" include faint.tif -o "${mode% *}.inc" --mode "${mode% *}"
    grep -q "end ${mode#* } units away" "${mode% *}.inc"
  done
  run -0 "$BAKESLAB" include faint.tif -o c.inc --mode cluster --lights 1
  grep -qE "end (0\.)?[1-9.]+ units away" c.inc
  run -0 "$BAKESLAB" include even.tif -o a.inc --mode sheet
  run -1 grep -q 'too faint (1e-10): even' a.inc
}

@test "more lights than a cluster may have" {
  refuses 1 "even.tif: 65 lights are too many for a cluster" "ask for --lights 64" -- "$BAKESLAB" include even.tif -o a.inc --mode cluster --lights 65
  [ ! -e a.inc ]
}

@test "auto takes the sheet where no cluster is exact enough, and says how far off it is" {
  light() { for k in {0..63}; do ((k * 11 % 7)) && printf 00000000 || printf '%s' "$one"; done; }
  raw_slab speckled.tif '[2, 2, 8, 8]' 16 16 ', "name": "speckled"' "$(light)" "$(light)" "$(light)"
  run -0 --separate-stderr "$BAKESLAB" include speckled.tif -o a.inc --mode auto --tolerance 0.15 --distance 8
  [[ $stderr == *"with 15 % allowed, sheet of "*"cluster of "*" % off"* ]]
}

@test "all energy in one sample: every kind lights and tells its error" {
  dark=$(printf '00000000%.0s' {1..27})
  spot=$dark${one}00000000${one}00000000${one}$(printf '00000000%.0s' {1..224})
  raw_slab spot.tif '[2, 2, 8, 8]' 16 16 ', "name": "spot"' "$spot"
  for mode in sheet cluster point; do
    run -0 --separate-stderr "$BAKESLAB" include spot.tif -o $mode.inc --mode $mode
    [ -z "$stderr" ]
    grep -q '^// .*error' $mode.inc
  done
}

@test "the header tells the slab's own error, as check --error does" {
  light() { for k in {0..63}; do ((k * 11 % 7)) && printf 3f000000 || printf '%s' "$one"; done; }
  raw_slab rough.tif '[4, 4, 8, 8]' 32 32 ', "name": "rough"' "$(light)"
  told=$("$BAKESLAB" check --error rough.tif | sed -n 's/.*(.*): \(about\|at least\) \([0-9.e-]* %\) (.*/\2/p')
  [ "$(wc -l <<<"$told")" -eq 3 ]
  for mode in sheet cluster point; do
    "$BAKESLAB" include rough.tif -o $mode.inc --mode $mode
    said=$(sed -n 's,^//   page 1: about \(.*\) at 1\, \(.*\) at 4\, \(.*\) at 16.*,\1\n\2\n\3,p' $mode.inc)
    [ "$said" = "$told" ] || { echo "$mode: $said, not $told"; false; }
    # Its parts, and all with the lights' in quadrature.
    grep -qE '^//     noise unknown, unknown, unknown; resolution( [0-9.e-]+ %,?){3};$' $mode.inc
    sed -n "/^\/\/   page 1: about/,/all, with/p" $mode.inc | tr -d '\n/' |
      sed 's/.*1: about \([0-9.e+-]*\) %.*; lights \([0-9.e+-]*\) %.*: \([0-9.e+-]*\) %.*/\1 \2 \3/;s/ %.*//' |
      awk '{ exit !($3 > 0 && ($3/sqrt($1^2 + $2^2) - 1)^2 < 0.1^2) }'
  done
}

@test "options that contradict each other" {
  misused() { # WHAT IT SAYS, OPTIONS...
    local says=$1
    shift
    run -2 --separate-stderr "$BAKESLAB" include even.tif -o a.inc "$@"
    [[ $stderr == "bakeslab include: $says"* ]]
  }
  misused '--mode auto: needs --tolerance T' --mode auto
  misused '--lights and --tolerance: give one of them' --mode cluster --lights 4 --tolerance 0.1
  misused '--lights: the far field is one light' --mode point --lights 4
  misused '--tolerance -1: must be a positive number' --tolerance -1
  misused '--distance nan: must be a number from 0.01 to 1e+06' --distance nan
  misused '--distance 1e-200: must be a number from 0.01 to 1e+06' --mode point --distance 1e-200
  misused '--distance 1e300: must be a number from 0.01 to 1e+06' --mode cluster --distance 1e300
}
