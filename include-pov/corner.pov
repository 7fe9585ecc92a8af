// Persistence of Vision Ray Tracer Scene File
// File:   corner.pov
// Desc:   a corner to read in, at night, under the paper's lamp on a tripod, 40 cm wide here: lit
//         through the canned lamp, or, with Declare=Full_Lamp=1, by the lamp's whole geometry.
//         Centimetres; y is up, z away from the viewer.
// Usage:  see demo.sh
// Licence: CC0
//
// What the room reflects onto itself is gathered by radiosity in both. The whole lamp needs it for
// its own light, too: its reflector lights the room by nothing else. Its counts are such that the
// picture takes about as long as the canned lamp's does with smooth edges (+A).
#version 3.7;
#include "transforms.inc"
#include "shapes.inc"

#declare Eye = <246, 108, -196>;
#declare Exposure = <12, 10.4, 8.2>;           // a warm light
#declare Lamp_Turn = transform { rotate 63*z rotate 10*y translate <0, 160, 0> };

// Frame: where all but the lamp stands.
#ifdef (Full_Lamp)
  #declare Canned_Bake_Effects = "extended_source";
  #include "parabolic.pov"
  global_settings {
    max_trace_level 12
    radiosity {
      pretrace_start 0.08 pretrace_end 0.02
      count 50 error_bound 0.4 nearest_count 8 recursion_limit 3
      low_error_factor 0.7 minimum_reuse 0.01 gray_threshold 0 brightness 1
    }
  }
  // The script has the lamp at the origin, 20 cm wide: the room comes to it.
  #declare Frame = transform { scale 2 transform { Lamp_Turn } inverse };
  object { Canned_Housing }
  // The script's bulb stays as it is: the eye sees it brighter.
  sphere {
    Eye, 0.5
    pigment { rgb Exposure filter 1 } finish { diffuse 0 ambient 0 }
    no_shadow no_radiosity transform { Frame }
  }
#else
  global_settings {
    assumed_gamma 1
    radiosity {
      pretrace_start 0.08 pretrace_end 0.02
      count 40 error_bound 0.6 nearest_count 8 recursion_limit 2
      low_error_factor 0.7 minimum_reuse 0.03 gray_threshold 0 brightness 1
    }
  }
  #default { finish { ambient 0 } }
  #declare Parabolic_Lights = 8;               // an axis: one in four of the slab's
  #include "parabolic.inc"
  #declare Frame = transform { translate 0 };
  object { Parabolic_Canned(2, Exposure) transform Lamp_Turn }
  object { Parabolic_Canned_Housing() scale 2 transform { Lamp_Turn } }
  // Its face is held back 200 times, so that more is seen of it than white: the bright bowl, and
  // the grid of blockers before it.
  object {
    Parabolic_Canned_Face(2, Exposure/200, vinv_transform(Eye, Lamp_Turn))
    clipped_by { cylinder { -y, y, 20 } }
    transform Lamp_Turn
  }
#end

#default { finish { diffuse 1 ambient 0 } }
#macro Matt(Colour) pigment { rgb Colour } #end
#macro Rounded(A, B, R) object { Round_Box_Union(A, B, R) } #end

#declare Wood = pigment {
  wood turbulence 0.06 octaves 3 rotate 4*y
  color_map { [0 rgb <0.42, 0.25, 0.13>] [0.7 rgb <0.34, 0.19, 0.09>] [1 rgb <0.22, 0.12, 0.055>] }
  scale <2.2, 2.2, 40>
}
#declare Board = 14;                           // the width of a floor board
#declare Walnut = <0.22, 0.12, 0.06>;

// Boards along x, each of its own shade.
#declare Floor = plane {
  y, 0
  pigment {
    brick
    pigment { rgb <0.05, 0.03, 0.02> },
    pigment {
      cells scale <170, 1000, Board>
      pigment_map {
        #for (I, 0, 7)
          #local Shade = mod(3*I, 8);
          [I/7
            bozo turbulence 0.6 scale <60, 1, 1.2> translate 37*I*<3, 0, 1>
            color_map {
              [0.2 rgb (0.75 + 0.07*Shade)*<0.40, 0.235, 0.125>]
              [0.8 rgb (0.70 + 0.06*Shade)*<0.29, 0.16, 0.08>]
            }
          ]
        #end
      }
    }
    brick_size <170, 1000, Board> mortar 0.35 translate <20, 500, 3>
  }
  no_shadow
}

// Nothing stands behind the walls: to test them for shadows would be in vain.
#declare Walls = union {
  plane { -z, -95 Matt(<0.16, 0.36, 0.37>) }
  plane { x, -75 Matt(<0.16, 0.36, 0.37>) }
  plane { -x, -420 Matt(0.7) }
  plane { z, -400 Matt(0.7) }
  plane { -y, -270 Matt(0.8) }
  no_shadow
}
#declare Skirting = union {
  box { <-75, 0, 93>, <420, 11, 95> }
  box { <-75, 0, -400>, <-73, 11, 95> }
  Matt(0.75)
}

#declare Tripod = union {
  sphere { 0, 3 }
  cylinder { <0, 0, 0>, <0, -22, 0>, 1.2 }
  #for (I, 0, 2)
    cone { <0, -14, 0>, 2, vrotate(<42, -172, 0>, (120*I + 50)*y), 1.2 }
  #end
  Matt(Walnut)
  translate vtransform(<0, 30, 0>, Lamp_Turn)
}

// An armchair that faces -z: cushions on a frame of round rods.
#declare Chair = union {
  union {
    Rounded(<-31, 27, -34>, <31, 43, 30>, 6)
    object { Rounded(<-31, 0, -7>, <31, 56, 7>, 6) rotate 17*x translate <0, 40, 29> }
    pigment { rgb <0.72, 0.42, 0.09> }
    normal { bumps 0.2 scale 0.5 }
  }
  union {
    #for (Side, -1, 1, 2)
      cylinder { <Side*36, 0, -32>, <Side*35, 57, -28>, 2 }
      cylinder { <Side*36, 0, 40>, <Side*35, 57, 30>, 2 }
      Rounded(<Side*35 - 4, 56, -37>, <Side*35 + 4, 60, 40>, 1.8)
      cylinder { <Side*35, 25, -30>, <Side*35, 25, 36>, 1.6 }
    #end
    cylinder { <-35, 26, -29>, <35, 26, -29>, 1.8 }
    cylinder { <-35, 26, 35>, <35, 26, 35>, 1.8 }
    Matt(1.5*Walnut)
  }
}

#declare Table = union {
  cylinder { <0, 47, 0>, <0, 50, 0>, 27 }
  #for (I, 0, 2) cylinder { vrotate(<12, 47, 0>, 120*I*y), vrotate(<22, 0, 0>, 120*I*y), 1.5 } #end
  pigment { Wood rotate 70*y }
}
#macro Book(Y, Thick, Turn, Colour)
  union {
    box { <-11, Y, -8>, <11, Y + 0.3, 8> Matt(Colour) }
    box { <-11, Y + Thick - 0.3, -8>, <11, Y + Thick, 8> Matt(Colour) }
    box { <-11, Y, 7.6>, <11, Y + Thick, 8> Matt(Colour) }
    box { <-10.6, Y + 0.2, -7.6>, <10.6, Y + Thick - 0.2, 7.8> Matt(0.8) }
    rotate Turn*y
  }
#end
#declare Things = union {
  union {
    Book(50, 3.5, 12, <0.10, 0.17, 0.36>)
    Book(53.5, 2.6, -9, <0.55, 0.12, 0.08>)
    Book(56.1, 3, 20, <0.75, 0.66, 0.45>)
    translate <-6, 0, 6>
  }
  difference {
    cylinder { <0, 50, 0>, <0, 59, 0>, 4.2 }
    cylinder { <0, 51, 0>, <0, 60, 0>, 3.8 }
    Matt(<0.85, 0.82, 0.75>) translate <15, 0, 4>
  }
  torus { 2.8, 0.6 rotate 90*x translate <19.6, 54.5, 4> Matt(<0.85, 0.82, 0.75>) }
}

// Leaves, each a bent sheet on a stem, turned by the golden angle.
#declare Leaf = intersection {
  sphere { 0, 1 scale <15, 15, 15> translate <0, -10, 0> }
  sphere { 0, 1 scale <15, 15, 15> translate <0, -10, 0> inverse translate -0.25*y }
  cylinder { -20*y, 20*y, 1 scale <11, 1, 4.6> }
}
#declare Plant = union {
  difference {
    cone { 0, 12, 26*y, 16 } cone { 20*y, 13, 26.1*y, 15 }
    Matt(<0.80, 0.76, 0.70>)
  }
  cylinder { 20*y, 22*y, 14 Matt(0.05) }
  #for (I, 0, 21)
    #local Up = 32 + 3.6*I;
    #local Out = 26 - 0.75*I;
    union {
      object {
        Leaf translate 11*x rotate (-38 + 4.2*I)*z translate <Out - 8, Up + 14, 0>
        Matt(<0.10 + 0.004*I, 0.26 + 0.007*I, 0.07>)
      }
      union {
        cylinder { <2, 20, 0>, <Out/3, Up - 4, 0>, 0.5 }
        sphere { <Out/3, Up - 4, 0>, 0.5 }
        cylinder { <Out/3, Up - 4, 0>, <Out - 8, Up + 14, 0>, 0.5 }
        Matt(<0.16, 0.26, 0.07>)
      }
      rotate 137.5*I*y
    }
  #end
}

// A picture in its frame, on the wall.
#macro Framed(Wide, High, Picture)
  union {
    difference {
      box { <-Wide/2, -High/2, -2.5>, <Wide/2, High/2, 0> }
      box { <-Wide/2 + 1.6, -High/2 + 1.6, -3>, <Wide/2 - 1.6, High/2 - 1.6, 1> }
      Matt(0.04)
    }
    box { <-Wide/2 + 1, -High/2 + 1, -0.8>, <Wide/2 - 1, High/2 - 1, 0> Matt(0.82) }
    box { <-Wide/2 + 7, -High/2 + 7, -0.81>, <Wide/2 - 7, High/2 - 7, 0> pigment { Picture } }
  }
#end
#declare Hills = pigment {
  gradient y scale 60 translate -30*y
  warp { turbulence <0, 0.25, 0> octaves 3 }
  color_map {
    [0.30 rgb <0.15, 0.10, 0.12>] [0.30 rgb <0.42, 0.16, 0.10>] [0.45 rgb <0.60, 0.26, 0.12>]
    [0.45 rgb <0.80, 0.50, 0.22>] [0.60 rgb <0.85, 0.62, 0.35>] [0.60 rgb <0.85, 0.78, 0.60>]
  }
}
#declare Sun = pigment {
  cylindrical rotate 90*x scale 9.5 translate 4*y
  color_map { [0.02 rgb <0.84, 0.80, 0.70>] [0.02 rgb <0.62, 0.18, 0.10>] }
}
#declare Rug = cylinder {
  0, y, 90
  pigment {
    cylindrical scale 90
    color_map {
      [0.10 rgb <0.62, 0.57, 0.48>] [0.10 rgb <0.32, 0.10, 0.08>]
      [0.18 rgb <0.32, 0.10, 0.08>] [0.18 rgb <0.62, 0.57, 0.48>]
    }
  }
  normal { bumps 0.4 scale 0.8 }
}

union {
  object { Floor }
  object { Walls }
  object { Skirting }
  object { Tripod }
  object { Rug translate <120, 0, -10> }
  object { Chair rotate -32*y translate <132, 0, 28> }
  union { object { Table } object { Things } translate <60, 0, 8> }
  object { Plant translate <222, 0, 62> }
  object { Framed(52, 66, Hills) translate <92, 142, 95> }
  object { Framed(38, 46, Sun) translate <150, 150, 95> }
  transform { Frame }
}

camera {
  location Eye right 1.6*x up y angle 65 look_at <98, 80, 40>
  transform { Frame }
}
