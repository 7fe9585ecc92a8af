// The radiance of a pixel: shade_radiance of shade.c, or that of a lamp in front of it.

uniform sampler2D position, diffuse, specular, shows, irradiance, gloss, lamps;
uniform vec3 from;    // the camera
uniform float scale;  // of irradiance and gloss

layout(location = 0) out vec4 radiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 shown = texelFetch(shows, pixel, 0);
  vec4 lamp = texelFetch(lamps, ivec2(pixel.x, textureSize(lamps, 0).y - 1 - pixel.y), 0);
  vec3 light = texelFetch(diffuse, pixel, 0).rgb*texelFetch(irradiance, pixel, 0).rgb +
               texelFetch(specular, pixel, 0).rgb*texelFetch(gloss, pixel, 0).rgb;
  bool seen = lamp.w > 0 &&
              (shown.w == 0 || lamp.w < distance(texelFetch(position, pixel, 0).xyz, from));
  radiance = vec4(seen ? lamp.rgb : shown.rgb + scale*light, 1);
}
