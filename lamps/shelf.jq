# shelf.jq - the page of the shelf: a list of lamps (shelf.sh's facts) to HTML. All text of
# theirs goes through @html.

def rounded: if . == 0 then 0 else . as $x | (fabs | log10 | floor) as $e
  | pow(10; 2 - $e) as $k | ($x*$k | round)/$k end;
def bytes: if . < 1e6 then "\([./1e3 | ceil, 1] | max) kB" else "\(./1e5 | round/10) MB" end;
def metres: if . >= 1 then "\(rounded) m" elif . >= 0.01 then "\(.*100 | rounded) cm" else "\(.*1000 | rounded) mm" end;
def seconds: if . < 90 then "\(rounded) s" else "\(./60 | rounded) min" end;
def percent: "\(.*1000 | round/10) %";
def edge($u): [$u[] | .*.] | add | sqrt;
def plural($count; $word): "\($count) \($word)" + if $count == 1 then "" else "s" end;

def size: .pages as $pages
  | ([$pages[] | "\(edge(.u)*.metres_per_unit | metres) × \(edge(.v)*.metres_per_unit | metres)"] | unique | join(", "))
    + if ($pages | length) > 1 then ": \(plural($pages | length; "page"))" else "" end;
def resolution: [.pages[].samples | "\(.[0]) × \(.[1]) positions, \(.[2]) × \(.[3]) directions"] | unique | join("; ");
def flux: [.pages[].flux] | transpose | map(add | rounded) | "\(.[0]), \(.[1]), \(.[2])";
def plane: [.pages[] | if .st_distance then .st_distance*.metres_per_unit | metres else "at infinity" end]
  | unique | join(", ");
# Of the run that finished the bake, with the small bakes before it.
def time: . as {$log}
  | (($log | capture("small bakes before it took (?<cpu>[0-9.]+) CPU s") | .cpu | tonumber) // 0) as $before
  | ($log | capture("(?<all>[0-9]+) batches, (?<found>[0-9]+) of them found finished; .* (?<cpu>[0-9.]+) CPU s"))
    // null
  | if . == null then "not known" else "\((.cpu | tonumber) + $before | seconds) of a processor"
    + if .found != "0" then ", with \(.found) of \(.all) batches found finished" else "" end end;

# What the slab tells of its error, by distance: the mean of its pages', by their flux.
def told_error: .pages as $pages
  | [$pages[].flux | add] as $flux
  | ([$pages[] | edge(.u), edge(.v)] | max*$pages[0].metres_per_unit) as $width
  | [$pages[].error] | transpose | map(
      (if all(.all) and ($flux | add) > 0 then [[.[].all], $flux] | transpose | map(.[0]*.[1]) | add/($flux | add) | percent
       else "not known" end) + " at \(.[0].apertures*$width | metres)")
  | join(", ");

# Of what was imported: what it comes from, and the notes of the import.
def source: .pages[0].provenance.import
  | "\([.source] | flatten | join(", ")) (\(.kind)): \(.assumptions)";

def row($what; $text): @html "<tr><th scope=\"row\">\($what)</th><td>\($text)</td></tr>\n";
def effects: .pages[0].provenance.effects?
  | if type == "object" then
      "<table><caption>Effects: simulated or skipped</caption>\n"
      + (to_entries | map(row(.key | gsub("_"; " "); .value | if type == "string" then . else tojson end)) | add // "")
      + "</table>\n"
    else "" end;
def figure($file; $alt; $caption; $height):
  @html "<figure><img src=\"\($file)\" alt=\"\($alt)\" width=\"480\" height=\"\($height)\" loading=\"lazy\"><figcaption>\($caption)</figcaption></figure>\n";

def card:
  @html "<article id=\"\(.name)\">\n<h2>\(.name | gsub("_"; " "))</h2>\n<p>\(.about)</p>\n"
  + if .error then @html "<p class=\"error\">This lamp was not built:</p>\n<pre class=\"error\">\(.error)</pre>\n"
    else
      "<div class=\"pictures\">\n"
      + if .baked then figure("\(.name).png"; "The lamp \(.name | gsub("_"; " "))"; "the lamp, by its script"; 360) else "" end
      + figure("\(.name).near.png"; "Floor, wall and post lit by \(.name | gsub("_"; " ")), \(.near | metres) away"; "near: from \(.near | metres)"; 320)
      + figure("\(.name).far.png"; "Floor, wall and post lit by \(.name | gsub("_"; " ")), \(.far | metres) away"; "far: from \(.far | metres)"; 320)
      + "</div>\n<table><caption>Figures</caption>\n"
      + row("flux, R, G, B"; "\(flux) \(.pages[0].flux_unit)") + row("size"; size) + row("resolution"; resolution)
      + row("st plane"; plane) + if .baked then row("baked in"; time) else row("imported from"; source) end
      + row("error of irradiance"; told_error)
      + "</table>\n" + effects
      + @html "<h3>In a scene</h3>\n<pre><code>#include \"\(.name).inc\"\nobject { \(.macro)(1, 1) }"
      + (if .housing then @html "\nobject { \(.macro)_Housing() }" else "" end) + "</code></pre>\n<h3>Files</h3>\n<ul>\n"
      + (.files | map(@html "<li><a href=\"\(.name | @uri)\" download>\(.name)</a>, \(.bytes | bytes)</li>\n") | add) + "</ul>\n"
    end
  + "</article>\n";

def style: ":root { color-scheme: light dark; --line: #8886; --bad: #b00020 }
@media (prefers-color-scheme: dark) { :root { --bad: #ff8a80 } }
body { font: 1rem/1.45 system-ui, sans-serif; margin: 0 auto; max-width: 100rem; padding: 1rem }
main { align-items: start; display: grid; gap: 1rem; grid-template-columns: repeat(auto-fill, minmax(min(100%, 30rem), 1fr)) }
article { border: 1px solid var(--line); border-radius: .5rem; min-width: 0; padding: 0 1rem 1rem }
nav ul { display: flex; flex-wrap: wrap; gap: .25rem 1rem; list-style: none; padding: 0 }
nav a { display: inline-block; padding: .3rem 0 }
h2 { margin: 1rem 0 .5rem } h3 { font-size: 1rem; margin: 1rem 0 .25rem }
.pictures { display: grid; gap: .5rem; grid-template-columns: 1fr 1fr }
.pictures figure:nth-last-child(3) { grid-column: 1 / 3 }
figure { margin: 0 } img { background: #000; display: block; height: auto; width: 100% }
figcaption, caption { font-size: .875rem; text-align: left } caption { font-weight: bold; padding-top: 1rem }
table { border-collapse: collapse; width: 100% }
th, td { border-top: 1px solid var(--line); overflow-wrap: anywhere; padding: .25rem .5rem .25rem 0; text-align: left; vertical-align: top }
th { font-weight: normal; width: 9.5rem }
pre { border: 1px solid var(--line); border-radius: .25rem; margin: .5rem 0; overflow-wrap: anywhere; padding: .5rem; white-space: pre-wrap }
pre code { user-select: all } .error { color: var(--bad) }
";

def page: . as $lamps
  | "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
  + "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Canned lamps</title>\n"
  + "<style>\n\(style)</style>\n</head>\n<body>\n<header>\n<h1>Canned lamps</h1>\n"
  + "<p>\(plural(length; "lamp")), each simulated or measured once: put its include file and image beside a scene for POV-Ray 3.7,"
  + " or light a mesh with its slab (.tif) by renderslab. Near is two widths of the lamp away, far eight, or where its"
  + " light is in focus; these pictures are by renderslab, from the slab.</p>\n<nav aria-label=\"Lamps\"><ul>\n"
  + ($lamps | map(@html "<li><a href=\"#\(.name)\">\(.name | gsub("_"; " "))</a></li>\n") | add // "") + "</ul></nav>\n"
  + ([$lamps[] | select(.error) | .name] | if length > 0 then
      @html "<p class=\"error\" role=\"alert\">Not built: \(map(gsub("_"; " ")) | join(", ")).</p>\n" else "" end)
  + "</header>\n<main>\n" + ($lamps | map(card) | add // "") + "</main>\n</body>\n</html>";
