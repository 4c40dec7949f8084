// Instruments: a shape of unit size placed by a model matrix.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
#ifdef OUTLINE
layout(location = 2) in vec3 a_strip;  // xy: away from the shape in clip units, z: cover
#endif

uniform mat4 view_projection;
uniform mat4 model;

out vec3 v_position;
out vec3 v_normal;
#ifdef OUTLINE
out float v_cover;
#endif

void main() {
  vec4 position = model * vec4(a_position, 1.0);
  gl_Position = view_projection * position;
#ifdef OUTLINE
  gl_Position.xyz += vec3(a_strip.xy, -strip_lift) * gl_Position.w;
  v_cover = a_strip.z;
#endif
  v_position = position.xyz;
  v_normal = mat3(model) * a_normal;
}
