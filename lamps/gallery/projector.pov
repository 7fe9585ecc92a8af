// Persistence of Vision Ray Tracer Scene File
// File:   projector.pov
// Desc:   an evening of slides: the shelf's slide projector throws a landscape on a screen, and dust
//         in the air shows its beam, in the slide's colours. Centimetres; the projector's lens is
//         at <0, 104, 0>, the screen 2 m before it.
// Usage:  povray +Iprojector.pov, where slide_projector.inc is (`make gallery`)
// Licence: CC0
#version 3.7;
#include "gallery.inc"
Gallery_Radiosity(0.4)

#declare Eye = <-172, 150, -100>;
#declare Slide_Projector_Lights = 4;
#include "slide_projector.inc"
#declare Gain = 190;
#declare Place = transform { translate 104*y }
object { Slide_Projector_Canned(1, Gain) transform Place }
object { Slide_Projector_Canned_Housing() transform { Place } }

// Dust in the beam alone: elsewhere there is no light to show it. It scatters so little that the
// light is not dimmed, so the dust throws no shadow, and no ray has to look for it.
#macro Flank(X, Y, Near, Far)  // a plane through the lens's rim and the picture's
  plane { vnormalize(<X, Y, -(Far - Near)/197>), vdot(vnormalize(<X, Y, -(Far - Near)/197>), <X*Near, Y*Near, 2>) }
#end
intersection {
  plane { -z, -2 }
  plane { z, 199 }
  Flank(1, 0, 2.4, 36) Flank(-1, 0, 2.4, 36) Flank(0, 1, 2.4, 25) Flank(0, -1, 2.4, 25)
  hollow
  pigment { rgbt 1 }
  interior {
    media {
      scattering { 1, 0.0009 extinction 0 }
      method 2 intervals 1 samples 20 jitter 0
    }
  }
  no_shadow
  no_radiosity
  transform Place
}

// The screen on its tripod.
union {
  box { <-62, 62, 200>, <62, 148, 200.6> Matt(0.9) }
  box { <-66, 58, 200.1>, <66, 152, 200.5> Matt(0.02) }
  cylinder { <-67, 153, 200.4>, <67, 153, 200.4>, 1.6 }
  cylinder { <-67, 55, 200.4>, <67, 55, 200.4>, 3.4 }
  cylinder { <0, 30, 204>, <0, 170, 204>, 1.5 }
  #for (I, 0, 2) cylinder { <0, 50, 204>, <0, 0, 204> + vrotate(55*x, 120*I*y + 30*y), 1.2 } #end
  Matt(0.1)
}

// The room: a parquet, dark walls, a ceiling.
#declare Room = union {
  box {
    <-320, -2, -320>, <240, 0, 330>
    pigment {
      cells scale <14, 40, 90>
      pigment_map {
        #for (I, 0, 5)
          [I/5 Grain(2.5, (0.75 + 0.1*mod(3*I, 6)/2)*<0.40, 0.25, 0.14>, (0.7 + 0.1*mod(3*I, 6)/2)*<0.24, 0.14, 0.07>) rotate 90*y translate 31*I*x]
        #end
      }
    }
    finish { reflection { 0, 0.10 fresnel } } interior { ior 1.4 }
  }
  box { <-330, 0, 330>, <250, 290, 340> Matt(<0.36, 0.42, 0.44>) }
  box { <240, 0, -320>, <250, 290, 330> Matt(<0.36, 0.42, 0.44>) }
  box { <-330, 0, -320>, <-320, 290, 330> Matt(<0.36, 0.42, 0.44>) }
  box { <-330, 0, -330>, <250, 290, -320> Matt(<0.36, 0.42, 0.44>) }
  box { <-330, 270, -330>, <250, 280, 340> Matt(0.7) }
  box { <-320, 0, 328.5>, <240, 9, 330> Matt(0.55) }
  box { <238.5, 0, -320>, <240, 9, 330> Matt(0.55) }
}
object { Room }

// The projector's table.
union {
  Rounded(<-30, 92, -52>, <34, 95.9, 8>, 1)
  #for (X, -24, 28, 52) #for (Z, -46, 2, 48) cone { <X, 92, Z>, 2.2, <1.15*X, 0, Z*1.1>, 1.4 } #end #end
  pigment { Grain(2, <0.45, 0.27, 0.14>, <0.27, 0.15, 0.07>) }
}
union {
  box { <14, 95.9, -4>, <26, 97.1, 6> } box { <14.4, 97.1, -3.4>, <25.4, 98.2, 5.4> }
  Matt(<0.5, 0.42, 0.28>) rotate 3*y
}

// Chairs of bent wood.
#declare Chair = union {
  cylinder { <0, 44, 0>, <0, 46.5, 0>, 20 }
  torus { 19, 1.6 translate 44.5*y }
  #for (Side, -1, 1, 2)
    cone { <Side*14, 44, -13>, 1.8, <Side*17, 0, -17>, 1.3 }
    cylinder { <Side*15, 0, 17>, <Side*16, 46, 16>, 1.5 }
    cylinder { <Side*16, 46, 16>, <Side*15, 78, 22>, 1.5 }
  #end
  torus { 15, 1.5 rotate 90*x clipped_by { plane { -y, 0 } } translate <0, 78, 22> }
  torus { 8.5, 1.2 rotate 90*x clipped_by { plane { -y, 0 } } translate <0, 66, 20.5> }
  cylinder { <-15.4, 55, 18>, <15.4, 55, 18>, 1.2 }
  cylinder { <-8.5, 55, 18>, <-8.5, 66, 20.5>, 1.2 }
  cylinder { <8.5, 55, 18>, <8.5, 66, 20.5>, 1.2 }
  torus { 14, 0.9 translate 22*y }
  Matt(<0.30, 0.15, 0.07>)
  finish { specular 0.2 roughness 0.02 }
  rotate 180*y                                 // it faces the screen
}
object { Chair rotate 4*y translate <-95, 0, 38> }
object { Chair rotate -6*y translate <-92, 0, 112> }
object { Chair rotate 12*y translate <82, 0, 60> }
object { Chair rotate -3*y translate <88, 0, 128> }

// A rubber plant in the corner.
union {
  difference { cone { 0, 17, 34*y, 22 } cone { 30*y, 20, 35*y, 21 } Matt(<0.45, 0.42, 0.38>) }
  cylinder { 30*y, 31*y, 20 Matt(0.03) }
  cone { 30*y, 1.8, 150*y, 0.7 Matt(<0.2, 0.14, 0.08>) }
  #for (I, 0, 17)
    sphere {
      0, 1 scale <17, 1, 7> translate 19*x rotate (30 - 1.2*I)*z rotate 137.5*I*y translate (48 + 6.4*I)*y
      Matt(<0.06, 0.17, 0.07>) finish { specular 0.3 roughness 0.03 }
    }
  #end
  translate <168, 0, 270>
}

// A little of the evening, through a window behind the viewer.
light_source { <-310, 190, -250> rgb <0.050, 0.066, 0.10> media_interaction off }

camera { location Eye right 1.6*x up y angle 54 look_at <-4, 94, 98> }
