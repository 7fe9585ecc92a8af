// A hanging lamp with a paper shade, to be seen from all sides: what leaves it is caught by a
// cube of six slabs, 60 cm wide, around a shade of 36 cm. Centimetres, the cube's middle at the
// origin; radiance in W/(sr m2), a bulb of about 800 lm.
// It calls for interreflection: paper lets half of its light through and gives most of the rest
// back to the inside.
// Pages: 1 to 4 the sides (towards +z, +x, -z, -x), 5 above, 6 below. From a shade in the middle
// all light leaves a cube this wide within the windows, so nothing is cut off.
// Bake: bakeslab bake paper_shade.pov -o paper_shade.tif --uv 16x16 --st 64x64
// Use: object { Paper_Shade_Canned(1, 1) translate 150*y }, with nothing inside the cube
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Side = 60;                            // of the cube
#declare Height = 22;                          // of the shade
#declare Top = 11;                             // radius
#declare Bottom = 18;                          // radius

Canned_Lamp("paper_shade")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("interreflection")
#for (I, 0, 3)
  Canned_Slab(vrotate(Side/2*z, 90*I*y), vrotate(Side*x, 90*I*y), Side*y, vrotate(z, 90*I*y), <-2.8, 2.8, -2.5, 3.5>, 0)
#end
Canned_Slab(Side/2*y, Side*x, Side*z, y, <-2.6, 2.6, -2.6, 2.6>, 0)
Canned_Slab(-Side/2*y, Side*x, Side*z, -y, <-2.6, 2.6, -2.6, 2.6>, 0)
Canned_Bulb(-1*y, 3, 70*<1, 0.85, 0.65>)

// The paper: 45 % is thrown back, 35 % goes through.
cone {
  -Height/2*y, Bottom, Height/2*y, Top open
  pigment { rgb <1, 0.97, 0.9> }
  finish { diffuse 0.45, 0.35 }
}

// Wire rings, the cross that carries the shade, the socket, and the cord up to the cube's top.
union {
  torus { Bottom, 0.2 translate -Height/2*y }
  torus { Top, 0.2 translate Height/2*y }
  cylinder { <-Top, Height/2 - 0.5, 0>, <Top, Height/2 - 0.5, 0>, 0.15 }
  cylinder { <0, Height/2 - 0.5, -Top>, <0, Height/2 - 0.5, Top>, 0.15 }
  cylinder { 2.5*y, 9*y, 1.7 }
  cylinder { 9*y, (Side/2 - 0.1)*y, 0.3 }
  pigment { rgb 0.15 }
  finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#declare Eye = <40, -22, -110>;
camera { location Eye look_at <0, 2, 0> angle 30 }
sphere { Eye, 0.5 pigment { rgb 0.3 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
