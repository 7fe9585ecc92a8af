// The lamp of parabolic.pov with twice the area of aperture, as for figure 6 of "Canned
// Lightsources": the same bulb, focal length and blockers' height; the bowl is cut at
// another depth, and the grid cuts light off at slope 1.75. Centimetres.
// It calls for what that lamp does: interreflection.
// Finer directions than those of that lamp leave no grid on things near by.
// Bake: bakeslab bake parabolic_large.pov -o parabolic_large.tif --uv 16x16 --st 96x96
// Use: object { Parabolic_Large_Canned(1, 1) }
// Licence: CC0
#version 3.7;

#declare Parabolic_Name = "parabolic_large";
#declare Parabolic_Radius = 14;
#include "parabolic.pov"
