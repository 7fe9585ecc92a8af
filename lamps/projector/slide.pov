// A slide for `bakeslab projector`: letters, stars and stripes on coloured fields, with fine
// detail everywhere, so that it shows where a projection is sharp.
//   povray +Ilamps/projector/slide.pov +Oslide.png +W768 +H512 +A0.1
// Licence: CC0
#version 3.7;
global_settings { assumed_gamma 1 }
camera { orthographic location -10*z right 6*x up 4*y direction z }   // 6 x 4 fields
background { rgb 0.9 }

#declare Lines = array[3] { "CANNED", "LIGHTS", "OURCES" }
#declare Rays = 16;   // of a star

#macro Glow(Colour) pigment { rgb Colour } finish { emission 1 diffuse 0 } #end

// From red over green to blue along x.
#macro Hue(Column)
  #local Angle = 2*pi*Column/7;
  (0.02 + 0.3*pow(0.5 + 0.5*cos(Angle), 2)*x + 0.3*pow(0.5 + 0.5*cos(Angle - 2*pi/3), 2)*y + 0.3*pow(0.5 + 0.5*cos(Angle + 2*pi/3), 2)*z)
#end

#for (Row, 0, 3)
  #for (Column, 0, 5)
    union {
      box { <-0.47, -0.47, 0>, <0.47, 0.47, 0> Glow(Hue(Column)) }
      torus { 0.4, 0.012 rotate 90*x Glow(<1, 1, 1>) }
      #if (Row > 0)
        #local Letter = text { internal 1 substr(Lines[3 - Row], Column + 1, 1) 0.01, 0 };
        object { Letter translate -(min_extent(Letter) + max_extent(Letter))/2 scale 0.75 translate -0.1*z Glow(<1, 1, 1>) }
      #else
        #if (mod(Column, 2))
          #for (N, 0, Rays - 1)
            triangle { <0, 0, -0.1>, <0.36, 0.36*tan(pi/2/Rays), -0.1>, <0.36, -0.36*tan(pi/2/Rays), -0.1> rotate 360*z*N/Rays Glow(<1, 1, 1>) }
          #end
        #else
          #local Count = 2*Column + 3;
          #for (N, 0, Count - 1)
            box { <-0.24 + 0.48*N/(Count - 0.5), -0.24, -0.1>, <-0.24 + 0.48*(N + 0.5)/(Count - 0.5), 0.24, -0.1> Glow(<1, 1, 1>) }
          #end
        #end
      #end
      translate <Column - 2.5, Row - 1.5, 0>
    }
  #end
#end
