# poses.bash - cameras at random places of a hemisphere below a lamp at the origin, all looking at
# it: as transforms.json, and as cameras.inc for POV-Ray. Sourced.
# shellcheck shell=bash

# poses COUNT RADIUS WIDTH PIXELS: square pictures of so many pixels a side, as wide as WIDTH at the
# lamp; frame n is NAME n.exr. The lamp's -y is the middle of the hemisphere.
poses() {
  awk -v count="$1" -v radius="$2" -v width="$3" -v pixels="$4" '
    function cross(a, b, c) {
      c[1] = a[2]*b[3] - a[3]*b[2]; c[2] = a[3]*b[1] - a[1]*b[3]; c[3] = a[1]*b[2] - a[2]*b[1]
      l = sqrt(c[1]*c[1] + c[2]*c[2] + c[3]*c[3]); for (k = 1; k <= 3; ++k) c[k] /= l
    }
    function sdl(v) { return sprintf("<%.17g, %.17g, %.17g>", v[1], v[2], v[3]) }
    # a multiplicative generator: the same places by any awk
    function draw() { seed = (seed*16807) % 2147483647; return seed/2147483647 }
    BEGIN {
      seed = 42
      printf "{\"fl_x\": %.17g, \"w\": %d, \"h\": %d, \"frames\": [", pixels*radius/width, pixels, pixels >"transforms.json"
      print "#switch (frame_number)" >"cameras.inc"
      for (n = 1; n <= count; ++n) {
        z = draw(); angle = 2*3.14159265358979*draw(); r = sqrt(1 - z*z)
        back[1] = r*cos(angle); back[2] = -z; back[3] = r*sin(angle)
        side[1] = 0.3; side[2] = 0.1; side[3] = 1
        # lamp space is left-handed, files are right-handed
        cross(back, side, right); cross(right, back, up)
        for (k = 1; k <= 3; ++k) { at[k] = radius*back[k]; ahead[k] = -back[k]; wide[k] = right[k]*width/radius; high[k] = up[k]*width/radius }
        printf "#case (%d) camera { perspective location %s direction %s right %s up %s } #break\n", n, sdl(at), sdl(ahead), sdl(wide), sdl(high) >"cameras.inc"
        printf "%s\n{\"file_path\": \"picture%0*d.exr\", \"transform_matrix\": [", (n > 1 ? "," : ""), length(count), n >"transforms.json"
        split("1 3 2", row, " ")
        for (k = 1; k <= 3; ++k) printf "[%.17g, %.17g, %.17g, %.17g], ", right[row[k]], up[row[k]], back[row[k]], at[row[k]] >"transforms.json"
        printf "[0, 0, 0, 1]]}" >"transforms.json"
      }
      print "]}" >"transforms.json"
      print "#end" >"cameras.inc"
    }'
}
