// Persistence of Vision Ray Tracer Scene File
// File:   headlights.pov
// Desc:   an avenue of birches by the dipped beams of a car, as its driver sees it: the light ends
//         at the height of the lamps, and climbs to the right. The patches on the road are the
//         lamps' own: each facet of their mirrors throws a picture of the filament. Centimetres;
//         the lamps are at z = 0, shining along z, and the road is y = 0.
// Usage:  povray +Iheadlights.pov, where headlight.inc is (`make gallery`)
// Licence: CC0
#version 3.7;
#include "gallery.inc"

#declare Headlight_Lights = 4;                 // all it lights is far away
#include "headlight.inc"
#declare Gain = 380*<1, 0.97, 0.90>;
#for (Side, -1, 1, 2)
  object { Headlight_Canned(1, Gain) translate <Side*62, 66, 0> }
#end

#declare Dice = seed(12);
#macro Between(A, B) (A + (B - A)*rand(Dice)) #end

// The road is 6 m wide; the car keeps to its right half. Old asphalt, patched.
#declare Middle = -160;                        // x of its middle
#declare Half = 310;
#declare Asphalt = pigment {
  bozo scale <90, 1, 400> turbulence 0.5
  pigment_map {
    [0.35 granite scale 5 color_map { [0 rgb 0.13] [0.5 rgb 0.16] [1 rgb 0.20] }]
    [0.65 granite scale 5 color_map { [0 rgb 0.16] [0.5 rgb 0.20] [1 rgb 0.25] }]
  }
}
box {
  <Middle - Half, -20, -600>, <Middle + Half, 0, 30000>
  pigment { Asphalt }
}
// Its lines: worn paint.
#macro Line(X, From, Long)
  box {
    <X - 6, -1, From>, <X + 6, 0.3, From + Long>
    pigment { granite scale 30 color_map { [0.30 rgb 0.45] [0.45 rgb 0.72] } }
  }
#end
union {
  Line(Middle - Half + 20, -600, 30600)
  Line(Middle + Half - 20, -600, 30600)
  #for (I, 0, 40) Line(Middle, -300 + 900*I, 350) #end
}

// Verges: grass and fallen leaves.
#declare Verge = pigment {
  bozo scale 60 turbulence 0.7
  color_map {
    [0.2 rgb <0.10, 0.13, 0.04>] [0.5 rgb <0.17, 0.19, 0.06>] [0.7 rgb <0.25, 0.17, 0.06>]
  }
}
box { <-9000, -30, -600>, <Middle - Half, -2, 30000> pigment { Verge } normal { bumps 0.8 scale 9 } }
box { <Middle + Half, -30, -600>, <9000, -2, 30000> pigment { Verge } normal { bumps 0.8 scale 9 } }
#declare Blades = mesh {
  #for (I, 0, 240)
    #local A = 2*pi*rand(Dice);
    #local P = Between(0, 55)*<cos(7*I), 0, sin(7*I)>;
    #local Tip = P + <cos(A), 0, sin(A)>*Between(3, 16) + y*Between(14, 38);
    triangle { P - 1.1*<sin(A), 0, -cos(A)>, P + 1.1*<sin(A), 0, -cos(A)>, Tip }
  #end
}
union {
  #for (I, 0, 170)
    #local Z = 220 + 42*I + Between(0, 40);
    #for (Side, -1, 1, 2)
      object {
        Blades rotate Between(0, 360)*y scale <1, Between(0.5, 1.2), 1>
        translate <Middle + Side*(Half + Between(50, 170)), -3, Z>
        Matt(<0.15, 0.19, 0.05> + Between(0, 0.12)*<1, 0.75, 0.2>)
      }
    #end
  #end
  #for (I, 0, 420)
    disc {
      0, y, Between(2.5, 6)
      scale <1, 1, 1.6> rotate <Between(-25, 25), Between(0, 360), Between(-25, 25)>
      translate <Middle + select(Between(-1, 1), -1, 1)*(Half - 60 + 330*pow(rand(Dice), 0.7)), 2.5, 250 + 3200*pow(rand(Dice), 1.5)>
      Matt(<0.55, 0.33, 0.06> - Between(0, 0.25)*<0.4, 1, 0.2>)
    }
  #end
}

// Birches: white bark with dark scars, and boughs that the light does not reach.
#declare Bark = pigment {
  bozo scale <7, 2.2, 7> turbulence 0.35
  pigment_map {
    [0.62 bozo scale <30, 90, 30> color_map { [0.3 rgb <0.80, 0.77, 0.70>] [0.8 rgb <0.62, 0.56, 0.47>] }]
    [0.66 rgb <0.10, 0.08, 0.07>]
  }
}
#macro Birch(Thick)
  union {
    cone { -20*y, 1.35*Thick, 60*y, Thick }
    #local Lean = <Between(-14, 14), 0, Between(-14, 14)>;
    #local From = <0, 60, 0>;
    #for (K, 1, 6)
      #local To = <0, 60 + 170*K, 0> + K*Lean + <Between(-6, 6), 0, Between(-6, 6)>;
      cone { From, Thick*(1 - (K - 1)*0.12), To, Thick*(1 - K*0.12) }
      sphere { To, Thick*(1 - K*0.12) }
      #if (K > 1)
        #for (N, 0, 3)
          #local Up = To + vrotate(<Between(90, 190), Between(40, 150), 0>, Between(0, 360)*y);
          cone { To - N*22*y, Thick*0.3, Up, 0.8 }
          #for (M, 0, 3)
            cone { To + (Up - To)*(0.45 + 0.16*M), 1.2, Up + <Between(-60, 60), Between(-70, 30), Between(-60, 60)>, 0.4 }
          #end
        #end
      #end
      #local From = To;
    #end
    pigment { Bark translate Between(0, 900) }
  }
#end
union {
  #for (I, 0, 15)
    #for (Side, -1, 1, 2)
      object {
        Birch(Between(13, 19)) rotate Between(0, 360)*y
        translate <Middle + Side*(Half + Between(170, 240)), 0, 620 + 560*I + Between(-90, 90)>
      }
    #end
  #end
  // The wood behind them.
  #for (I, 0, 90)
    #local Side = select(Between(-1, 1), -1, 1);
    #local Z = 700 + 9000*rand(Dice);
    cone {
      <0, -20, 0>, Between(14, 30), <Between(-40, 40), 1400, 0>, 6
      translate <Middle + Side*(Half + Between(420, 1900)), 0, Z>
      Matt(<0.13, 0.105, 0.08>)
    }
  #end
}

// Posts with reflectors, which shine back at the car.
#for (I, 0, 5)
  #for (Side, -1, 1, 2)
    union {
      box { <-6, 0, -4>, <6, 100, 4> Matt(0.75) }
      box { <-6.1, 68, -4.1>, <6.1, 92, 4.1> Matt(0.03) }
      box { <-2.5, 72, -4.6>, <2.5, 88, -4> Matt((Side < 0 ? 1 : 0)*<1.6, 1.6, 1.5> + (Side > 0 ? 1 : 0)*<2.4, 1.1, 0.25>) }
      translate <Middle + Side*(Half + 55), 0, 900 + 1500*I>
    }
  #end
#end

// The moonless night.
sky_sphere {
  pigment {
    gradient y
    color_map { [0 rgb <0.022, 0.034, 0.060>] [0.12 rgb <0.010, 0.017, 0.036>] [0.6 rgb <0.003, 0.005, 0.013>] }
  }
  pigment {
    bozo scale 0.0024
    color_map { [0.86 rgbt 1] [0.94 rgb 0.2] }
  }
}
light_source { <2000, 9000, 3000> rgb <0.012, 0.018, 0.03> parallel point_at <0, 0, 8000> shadowless }

// The car's own bonnet.
superellipsoid {
  <0.35, 0.5> scale <92, 16, 70> rotate -4*x translate <0, 73, -112>
  Matt(<0.01, 0.012, 0.02>)
}

camera { location <-36, 138, -265> right 1.6*x up y angle 58 look_at <-70, 112, 900> }
