// A candle in a pierced tin: its holes throw spots on walls and ceiling, its open top a
// bright disc. Centimetres; it stands on y = 0, 7.6 cm wide and 11 cm high; radiance in
// W/(sr m2).
// It calls for interreflection: the tin's bright inside lights itself, a quarter of the light,
// and glows through the holes.
// The holes are clear places in the tin's pigment, which are faster than holes cut from it.
// The flame is two small balls, seen through the holes as large as they are.
// Pages: 1 to 4 the sides (towards +z, +x, -z, -x), 5 the top. The box is wide enough for
// light to leave it within the windows, but for 3 %, of which `bakeslab check` warns: the glow of
// the holes on the table beside the tin, which would need a page below.
// Bake: bakeslab bake candle_tin.pov -o candle_tin.tif --uv 24x24 --st 64x64
// Use: object { Candle_Tin_Canned(1, 1) translate 75*y }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Radius = 3.8;                         // of the tin
#declare Height = 11;                          // of the tin
#declare Side = 13;                            // of the box
#declare Top = 14;                             // of the box
#declare Around = 20;                          // holes in a row
#declare Pitch = 1.1;                          // of the rows

Canned_Lamp("candle_tin")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("interreflection")
#for (I, 0, 3)
  Canned_Slab(
    vrotate(<0, Top/2, Side/2>, 90*I*y), vrotate(Side*x, 90*I*y), Top*y, vrotate(z, 90*I*y), <-2.4, 2.4, -2, 2.4>, 0)
#end
Canned_Slab(Top*y, Side*x, Side*z, y, <-2.4, 2.4, -2.4, 2.4>, 0)
Canned_Bulb(<0, 5.4, 0>, 0.4, 40*<1, 0.55, 0.2>)
Canned_Bulb(<0, 6.1, 0>, 0.25, 40*<1, 0.55, 0.2>)

// Negative in a hole. Rows 1 to 5 from y = 3.6, every other one turned by half a hole; the
// middle one has the largest holes.
#declare Row = function(y) { floor((y - 3.6)/Pitch) }
#declare Along = function(x, y, z) { (atan2(z, x)/(2*pi) + 1)*Around + mod(Row(y), 2)/2 }
#declare Hole = function(x, y, z) {
  sqrt(pow((Along(x, y, z) - floor(Along(x, y, z)) - 0.5)*2*pi*Radius/Around, 2)
    + pow(y - 3.6 - (Row(y) + 0.5)*Pitch, 2)) - 0.42 + 0.08*abs(Row(y) - 2)
}
cylinder {
  0.01*y, Height*y, Radius open
  pigment {
    function { select(Hole(x, y, z), 1, 0)*select(y - 3.6, 0, 1)*select(y - 3.6 - 5*Pitch, 1, 0) }
    color_map { [0.5 rgb <0.75, 0.72, 0.65>] [0.5 rgbt 1] }
  }
  finish { diffuse 0.9 }
}
torus { Radius, 0.12 translate Height*y pigment { rgb <0.75, 0.72, 0.65> } finish { diffuse 0.9 } }

// The candle.
union {
  cylinder { 0.01*y, 4*y, 2.6 }
  pigment { rgb <0.95, 0.9, 0.8> } finish { diffuse 1 }
}
cylinder { 4*y, 5*y, 0.08 pigment { rgb 0.05 } finish { diffuse 1 } }

// For previews only: the bake brings its own cameras. The eye sees brighter.
#ifndef (Canned_Bake_Effects)
  plane { y, 0 pigment { rgb 0.6 } finish { diffuse 1 } no_radiosity }
  light_source { <-300, 300, -400> rgb 0.05 }
#end
#declare Eye = <12, 26, -42>;
camera { location Eye look_at <0, 5, 0> angle 36 }
sphere { Eye, 0.2 pigment { rgb 3 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
