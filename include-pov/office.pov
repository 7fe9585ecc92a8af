// Persistence of Vision Ray Tracer Scene File
// File:   office.pov
// Desc:   an office by night under the paper's lamp, as in figure 6 of "Canned Lightsources":
//         table, chair, shelf and things on them. Centimetres; y is up, z away from the viewer.
// Usage:  povray +Ioffice.pov +FE -A               with parabolic_small.inc, 35 cm wide here
//         povray ... Declare=Large=1               with parabolic_large.inc, twice as wide
//         povray ... Declare=Write_Mesh=1 +W1 +H1  writes the mesh office.obj, without a lamp
// Licence: CC0
#version 3.7;
#include "office_shapes.inc"
global_settings { assumed_gamma 1 }
#default { finish { ambient 0 } }

Office_Camera(<-75, 175, -240>, <0, 76, 50>, 48, 4/3)

// The lamp is out of sight, on the right, and shines down at the chair, the table and the wall.
#declare Lamp_Size = 2.5;
#declare Lamp_Place = transform { rotate -45*x rotate -35*y translate <105, 205, -95> };
Office_Light(Lamp_Place, Lamp_Size)
#ifndef (Write_Mesh)
  #ifdef (Large)
    #include "parabolic_large.inc"
    object { Parabolic_Large_Canned(Lamp_Size, 1) transform { Lamp_Place } }
  #else
    #include "parabolic_small.inc"
    object { Parabolic_Small_Canned(Lamp_Size, 1) transform { Lamp_Place } }
  #end
#end

// ---- The room
Office_Paint("carpet", <0.45, 0.47, 0.52>)
Office_Box(<-260, -2, -320>, <260, 0, 170>)
Office_Paint("wall", <0.80, 0.77, 0.70>)
Office_Box(<-260, 0, 170>, <260, 280, 174>)
Office_Box(<-200, 0, -320>, <-196, 280, 170>)

// ---- The table, and what lies on it
#declare Office_Place = transform { translate <-20, 0, 70> };
Office_Paint("oak", <0.66, 0.45, 0.25>)
Office_Box(<-85, 71, -38>, <85, 75, 38>)
#for (Side, -1, 1, 2)
  Office_Box(<Side*80 - 3, 0, -34>, <Side*80 + 3, 71, -28>)
  Office_Box(<Side*80 - 3, 0, 28>, <Side*80 + 3, 71, 34>)
#end
Office_Paint("paper", <0.85, 0.85, 0.82>)
Office_Box(<-12, 75, -28>, <9, 75.4, 2>)
Office_Paint("globe", <0.30, 0.45, 0.70>)
Office_Ball(<-58, 99, 8>, 15)
Office_Paint("brass", <0.70, 0.55, 0.20>)
Office_Rod(<-58, 75, 8>, <-58, 77, 8>, 10)
Office_Rod(<-58, 77, 8>, <-58, 85, 8>, 1.5)
Office_Paint("mug", <0.75, 0.20, 0.15>)
Office_Rod(<30, 75, -16>, <30, 85, -16>, 4.5)
Office_Paint("pens", <0.20, 0.35, 0.25>)
Office_Rod(<52, 75, 12>, <52, 86, 12>, 5)
Office_Rod(<50, 85, 12>, <47, 97, 10>, 0.6)
Office_Rod(<53, 85, 13>, <56, 98, 16>, 0.6)
Office_Rod(<53, 85, 10>, <52, 96, 6>, 0.6)

// ---- The chair, a little turned away
#declare Office_Place = transform { rotate -20*y translate <10, 0, -15> };
Office_Paint("chair", <0.35, 0.22, 0.15>)
Office_Box(<-23, 44, -22>, <23, 48, 22>)
#for (Side, -1, 1, 2)
  Office_Box(<Side*20 - 2, 0, 17>, <Side*20 + 2, 44, 21>)
  Office_Box(<Side*20 - 2, 0, -22>, <Side*20 + 2, 96, -18>)
#end
Office_Box(<-22, 92, -22>, <22, 98, -18>)
#for (Slat, -2, 2) Office_Box(<7*Slat - 1.2, 48, -21>, <7*Slat + 1.2, 92, -19>) #end

// ---- The shelf on the wall, with books and a vase
#declare Office_Place = transform { translate <-25, -6, 170> };
Office_Paint("shelf", <0.60, 0.60, 0.58>)
#for (Board, 0, 1) Office_Box(<-70, 128 + 42*Board, -26>, <70, 131 + 42*Board, 0>) #end
#for (Side, -1, 1, 2) Office_Box(<Side*69 - 1.5, 131, -24>, <Side*69 + 1.5, 170, 0>) #end
#declare Books = array[9] { 24, 27, 22, 29, 25, 30, 23, 26, 21 };
#for (Book, 0, 8)
  Office_Paint(concat("book", str(Book, 0, 0)), <0.35 + 0.4*mod(Book, 2), 0.25 + 0.2*mod(Book, 3), 0.3 + 0.1*mod(Book, 4)>)
  Office_Box(<-60 + 6*Book, 131, -22>, <-54.6 + 6*Book, 131 + Books[Book], -4>)
#end
Office_Paint("vase", <0.55, 0.70, 0.65>)
Office_Ball(<38, 141, -13>, 10)
Office_Rod(<38, 149, -13>, <38, 160, -13>, 3)
Office_Paint("box", <0.75, 0.60, 0.35>)
Office_Box(<-50, 173, -22>, <-15, 190, -3>)
Office_Ball(<20, 180, -13>, 7)
