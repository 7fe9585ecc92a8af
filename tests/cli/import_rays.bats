#!/usr/bin/env bats
# bakeslab import of ray files: radiance and flux of lamps whose rays are known, what is told of rays
# that are left out, refusals. The readers are tested in tests/unit/test_ray_file.c, where pages are
# laid in tests/unit/test_ray_pages.c.

load slab

setup() {
  mkdir "$BATS_TEST_TMPDIR/in"
  cd "$BATS_TEST_TMPDIR/in" || return
}

# lambertian COUNT HALF FLUX: rays of a square, HALF from its middle to its edges, in the plane y = 0;
# it shines to +y alike in all directions. Places and directions are evenly spread (by powers of the
# root of x^5 = x + 1: Roberts' sequence), so that sums of few rays are good.
lambertian() {
  awk -v count="$1" -v half="$2" -v flux="$3" 'BEGIN {
    pi = atan2(0, -1)
    for (k = 1; k <= 4; ++k) step[k] = 1 / 1.1673039782614187 ^ k
    for (n = 1; n <= count; ++n) {
      for (k = 1; k <= 4; ++k) { x[k] += step[k]; x[k] -= int(x[k]) }
      r = sqrt(x[1]); a = 2 * pi * x[2]
      printf "%.9g 0 %.9g %.9g %.9g %.9g %.17g\n", (2 * x[3] - 1) * half, (2 * x[4] - 1) * half,
        r * cos(a), sqrt(1 - r * r), r * sin(a), flux / count
    }
  }'
}

# told KEY: a number of provenance.import of s.exr.
told() { bakeslab_info | sed -n "s/.*\"$1\": *\(-\{0,1\}[0-9.e+-]*\).*/\1/p" | head -n 1; }
bakeslab_info() { "$BAKESLAB" info s.exr; }

# holds EXPRESSION: an awk expression is true.
holds() { awk "BEGIN { exit !($1) }" || { echo "not so: $1"; return 1; }; }

@test "a Lambertian square millimetre of 1 W: 1/(pi 1e-6) W/(sr m2), and its flux" {
  lambertian 50000 0.5 1 >lamp.txt
  "$BAKESLAB" import lamp.txt --unit mm -o s.exr --uv 2x2 --st 8x8 -q
  radiance=$("$BAKESLAB" lookup s.exr <<<'0.0001 0 -0.0002  0 1 0' | cut -d' ' -f1)
  error=$(told error)
  echo "radiance $radiance, told error $error"
  holds "($radiance / 318310 - 1)^2 < (3 * $error)^2 && $error < 0.1"
  # What goes in comes out, but for what is told to be left out.
  run --separate-stderr "$BAKESLAB" import lamp.txt --unit mm -o s.exr --uv 2 --st 8
  # shellcheck disable=SC2154 # set by run
  [[ $stderr == *"of 50000 rays, with "*" W ("*"), leave outside the pages' windows"* ]]
  left=${stderr#*rays, with }
  left=${left%% W*}
  holds "($(told flux_in) - 1)^2 < 1e-18 && ($(told flux_out) + $left - 1)^2 < 1e-12"
  "$BAKESLAB" check s.exr >checked
  run ! grep -F warning checked # that it misses light is told, and little
  "$BAKESLAB" info s.exr | grep -E 'flux +[0-9.e-]+ .*\(W\)'
  "$BAKESLAB" info s.exr | grep -F 'W/(sr m2)'
}

@test "pages that are given, in a unit that is given" {
  lambertian 20000 0.5 1 >lamp.txt
  "$BAKESLAB" import lamp.txt --unit mm -o s.exr --uv 2x2 --st 4x4 -q \
    --center -0.25,0,0 --u 0.5,0,0 --v 0,0,1 --normal 0,1,0 \
    --center 0.25,0.1,0 --u 0.5,0,0 --v 0,0,1 --normal 0,3,0
  "$BAKESLAB" info s.exr | grep -F 'page 2 of 2'
  "$BAKESLAB" info s.exr | grep -E 'center +0.00025 0.0001 0'
  holds "$(told flux_out) > 0.8 && $(told flux_out) < 1" # some passes beside the second
  # In metres no ray is near the second.
  refuses 1 'lamp.txt: page 2: no ray reaches it' -- "$BAKESLAB" import lamp.txt --unit mm -o t.exr \
    --center 0,0,0 --u 1,0,0 --v 0,0,1 --normal 0,1,0 \
    --center 5,0,0 --u 1,0,0 --v 0,0,1 --normal 0,1,0
  [ ! -e t.exr ]
}

@test "a box around a lamp that shines all round has all of its light, a rectangle half of it" {
  lambertian 5000 1 1 >up.txt
  awk '{ print $1, 1, $3, $4, $5, $6, $7; print $1, -1, $3, $4, -$5, $6, $7 
         print 1, $1, $3, $5, $4, $6, $7; print -1, $1, $3, -$5, $4, $6, $7 }' up.txt >lamp.txt
  "$BAKESLAB" import lamp.txt --box -o s.exr --uv 4x4 --st 8x8 -q
  "$BAKESLAB" info s.exr | grep -F 'page 4 of 4'
  holds "$(told flux_in) == 4 && $(told flux_out) > 3.95"
  run --separate-stderr "$BAKESLAB" import lamp.txt -o s.exr --uv 2 --st 8
  [[ $stderr == *"rays, with "*" W ("*"), reach no page; --box has pages all round"* ]]
  holds "$(told flux_out) < 3"
}

@test "lumens make cd/m2 of watts, and several files are one lamp" {
  lambertian 2000 1 1 >a.txt
  lambertian 2000 1 3 | awk '{ $1 += 2; print }' >b.txt
  "$BAKESLAB" import a.txt b.txt -o s.exr --uv 2x2 --st 4x4 --lumens 800 -q
  "$BAKESLAB" info s.exr | grep -F 'cd/m2'
  holds "$(told flux_in) == 800 && $(told flux_out) > 790"
  left=$("$BAKESLAB" lookup s.exr <<<'0 0 0  0 1 0' | cut -d' ' -f1)
  right=$("$BAKESLAB" lookup s.exr <<<'2 0 0  0 1 0' | cut -d' ' -f1)
  holds "$right / $left > 2.8 && $right / $left < 3.2"
}

@test "the same file makes the same slab on any number of processors, and the slab says what it is made of" {
  lambertian 40000 1 1 >lamp.txt
  processor=$(taskset -cp $$ | sed 's/.*: *\([0-9]*\).*/\1/')
  taskset -c "$processor" "$BAKESLAB" import lamp.txt -o s.exr --uv 2 --st 8 -q
  cp s.exr first.exr
  "$BAKESLAB" import lamp.txt -o s.exr --uv 2 --st 8 -q
  cmp s.exr first.exr
  "$BAKESLAB" info s.exr | grep -F '"source": "lamp.txt", "kind": "ray text"'
}

@test "--tolerance is of irradiance: the fewest samples for it, or what is missing" {
  lambertian 20000 1 1 >lamp.txt
  run --separate-stderr "$BAKESLAB" import lamp.txt -o s.exr --tolerance 0.1
  [ "$status" -eq 0 ] && [[ $stderr != *tolerance* ]]
  "$BAKESLAB" info s.exr | grep -F 'noise without blur' | grep -F 'irradiance errs by '
  "$BAKESLAB" info s.exr | grep -E 'samples +4 x 4 x 16 x 16'
  run --separate-stderr "$BAKESLAB" import lamp.txt -o s.exr --tolerance 1e-9 --uv 4 --st 8
  [ "$status" -eq 0 ]
  [[ $stderr == *"page 1: 4x4 x 8x8 samples err by "*" of irradiance, more than --tolerance 1e-09"* ]]
}

@test "what is no lamp is refused, with its line, and nothing is left" {
  printf '0 0 0 0 0 1 1\n0 0 0 0 0 0 1\n' >lamp.txt
  refuses 1 'lamp.txt: line 2: a ray without direction' -- "$BAKESLAB" import lamp.txt -o s.exr
  printf '0 0 0 0 0 1 0\n' >lamp.txt
  refuses 1 'lamp.txt: has no rays that carry flux' -- "$BAKESLAB" import lamp.txt -o s.exr
  printf '# x y z\n\n' >lamp.txt
  refuses 1 'lamp.txt: has no rays, only comments' -- "$BAKESLAB" import lamp.txt -o s.exr
  printf '0 0 0 0 0 1 1\n' >lamp.txt
  refuses 1 'lamp.txt: --kelvin' 'photometric' -- "$BAKESLAB" import lamp.txt -o s.exr --kelvin 3000
  printf 'IESNA91\nTILT=NONE\n' >lamp.txt
  refuses 1 'lamp.txt: --center' 'ray files' -- "$BAKESLAB" import lamp.txt -o s.exr --box
  # Nor is it told, beside that, what would be so of the lamp.
  printf '0 0 0 0 0 1 1\n0 0 0 0 0 1 1\n' >lamp.txt
  refuses 1 'LogLuv' -- "$BAKESLAB" import lamp.txt -o s.tif --uv 1 --st 1 --lumens 1e14
  refuses 1 'lamp.txt: ' -- "$BAKESLAB" import lamp.txt -o s.tif --uv 1 --st 1 --lumens 1e300
  printf 'TM25' >lamp.txt
  refuses 1 'lamp.txt: byte 4: ends within its header' -- "$BAKESLAB" import lamp.txt -o s.exr
  printf '\xf2\x03\0\0' >lamp.txt
  refuses 1 'lamp.txt: byte 4: ends within its header' -- "$BAKESLAB" import lamp.txt -o s.exr
  [ "$(ls)" = lamp.txt ]
}

@test "options of pages" {
  refuses 2 'once for each page' -- "$BAKESLAB" import lamp.txt -o s.exr --center 0,0,0 --u 1,0,0
  refuses 2 '--u 1,0: must be three numbers' -- "$BAKESLAB" import lamp.txt -o s.exr --u 1,0
  refuses 2 'give one of them' -- "$BAKESLAB" import lamp.txt -o s.exr --box --center 0,0,0 \
    --u 1,0,0 --v 0,1,0 --normal 0,0,1
  refuses 2 '--unit' -- "$BAKESLAB" import lamp.txt -o s.exr --unit inch
  printf '0 0 0 0 0 1 1\n' >lamp.txt
  refuses 1 'page 1' -- "$BAKESLAB" import lamp.txt -o s.exr --center 0,0,0 --u 1,0,0 --v 1,1,0 \
    --normal 0,0,1
}
