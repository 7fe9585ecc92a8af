// A car's headlight (dipped beam): a free-form mirror of 36 x 6 facets. Each is a piece of a
// paraboloid about the filament, turned to where its image of the filament is to go, so that
// hardly any light goes above the horizon save on the right, where it climbs (right-hand traffic).
// Centimetres; 18 x 12 cm, shining along +z from z = 0, x to the driver's right;
// radiance in W/(sr m2).
// It calls for nothing: rays meet the filament by way of the mirror themselves, and nothing
// else in there is bright.
// The st plane is 10 m away, where headlights are adjusted; a direction is 4 cm wide there.
// Bake: bakeslab bake headlight.pov -o headlight.tif --uv 15x10 --st 256x104
// Use: object { Headlight_Canned(1, 1) }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Width = 18;
#declare Height = 12;
#declare Columns = 36;
#declare Rows = 6;
#declare Focal = 2.6;                          // of the paraboloids
#declare Focus = <0, 0, -9>;                   // the filament
#declare Filament = 0.25;                      // half its length, along z

Canned_Lamp("headlight")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, Width*x, Height*y, z, <-0.5, 0.5, -0.3, 0.15>, 1000)
#for (I, -1, 1)
  Canned_Bulb(Focus + I*Filament*2/3*z, Filament/3, 20000*<1, 0.93, 0.78>)
#end

// A facet between slanted planes: how far its beam turns up and to the right, in degrees.
#macro Facet(X0, Y0, Up, Right)
  quadric {
    <1, 1, 0>, <0, 0, 0>, <0, 0, -4*Focal>, -4*Focal*Focal
    rotate <-Up, Right, 0>
    translate Focus
    clipped_by { box { <X0, Y0, -20>, <X0 + Width/Columns, Y0 + Height/Rows, -0.01> } }
    pigment { rgb 0 }
    finish { diffuse 0 reflection { 0.88 } }
  }
#end
#for (I, 0, Columns - 1)
  #for (J, 0, Rows - 1)
    #local X0 = I*Width/Columns - Width/2;
    #local Y0 = J*Height/Rows - Height/2;
    #local Middle = <X0 + Width/Columns/2, Y0 + Height/Rows/2, 0>;
    // The facet's distance from the filament, and the angle of half the image that it makes.
    #local Distance = Focal + vdot(Middle, Middle)/(4*Focal);
    #local Image = degrees(atan2(Filament, Distance));
    // Outer facets make small images: the bright middle of the beam; those between, its width.
    #local Right = 22*sin(pi*2*Middle.x/Width);
    #local Up = -Image - 0.4;
    // The left of the mirror makes the beam climb to the right, by 15 degrees.
    #if (Middle.x < -0.28*Width)
      #local Right = Image + 14*abs(sin(pi*2*Middle.x/Width));
      #local Up = Up + 0.26*Right;
    #end
    Facet(X0, Y0, Up, Right)
  #end
#end

// A black cap keeps the filament's own light in; black walls behind and beside the mirror.
#declare Black = texture { pigment { rgb 0.01 } finish { diffuse 1 } }
difference {
  sphere { Focus, 1.1 }
  sphere { Focus, 1 }
  plane { z, Focus.z + 0.5 }
  texture { Black }
}
difference {
  box { <-Width/2 - 0.3, -Height/2 - 0.3, -13>, <Width/2 + 0.3, Height/2 + 0.3, -0.01> }
  box { <-Width/2, -Height/2, -12.7>, <Width/2, Height/2, 0> }
  texture { Black }
}

// What is seen of the headlight from outside; scenes get it as Headlight_Canned_Housing().
#declare Canned_Housing = difference {
  superellipsoid { <0.3, 0.3> scale <Width/2 + 1.5, Height/2 + 1.5, 8> translate -8.1*z }
  box { <-Width/2 - 0.2, -Height/2 - 0.2, -13.2>, <Width/2 + 0.2, Height/2 + 0.2, 1> }
  pigment { rgb <0.3, 0.32, 0.36> } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass, and has
// a wall behind it for the mirror to show.
#declare Eye = <3, -3, 70>;
#ifndef (Canned_Bake_Effects)
  object { Canned_Housing }
  light_source { <-300, 300, 400> rgb 60 shadowless }
  plane { -z, -300 pigment { rgb <0.6, 0.8, 1> } finish { emission 15 diffuse 0 } }
#end
camera { location Eye look_at <0, 0, -4> angle 24 }
sphere { Eye, 0.5 pigment { rgb 0.02 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
