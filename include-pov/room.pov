// room.pov - a room for the canned desk lamp of README.md's tutorial, in centimetres: a floor and
// three walls, and on a table a ball and a box. room.obj is the same room as a mesh.
// Use: povray room.pov, where desk_lamp.inc and desk_lamp.exr are
// Licence: CC0
#version 3.7;
#include "desk_lamp.inc"
global_settings { assumed_gamma 1 }
camera { location <-60, 140, -290> right 4/3*x look_at <0, 80, 0> angle 50 }

object { Desk_Lamp_Canned(1, 5) translate <0, 190, 20> }   // Scale, Gain

#macro Matt(Colour)
  texture { pigment { rgb Colour } finish { diffuse 1 ambient 0 } }
#end

polygon { 4, <-150, 0, -150>, <150, 0, -150>, <150, 0, 120>, <-150, 0, 120> Matt(<0.7, 0.65, 0.6>) }
polygon { 4, <-150, 0, 120>, <150, 0, 120>, <150, 220, 120>, <-150, 220, 120> Matt(<0.8, 0.8, 0.75>) }
polygon { 4, <-150, 0, -150>, <-150, 0, 120>, <-150, 220, 120>, <-150, 220, -150> Matt(<0.75, 0.35, 0.25>) }
polygon { 4, <150, 0, -150>, <150, 0, 120>, <150, 220, 120>, <150, 220, -150> Matt(<0.35, 0.45, 0.7>) }

union {
  box { <-70, 70, -40>, <70, 74, 40> }
  #for (X, -66, 60, 126)
    #for (Z, -36, 30, 66)
      box { <X, 0, Z>, <X + 6, 70, Z + 6> }
    #end
  #end
  Matt(<0.7, 0.5, 0.3>)
}
box { <-48, 74, -14>, <-22, 84, 14> Matt(<0.3, 0.55, 0.4>) }
sphere { <24, 86, -6>, 12 Matt(<0.9, 0.85, 0.8>) }
