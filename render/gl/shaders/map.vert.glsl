// A shadow map: the mesh as seen from a point of the aperture, through the window.

uniform vec3 center;      // of the page
uniform mat3 frame;       // its columns are u', v' and n
uniform vec2 at, kappa;   // the point; 1/distance of the st plane
uniform vec4 map_window;  // s0, t0, 1/(s1 - s0), 1/(t1 - t0)

layout(location = 0) in vec3 corner;

void main() {
  vec3 p = (corner - center)*frame;
  vec2 st = p.xy - at + p.z*(kappa*at - map_window.xy);
  // Without near and far plane: depth is written by the fragments.
  gl_Position = vec4(2*st*map_window.zw - p.z, 0, p.z);
}
