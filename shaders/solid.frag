// Polished metal or enamel. HIDDEN: the part behind the surface of the body, seen through it.
in vec3 v_position;
in vec3 v_normal;
#ifdef OUTLINE
in float v_cover;
#elif defined(HIDDEN)
const float v_cover = 0.42;
#else
const float v_cover = 1.0;
#endif

uniform vec3 eye;
uniform vec3 key_direction;
uniform vec3 tint;
uniform float metal;  // 1: steel, 0: enamel
#ifdef SHADED
in float v_visible;  // visible fraction of the key light
#endif

out vec4 colour;

void main() {
  vec3 n = normalize(v_normal), v = normalize(eye - v_position), r = reflect(-v, n);
  float horizon = smoothstep(-0.25, 0.10, r.y) * (0.55 + 0.45 * smoothstep(0.1, 0.9, r.y));
  vec3 room = mix(vec3(0.10, 0.13, 0.14), 1.1 * sky_colour, horizon);
  float lamp = smoothstep(0.86, 0.97, dot(r, key_direction));
  float fresnel = 0.04 + 0.96 * pow(1.0 - clamp(dot(n, v), 0.0, 1.0), 5.0);
  float lit = 0.15 + 0.85 * clamp(dot(n, key_direction), 0.0, 1.0);
#ifdef SHADED
  lit *= v_visible;
#endif
  vec3 diffuse = tint * (key_colour * lit + 0.6 * sky_colour);
  vec3 mirror = room + 2.2 * lamp * key_colour;
  colour = vec4(to_screen(mix(diffuse + fresnel * mirror, tint * mirror, metal), gl_FragCoord.xy), v_cover);
}
