# shelf_room.jq - the scene in which a lamp of the shelf is shown: a floor, a wall and a post,
# laid out around the lamp in its own coordinates, by what `bakeslab info --json` says of it.
#
#   room("near")    two aperture widths from the floor or wall that it shines at
#   room("far")     eight, or where its st plane is
#
# gives {distance (in metres), view (options of renderslab), obj (text of an OBJ file)}.

def plus($a; $b): [range(3) | $a[.] + $b[.]];
def times($a; $k): [range(3) | $a[.]*$k];
def dot($a; $b): [range(3) | $a[.]*$b[.]] | add;
def length_of($a): dot($a; $a) | sqrt;
def cross($a; $b): [range(3) as $k | $a[($k + 1)%3]*$b[($k + 2)%3] - $a[($k + 2)%3]*$b[($k + 1)%3]];
# p + x e + y up + z side: where things are in the room.
def at($p; $frame; $x; $y; $z):
  reduce ([$frame.e, $x], [[0, 1, 0], $y], [$frame.side, $z]) as [$axis, $k] ($p; plus(.; times($axis; $k)));

# The page's corners.
def corners: .center as $c | .u as $u | .v as $v
  | [(0.5, -0.5) as $i | (0.5, -0.5) as $j | plus(plus($c; times($u; $i)); times($v; $j))];

# Where the lamp is, how large, and where its light goes to: e is level.
def lamp_frame:
  .pages as $pages
  | [$pages[].flux | add] as $flux
  | (reduce range($pages | length) as $k ([0, 0, 0]; plus(.; times($pages[$k].normal; $flux[$k])))) as $sum
  | times($sum; 1/([$flux | add, 1e-30] | max)) as $toward
  | [$toward[0], 0, $toward[2]] as $level
  | (if length_of($level) > 0.05 then times($level; 1/length_of($level)) else [0, 0, 1] end) as $e
  | times(reduce $pages[].center as $c ([0, 0, 0]; plus(.; $c)); 1/($pages | length)) as $middle
  | [$pages[] | corners[]] as $corners
  | {
      $e, side: [$e[2], 0, -$e[0]], $middle, down: ($toward[1] < -0.7),
      width: ([$pages[] | length_of(.u), length_of(.v)] | max),
      reach: ([$corners[] | dot(plus(.; times($middle; -1)); $e)] | max),
      low: ($middle[1] - ([$corners[][1]] | min)),
      spread: (if ([$pages[].center] | unique | length) > 1 then 1.3
               else [[$pages[0].st_window[] | fabs] | max*1.15, 0.25] | max | [., 1.3] | min end),
      focus: $pages[0].st_distance,
      flux: ([range(3) as $c | [$pages[].flux[$c]] | add] | max), around: ([$pages[].center] | unique | length > 1)
    };

# A quadrangle as OBJ text: its corner, two edges, and its normal. Counter-clockwise as seen from
# the normal's side in OBJ's right-handed space, into which z is mirrored.
def quad($p; $a; $b; $n):
  def line($word; $v): "\($word) \($v[0]) \($v[1]) \(-$v[2])\n";
  (if dot(cross($a; $b); $n) < 0 then [$a, $b] else [$b, $a] end) as [$a, $b]
  | line("v"; $p) + line("v"; plus($p; $a)) + line("v"; plus(plus($p; $a); $b)) + line("v"; plus($p; $b))
    + line("vn"; $n) + "f -4//-1 -3//-1 -2//-1 -1//-1\n";

# A box that stands on p: half its side, and its height.
def post($p; $frame; $half; $height):
  [0, $height, 0] as $up
  | times($frame.e; 2*$half) as $e | times($frame.side; 2*$half) as $s
  | at($p; $frame; -$half; 0; -$half) as $corner
  | quad($corner; $s; $up; times($frame.e; -1)) + quad(plus($corner; $e); $s; $up; $frame.e)
    + quad($corner; $e; $up; times($frame.side; -1)) + quad(plus($corner; $s); $e; $up; $frame.side)
    + quad(plus($corner; $up); $e; $s; [0, 1, 0]);

def room($which):
  .pages[0].metres_per_unit as $metres
  | lamp_frame as $frame
  | (if $which == "near" then 2*$frame.width else $frame.focus // 8*$frame.width end) as $distance
  | ($frame.spread*$distance) as $size
  # Along e and down from the lamp's middle: the wall, the floor; and what is looked at.
  | (if $frame.down then
       {wall: (0.8*$size), floor: $distance, ahead: (0.15*$size), rise: (0.1*$size), post: (0.05*$size)}
     else {wall: ($frame.reach + $distance), floor: ([$frame.low + 0.05*$frame.width, 0.55*$size] | max)}
       | . + {ahead: .wall, rise: (0.45*.floor + 0.1*$size), post: (.wall - 0.3*$size)} end) as $place
  | at($frame.middle; $frame; $place.wall; -$place.floor; 0) as $foot
  | at($frame.middle; $frame; $place.ahead; $place.rise - $place.floor; 0) as $look
  | at($look; $frame; -2*$size; (if $frame.down then 1.5 else 0.8 end)*$size; 0.9*$size) as $eye
  | at($frame.middle; $frame; $place.post; -$place.floor; -0.35*$size) as $post
  | (50*$size) as $far
  | {
      distance: ($distance*$metres),
      view: (["--camera", "from=\($eye | join(",")) at=\($look | join(",")) fov=58"]
        # The picture shows a lamp that shines all round, and is not to be exposed for that.
        + if $frame.around then
            ["--exposure", "\($frame.flux*0.8/pow(3.14159*($frame.reach + $distance)*$metres; 2))"]
          else [] end),
      obj: ("mtllib room.mtl\no room\nusemtl matt\n"
        + quad(at($foot; $frame; 0; 0; -$far); times($frame.e; -$far); times($frame.side; 2*$far); [0, 1, 0])
        + quad(at($foot; $frame; 0; 0; -$far); [0, $far, 0]; times($frame.side; 2*$far); times($frame.e; -1))
        + post($post; $frame; 0.035*$size; 0.45*$size))
    };
