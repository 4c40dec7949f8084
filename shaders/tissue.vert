layout(location = 0) in vec3 a_position;  // m
layout(location = 1) in vec3 a_normal;
layout(location = 2) in float a_value;    // of the field shown, 0..1 over its range; without one, of a wound: open, 0..1
layout(location = 3) in vec3 a_rest;      // rest position in body radii about the body's centre
layout(location = 4) in vec3 a_on_sphere; // position on the unit sphere, for the detail map
layout(location = 5) in vec4 a_surface;   // rgb: square root of the tint, a: ambient occlusion, 1: open
#ifdef WOUND
layout(location = 8) in float a_depth;   // below the original skin at rest, in body radii
#endif
#ifdef HATCH
layout(location = 7) in float a_beyond;   // above 0: hatched
#endif
#ifdef PAINTED
layout(location = 9) in vec2 a_place;     // in the texture
layout(location = 10) in vec4 a_colour;   // sRGB
#endif
#ifdef BURNT
layout(location = 11) in float a_burnt;   // level of heat, 0..1
#endif
#ifdef OUTLINE
layout(location = 6) in vec3 a_strip;     // xy: away from the shape in clip units, z: cover
#endif

uniform mat4 view_projection;
uniform mat4 shadow_matrix;
uniform vec3 key_direction;
uniform vec3 eye;
uniform vec4 section;  // section plane: below 0 in product with points that are left out
uniform sampler2DShadow shadow_map;

out vec3 v_normal;
out vec3 v_on_sphere;
out vec3 v_slope;     // gradient of broad bumps, in rest coordinates
out vec3 v_view;      // unit, towards the eye
out vec4 v_surface;
out float v_visible;  // visible fraction of the key light
out float v_value;
#if defined(WOUND) || defined(BURNT)
out vec3 v_rest;
#endif
#ifdef WOUND
out float v_depth;
#endif
#ifdef BURNT
out float v_burnt;
#endif
#ifdef PAINTED
out vec2 v_place;
out vec3 v_colour;
#endif
#ifdef HATCH
out float v_beyond;
#endif
out vec3 v_position;
#ifdef OUTLINE
out float v_cover;
#endif

// The lamp is wide, so its shadow is smooth enough to be computed per vertex.
float key_visibility() {
  vec3 at = (shadow_matrix * vec4(a_position, 1.0)).xyz * 0.5 + 0.5;
  at.z -= 0.012 + 0.02 * (1.0 - clamp(dot(a_normal, key_direction), 0.0, 1.0));
  return lamp_visibility(shadow_map, at);
}

void main() {
  gl_Position = view_projection * vec4(a_position, 1.0);
  gl_ClipDistance[0] = dot(section, vec4(a_position, 1.0));
#ifdef OUTLINE
  gl_Position.xyz += vec3(a_strip.xy, -strip_lift) * gl_Position.w;
  v_cover = a_strip.z;
#endif
  v_position = a_position;
  v_view = normalize(eye - a_position);
  v_normal = a_normal;
  v_on_sphere = a_on_sphere;
  vec4 broad = noise(a_rest * 4.1 + 3.7);
  v_slope = 0.10 * broad.xyz;
  v_surface = vec4(a_surface.rgb * a_surface.rgb * (0.72 + 0.56 * broad.w), a_surface.a);
#ifdef CAP
  v_visible = 1.0;  // the shadow map holds the whole body
#else
  v_visible = key_visibility();
#endif
  v_value = a_value;
#if defined(WOUND) || defined(BURNT)
  v_rest = a_rest;
#endif
#ifdef WOUND
  v_depth = a_depth;
#endif
#ifdef BURNT
  v_burnt = a_burnt;
#endif
#ifdef PAINTED
  v_place = a_place;
  v_colour = a_colour.rgb;
#endif
#ifdef HATCH
  v_beyond = a_beyond;
#endif
}
