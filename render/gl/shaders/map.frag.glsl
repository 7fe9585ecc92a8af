// The depth is near/z: floats hold it equally well at all distances, where 1 - near/z would
// lose its digits.

uniform float near;

void main() {
  gl_FragDepth = near*gl_FragCoord.w;
}
