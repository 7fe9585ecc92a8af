// Persistence of Vision Ray Tracer Scene File
// File:   desk.pov
// Desc:   a desk at night under the shelf's desk lamp: its shade glows where one looks into it,
//         and shadows are soft close to it. Centimetres; the lamp stands at the origin.
// Usage:  povray +Idesk.pov, where desk_lamp.inc is (`make gallery`)
// Licence: CC0
#version 3.7;
#include "gallery.inc"
Gallery_Radiosity(0.5)

#declare Eye = <70, 24, -84>;
#declare Gain = 1.1*<1, 0.86, 0.68>;
#declare Desk_Lamp_Lights = 8;
#include "desk_lamp.inc"

object { Desk_Lamp_Canned(1, Gain) }
object { Desk_Lamp_Canned_Housing() }
// What is seen in its shade, held back so that it is not all white.
object {
  Desk_Lamp_Canned_Face(1, 0.05*Gain, Eye)
  clipped_by { cylinder { <12.5, 29, 0>, <13.9, 26, 0>, 8 } }
}

// The desk's top is y = 0.
union {
  Rounded(<-75, -3.5, -42>, <95, 0, 34>, 0.8)
  pigment { Grain(1.3, <0.36, 0.20, 0.10>, <0.25, 0.13, 0.06>) }
  finish { specular 0.15 roughness 0.03 reflection { 0, 0.12 fresnel } }
  interior { ior 1.4 }
}

// An open book, its pages curved.
#declare Lines = pigment {
  gradient z scale 1.15
  pigment_map {
    [0.62 rgb 0.86]
    [0.62 cells scale <0.31, 9, 9> color_map { [0.2 rgb 0.86] [0.2 rgb 0.25] [0.9 rgb 0.4] }]
  }
}
#macro Page(Side)
  intersection {
    cylinder { <Side*5.5, -9.1, -11>, <Side*5.5, -9.1, 11>, 11.2 }
    box { <0, 0, -10.5>, <Side*14.5, 3, 10.5> }
    pigment {
      gradient z translate -0.5*z scale 21
      pigment_map {
        [0.06 rgb 0.86] [0.06 gradient x pigment_map {
          [0.1 rgb 0.86] [0.1 Lines scale <1/12.5, 1, 1/21>] [0.9 Lines scale <1/12.5, 1, 1/21>] [0.9 rgb 0.86] }
          scale <Side*14, 1, 1>]
        [0.93 rgb 0.86]
      }
    }
  }
#end
#declare Open_Book = union {
  Page(-1)
  Page(1)
  box { <-15, 0, -11>, <15, 0.25, 11> Matt(<0.4, 0.07, 0.06>) }
}

#declare Pencil = union {
  prism { 0, 15, 6, #for (I, 0, 5) <0.4*cos(I*pi/3), 0.4*sin(I*pi/3)> #if (I < 5) , #end #end Matt(<0.85, 0.52, 0.05>) }
  cone { 15*y, 0.38, 17*y, 0.1 Matt(<0.75, 0.55, 0.35>) }
  cone { 17*y, 0.1, 17.4*y, 0 Matt(0.05) }
  cylinder { -1.4*y, 0, 0.42 Matt(<0.75, 0.4, 0.38>) }
  rotate -90*z translate 0.36*y
}

// A pair of glasses, folded open.
#declare Rim = <0.05, 0.045, 0.04>;
#declare Glasses = union {
  #for (Side, -1, 1, 2)
    torus { 2.5, 0.22 rotate 90*x scale <1.1, 0.9, 1> translate <Side*3.3, 2.4, 0> }
    cylinder { <Side*6, 3.2, 0>, <Side*6.4, 3, 12>, 0.2 }
    cylinder { <Side*6.4, 3, 12>, <Side*6.3, 0.6, 15.5>, 0.22 }
  #end
  torus { 0.85, 0.2 rotate 90*x clipped_by { plane { -y, 0 } } translate 2.9*y }
  Matt(Rim) finish { specular 0.6 roughness 0.01 }
}

#declare Plant = union {
  difference {
    cone { 0, 4.2, 9*y, 5.6 }
    cone { 7.5*y, 4.9, 9.1*y, 5.2 }
    Matt(<0.62, 0.27, 0.16>)
  }
  cylinder { 7*y, 8*y, 5 Matt(0.03) }
  #for (I, 0, 33)
    sphere {
      0, 1 scale <0.55, 2.6 + 0.06*I, 1.3>
      translate (2.2 + 0.06*I)*y rotate -(86 - 2.35*I)*z rotate 137.5*I*y translate <0, 7.6 + 0.08*I, 0>
      Matt(<0.16 + 0.006*I, 0.36 + 0.005*I, 0.2>)
      finish { specular 0.1 roughness 0.05 }
    }
  #end
}

object { Open_Book rotate -14*y translate <31, 0, -6> }
object { Pencil rotate 35*y translate <46, 0, -24> }
object { Glasses rotate 205*y translate <19, 0, -24> }
object { Mug(<0.10, 0.28, 0.34>) rotate -30*y translate <47, 0, 17> }
object { Plant translate <-24, 0, -10> }
union {
  object { Book(24, 3.6, 17, <0.12, 0.19, 0.33>) rotate 4*y translate <-14, 0, 8> }
  object { Book(22, 2.4, 16, <0.62, 0.42, 0.12>) rotate -7*y translate <-12.5, 3.6, 7> }
  object { Book(20, 3, 14.5, <0.45, 0.12, 0.10>) rotate 11*y translate <-13, 6, 11> }
  translate <62, 0, 8>
}

// The wall, and a window on the night.
difference {
  box { <-300, -80, 34>, <300, 250, 50> }
  box { <-70, 22, 33>, <-8, 130, 51> }
  Matt(<0.36, 0.33, 0.30>)
  normal { bumps 0.06 scale 0.7 }
}
union {
  difference {
    box { <-73, 19, 32>, <-5, 133, 36> }
    box { <-69, 23, 31>, <-9, 129, 37> }
  }
  box { <-40.5, 22, 34>, <-37.5, 130, 37> }
  box { <-70, 62, 34>, <-8, 65, 37> }
  Rounded(<-77, 17, 27>, <-1, 19.5, 36>, 0.6)
  Matt(0.72)
}
box {
  <-320, -60, 400>, <40, 330, 401>
  pigment {
    gradient y scale 390 translate -60*y
    color_map { [0 rgb <0.020, 0.035, 0.075>] [0.3 rgb <0.012, 0.026, 0.070>] [1 rgb <0.003, 0.007, 0.028>] }
  }
  finish { emission 1 diffuse 0 }
}
// Houses afar, some of their windows lit.
#declare Dice = seed(7);
union {
  #for (I, 0, 11)
    #local X = -330 + 30*I + 8*rand(Dice);
    #local High = 34 + 62*rand(Dice);
    #local Wide = 20 + 12*rand(Dice);
    box { <X, -60, 380>, <X + Wide, High, 390> Matt(1) finish { diffuse 0 emission rgb <0.003, 0.004, 0.009> } }
    #for (J, 0, 8)
      #for (K, 0, 3)
        #if (rand(Dice) < 0.24)
          box {
            <X + 2 + 5*K, High - 8 - 9*J, 379>, <X + 4.6 + 5*K, High - 4 - 9*J, 380>
            Matt(1) finish { diffuse 0 emission rgb (0.15 + 0.35*rand(Dice))*<1, 0.66, 0.28> }
          }
        #end
      #end
    #end
  #end
}

// Notes and a picture pinned to the wall.
#macro Note(Colour, Turn) box { <-4, -4, -0.08>, <4, 4, 0> Matt(Colour) rotate Turn*z } #end
union {
  object { Note(<0.85, 0.72, 0.25>, 4) translate <24, 41, 34> }
  object { Note(<0.72, 0.82, 0.80>, -3) translate <35, 44, 34> }
  object { Note(<0.85, 0.55, 0.45>, 2) translate <27, 52.5, 34> }
  box { <44, 32, 33.4>, <66, 61, 34> Matt(0.03) }
  box {
    <45.2, 33.2, 33.3>, <64.8, 59.8, 34>
    pigment {
      gradient y scale 27 translate 33*y warp { turbulence <0, 0.10, 0> octaves 3 }
      color_map {
        [0.28 rgb <0.07, 0.13, 0.17>] [0.28 rgb <0.13, 0.27, 0.32>] [0.42 rgb <0.16, 0.33, 0.36>]
        [0.42 rgb <0.30, 0.47, 0.48>] [0.55 rgb <0.42, 0.56, 0.54>] [0.55 rgb <0.80, 0.70, 0.52>] [1 rgb <0.82, 0.76, 0.62>]
      }
    }
  }
}

camera { location Eye right 1.6*x up y angle 47 look_at <19, 19, 2> }
