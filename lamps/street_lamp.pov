// A street lamp: 32 light-emitting diodes, each under a lens that throws its light along the
// street rather than down: a batwing, brightest at some 60 degrees, so that the road is lit
// evenly between two posts. Centimetres; it shines down through y = 0, 22 x 10 cm, the street
// running along x; radiance in W/(sr m2), some 17 watts of light.
// It calls for nothing: rays find the diodes themselves through the lenses, and the board around
// these is black.
// A lens is shaped by Snell's law, plane by plane through its axis: light that leaves the diode
// at an angle a, a share sin(a)^2 of it, goes to the angle b with tan(b) = Spread*sin(a), so that
// equal shares go to equal areas of the road.
// Positions are 7 mm apart, not much more than a diode is wide behind its lens: in larger ones
// few rays would find it.
// Bake: bakeslab bake street_lamp.pov -o street_lamp.tif --uv 32x16 --st 96x64 --rays 24
// Use: object { Street_Lamp_Canned(1, 1) translate 800*y } and its housing likewise
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Columns = 8;
#declare Rows = 4;
#declare Pitch = <2.2, 0, 1.6>;
#declare Height = 0.8;                         // of the board
#declare Radius = 0.55;                        // of a lens on its axis; along the street it is larger
#declare Die = 0.1;                            // radius of a diode
#declare Index = 1.49;                         // of acrylic
#declare Along = 2.5;                          // Spread along the street (68 degrees)
#declare Across = 1.1;                         // and across it
#declare Radiance = 60000*<1, 0.93, 0.82>;

Canned_Lamp("street_lamp")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, 22*x, 10*z, -y, <-4, 4, -3, 3>, 0)
Canned_Glow(Columns*Rows*pi*Die*Die, Radiance)

// Points of a lens around the diode: Rings from the axis to the board, Spokes around it.
#declare Rings = 24;
#declare Spokes = 48;
#declare Points = array[Spokes][Rings + 1]
#for (I, 0, Spokes - 1)
  #local Turn = 2*pi*I/Spokes;
  #local Spread = 1/sqrt(pow(cos(Turn)/Along, 2) + pow(sin(Turn)/Across, 2));
  #local Distance = Radius;
  #for (J, 0, Rings)
    #local A = pi/2*J/Rings;
    #declare Points[I][J] = Distance*<sin(A)*cos(Turn), -cos(A), sin(A)*sin(Turn)>;
    // Halfway to the next ring: how far the light is bent there, and the surface that does it.
    #local A = pi/2*(J + 0.5)/Rings;
    #local Bend = atan2(Spread*sin(A), 1) - A;
    #local Distance = Distance*exp(sin(Bend)/(Index - cos(Bend))*pi/2/Rings);
  #end
#end
#macro Point(I, J) Points[mod(I + Spokes, Spokes)][J] #end
#declare Normals = array[Spokes][Rings + 1]
#for (I, 0, Spokes - 1)
  #declare Normals[I][0] = -y;
  #for (J, 1, Rings)
    #declare Normals[I][J] = vnormalize(vcross(Point(I + 1, J) - Point(I - 1, J), Point(I, min(J + 1, Rings)) - Point(I, J - 1)));
  #end
#end
#declare Lens = union {
  mesh {
    #for (I, 0, Spokes - 1)
      #local K = mod(I + 1, Spokes);
      #for (J, 0, Rings - 1)
        smooth_triangle { Points[I][J], Normals[I][J], Points[I][J + 1], Normals[I][J + 1], Points[K][J + 1], Normals[K][J + 1] }
        #if (J > 0)
          smooth_triangle { Points[I][J], Normals[I][J], Points[K][J + 1], Normals[K][J + 1], Points[K][J], Normals[K][J] }
        #end
      #end
    #end
    pigment { rgbf 1 } finish { diffuse 0 }
    interior { ior Index }
  }
  // The air between diode and lens, and the diode.
  sphere { 0, 0.5*Radius hollow pigment { rgbf 1 } finish { diffuse 0 } interior { ior 1 } }
  disc { -0.001*y, y, Die pigment { rgb 1 } finish { emission rgb Radiance diffuse 0 } }
}
#for (I, 1, Columns)
  #for (J, 1, Rows)
    object { Lens translate <(I - (Columns + 1)/2)*Pitch.x, Height, (J - (Rows + 1)/2)*Pitch.z> }
  #end
#end
box { <-11, Height, -5>, <11, Height + 0.2, 5> pigment { rgb 0.02 } finish { diffuse 1 } }

// The head on its post, 8 m above the ground; scenes get it as Street_Lamp_Canned_Housing().
#declare Canned_Housing = union {
  difference {
    superellipsoid { <0.4, 0.4> scale <26, 5, 9> translate <8, 5.2, 0> }
    box { <-11.1, -1, -5.1>, <11.1, 1.1, 5.1> }
    plane { y, 0.01 }
  }
  cylinder { <20, 6, 0>, <75, 12, 0>, 3 }
  sphere { <75, 12, 0>, 3 }
  cone { <75, 12, 0>, 3, <75, -800, 0>, 8 }
  pigment { rgb 0.25 } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#ifndef (Canned_Baking)
  object { Canned_Housing }
  light_source { <-300, -500, -700> rgb 500 }
#end
#declare Eye = <-24, -34, -26>;
camera { location Eye look_at <3, 1, 0> angle 42 }
sphere { Eye, 0.2 pigment { rgb 0.005 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
