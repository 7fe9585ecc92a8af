// A torch: a light-emitting diode in an aluminium tube, and a thick plano-convex lens, whose
// spherical faults make the bright rings that torches throw. Millimetres; it shines along +z
// from its front rim at z = 0; radiance in W/(sr m2).
// It calls for caustics: the rim in front of the lens gets its light through the lens alone, by
// photons; without them POV-Ray lights it as if the lens did not bend light. What is seen
// through the lens needs none: rays find the diode themselves. Behind the lens the tube is
// black, so that there is no interreflection to speak of.
// The st plane is 1 m away, where the spot is looked at. The rim's faint light goes on beyond
// the window, 2 % of all, of which the bake warns. 24 x 24 positions leave no grid on things near by.
// Bake: bakeslab bake torch.pov -o torch.tif --uv 24x24 --st 80x80 --rays 6
// Use: object { Torch_Canned(1, 1) } object { Torch_Canned_Housing() }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Radius = 14;                          // of the lens
#declare Curve = 17;                           // radius of its round side
#declare Thickness = 8;
#declare Flat = -13;                           // its flat side
#declare Diode = -28;                          // the diode

Canned_Lamp("torch")
Canned_Metres_Per_Unit(0.001)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("caustics")
Canned_Slab(<0, 0, 0>, 30*x, 30*y, z, <-0.8, 0.8, -0.8, 0.8>, 1000)
Canned_Bulb(<0, 0, Diode + 0.3>, 1.2, 12000*<0.95, 1, 1.05>)

intersection {
  sphere { (Flat + Thickness - Curve)*z, Curve }
  plane { -z, -Flat }
  cylinder { (Flat - 1)*z, z, Radius }
  pigment { rgbf 1 } finish { diffuse 0 }
  interior { ior 1.5 }
  photons { target 2 refraction on reflection on }
}

// The bright rim, the tube, the diode's board, and the ring that holds the lens.
cylinder { Flat*z, -0.01*z, 15 open pigment { rgb 0.3 } finish { diffuse 1 } }
union {
  cylinder { (Diode - 1)*z, Flat*z, 15 open }
  disc { Diode*z, z, 15 }
  difference {
    cylinder { (Flat - 1)*z, Flat*z, 15 }
    cylinder { (Flat - 2)*z, z, Radius - 0.5 }
  }
  pigment { rgb 0.03 } finish { diffuse 1 }
  photons { collect off }
}

// What is seen of the torch from outside; scenes get it as Torch_Canned_Housing().
#declare Canned_Housing = union {
  difference {
    union {
      cylinder { <0, 0, -42>, <0, 0, -0.01>, 17 }
      cone { <0, 0, -56>, 11, <0, 0, -42>, 17 }
      cylinder { <0, 0, -125>, <0, 0, -56>, 11 }
      #local N = 0;
      #while (N < 9)
        cylinder { <0, 0, -118 + 6*N>, <0, 0, -115 + 6*N>, 11.7 }
        #local N = N + 1;
      #end
    }
    cylinder { <0, 0, -30>, <0, 0, 1>, 15.2 }
  }
  cylinder { <0, 11, -66>, <0, 13, -66>, 4 }
  pigment { rgb 0.1 } finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#ifndef (Canned_Bake_Effects)
  object { Canned_Housing }
  light_source { <-300, 400, 300> rgb 200 photons { refraction off reflection off } }
#end
#declare Eye = <-48, 32, 290>;
camera { location Eye look_at <5, 0, -50> angle 20 }
sphere { Eye, 2 pigment { rgb 0.015 filter 1 } finish { diffuse 0 } no_shadow no_radiosity }
