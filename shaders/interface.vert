// Dear ImGui's triangles: pixels from the top left corner.
layout(location = 0) in vec2 a_position;
layout(location = 1) in vec2 a_at;
layout(location = 2) in vec4 a_colour;

uniform vec4 frame;  // xy: top left, zw: size, in pixels

out vec2 v_at;
out vec4 v_colour;

void main() {
  v_at = a_at;
  v_colour = a_colour;
  vec2 p = (a_position - frame.xy) / frame.zw;
  gl_Position = vec4(2.0 * p.x - 1.0, 1.0 - 2.0 * p.y, 0.0, 1.0);
}
