// Squares of an earlier picture and of the change since, at some of the pixels.

uniform sampler2D radiance, earlier;
uniform vec2 step;  // from one of them to the next

layout(location = 0) out vec2 squares;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy*step);
  vec3 now = texelFetch(radiance, pixel, 0).rgb;
  vec3 then = texelFetch(earlier, pixel, 0).rgb, change = now - then;
  squares = vec2(dot(then, then), dot(change, change));
}
