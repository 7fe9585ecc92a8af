// A receiver, and how it shows its light: shade.c for each pixel.

uniform vec3 from;   // the camera
uniform vec3 shift;  // from the mesh's origin to the receivers'
uniform float near;
uniform vec3 diffuse, specular, emission;
uniform float shininess;  // 0: no highlight
uniform bool textured;
uniform sampler2D picture;

in vec3 point, normal;
flat in vec3 geometric;
in vec2 uv;

layout(location = 0) out vec4 position_out;
layout(location = 1) out vec4 normal_out;
layout(location = 2) out vec4 lift_out;
layout(location = 3) out vec4 eye_out;
layout(location = 4) out vec4 diffuse_out;
layout(location = 5) out vec4 specular_out;
layout(location = 6) out vec4 shows_out;

vec3 turned_towards(vec3 eye, vec3 n) {
  return dot(eye, n) < 0 ? -n : n;
}

void main() {
  vec3 eye = normalize(from - point);
  vec3 shows = textured ? diffuse*texture(picture, vec2(uv.x, 1 - uv.y)).rgb : diffuse;
  bool lit = shows != vec3(0) || shininess > 0;
  float size = length(normal);  // opposite normals may cancel out
  gl_FragDepth = near*gl_FragCoord.w;
  position_out = vec4(point + shift, lit ? shininess : -1);
  normal_out = vec4(turned_towards(eye, size > 0 ? normal/size : geometric), 0);
  lift_out = vec4(turned_towards(eye, geometric), 0);
  eye_out = vec4(eye, 0);
  diffuse_out = vec4(shows, 0);
  specular_out = vec4(specular, 0);
  shows_out = vec4(emission, 1);
}
