// Persistence of Vision Ray Tracer Scene File
// File:   office.pov
// Desc:   an office late in the evening under six of the shelf's fluorescent fixtures: their louvres
//         and tubes are seen in the ceiling, and nothing has a hard shadow. Centimetres.
// Usage:  povray +Ioffice.pov, where fluorescent.inc is (`make gallery`)
// Licence: CC0
#version 3.7;
#include "gallery.inc"
Gallery_Radiosity(0.5)

#declare Eye = <-296, 106, -266>;
#declare Ceiling = 272;
#declare Fluorescent_Lights = 4;               // all they light is far away
#include "fluorescent.inc"
#declare Gain = 4*<1, 0.97, 0.92>;
#for (I, -1, 1)
  #for (J, -1, 1, 2)
    #local Place = transform { rotate 90*y translate <200*I, Ceiling - 1, 110*J> }
    object { Fluorescent_Canned(1, Gain) transform Place }
    object { Fluorescent_Canned_Face(1, 0.5*Gain, vinv_transform(Eye, Place)) transform Place }
    // A steel frame, and behind the face darkness.
    union {
      difference {
        box { <-32, -0.6, -17>, <32, 1, 17> }
        box { <-30, -0.7, -15>, <30, 1.1, 15> }
        Matt(0.75)
      }
      box { <-31, 0.8, -16>, <31, 0.9, 16> Matt(0.3) }
      transform { Place }
    }
  #end
#end

// The room: a carpet, three walls, and a ceiling of tiles.
#declare Wide = 330;                           // half its width
#declare Deep = 280;                           // and half its depth
box {
  <-Wide, -2, -Deep>, <Wide, 0, Deep>
  pigment {
    checker
    pigment { granite scale 3 color_map { [0 rgb <0.16, 0.19, 0.22>] [1 rgb <0.26, 0.29, 0.33>] } },
    pigment { granite scale 3 color_map { [0 rgb <0.19, 0.22, 0.25>] [1 rgb <0.29, 0.33, 0.37>] } }
    scale 50
  }
}
union {
  box { <Wide, 0, -Deep>, <Wide + 10, Ceiling, Deep> Matt(<0.74, 0.73, 0.69>) }
  box { <-Wide - 10, 0, -Deep>, <-Wide, Ceiling, Deep> Matt(<0.74, 0.73, 0.69>) }
  box { <-Wide, 0, -Deep - 10>, <Wide, Ceiling, -Deep> Matt(<0.74, 0.73, 0.69>) }
  // The windows' wall.
  difference {
    box { <-Wide, 0, Deep>, <Wide, Ceiling, Deep + 25> }
    #for (I, -1, 1) box { <210*I - 90, 92, Deep - 1>, <210*I + 90, 236, Deep + 26> } #end
    Matt(<0.30, 0.42, 0.44>)
  }
  #for (I, -1, 1)
    difference {
      box { <210*I - 92, 90, Deep + 12>, <210*I + 92, 238, Deep + 16> }
      box { <210*I - 86, 96, Deep + 11>, <210*I - 3, 232, Deep + 17> }
      box { <210*I + 3, 96, Deep + 11>, <210*I + 86, 232, Deep + 17> }
      Matt(0.7)
    }
    box { <210*I - 94, 88, Deep - 8>, <210*I + 94, 91, Deep + 14> Matt(0.75) }
  #end
  box { <-Wide, 0, Deep - 1.2>, <Wide, 10, Deep> Matt(0.6) }
  box { <Wide - 1.2, 0, -Deep>, <Wide, 10, Deep> Matt(0.6) }
}
box {
  <-Wide, Ceiling, -Deep>, <Wide, Ceiling + 5, Deep>
  pigment {
    brick pigment { rgb 0.55 }, pigment { bozo scale 1.5 color_map { [0 rgb 0.74] [1 rgb 0.82] } }
    brick_size <60, 60, 60> mortar 1.2 rotate 90*x
  }
}

// The town by night: dark fronts, a lit window here and there.
#declare Dice = seed(31);
union {
  #for (I, 0, 16)
    #local X = -900 + 120*I;
    #local High = 120 + 320*rand(Dice);
    box { <X, -900, 1400>, <X + 90 + 30*rand(Dice), High, 1500> Matt(1) finish { diffuse 0 emission rgb <0.010, 0.013, 0.024> } }
    #for (J, 0, 14)
      #for (K, 0, 3)
        #if (rand(Dice) < 0.3)
          box {
            <X + 8 + 21*K, High - 24 - 32*J, 1399>, <X + 20 + 21*K, High - 10 - 32*J, 1400>
            Matt(1) finish { diffuse 0 emission rgb (0.06 + 0.22*rand(Dice))*<1, 0.75, 0.42> }
          }
        #end
      #end
    #end
  #end
  box { <-4000, -900, 1900>, <4000, 1500, 1901> Matt(1) finish { diffuse 0 emission rgb <0.022, 0.034, 0.075> } }
  no_radiosity
}

// A desk with a screen, a keyboard and a chair; one sits at its side towards -z.
#declare Desk = union {
  union {
    Rounded(<-80, 71, -40>, <80, 74, 40>, 0.8)
    pigment { Grain(3, <0.66, 0.50, 0.33>, <0.50, 0.35, 0.21>) }
  }
  union {
    #for (Side, -1, 1, 2)
      box { <Side*72 - 2, 0, -36>, <Side*72 + 2, 71, -32> }
      box { <Side*72 - 2, 0, 32>, <Side*72 + 2, 71, 36> }
      box { <Side*72 - 2, 67, -32>, <Side*72 + 2, 71, 32> }
    #end
    box { <-70, 30, 33>, <70, 66, 34> }
    Matt(0.55)
  }
  union {                                      // drawers
    Rounded(<28, 8, -30>, <66, 68, 30>, 0.6)
    #for (I, 0, 2) box { <38, 22 + 19*I, -31.5>, <56, 23.5 + 19*I, -30> } #end
    Matt(0.72)
  }
}
#macro Monitor(Picture)
  union {
    union {
      Rounded(<-29, 12, -1.5>, <29, 48, 1.5>, 0.6)
      cylinder { <0, 1, 3>, <0, 26, 3>, 2 }
      Rounded(<-12, 0, -6>, <12, 1.2, 10>, 0.5)
      Matt(0.04)
    }
    box { <-27.6, 13.6, -1.56>, <27.6, 46.6, -1.4> pigment { Picture } finish { diffuse 0 emission 0.55 } }
  }
#end
#declare Text = pigment {
  gradient y scale 2.4
  pigment_map {
    [0.5 rgb <0.10, 0.12, 0.16>]
    [0.5 cells scale <3.3, 99, 99> color_map { [0.35 rgb <0.10, 0.12, 0.16>] [0.35 rgb <0.25, 0.55, 0.60>] [0.7 rgb <0.75, 0.6, 0.35>] [1 rgb 0.7] }]
  }
}
#declare Graph = pigment {
  gradient y scale 33 translate 13.6*y warp { turbulence <0, 0.35, 0> octaves 4 lambda 2.4 }
  color_map { [0.45 rgb <0.16, 0.36, 0.62>] [0.45 rgb <0.85, 0.87, 0.9>] [1 rgb <0.9, 0.92, 0.95>] }
}
#declare Keyboard = union {
  object { Rounded(<-21, 0, -7>, <21, 1.6, 7>, 0.4) Matt(0.08) }
  #for (I, 0, 12) #for (J, 0, 3) box { <-19.4 + 3*I, 1.6, -5.6 + 3*J>, <-16.9 + 3*I, 2.1, -3.2 + 3*J> Matt(0.16) } #end #end
}
#macro Chair(Colour)
  union {
    union {
      superellipsoid { <0.4, 0.5> scale <24, 4.5, 23> translate 46*y }
      superellipsoid { <0.4, 0.5> scale <22, 28, 4> rotate -9*x translate <0, 84, -24> }
      pigment { rgb Colour } normal { bumps 0.15 scale 0.6 }
    }
    union {
      cylinder { <0, 8, 0>, <0, 42, 0>, 2.6 }
      box { <-3, 42, -26>, <3, 43.5, 0> }
      box { <-3, 43, -28>, <3, 80, -25> }
      #for (I, 0, 4)
        cone { 9*y, 3, vrotate(<29, 6, 0>, 72*I*y), 1.6 }
        sphere { vrotate(<29, 3, 0>, 72*I*y), 3 }
      #end
      #for (Side, -1, 1, 2)
        Rounded(<Side*27 - 3, 64, -12>, <Side*27 + 3, 67, 12>, 1.2)
        cylinder { <Side*27, 46, -4>, <Side*27, 65, -4>, 1.4 }
        cylinder { <Side*27, 46, -4>, <Side*18, 43, -4>, 1.4 }
      #end
      Matt(0.06)
    }
  }
#end
#macro Place_Of_Work(Picture, Colour, Turn, Away)
  union {
    object { Desk }
    object { Monitor(Picture) rotate 6*y translate <-8, 74, 18> }
    object { Keyboard rotate 3*y translate <-8, 74, -14> }
    object { Chair(Colour) rotate Turn*y translate <-8, 0, -58 - Away> }
  }
#end
#declare Blue = <0.10, 0.20, 0.36>;
#declare Rust = <0.52, 0.18, 0.08>;
union {
  object { Place_Of_Work(Text, Rust, 14, -24) translate <-100, 0, -10> }
  object { Place_Of_Work(Graph, Blue, -14, 4) translate <150, 0, 0> }
  object { Place_Of_Work(Graph, Blue, 30, 26) translate <-140, 0, 190> }
  object { Place_Of_Work(Text, Rust, -20, 2) translate <130, 0, 196> }
}
union {                                        // papers, a mug, folders
  #for (I, 0, 4) box { <0, 0.1*I, 0>, <21, 0.1*I + 0.1, 29.7> Matt(0.82 - 0.03*I) rotate (11*I - 16)*y translate <-172 + 2*I, 74, -40> } #end
  object { Mug(<0.75, 0.20, 0.12>) rotate 120*y translate <-58, 74, -32> }
  object { Book(22, 4, 30, <0.12, 0.30, 0.24>) translate <195, 74, -18> }
  object { Book(21, 3, 28, <0.60, 0.42, 0.10>) rotate 8*y translate <196, 78, -16> }
  object { Mug(0.75) translate <104, 74, -22> }
}

// Shelves along the right wall, with folders.
union {
  #for (I, 0, 4) box { <292, 8 + 38*I, -90>, <Wide, 10 + 38*I, 90> } #end
  #for (I, -1, 1) box { <292, 0, 90*I - 1>, <Wide, 162, 90*I + 1> } #end
  box { <Wide - 1, 0, -90>, <Wide, 162, 90> }
  Matt(0.68)
}
#for (I, 0, 3)
  #for (K, 0, 19)
    #if (mod(I*7 + K*3, 11) > 2)
      #local Hue = mod(I*5 + K*7, 5);
      box {
        <296, 10 + 38*I, -86 + 8.7*K>, <324, 10 + 38*I + 29 + mod(K*5 + I, 3), -86 + 8.7*K + 7.6>
        Matt(select(Hue - 1, 1, 0, 0)*<0.12, 0.22, 0.38> + select(abs(Hue - 1) - 0.5, 1, 0)*<0.60, 0.58, 0.52>
          + select(abs(Hue - 2) - 0.5, 1, 0)*<0.48, 0.13, 0.09> + select(Hue - 2.5, 0, 1)*<0.16, 0.17, 0.17>)
      }
    #end
  #end
#end

// A plant beside the window.
union {
  difference { cone { 0, 16, 36*y, 21 } cone { 33*y, 19, 37*y, 20 } Matt(0.78) }
  cylinder { 32*y, 33*y, 19 Matt(0.04) }
  #for (I, 0, 26)
    union {
      cylinder { 32*y, <12 + 0.5*I, 56 + 3*I, 0>, 0.7 Matt(<0.14, 0.25, 0.08>) }
      sphere { 0, 1 scale <17, 1, 6> translate 15*x rotate (35 - 2.2*I)*z translate <11 + 0.5*I, 56 + 3*I, 0> Matt(<0.08, 0.25 + 0.004*I, 0.09>) }
      rotate 137.5*I*y
    }
  #end
  translate <284, 0, 236>
}

camera { location Eye right 1.6*x up y angle 66 look_at <42, 128, 60> }
