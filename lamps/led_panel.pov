// A panel of 8 x 8 light-emitting diodes on a white board in a black frame, without a
// diffuser: shadows have 64 edges. Centimetres; it shines down through y = 0, 16 x 16 cm;
// radiance in W/(sr m2), a third of a watt of light.
// It calls for nothing: the diodes' light meets the board at grazing angles, and the frame is
// black. (Of the diodes' domes rays see what is above the board.)
// The diodes shine to all sides, of which `bakeslab check` warns: 7 % of the light is beyond slope
// 4, 76 degrees.
// Bake: bakeslab bake led_panel.pov -o led_panel.tif --uv 32x32 --st 32x32
// Use: object { Led_Panel_Canned(1, 1) translate 60*y }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Side = 16;
#declare Dies = 8;                             // along a side
#declare Pitch = Side/Dies;
#declare Height = 0.8;                         // of the frame, and of the board above y = 0

Canned_Lamp("led_panel")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("")
Canned_Slab(<0, 0, 0>, Side*x, Side*z, -y, <-4, 4, -4, 4>, 0)
#for (I, 1, Dies)
  #for (J, 1, Dies)
    Canned_Bulb(<(I - 0.5)*Pitch - Side/2, Height - 0.05, (J - 0.5)*Pitch - Side/2>, 0.4, 25*<1, 0.95, 0.85>)
  #end
#end

box { <-Side/2, Height, -Side/2>, <Side/2, Height + 0.2, Side/2> pigment { rgb 0.9 } finish { diffuse 1 } }

// The frame: what is seen of the panel from outside; scenes get it as Led_Panel_Canned_Housing().
#declare Canned_Housing = difference {
  box { <-Side/2 - 0.5, 0.01, -Side/2 - 0.5>, <Side/2 + 0.5, Height + 0.6, Side/2 + 0.5> }
  box { <-Side/2, 0, -Side/2>, <Side/2, Height + 0.2, Side/2> }
  pigment { rgb 0.03 } finish { diffuse 1 }
}
object { Canned_Housing }

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#declare Eye = <14, -20, -28>;
camera { location Eye look_at <0, 0, 0> angle 34 }
sphere { Eye, 0.2 pigment { rgb 0.4 filter 1 } finish { diffuse 0 } no_shadow }
