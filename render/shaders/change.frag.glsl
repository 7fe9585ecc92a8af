// Squares of the picture and of its change, at some of its pixels.

uniform sampler2D radiance, before;
uniform vec2 step;  // from one of them to the next

layout(location = 0) out vec2 squares;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy*step);
  vec3 now = texelFetch(radiance, pixel, 0).rgb;
  vec3 change = now - texelFetch(before, pixel, 0).rgb;
  squares = vec2(dot(now, now), dot(change, change));
}
