// A desk lamp: a conical shade, white and matt inside, with a frosted bulb of about 800 lm,
// on an arm and a foot. It stands on y = 0, its foot at the origin, and shines down along +x.
// Centimetres; radiance in W/(sr m2).
// It calls for interreflection: the white shade lights itself, which is a fifth of the light.
// The bulb is round and small beside the shade, so that its size matters little to shading
// (rays see it as the sphere that it is).
// A matt shade shines up to grazing angles: 3 % of the light is beyond slope 3, 72 degrees, and
// less than 1 % beyond slope 5.
// Bake: bakeslab bake desk_lamp.pov -o desk_lamp.tif --uv 16x16 --st 64x64
// Use: object { Desk_Lamp_Canned(1, 1) } object { Desk_Lamp_Canned_Housing() } on a desk at y = 0
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Tilt = 25*z;
#declare Elbow = <-12, 26, 0>;
#declare Joint = <6, 43, 0>;                   // where the head hangs
#declare Down = vrotate(-y, Tilt);             // the head's axis
#declare Opening = Joint + 17*Down;            // its centre
#declare Radius = 8;                           // of the opening

Canned_Lamp("desk_lamp")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("interreflection")
Canned_Slab(Opening, vrotate(2*Radius*x, Tilt), 2*Radius*z, Down, <-5, 5, -5, 5>, 0)
Canned_Bulb(Joint + 9.5*Down, 3, 70)

// The shade's inside, and the socket above it.
union {
  cone { Joint + 4*Down, 3, Opening - 0.01*Down, Radius open }
  cylinder { Joint + 4*Down, Joint + 6.5*Down, 1.4 }
  disc { Joint + 4*Down, Down, 3 }
  pigment { rgb 0.85 }
  finish { diffuse 1 }
}

// What is seen of the lamp from outside; scenes get it as Desk_Lamp_Canned_Housing().
#declare Canned_Housing = union {
  cone { Joint + 4*Down, 3.1, Opening - 0.01*Down, Radius + 0.1 open }
  cone { Joint - Down, 2.2, Joint + 4*Down, 3.1 }
  sphere { Joint, 1.6 }
  cylinder { Joint, Elbow, 0.6 }
  sphere { Elbow, 1.3 }
  cylinder { Elbow, y, 0.6 }
  cylinder { 0, 0.8*y, 8.5 }
  cone { 0.8*y, 8.5, 2*y, 2.5 }
  pigment { rgb <0.5, 0.05, 0.03> } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#ifndef (Canned_Bake_Effects)
  object { Canned_Housing }
  plane { y, 0 pigment { rgb 0.5 } finish { diffuse 1 } no_radiosity }
  light_source { <-300, 300, -400> rgb 2 }
#end
#declare Eye = <72, 22, -95>;
camera { location Eye look_at <5, 24, 0> angle 34 }
sphere { Eye, 0.5 pigment { rgb 0.25 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
