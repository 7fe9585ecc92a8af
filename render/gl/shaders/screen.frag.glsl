// The picture on the screen, in sRGB, with words over it.

uniform sampler2D radiance, words;
uniform float white;

layout(location = 0) out vec4 color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 light = clamp(texelFetch(radiance, pixel, 0).rgb/white, 0, 1);
  vec3 srgb = mix(12.92*light, 1.055*pow(light, vec3(1/2.4)) - 0.055, greaterThan(light, vec3(0.0031308)));
  float word = texelFetch(words, ivec2(pixel.x, textureSize(words, 0).y - 1 - pixel.y), 0).r;
  color = vec4(word == 1 ? vec3(1) : word > 0 ? 0.4*srgb : srgb, 1);
}
