// The paper's equation 4, summed over views of one page: each is a slide that is projected
// onto the receivers, times a spotlight's cosine and inverse square, times Phong's highlight.
// GLOSS and SHADOWS are defined where some receiver needs them.

uniform sampler2D position, normal;  // of the receivers; position.w: the exponent of the
                                     // highlight, below 0 where there is no receiver
uniform vec3 center;                 // of the page
uniform mat3 frame;                  // its columns are u', v' and n
uniform vec2 kappa;                  // 1/distance of the st plane
uniform vec4 window;                 // s0, t0, 1/(s1 - s0), 1/(t1 - t0)
uniform vec2 cell;                   // sides of a view's cell, one times the page's gain
uniform sampler2DArray slides;
uniform samplerBuffer views;         // a, b, layer of the slides, map
uniform int first, count;
uniform vec2 share;                  // of the views that counts, from view `first` on

// Nothing becomes infinite: beside a view, slopes and inverse squares have no bounds.
const float steep = 1e18, bright = 1e30, least = 1e-36;

layout(location = 0) out vec4 irradiance;
#ifdef GLOSS
uniform sampler2D eye;
layout(location = 1) out vec4 gloss;
#endif

#ifdef SHADOWS
uniform sampler2D lift;              // the geometric normal
uniform sampler2DArray maps;         // near/z of what is next to the page (map.vert.glsl)
uniform samplerBuffer map_centers;   // a, b of the maps
uniform int first_map;               // the one in layer 0
uniform vec4 map_window;             // as `window`, of the maps
uniform float near;

// Does the map hold something between its centre and p? A texel holds what stands on the ray
// through its middle, so it is compared with the receiver's own plane there, of which 1/z is
// linear in slopes: a plane casts no shadow on itself, however slanted. Neighbouring facets
// may stand out of that plane by about a texel, and rasterised corners are off by 1/256.
bool shadowed(vec3 p, vec3 plane, int map) {
  vec2 at = texelFetch(map_centers, map).xy;
  vec2 size = vec2(textureSize(maps, 0).xy);
  vec2 slope = (p.xy - at)/p.z, texel = 1/(map_window.zw*size);
  vec2 st = (slope + kappa*at - map_window.xy)/texel;
  if (any(lessThan(st, vec2(0))) || any(greaterThanEqual(st, size))) return false;
  vec2 middle = slope + (floor(st) + 0.5 - st)*texel;
  float across = dot(plane, vec3(p.xy - at, p.z));
  float own = dot(plane, vec3(middle, 1))/across;
  float slack = max(texel.x, texel.y)/p.z + dot(abs(plane.xy), texel)/(16*abs(across));
  float nearest = texelFetch(maps, ivec3(ivec2(st), map - first_map), 0).r/near;
  return nearest > own + slack;
}
#endif

// Software renderers do both sides of a branch: weights of 0 are cheaper.
vec3 slide(vec2 slope, vec2 at, float layer) {
  vec2 st = (kappa*at - slope - window.xy)*window.zw;
  vec2 inside = step(0, st)*step(st, vec2(1));
  return inside.x*inside.y*textureLod(slides, vec3(st, layer), 0).rgb;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 point = texelFetch(position, pixel, 0);
  vec3 p = (point.xyz - center)*frame;
  if (point.w < 0 || p.z < least) discard;
  vec3 n = texelFetch(normal, pixel, 0).xyz*frame;
#ifdef GLOSS
  vec3 e = texelFetch(eye, pixel, 0).xyz*frame;
  vec3 glossy = vec3(0);
#endif
#ifdef SHADOWS
  vec3 plane = texelFetch(lift, pixel, 0).xyz*frame;
#endif
  vec3 matte = vec3(0);
  for (int k = first; k < first + count; ++k) {
    vec4 view = texelFetch(views, k);
    float part = min(k - first + 1, share.y) - max(k - first, share.x);
    vec2 slope = clamp((view.xy - p.xy)/p.z, -steep, steep);
    float height = max(dot(n.xy, slope) - n.z, 0), square = 1 + dot(slope, slope);
    vec3 light = slide(slope, view.xy, view.z);
#ifdef SHADOWS
    if (light == vec3(0) || shadowed(p, plane, int(view.w))) continue;
#endif
    light *= part;
    matte += light*(height/square/square);
#ifdef GLOSS
    float r = sqrt(square);
    float along = dot(n, normalize(vec3(slope, -1)/r + e));
    if (height > 0 && along > 0 && point.w > 0) glossy += light*(pow(along, point.w)/(r*square));
#endif
  }
  vec2 size = min(cell/p.z, steep);
  irradiance = vec4(clamp(matte*size.x*size.y, -bright, bright), 0);
#ifdef GLOSS
  gloss = vec4(clamp(glossy*size.x*size.y, -bright, bright), 0);
#endif
}
