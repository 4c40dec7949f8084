// Body or tool projected along the key light, or onto the ground.
layout(location = 0) in vec3 a_position;

uniform mat4 matrix;
uniform mat4 model;
uniform float ground;  // m
uniform float radius;  // m

out float v_height;    // above the ground, in body radii

void main() {
  vec4 position = model * vec4(a_position, 1.0);
  v_height = (position.y - ground) / radius;
  gl_Position = matrix * position;
}
