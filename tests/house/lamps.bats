#!/usr/bin/env bats
# make lamps: a shelf of two quick lamps, a photometric file and a broken lamp, and its page.
load house
load lamp_make

setup_file() {
  load house
  load lamp_make
  export LAMPS=$BATS_FILE_TMPDIR/scripts SHELF=$BATS_FILE_TMPDIR/shelf
  mkdir "$LAMPS"
  cd "$LAMPS" || return 1
  some_lamp wall '#declare Glow = 0.5;'
  sed -i '1i // A wall & <i>nothing</i> else.\n// Bake: bakeslab bake wall.pov -o wall.tif --uv 2x2 --st 4x8 --rays 4' wall.pov
  # Seen from four sides.
  some_lamp box '#declare Glow = 2;'
  echo '#declare Canned_Housing = sphere { <0, 0, -1>, 3 pigment { rgb 1 } }' >>box.pov
  sed -i '1i // Bake: bakeslab bake box.pov -o box.tif --uv 2 --st 4 --rays 4' box.pov
  printf 'Canned_Slab(%s, <-1, 1, -1, 1>, 0)\n' '<0, 0, -2.2>, <2, 0, 0>, <0, 2, 0>, <0, 0, -1>' >>box.pov
  some_lamp broken 'sphere { "<script>alert(1)</script>" }'
  shelve >"$BATS_FILE_TMPDIR/out" 2>"$BATS_FILE_TMPDIR/err" && return 1
  cp "$SHELF/index.html" "$BATS_FILE_TMPDIR/broken.html"
}

# make lamps with the programs under test, which are there.
shelve() {
  house_make lamps BIN= BAKE_BIN="$BAKESLAB" RENDER_BIN="$RENDERSLAB" SHELF="$SHELF" \
    SHELF_LAMPS="$LAMPS/wall.pov $LAMPS/box.pov $LAMPS/broken.pov $ROOT/lamps/wall_washer.ies" "$@"
}

setup() { cd "$SHELF" || return 1; }

# card NAME: that of a lamp, from the page before the broken lamp is mended.
card() { sed -n "/<article id=\"$1\">/,/<\\/article>/p" "$BATS_FILE_TMPDIR/broken.html"; }

# figure WHAT VALUE: the card on stdin says so, in its three digits.
figure() {
  awk -F '<td>|[,<]' -v what="$1" "index(\$0, what) { for (n = 1; n < NF; ++n) if (\$n ~ /^[0-9.]+\$/) { told = \$n; break } }
    END { print told; value = $2; exit !(told > 0.99*value && told < 1.01*value) }"
}

@test "a broken lamp is told on stderr and on the page, and as text" {
  grep -q "bakeslab: $LAMPS/broken.pov: POV-Ray: File .*broken.pov' line 3" "$BATS_FILE_TMPDIR/err"
  grep -q "make lamps: $LAMPS/broken.pov: was not built" "$BATS_FILE_TMPDIR/err"
  card broken | grep -q 'not built'
  card broken | grep -qE 'broken.pov&(#39|apos); line 3: Parse Error'
  grep -q 'role="alert">Not built: broken\.<' index.html
  card wall | grep -qF '<p>A wall &amp; &lt;i&gt;nothing&lt;/i&gt; else. </p>'
  [ ! -e broken.tif ] && [ ! -e broken.inc ]
}

@test "the others are built: figures, pictures, files and the include's line" {
  local file
  [ "$(grep -c '<article' index.html)" -eq 4 ]
  card wall | grep -qF '2 × 2 positions, 4 × 8 directions'
  # Radiance 0.5 through 4 square metres, slopes up to 1: the integral of 1/(1 + s^2 + t^2)^2
  # over them is sqrt(8) atan(sqrt(1/2)). The box is four times as bright and has two such sides.
  card wall | figure 'flux, R, G, B' 'sqrt(8)*atan2(1, sqrt(2))*4*0.5'
  card box | figure 'flux, R, G, B' 'sqrt(8)*atan2(1, sqrt(2))*4*0.5*8'
  card box | grep -qF ': 2 pages'
  # What the slab tells, and all CPU time that the bake told: of a page, and of two that are alike.
  for lamp in wall box; do
    card $lamp | grep -qF "error of irradiance</th><td>$("$BAKESLAB" info --json $lamp.tif |
      jq '[.pages[].error[0].all] | add/length*1000 | round/10') % at 2 m, "
    card $lamp | grep -qF "baked in</th><td>$(grep -oE '[0-9.]+ CPU s' $lamp.bake.log |
      awk '{ sum += $1 } END { printf "%g", sum }') s of a processor"
  done
  card wall | grep -qF 'object { Wall_Canned(1, 1) }'
  card wall | grep -q '<th scope="row">interreflection</th><td>off</td>'
  for file in wall.tif wall.inc wall.exr box.tif box.inc box.exr wall_washer.{tif,inc,exr}; do
    grep -qF "<a href=\"$file\"" index.html
    [ -s "$file" ]
  done
  card wall | grep -qF "wall.inc</a>, $((($(stat -c %s wall.inc) + 999) / 1000)) kB"
  # What is imported says from where; its flux is the file's.
  card wall_washer | grep -qF '<p>A wall washer: a long flat opening'
  card wall_washer | grep -q '<th scope="row">imported from</th><td>wall_washer.ies (ies): each point'
  card wall_washer | figure 'flux, R, G, B' 1694
  # What the page says to copy is a scene that renders: with a housing where there is one.
  card box | grep -q 'Box_Canned_Housing()'
  for lamp in wall box wall_washer; do
    { echo '#version 3.7; camera { location -9*z look_at 0 }'; card $lamp | sed -n '/<code>/,/<\/code>/p' |
      sed 's/<[^>]*>//g; s/&quot;/"/g'; } >scene.pov
    povray +Iscene.pov +W8 +H8 -D -GA +Oscene.png 2>/dev/null
  done
}

@test "every picture has a text, every link and picture is there, nothing comes from elsewhere" {
  [ "$(grep -o '<img ' index.html | wc -l)" -eq 8 ]
  [ "$(grep -oE '<img [^>]*alt="[^"]+"' index.html | wc -l)" -eq 8 ]
  for link in $(grep -oE '(src|href)="[^"]*"' index.html | cut -d'"' -f2); do
    echo "$link"
    case $link in
      '#'*) grep -q "id=\"${link#?}\"" index.html ;;
      *) [ -s "$link" ] ;;
    esac
  done
  [ "$(grep -cE 'https?:|//|<script|url\(|@import' index.html)" -eq 0 ]
}

@test "the effects' table shows whatever the slab says of them, as text" {
  page=$(jq -s --arg bad '<b>&"' '.[0] | .pages[0].provenance.effects = {caustics: ("off: 0.1 % " + $bad), ($bad): {x: 1}}' facts.json |
    jq -rs -L "$ROOT/lamps" 'include "shelf"; page')
  [[ $page == *'caustics</th><td>off: 0.1 % &lt;b&gt;&amp;&quot;</td>'*'<th scope="row">&lt;b&gt;&amp;&quot;</th>'* ]]
  [[ $page != *'<b>'* ]]
}

# What a browser makes of the page in frames as wide as a phone and a screen, and its console.
# Their load waits for all pictures, once they are not loaded as late as may be.
in_browser() {
  sed 's/ loading="lazy"//' index.html >check.html
  cat >frames.html <<'END'
<!DOCTYPE html><title>not loaded</title>
<iframe src="check.html" style="width: 390px; border: 0"></iframe>
<iframe src="check.html" style="width: 1280px; border: 0"></iframe>
<script>
onload = () => document.title = [...document.querySelectorAll('iframe')].map(frame => {
  const page = frame.contentDocument, root = page.documentElement;
  return ['cards', page.querySelectorAll('article').length,
    'pictures', [...page.images].filter(image => image.naturalWidth > 0).length,
    'width', root.clientWidth, root.scrollWidth, getComputedStyle(root).colorScheme].join(' ');
}).join('; ');
</script>
END
  chromium --headless --no-sandbox --disable-gpu --hide-scrollbars --user-data-dir="$BATS_TEST_TMPDIR/chromium" \
    --window-size=1400,1000 --allow-file-access-from-files --enable-logging=stderr --dump-dom "file://$PWD/frames.html" \
    2>console.log | sed -n 's|.*<title>\(.*\)</title>.*|\1|p'
}

@test "in a browser: cards, pictures, no word on the console, no wider than a phone" {
  needs chromium
  run in_browser
  echo "$output"
  [ "$(grep -c CONSOLE console.log)" -eq 0 ]
  [ "$output" = 'cards 4 pictures 8 width 390 390 light dark; cards 4 pictures 8 width 1280 1280 light dark' ]
}

@test "mended: the broken lamp alone is built, and nothing twice" {
  before=$(stat -c '%n %y' wall.* box.* | grep -v json)
  some_lamp "$LAMPS/broken" '#declare Glow = 1;'
  shelve 2>&1
  [ "$(stat -c '%n %y' wall.* box.* | grep -v json)" = "$before" ]
  [ "$(grep -c 'class="error"' index.html)" -eq 0 ]
  [ -s broken.inc ]
  # Other options bake anew.
  shelve SHELF_LAMPS="$LAMPS/wall.pov" SHELF_FLAGS='--uv 2 --st 4 --rays 2' 2>&1
  "$BAKESLAB" info wall.tif | grep -q 'samples .*2 x 2 x 4 x 4'
}
