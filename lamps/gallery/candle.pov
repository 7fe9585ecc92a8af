// Persistence of Vision Ray Tracer Scene File
// File:   candle.pov
// Desc:   the shelf's candle tin in a corner: each of its hundred holes throws a blurred picture of
//         the flame. Centimetres; the tin stands at the origin on a slate, since the lamp's
//         pages are a box of 13 x 14 x 13, in which its slab lights nothing.
// Usage:  povray +Icandle.pov, where candle_tin.inc is (`make gallery`)
// Licence: CC0
#version 3.7;
#include "gallery.inc"
Gallery_Radiosity(0.8)

#declare Eye = <-36, 34, -78>;
#declare Candle_Tin_Lights = 8;
#include "candle_tin.inc"
#declare Gain = 200;
#declare Place = transform { rotate 20*y }
object { Candle_Tin_Canned(1, Gain) transform Place }

// The tin's outside, which its own candle does not light. Its holes are finer than the slab's
// positions, so that here they are drawn as in the lamp's script, glowing, instead of its face.
#declare Row = function(y) { floor((y - 3.6)/1.1) }
#declare Along = function(x, y, z) { (atan2(z, x)/(2*pi) + 1)*20 + mod(Row(y), 2)/2 }
#declare Hole = function(x, y, z) {
  sqrt(pow((Along(x, y, z) - floor(Along(x, y, z)) - 0.5)*2*pi*3.8/20, 2)
    + pow(y - 3.6 - (Row(y) + 0.5)*1.1, 2)) - 0.42 + 0.08*abs(Row(y) - 2)
}
union {
  cylinder {
    0.01*y, 11*y, 3.8 open
    texture {
      function { select(Hole(x, y, z), 1, 0)*select(y - 3.6, 0, 1)*select(y - 9.1, 1, 0) }
      texture_map {
        [0.5 Matt(<0.42, 0.40, 0.37>) finish { specular 0.3 roughness 0.03 }]
        [0.5 spherical scale 5 translate 5.6*y texture_map {
          [0.24 Matt(1) finish { diffuse 0 emission rgb <0.9, 0.42, 0.12> }]
          [1.0 Matt(1) finish { diffuse 0 emission rgb <2.6, 1.5, 0.6> }] }]
      }
    }
  }
  union {
    torus { 3.8, 0.14 translate 11*y }
    torus { 3.8, 0.12 translate 0.6*y }
    Matt(<0.42, 0.40, 0.37>) finish { specular 0.3 roughness 0.03 }
  }
  transform { Place }
}
// The glow of its inside, through the open top.
disc { 4*y, y, 3.75 Matt(1) finish { diffuse 0 emission rgb <1.6, 0.8, 0.28> } transform { Place } }

// Slate, on a table of oak.
superellipsoid {
  <0.1, 0.3> rotate 90*x scale <10, 0.45, 10> translate -0.5*y rotate 20*y
  pigment { granite scale 4 color_map { [0 rgb 0.012] [1 rgb 0.022] } }
  normal { granite 0.1 scale 5 }
}
union {
  #for (I, -4, 4)
    Rounded(<-90, -4, 14*I - 6.95>, <90, -0.9, 14*I + 6.95>, 0.25)
  #end
  pigment {
    cells scale <400, 90, 14> translate <-200, -45, -7>
    pigment_map {
      #for (I, 0, 5)
        [I/5 Grain(1.6, (0.85 + 0.06*mod(2*I, 5))*<0.50, 0.33, 0.18>, (0.85 + 0.06*mod(2*I, 5))*<0.34, 0.20, 0.10>) translate <17*I, 3*I, 5*I>]
      #end
    }
  }
  translate 6*z
}

// Two plastered walls.
#declare Plaster = texture {
  pigment { bozo scale 30 turbulence 0.5 color_map { [0 rgb <0.70, 0.60, 0.48>] [1 rgb <0.78, 0.69, 0.57>] } }
  normal { bumps 0.12 scale <2.5, 2.5, 2.5> }
}
plane { -z, -44 texture { Plaster } no_shadow }
plane { -x, -52 texture { Plaster } no_shadow }

// Oranges in a bowl, and two beside it.
#macro Orange(Big)
  sphere {
    0, Big scale <1, 0.94, 1>
    Matt(<0.85, 0.34, 0.03>) normal { bumps 0.25 scale 0.18 } finish { specular 0.25 roughness 0.03 }
  }
#end
union {
  union {
    difference {
      sphere { 0, 13 scale <1, 0.62, 1> translate 8*y }
      sphere { 0, 12.4 scale <1, 0.60, 1> translate 8*y }
      plane { -y, -8 }
      plane { y, 0.4 }
    }
    cylinder { 0, 0.9*y, 5 }
    torus { 12.7, 0.3 translate 8*y }
    Matt(<0.10, 0.22, 0.34>) finish { specular 0.4 roughness 0.015 }
  }
  #for (I, 0, 4) object { Orange(4) rotate 60*I translate vrotate(<6.6, 8, 0>, 72*I*y) } #end
  object { Orange(4.2) translate <0, 12.6, 0> }
  translate <25, -0.9, 18>
}
object { Orange(4) translate <7, 2.8, -20> }
object { Orange(3.8) rotate 50*z translate <17, 2.6, -14> }

// A bottle, and twigs in it.
union {
  lathe {
    cubic_spline 9
    <0, 0>, <4.6, 0>, <5, 1>, <5, 14>, <4.2, 18>, <1.7, 21>, <1.5, 26>, <1.9, 27>, <1.4, 27.5>
    sturm
    Matt(<0.16, 0.24, 0.15>) finish { specular 0.5 roughness 0.01 }
  }
  #declare Dice = seed(3);
  #for (I, 0, 5)
    #local A = 60*I + 30*rand(Dice);
    #local From = <0, 24, 0>;
    #for (K, 1, 4)
      #local To = From + vrotate(<1.4*K + 1.2*rand(Dice), 7.5, 2*rand(Dice) - 1>, A*y);
      cylinder { From, To, 0.32 - 0.05*K Matt(<0.20, 0.12, 0.07>) }
      sphere { To, 0.32 - 0.05*K Matt(<0.20, 0.12, 0.07>) }
      #for (N, 0, 3)
        sphere {
          0, 1 scale <2.2, 0.16, 0.8> translate 2.4*x rotate <0, A + 130*N + 40*K, 35> translate From + (To - From)*(0.25*N + 0.2)
          Matt(<0.13 + 0.05*rand(Dice), 0.24, 0.12>)
        }
      #end
      #local From = To;
    #end
  #end
  translate <-29, -0.9, 22>
}

camera { location Eye right 1.6*x up y angle 52 look_at <5, 15, 8> }
