// The mesh as a camera sees it.

uniform vec3 from;   // the camera
uniform mat3 frame;  // its columns point right, up and along the view
uniform vec2 zoom;   // 1/half the picture's sides at distance 1

layout(location = 0) in vec3 corner;
layout(location = 1) in vec3 corner_normal;
layout(location = 2) in vec3 triangle_normal;
layout(location = 3) in vec2 corner_uv;

out vec3 point, normal;
flat out vec3 geometric;
out vec2 uv;

void main() {
  vec3 p = (corner - from)*frame;
  gl_Position = vec4(p.xy*zoom, 0, p.z);  // as in map.vert.glsl
  point = corner;
  normal = corner_normal;
  geometric = triangle_normal;
  uv = corner_uv;
}
