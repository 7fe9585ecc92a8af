// A storm lantern: a glowing mantle in a bulging glass chimney between a base and a roof of
// dull metal, on four posts. Centimetres; it stands on y = 0; radiance in W/(sr m2).
// It calls for caustics: what reaches base, roof and posts has gone through the glass, by
// photons; and for interreflection: base and roof light each other. Each changes 1 to 2 % of the
// light, but all of it where the lantern shines on itself.
// Pages: 1 to 4 the sides (towards +z, +x, -z, -x) of the box between base and roof, so that
// there is no gap for light to get out. Base and roof shine to the side at all angles: 2 % of
// the light is beyond the windows, as the bake says.
// Bake: bakeslab bake lantern.pov -o lantern.tif --uv 12x12 --st 64x64
// Use: object { Lantern_Canned(1, 1) } object { Lantern_Canned_Housing() }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Side = 16;                            // of base and roof, and of the box
#declare Low = 3;                              // the base's top
#declare High = 19;                            // the roof's lower side
#declare Middle = (Low + High)/2;

Canned_Lamp("lantern")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("interreflection caustics")
#for (I, 0, 3)
  Canned_Slab(
    vrotate(<0, Middle, Side/2>, 90*I*y), vrotate(Side*x, 90*I*y), (High - Low)*y, vrotate(z, 90*I*y),
    <-2.5, 2.5, -2.5, 2.5>, 0)
#end
// Below the middle of the glass: photons aimed at a target's middle must not start there.
Canned_Bulb(<0, 8.6, 0>, 1.2, 30*<1, 0.7, 0.35>)

// The chimney: a ball cut off above and below, 3 mm thick.
#declare Chimney = sphere { 0, 1 scale <5, 9, 5> translate 10.5*y }
#declare Hollow = sphere { 0, 1 scale <4.7, 8.7, 4.7> translate 10.5*y }
difference {
  object { Chimney }
  object { Hollow }
  plane { y, Low + 0.2 }
  plane { -y, 0.2 - High }
  pigment { rgbf <0.97, 1, 0.98, 1> }
  finish { diffuse 0 }
  interior { ior 1.5 }
  photons { target refraction on reflection on collect off }
  no_radiosity // light between base and roof goes straight on through it
}

#declare Metal = texture { pigment { rgb <0.5, 0.45, 0.35> } finish { diffuse 1 } }
union {
  box { <-Side/2, 2, -Side/2>, <Side/2, Low, Side/2> }
  box { <-Side/2, High, -Side/2>, <Side/2, High + 1, Side/2> }
  #for (I, 0, 3)
    cylinder { <7.2, Low, 7.2>, <7.2, High, 7.2>, 0.4 rotate 90*I*y }
  #end
  cylinder { Low*y, 7*y, 1.2 }
  cylinder { 7*y, 7.5*y, 0.6 }
  texture { Metal }
}

// What is seen of the lantern from outside; scenes get it as Lantern_Canned_Housing().
#declare Canned_Housing = union {
  box { <-Side/2, 2, -Side/2>, <Side/2, Low, Side/2> }
  box { <-Side/2 - 1, 0, -Side/2 - 1>, <Side/2 + 1, 2, Side/2 + 1> }
  box { <-Side/2, High, -Side/2>, <Side/2, High + 1, Side/2> }
  cone { (High + 1)*y, 11, (High + 6)*y, 3 }
  cylinder { (High + 6)*y, (High + 8)*y, 2.5 }
  torus { 3, 0.3 rotate 90*x translate (High + 11)*y }
  cylinder { <7.2, Low, 7.2>, <7.2, High, 7.2>, 0.4 }
  cylinder { <-7.2, Low, 7.2>, <-7.2, High, 7.2>, 0.4 }
  cylinder { <7.2, Low, -7.2>, <7.2, High, -7.2>, 0.4 }
  cylinder { <-7.2, Low, -7.2>, <-7.2, High, -7.2>, 0.4 }
  pigment { rgb <0.5, 0.45, 0.35> } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#ifndef (Canned_Bake_Effects)
  object { Canned_Housing }
  light_source { <-300, 300, -400> rgb 1.5 photons { refraction off reflection off } }
#end
#declare Eye = <20, 26, -80>;
camera { location Eye look_at <0, 14, 0> angle 32 }
sphere { Eye, 0.2 pigment { rgb 0.4 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
