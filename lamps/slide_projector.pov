// A slide projector: a lit slide (24 x 36 mm, a landscape) behind a real lens of f = 100 mm,
// f/2.5, which throws a picture 68 cm wide onto a screen at 2 m; elsewhere it is out of focus.
// The lens is a single one, with a single one's faults: soft corners, a curved image.
// Centimetres; the lens is at the origin, shining along +z; radiance in W/(sr m2).
// It calls for nothing: all inside is black. Rays go through the lens to the slide and find
// its colours there; no light source is needed at all.
// Its st plane is where the picture is sharp, so that st alone decides how sharp.
// Bake: bakeslab bake slide_projector.pov -o slide_projector.tif --uv 8x8 --st 192x128
// Use: object { Slide_Projector_Canned(1, 1) translate 80*y }
// Licence: CC0
#version 3.7;
#include "canned.inc"

#declare Screen = 200;                         // from the lens
#declare Focal = 10;                           // of the lens
#declare Glass = 1.5;                          // its refractive index
#declare Curve = 2*(Glass - 1)*Focal;          // radius of its surfaces
#declare Aperture = 2;                         // its radius
#declare Front = 1;                            // where the slab is
// Where the slide is sharp: by the lens equation, less 1 % for the lens's own blur.
#declare Back = 0.99/(1/Focal - 1/Screen);

Canned_Lamp("slide_projector")
Canned_Metres_Per_Unit(0.01)
Canned_Radiance_Unit("W/(sr m2)")
Canned_Needs("")
Canned_Slab(Front*z, 4.5*x, 4.5*y, z, <-0.19, 0.19, -0.13, 0.13>, Screen - Front)

// The lens, in a black tube.
#declare Sag = Curve - sqrt(Curve*Curve - 2.2*2.2);
intersection {
  sphere { (Curve - Sag)*z, Curve }
  sphere { (Sag - Curve)*z, Curve }
  pigment { rgbf 1 } finish { diffuse 0 }
  interior { ior Glass }
}
#declare Black = texture { pigment { rgb 0.01 } finish { diffuse 1 } }
cylinder { -4*z, (Front - 0.01)*z, 2.3 open texture { Black } }
difference {
  cylinder { 0.4*z, 0.5*z, 2.3 }
  cylinder { 0, z, Aperture }
  texture { Black }
}

// The slide, upside down, lit evenly from behind. One layer in front of the other.
#macro Layer(Colour)
  pigment { rgb 1 } finish { emission rgb 100*Colour diffuse 0 }
#end
union {
  box {
    <-1.8, -1.2, -0.001>, <1.8, 1.2, 0>
    pigment { gradient y color_map { [0 rgb <1, 0.75, 0.45>] [1 rgb <0.15, 0.35, 0.9>] } scale 2.4 translate -1.2*y }
    finish { emission 100 diffuse 0 }
  }
  disc { <0.75, 0.55, 0.01>, z, 0.28 Layer(<1, 0.95, 0.6>) }
  intersection {
    union {
      disc { <-1.1, -1.9, 0.02>, z, 1.5 Layer(<0.1, 0.25, 0.3>) }
      disc { <1.3, -2.4, 0.03>, z, 2 Layer(<0.08, 0.35, 0.12>) }
      box { <-1.8, -1.2, 0.039>, <1.8, -0.8, 0.04> Layer(<0.12, 0.45, 0.1>) }
      box { <-0.9, -0.9, 0.049>, <-0.2, -0.4, 0.05> Layer(<0.9, 0.85, 0.75>) }
      triangle { <-1, -0.4, 0.05>, <-0.1, -0.4, 0.05>, <-0.55, -0.05, 0.05> Layer(<0.7, 0.12, 0.05>) }
      box { <-0.7, -0.75, 0.059>, <-0.5, -0.55, 0.06> Layer(<0.15, 0.2, 0.3>) }
    }
    box { <-1.8, -1.2, -1>, <1.8, 1.2, 1> }
  }
  rotate 180*z
  translate -Back*z
}
// All round it is black, and closed: light leaves through the tube alone.
difference {
  box { <-5, -5, -13>, <5, 5, -4> }
  box { <-4.9, -4.9, -12.9>, <4.9, 4.9, -4.1> }
  cylinder { -5*z, -3*z, 2.3 }
  texture { Black }
}

// What is seen of the projector from outside; scenes get it as Slide_Projector_Canned_Housing().
#declare Canned_Housing = union {
  difference {
    box { <-8, -6, -30>, <16, 7, -3> }
    cylinder { <0, 0, -13>, <0, 0, 0>, 2.6 }
    pigment { rgb <0.35, 0.36, 0.4> }
  }
  difference {
    cylinder { <0, 0, -4>, <0, 0, 0.9>, 2.9 }
    cylinder { <0, 0, -13>, <0, 0, 1>, 2.4 }
    pigment { rgb 0.08 }
  }
  cylinder { <2, 11, -20>, <2, 13, -20>, 9 pigment { rgb 0.1 } }
  cylinder { <2, 7, -20>, <2, 11, -20>, 3 pigment { rgb 0.1 } }
  box { <-5, -7, -26>, <-2, -6, -7> pigment { rgb 0.05 } }
  box { <10, -7, -26>, <13, -6, -7> pigment { rgb 0.05 } }
  finish { diffuse 1 }
}

// For previews only: the bake brings its own cameras. The eye is behind dark glass.
#ifndef (Canned_Bake_Effects)
  object { Canned_Housing }
  light_source { <-100, 150, 200> rgb 110 shadowless }
#end
#declare Eye = <-9, 6, 70>;
camera { location Eye look_at <3, 2, 0> angle 34 }
sphere { Eye, 0.2 pigment { rgb 0.01 filter 1 } finish { diffuse 0 } no_shadow }
