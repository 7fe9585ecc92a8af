#version 3.7;
#include "canned.inc"
#declare R = 2; /* a /* nested */ comment */
#declare V = <1, 2, 3>*R ;
#local T = "a \" b"; // line
#if (R > 1) #declare Q = 3; #end
#declare Canned_Housing = union { difference { box { 0, V } sphere { 0, R } } text { ttf "a}.ttf" "b" 1, 0 } }
