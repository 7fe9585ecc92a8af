// A window with blinds before a bright sky: an opening as a lamp. Light comes in along -z, from
// the sky above and the meadow below, and is thrown up to the ceiling by the slats. Centimetres;
// 140 x 120 cm, its middle at the origin; radiance in W/(sr m2).
// It calls for interreflection: what the slats and the reveal show is light that they throw on.
// The sky is a thing that glows, far away and outside alone: a background is no light of the
// lamp's. The wall goes on around the window, so that nothing passes beside it. Light that comes in
// nearly along the wall, 1 % of it, is beyond the window of slopes.
// A position is as high as a slat's pitch. Directions are many up and down, where the slats' edges
// end the light, and few to the sides.
// Bake: bakeslab bake window_blinds.pov -o window_blinds.tif --uv 4x24 --st 24x256
// Use: object { Window_Blinds_Canned(1, 0.02) translate <0, 150, 200> }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Width = 140;
#declare Height = 120;
#declare Slats = 24;
#declare Pitch = Height/Slats;
#declare Depth = 5;                            // of a slat
#declare Tilt = 30;                            // its outer edge is that many degrees lower

Canned_Lamp("window_blinds")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("interreflection")
Canned_Slab(<0, 0, 0>, Width*x, Height*y, -z, <-6, 6, -6, 6>, 0)

// The sky, bright at the horizon, over a meadow.
sphere {
  0, 1e5
  clipped_by { plane { -z, -26 } }
  pigment {
    gradient y
    color_map {
      [0.497 rgb <4, 6, 2>]
      [0.5 rgb <70, 75, 80>]
      [0.6 rgb <45, 60, 85>]
      [1 rgb <20, 35, 70>]
    }
    translate -0.5*y
    scale 2e5
  }
  finish { emission 1 diffuse 0 }
}

#for (I, 0, Slats - 1)
  box {
    <-Width/2 + 0.5, -0.05, -Depth/2>, <Width/2 - 0.5, 0.05, Depth/2>
    rotate Tilt*x
    translate <0, (I + 0.5)*Pitch - Height/2, 5>
    pigment { rgb <0.8, 0.78, 0.72> } finish { diffuse 1 }
  }
#end
difference {
  box { <-5000, -5000, 0.02>, <5000, 5000, 25> }
  box { <-Width/2, -Height/2, -1>, <Width/2, Height/2, 26> }
  pigment { rgb 0.75 } finish { diffuse 1 }
}

// The frame on the wall's inside; scenes get it as Window_Blinds_Canned_Housing().
#declare Canned_Housing = union {
  difference {
    box { <-Width/2 - 6, -Height/2 - 6, -2>, <Width/2 + 6, Height/2 + 6, -0.01> }
    box { <-Width/2 - 0.2, -Height/2 - 0.2, -3>, <Width/2 + 0.2, Height/2 + 0.2, 1> }
  }
  box { <-Width/2 - 9, -Height/2 - 8, -10>, <Width/2 + 9, -Height/2 - 5, -0.01> }
  pigment { rgb 0.8 } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#ifndef (Canned_Baking)
  object { Canned_Housing }
  light_source { <-100, 200, -500> rgb 20 }
#end
#declare Eye = <90, 30, -260>;
camera { location Eye look_at <0, -4, 0> angle 44 }
sphere { Eye, 2 pigment { rgb 0.02 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
