// Persistence of Vision Ray Tracer Scene File
// File:   demo.pov
// Desc:   a floor, a wall and a ball under the paper's lamp: lit through the canned lamp,
//         or, with Declare=Full_Lamp=1, by the lamp's whole geometry. Centimetres.
// Usage:  see demo.sh
// Licence: CC0
//
// Both pictures show the lamp's light alone: light that floor, wall and ball reflect onto
// each other is kept out. The canned lamp is rendered without radiosity. The full lamp needs
// radiosity, since its reflector lights the room, so there floor and wall have no_radiosity
// (gathering rays do not see them) and the ball, which must still cast its shadow, is black.
#version 3.7;

#ifdef (Full_Lamp)
  #declare Canned_Bake_Effects = "extended_source";
  #include "parabolic.pov"
  global_settings {
    max_trace_level 12
    // One more recursion than in the bake: the first one is from the floor to the lamp.
    radiosity {
      pretrace_start 0.08 pretrace_end 0.01
      count 6400, 64000 error_bound 0.2 nearest_count 10 recursion_limit 3
      low_error_factor 0.7 minimum_reuse 0.01 gray_threshold 0 brightness 1
    }
  }
#else
  global_settings { assumed_gamma 1 }
  #default { finish { ambient 0 } }
  #include "parabolic.inc"
  object { Parabolic_Canned(1, 1) }
#end

#declare Matt = finish { diffuse 1 ambient 0 }

plane { y, -60 pigment { rgb 0.8 } finish { Matt } no_radiosity }
plane { -z, -80 pigment { rgb 0.8 } finish { Matt } no_radiosity }
sphere { <18, -48, 0>, 8 pigment { rgb 0 } finish { Matt } }
cylinder { <-25, -60, 25>, <-25, -35, 25>, 2 pigment { rgb 0 } finish { Matt } }

// All that the lamp lights is in view, so that the pictures' means compare its flux.
camera { location <-30, -8, -150> look_at <0, -60, -10> angle 58 right 2*x }
