// The lamp of parabolic.pov with half the area of aperture, as for figure 6 of "Canned
// Lightsources": the same bulb, focal length and blockers' height; the bowl is cut at
// another depth, and the grid cuts light off at slope 0.875. Centimetres.
// It calls for what that lamp does: interreflection.
// Bake: bakeslab bake parabolic_small.pov -o parabolic_small.tif --uv 16x16 --st 64x64
// Use: object { Parabolic_Small_Canned(1, 1) }
// Licence: CC0
#version 3.7;

#declare Parabolic_Name = "parabolic_small";
#declare Parabolic_Radius = 7;
#include "parabolic.pov"
