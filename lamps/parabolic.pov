// The lamp of "Canned Lightsources" (Heidrich, Kautz, Slusallek, Seidel, 1998), section 5
// and figure 4: a diffuse parabolic reflector with a small spherical luminary at its focus,
// covered with a grid of 3 x 3 long blockers. Centimetres; it shines down through y = 0.
// It calls for interreflection: the white bowl lights itself.
// Bake: bakeslab bake parabolic.pov -o parabolic.tif --uv 16x16 --st 64x64
// Use: object { Parabolic_Canned(1, 1) }
// A script that declares Parabolic_Name and Parabolic_Radius and includes this one is the
// same lamp with another opening: parabolic_small.pov, parabolic_large.pov.
// Licence: CC0
#version 3.7;
#include "canned.inc"

#ifndef (Parabolic_Name) #declare Parabolic_Name = "parabolic"; #end
#declare Housing_Radius = 10;
#ifndef (Parabolic_Radius) #declare Parabolic_Radius = Housing_Radius; #end
#declare Radius = Parabolic_Radius;            // of the reflector's opening
#declare Focus = 2.5;                          // its focal length
#declare Depth = Radius*Radius/(4*Focus);      // its depth
#declare Pitch = Radius/2;                     // of the blockers
#declare Height = 4;                           // they cut light off at slope Pitch/Height = 1.25
#declare Slope = 1.2*Pitch/Height;             // a little more: the grid's outer cells are wider
#declare Thickness = 0.2;

Canned_Lamp(Parabolic_Name)
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("interreflection")
Canned_Slab(<0, 0, 0>, <2*Radius, 0, 0>, <0, 0, 2*Radius>, <0, -1, 0>, <-Slope, Slope, -Slope, Slope>, 0)
Canned_Bulb(<0, Height + Depth - Focus, 0>, 1.5, 500)

#declare White = texture { pigment { rgb 0.8 } finish { diffuse 1 } }
#declare Black = texture { pigment { rgb 0.02 } finish { diffuse 1 } }

// The reflector: a shell between two paraboloids r^2 = 4 f (Top - y).
#declare Top = Height + Depth;
#declare Bowl = quadric { <1, 0, 1>, <0, 0, 0>, <0, 4*Focus, 0>, -4*Focus*Top }
intersection {
  object { Bowl translate Thickness*y }
  object { Bowl inverse }
  plane { -y, -Height }
  texture { White }
}

// The blockers, and a collar around them.
#declare Blocker = box { <-Radius, 0.1, -Thickness/2>, <Radius, Height, Thickness/2> }
intersection {
  union {
    #for (I, -1, 1)
      object { Blocker translate I*Pitch*z }
      object { Blocker rotate 90*y translate I*Pitch*x }
    #end
  }
  cylinder { 0, 2*Height*y, Radius }
  texture { Black }
}
cylinder { 0.1*y, Height*y, Radius open texture { Black } }

// What is seen of the lamp from outside; scenes get it as Parabolic_Canned_Housing().
#declare Housing_Top = Height + Housing_Radius*Housing_Radius/(4*Focus);
#declare Canned_Housing = union {
  intersection {
    quadric { <1, 0, 1>, <0, 0, 0>, <0, 4*Focus, 0>, -4*Focus*Housing_Top translate 2*Thickness*y }
    quadric { <1, 0, 1>, <0, 0, 0>, <0, 4*Focus, 0>, -4*Focus*Housing_Top translate Thickness*y inverse }
    plane { -y, -Height }
  }
  cylinder { 0.1*y, Height*y, Housing_Radius + Thickness open }
  pigment { rgb 0.3 } finish { diffuse 1 }
}
#if (Radius = Housing_Radius) object { Canned_Housing } #end

// For previews only: the bake brings its own cameras.
camera { location <12, -40, -25> look_at <0, 3, 0> angle 40 }
