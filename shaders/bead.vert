// A ball drawn as a point sprite.
layout(location = 0) in vec3 a_centre;  // m

uniform mat4 view;
uniform mat4 projection;
uniform vec4 section;         // as in tissue.vert
uniform float bead_radius;    // m
uniform float height;         // of the picture, pixels

out vec3 v_centre;            // in eye space

void main() {
  v_centre = (view * vec4(a_centre, 1.0)).xyz;
  gl_Position = projection * vec4(v_centre, 1.0);
  gl_ClipDistance[0] = dot(section, vec4(a_centre, 1.0));
  gl_PointSize = 1.2 * bead_radius * projection[1][1] * height / gl_Position.w + 1.0;
}
