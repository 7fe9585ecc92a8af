// A ceiling fixture of 60 x 30 cm: two fluorescent tubes in a white box behind louvres of
// matt aluminium. Centimetres, in the ceiling y = 0, shining down; radiance in W/(sr m2).
// It calls for interreflection: box and louvres take most of the tubes' light and pass it on.
// The tubes glow where they are seen; what they shine on things is that of small lights along
// their axes, closer together than the things are near. So they need no extended source.
// Canned_Glow tells the tubes' flux, and that these light_sources have what shows it.
// The louvres hide the tubes above slope 6/4.5 along them and 7.5/4.5 across; the glow of the
// louvres goes on to the side, 3 % of the light beyond the window, as the bake says.
// Bake: bakeslab bake fluorescent.pov -o fluorescent.tif --uv 32x16 --st 48x48
// Use: object { Fluorescent_Canned(1, 1) translate 250*y }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Length = 60;
#declare Width = 30;
#declare Height = 4.5;                         // of the louvres
#declare Radiance = 35*<1, 0.97, 0.9>;          // of a tube
#declare Tube = 1.3;                           // its radius
#declare Lights = 10;                          // along a tube

Canned_Lamp("fluorescent")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("interreflection")
Canned_Slab(<0, 0, 0>, Length*x, Width*z, -y, <-2.5, 2.5, -2.5, 2.5>, 0)

// A tube with its middle at C: radius r and radiance L. Its lights are those of spheres with
// as much flux: as a length p of the tube has, radius^2 = r p/2.
#macro Fluorescent_Tube(C)
  #local Pitch = (Length - 2)/Lights;
  #local Radius = sqrt(Tube*Pitch/2);
  #for (I, 0, Lights - 1)
    light_source {
      C + (I + 0.5 - Lights/2)*Pitch*x rgb Radiance*pow(100, 2)/2 fade_power 2 fade_distance Radius/100
    }
  #end
  #local End = (Length/2 - 1)*x;
  Canned_Glow(2*pi*Tube*2*vlength(End), Radiance)
  cylinder {
    C - End, C + End, Tube
    pigment { rgb 1 } finish { emission rgb Radiance ambient 0 diffuse 0 }
    no_shadow no_radiosity
  }
  // Radiosity must not gather what the lights give already.
  cylinder { C - End, C + End, 0.99*Tube pigment { rgb 0 } finish { diffuse 0 } no_shadow }
#end
Fluorescent_Tube(<0, 8.5, -7.5>)
Fluorescent_Tube(<0, 8.5, 7.5>)

// The box, open below.
difference {
  box { <-Length/2 - 0.3, 0.01, -Width/2 - 0.3>, <Length/2 + 0.3, 13.3, Width/2 + 0.3> }
  box { <-Length/2, 0, -Width/2>, <Length/2, 13, Width/2> }
  pigment { rgb 0.85 } finish { diffuse 1 }
}

// The louvres.
union {
  #for (I, -4, 4)
    box { <6*I - 0.05, 0.02, -Width/2>, <6*I + 0.05, Height, Width/2> }
  #end
  #for (I, -1, 1)
    box { <-Length/2, 0.02, 7.5*I - 0.05>, <Length/2, Height, 7.5*I + 0.05> }
  #end
  pigment { rgb 0.6 } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#declare Eye = <-40, -55, -70>;
camera { location Eye look_at <3, 0, 2> angle 40 }
sphere { Eye, 0.5 pigment { rgb 0.05 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
