// Persistence of Vision Ray Tracer Scene File
// File:   street.pov
// Desc:   wet asphalt and fog under three of the shelf's street lamps: the light that they throw
//         along the street stands in the fog as wide cones. Centimetres; the street runs along z.
// Usage:  povray +Istreet.pov, where street_lamp.inc is (`make gallery`)
// Licence: CC0
#version 3.7;
#include "gallery.inc"

#declare Eye = <-150, 150, -420>;
#declare Street_Lamp_Lights = 2;               // all they light is 30 of their widths away
#include "street_lamp.inc"
#declare Gain = 6.5*<1, 0.86, 0.62>;
#declare Image = <Eye.x, -Eye.y, Eye.z>;       // the eye, mirrored in the wet road
#macro Lamp(Turn, X, Z)
  #local Place = transform { rotate Turn*y translate <X, 800, Z> }
  object { Street_Lamp_Canned(1, Gain) transform Place }
  object { Street_Lamp_Canned_Housing() transform { Place } }
  object { Street_Lamp_Canned_Face(1, 0.01*Gain, vinv_transform(Eye, Place)) transform Place no_reflection }
  object { Street_Lamp_Canned_Face(1, 0.01*Gain, vinv_transform(Image, Place)) transform Place no_image }
#end
Lamp(90, 330, 500)
Lamp(-90, -330, 1900)
Lamp(90, 330, 3300)

// Fog, thin enough that what dims it on the lamps' side is not worth its time: without shadow.
box {
  <-1500, 0.5, -700>, <1500, 1100, 6000>
  hollow
  pigment { rgbt 1 }
  interior { media { scattering { 1, 0.00020 } method 3 intervals 1 samples 24 aa_level 2 jitter 0.3 } }
  no_shadow
}
background { rgb <0.010, 0.014, 0.022> }
light_source { <1000, 3000, -2000> rgb <0.020, 0.028, 0.045> parallel point_at 0 shadowless media_interaction off }

// Asphalt with puddles: mirrors where it is low.
#declare Stone = pigment { granite scale 6 color_map { [0 rgb 0.05] [0.5 rgb 0.09] [1 rgb 0.16] } }
plane {
  y, 0
  texture {
    bozo turbulence 0.6 octaves 4 scale <130, 1, 330> translate 30*x
    texture_map {
      [0.44 pigment { Stone } normal { granite 0.18 scale 9 } finish { diffuse 1 reflection { 0.02, 0.30 fresnel } }]
      [0.50 pigment { rgb 0.035 } normal { bumps 0.015 scale <14, 9, 14> } finish { diffuse 1 reflection { 0.05, 0.9 fresnel } }]
    }
  }
  interior { ior 1.33 }
}
// Kerbs and pavements.
#for (Side, -1, 1, 2)
  union {
    box { <365, 0, -700>, <380, 12, 7000> }
    box {
      <380, 0, -700>, <640, 11.5, 7000>
      pigment { brick pigment { rgb 0.05 }, pigment { granite scale 9 color_map { [0 rgb 0.13] [1 rgb 0.20] } } brick_size <45, 60, 45> mortar 1 rotate 0 }
    }
    Matt(0.26)
    finish { diffuse 1 reflection { 0, 0.25 fresnel } }
    interior { ior 1.33 }
    scale <Side, 1, 1>
  }
#end
#for (I, 0, 12) box { <-7, 0, -500 + 520*I>, <7, 0.2, -260 + 520*I> Matt(0.42) } #end

// Fronts with windows, some of them lit.
#declare Dice = seed(5);
#macro Front(Side, Z, Long, High, Colour)
  union {
    difference {
      box { <640, 0, Z>, <900, High, Z + Long> }
      #for (I, 0, floor(Long/170) - 1)
        #for (J, 0, floor((High - 90)/300) - 1)
          box { <639, 110 + 300*J, Z + 50 + 170*I>, <665, 270 + 300*J, Z + 130 + 170*I> }
        #end
      #end
      Matt(Colour)
    }
    #for (I, 0, floor(Long/170) - 1)
      #for (J, 0, floor((High - 90)/300) - 1)
        #local Lit = (rand(Dice) < 0.22 ? 1 : 0);
        box {
          <662, 110 + 300*J, Z + 50 + 170*I>, <664, 270 + 300*J, Z + 130 + 170*I>
          Matt(1) finish { emission rgb Lit*(0.25 + 0.3*rand(Dice))*<1, 0.62, 0.26> diffuse 0.02 reflection 0.06 }
        }
        box { <650, 100 + 300*J, Z + 44 + 170*I>, <636, 110 + 300*J, Z + 136 + 170*I> Matt(0.5) }
        box { <655, 110 + 300*J, Z + 88 + 170*I>, <658, 270 + 300*J, Z + 92 + 170*I> Matt(0.5) }
        box { <655, 205 + 300*J, Z + 50 + 170*I>, <658, 209 + 300*J, Z + 130 + 170*I> Matt(0.5) }
      #end
    #end
    box { <632, High - 18, Z>, <640, High, Z + Long> Matt(0.8*Colour) }
    scale <Side, 1, 1>
  }
#end
#for (I, 0, 7)
  Front(1, -700 + 900*I, 896, 1010 + 300*mod(I*3, 2), <0.45 - 0.04*mod(I, 3), 0.30 + 0.05*mod(I, 2), 0.22 + 0.04*mod(I, 3)>)
  Front(-1, -960 + 900*I, 896, 1310 - 300*mod(I*5, 2), <0.34 + 0.06*mod(I, 3), 0.32, 0.28 + 0.05*mod(I, 2)>)
#end

// Somebody with an umbrella, on the way home.
union {
  union {
    intersection { sphere { 0, 60 scale <1, 0.62, 1> } plane { -y, -6 } translate 172*y }
    #for (I, 0, 7) sphere { vrotate(<58, 177, 0>, 45*I*y), 1.3 } #end
    Matt(<0.42, 0.05, 0.04>)
  }
  cylinder { <0, 112, 0>, <0, 216, 0>, 1 Matt(0.05) }
  cone { <0, 60, 0>, 27, <0, 142, 0>, 17 Matt(<0.09, 0.10, 0.13>) }
  sphere { 0, 20 scale <1.1, 0.5, 0.8> translate 144*y Matt(<0.09, 0.10, 0.13>) }
  cone { <17, 142, 0>, 6.5, <6, 114, 14>, 5 Matt(<0.09, 0.10, 0.13>) }
  cone { <-18, 142, 0>, 6.5, <-24, 86, 2>, 4.6 Matt(<0.09, 0.10, 0.13>) }
  sphere { <0, 163, 0>, 11.5 Matt(<0.12, 0.09, 0.07>) }
  cone { <-8, 64, 0>, 8.5, <-9, 4, 13>, 5 Matt(0.04) }
  cone { <8, 64, 0>, 8.5, <9, 6, -16>, 5 Matt(0.04) }
  superellipsoid { <0.7, 0.7> scale <5.5, 4, 13> translate <-9, 4, 17> Matt(0.03) }
  superellipsoid { <0.7, 0.7> scale <5.5, 4, 13> translate <9, 5, -12> Matt(0.03) }
  translate <30, 0, 620>
}

camera { location Eye right 1.6*x up y angle 68 look_at <60, 330, 1200> }
