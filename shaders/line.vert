// Edges of the mesh, with a depth offset towards the eye.
layout(location = 0) in vec3 a_position;

uniform mat4 view_projection;
uniform vec4 section;  // as in tissue.vert

void main() {
  gl_Position = view_projection * vec4(a_position, 1.0);
  gl_ClipDistance[0] = dot(section, vec4(a_position, 1.0));
  gl_Position.z -= 0.0006 * gl_Position.w;
}
