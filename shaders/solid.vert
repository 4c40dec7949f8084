// Instruments: a shape of unit size placed by a model matrix. SHADED: shadows fall on it.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec3 a_normal;
#ifdef OUTLINE
layout(location = 2) in vec3 a_strip;  // xy: away from the shape in clip units, z: cover
#endif

uniform mat4 view_projection;
uniform mat4 model;
#ifdef SHADED
uniform mat4 shadow_matrix;
uniform sampler2DShadow shadow_map;

out float v_visible;  // visible fraction of the key light

// As of the tissue, at the vertices. The map has what is round the body; beyond it there are no shadows.
float key_visibility(vec3 place) {
  vec3 at = (shadow_matrix * vec4(place, 1.0)).xyz * 0.5 + 0.5;
  if (any(notEqual(at.xy, clamp(at.xy, 0.0, 1.0)))) return 1.0;
  return lamp_visibility(shadow_map, vec3(at.xy, min(at.z - 0.012, 1.0)));
}
#endif

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
#ifdef SHADED
  v_visible = key_visibility(v_position);
#endif
}
