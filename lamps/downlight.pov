// A downlight whose white can be tuned: a chip of warm and cold light-emitting diodes in a mirror,
// behind a honeycomb grid, which hides it from the side. Centimetres; it shines down through
// y = 0, 10 x 10 cm; radiance in W/(sr m2).
// The warm diodes are one channel and the cold ones another: one bake keeps them apart, and a
// scene mixes them.
// It calls for nothing: rays find the chip themselves by way of the mirror, and the grid is black.
// Light is faint beyond slope 0.8, where the grid cuts it off but in the cells' corners: the window
// holds these, and is not narrowed.
// Pages: 1 the warm light, 2 the cold one, through the same opening.
// Bake: bakeslab bake downlight.pov -o downlight.tif --window declared --uv 8x8 --st 120x120 --rays 48
// Use: Downlight_Canned_Channel("cold", 0.2) object { Downlight_Canned(1, 1) translate 240*y }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Opening = 4.6;                        // radius of the mirror's mouth
#declare Focal = 1.3;                          // of the mirror, a paraboloid
#declare Cell = 0.8;                           // width of a cell of the honeycomb
#declare Deep = 1;                             // and its depth
#declare Wall = 0.03;
#declare Mouth = Deep + 0.05;                  // where the mirror ends
#declare Vertex = Mouth + Opening*Opening/(4*Focal);
#declare Chip = Vertex - 0.85*Focal;           // nearly in the focus, looking down
#declare Side = 1.6;                           // of the chip
#declare Dies = 4;                             // along it

Canned_Lamp("downlight")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, 10*x, 10*z, -y, <-0.95, 0.95, -0.95, 0.95>, 0)

// Dies in a checkerboard, and the black board above them.
#macro Diodes(Odd, Radiance)
  Canned_Glow(Side*Side/2, Radiance)
  union {
    #for (I, 0, Dies - 1)
      #for (J, 0, Dies - 1)
        #if (mod(I + J, 2) = Odd)
          #local Corner = <I*Side/Dies - Side/2, Chip, J*Side/Dies - Side/2>;
          box { Corner, Corner + <Side/Dies, -0.01, Side/Dies> }
        #end
      #end
    #end
    pigment { rgb 1 } finish { emission rgb Canned_Lit(Radiance) diffuse 0 }
  }
#end
Canned_Channel("warm")
Diodes(0, 9000*<1.33, 0.94, 0.45>)             // near 3000 K
Canned_Channel("cold")
Diodes(1, 9000*<0.95, 1, 1.12>)                // near 6500 K
cylinder { Chip*y, (Chip + 0.1)*y, 2*Focal + 0.1 pigment { rgb 0.02 } finish { diffuse 1 } }

// The mirror: x^2 + z^2 = 4 Focal (Vertex - y), in a black block, and the tube below it.
#declare Black = texture { pigment { rgb 0.02 } finish { diffuse 1 } }
difference {
  cylinder { Mouth*y, Chip*y, Opening + 0.2 texture { Black } }
  quadric {
    <1, 0, 1>, <0, 0, 0>, <0, 4*Focal, 0>, -4*Focal*Vertex
    pigment { rgb 0 } finish { diffuse 0 reflection { 0.85 } }
  }
}
cylinder { 0.01*y, Mouth*y, Opening + 0.2 open texture { Black } }

// The honeycomb: of each cell three walls, which its neighbours share.
#declare Walls = union {
  #for (Turn, 0, 120, 60)
    box { <-Cell/2/sqrt(3) - Wall/3, 0.02, -Wall/2>, <Cell/2/sqrt(3) + Wall/3, Deep, Wall/2> translate Cell/2*z rotate Turn*y }
  #end
}
union {
  #for (I, -8, 8)
    #for (J, -8, 8)
      #local Place = Cell*<sqrt(3)/2*I, 0, J + I/2>;
      #if (vlength(Place) < Opening + 0.2) object { Walls translate Place } #end
    #end
  #end
  texture { Black }
}

// The ring in the ceiling and the can above; scenes get it as Downlight_Canned_Housing().
#declare Canned_Housing = difference {
  union {
    cylinder { 0.01*y, 0.25*y, 6.2 }
    cylinder { 0.2*y, 7.5*y, 5.2 }
  }
  cylinder { -y, 7.3*y, 4.82 }
  pigment { rgb 0.7 } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#ifndef (Canned_Baking)
  object { Canned_Housing }
  light_source { <-30, -60, -40> rgb 250 }
#end
#declare Eye = <0.8, -24, -2.6>;
camera { location Eye look_at <0, 1.5, 0> angle 32 }
sphere { Eye, 0.1 pigment { rgb 0.005 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
