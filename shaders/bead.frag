// The hemisphere that faces the eye, with its depth per pixel, so that it intersects the surface correctly.
in vec3 v_centre;

uniform mat4 view;
uniform mat4 projection;
uniform float bead_radius;
uniform vec3 key_direction;
uniform vec3 tint;

out vec4 colour;

void main() {
  vec2 d = (gl_PointCoord * 2.0 - 1.0) * vec2(1.2, -1.2);
  float r2 = dot(d, d);
  if (r2 > 1.0) discard;
  vec3 n = vec3(d, sqrt(1.0 - r2));
  vec4 clip = projection * vec4(v_centre + bead_radius * n, 1.0);
  gl_FragDepth = 0.5 + 0.5 * clip.z / clip.w;
  vec3 key = mat3(view) * key_direction;
  float facing = dot(n, key);
  float glint = smoothstep(0.93, 0.985, dot(reflect(vec3(0, 0, -1), n), key));
  vec3 light = key_colour * (0.12 + 0.88 * clamp(facing * 0.8 + 0.2, 0.0, 1.0)) + 0.5 * sky_colour;
  vec3 radiance = tint * light * mix(0.55, 1.0, n.z) + 0.9 * glint * key_colour;
  colour = vec4(to_screen(radiance, gl_FragCoord.xy), 1.0);
}
